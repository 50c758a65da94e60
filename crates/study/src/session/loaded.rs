//! What is loaded: a mechanism in a configuration, and the same as the only design of a job that is brought to
//! other poses.

use hyperstat_assembly::Geometry;
use hyperstat_joints::Dof;
use hyperstat_mechanisms::{Design, Input, Job, JobPoses, MemoryFiles, Placing, Registry};
use serde::Serialize;

use super::frame::Moving;
use super::map::Ready;
use super::refused::{Refusal, Refused};
use super::request::{Load, PoseAsked, ValueAsked};
use crate::error::StudyError;
use crate::scene;
use crate::schema::COORDINATES;
use crate::selection::Selection;
use crate::study::Study;
use crate::sweep::placing;

/// What is loaded, with what was worked out of it.
#[derive(Debug)]
pub(super) struct Subject {
    pub(super) study: Study,
    registry: Registry,
    jobs: Vec<JobInfo>,
    /// The design of the study alone, in all poses of its job.
    pub(super) job: Job,
    pub(super) design: Design,
    /// Its pose, and how it is reached; `None` where it has none of its own.
    pub(super) pose: Option<[f64; 6]>,
    drives: Option<Vec<f64>>,
    /// What was asked last at a pose of its own.
    posed: Option<(PoseAsked, Study)>,
    pub(super) moving: Option<Moving>,
    pub(super) ready: Option<Ready>,
}

/// What is known of a file that was loaded. Field names are those of the JSON.
#[derive(Debug, Serialize)]
pub struct Loaded {
    /// Name of the mechanism.
    pub name: String,
    /// `mechanism` or `batch`.
    pub kind: &'static str,
    /// The jobs of a batch.
    pub jobs: Vec<JobInfo>,
    /// The job.
    pub job: Option<String>,
    /// Number of the design, of a job that varies.
    pub design: Option<usize>,
    /// Number of the pose.
    pub pose: Option<usize>,
    /// Names of the load cases.
    pub cases: Vec<String>,
    /// Coordinates of the output that it is moved by.
    pub coordinates: Vec<Movable>,
    /// Drives that it is moved by.
    pub drives: Vec<Movable>,
    /// How large it is \[m\].
    pub size: f64,
    /// Names of the files that were read.
    pub files: Vec<String>,
    /// What the reader should know.
    pub warnings: Vec<String>,
    /// What is no fault, but may be a slip.
    pub notes: Vec<String>,
    /// Why it cannot be solved.
    pub problem: Option<Refusal>,
}

/// A job of a batch.
#[derive(Debug, Clone, Serialize)]
pub struct JobInfo {
    /// Its name.
    pub name: String,
    /// How many poses it has.
    pub poses: usize,
    /// How many designs.
    pub designs: usize,
}

/// A coordinate or a drive.
#[derive(Debug, Clone, Serialize)]
pub struct Movable {
    /// `x` to `rz`, or `joint.direction`.
    pub name: String,
    /// `m` or `rad`.
    pub unit: &'static str,
    /// Its value.
    pub value: f64,
    /// The least value over the poses of the job, or a guess.
    pub from: f64,
    /// The largest.
    pub to: f64,
}

impl Subject {
    /// Reads a file among others.
    pub(super) fn load(given: Load, registry: &Registry) -> Result<Self, Refused> {
        let files: MemoryFiles = given.files.into_iter().collect();
        let path = given.main.as_ref();
        let input = hyperstat_mechanisms::load(path, &files, registry)?;
        let jobs: Vec<JobInfo> = match &input {
            Input::Batch(batch) => batch.jobs.iter().map(JobInfo::of).collect(),
            Input::Mechanism(_) => Vec::new(),
        };
        let selection = Selection {
            // The first, where none is chosen: there is something to show, and the others are told.
            job: given.job.or_else(|| Some(jobs.first()?.name.clone())),
            design: given.design,
            pose: given.pose,
        };
        let study = Study::of_first(input, path, &selection)?;
        Self::of(study, jobs, registry)
    }

    fn of(study: Study, jobs: Vec<JobInfo>, registry: &Registry) -> Result<Self, Refused> {
        let job = study.alone(registry)?;
        let design = job.design(0)?;
        let (pose, drives) = own_pose(&study, &job, &design);
        Ok(Self {
            study,
            registry: registry.clone(),
            jobs,
            job,
            design,
            pose,
            drives,
            posed: None,
            moving: None,
            ready: None,
        })
    }

    /// The same with other values at some paths.
    pub(super) fn with_values(&self, values: &[(String, ValueAsked)]) -> Result<Self, Refused> {
        let changed = self.study.with_values(values)?;
        Self::of(changed, self.jobs.clone(), &self.registry)
    }

    /// What is known of it.
    pub(super) fn loaded(&self) -> Result<Loaded, Refused> {
        let study = &self.study;
        let model = study.model();
        let (check, error) = study.check();
        let size = scene::size(model);
        Ok(Loaded {
            name: model.name.clone(),
            kind: match study.job() {
                Some(_) => "batch",
                None => "mechanism",
            },
            jobs: self.jobs.clone(),
            job: study.job().map(|(job, _)| job.into()),
            design: study.design(),
            pose: study.job().map(|(_, pose)| pose),
            cases: model.cases().iter().map(|case| case.name.clone()).collect(),
            coordinates: self.coordinates(size),
            drives: self.drives(),
            size,
            files: (study.files().iter())
                .map(|path| path.display().to_string())
                .collect(),
            warnings: check.warnings,
            notes: check.notes,
            problem: error.as_ref().map(Refusal::from),
        })
    }

    fn coordinates(&self, size: f64) -> Vec<Movable> {
        /// Of its size, or of a turn of 1 rad, that it is moved by where no poses say how far.
        const GUESS: f64 = 0.25;
        let commanded = self.job.commanded();
        let taken = self.design.coordinates();
        let named = |name: &str| commanded.iter().find(|own| own.name == name);
        let coordinate = |place: usize| {
            let name = COORDINATES[place];
            let value = self.pose.map_or(0.0, |pose| pose[place]);
            let values = named(name).map_or(&[][..], |own| &own.values);
            let from = values.iter().copied().fold(value, f64::min);
            let to = values.iter().copied().fold(value, f64::max);
            let reach = if place < 3 { size * GUESS } else { GUESS };
            let guess = if from < to { 0.0 } else { reach };
            Movable {
                name: name.into(),
                unit: if place < 3 { "m" } else { "rad" },
                value,
                from: from - guess,
                to: to + guess,
            }
        };
        let is_moved = |place: &usize| taken[*place];
        (0..6).filter(is_moved).map(coordinate).collect()
    }

    fn drives(&self) -> Vec<Movable> {
        let all: Vec<_> = self.study.model().drives().collect();
        let commanded = self.job.commanded();
        let size = scene::size(self.study.model());
        let drives = self.design.drives().into_iter();
        drives
            .map(|(joint, dof): (_, Dof)| {
                let name = format!("{}.{dof}", self.study.model().joints()[joint.0].name);
                let place = all.iter().position(|own| *own == (joint, dof));
                let values = self.drives.as_ref();
                let value = values.and_then(|values| values.get(place?).copied());
                let value = value.unwrap_or(0.0);
                let own = commanded.iter().find(|own| own.name == name);
                let values = own.map_or(&[][..], |own| &own.values);
                let from = values.iter().copied().fold(value, f64::min);
                let to = values.iter().copied().fold(value, f64::max);
                let reach = if dof.is_rotation() { 0.5 } else { 0.25 * size };
                let guess = if from < to { 0.0 } else { reach };
                Movable {
                    name,
                    unit: if dof.is_rotation() { "rad" } else { "m" },
                    value,
                    from: from - guess,
                    to: to + guess,
                }
            })
            .collect()
    }

    /// Asks the study at a pose, or at that which was loaded.
    pub(super) fn at<T>(
        &mut self,
        pose: Option<&PoseAsked>,
        ask: impl FnOnce(&mut Study) -> Result<T, StudyError>,
    ) -> Result<T, Refused> {
        let Some(pose) = pose else {
            return Ok(ask(&mut self.study)?);
        };
        let kept = self.posed.take().filter(|(own, _)| own == pose);
        let (_, study) = match kept {
            Some(kept) => self.posed.insert(kept),
            None => {
                let study = self.posed_at(pose)?;
                self.posed.insert((pose.clone(), study))
            }
        };
        Ok(ask(study)?)
    }

    /// The study at a pose.
    fn posed_at(&self, pose: &PoseAsked) -> Result<Study, Refused> {
        if let PoseAsked::Number(number) = pose {
            return Ok(Study::of_job(self.job.clone(), 0, *number)?);
        }
        let mut job = self.job.clone();
        let named = match pose {
            PoseAsked::At(asked) => self.whole(asked)?,
            PoseAsked::Drives(drives) => drives.iter().map(|(k, v)| (k.clone(), *v)).collect(),
            PoseAsked::Number(_) => Vec::new(),
        };
        let (columns, rows) = named.into_iter().unzip();
        job.set_poses(JobPoses::Table { columns, rows })?;
        Ok(Study::of_job(job, 0, 0)?)
    }

    /// Coordinates as a table of poses has them: of a prebuilt mechanism all six, those that are not given as
    /// in the pose that was loaded.
    pub(super) fn whole<'a>(
        &self,
        asked: impl IntoIterator<Item = (&'a String, &'a f64)>,
    ) -> Result<Vec<(String, f64)>, Refused> {
        let asked: Vec<(&String, &f64)> = asked.into_iter().collect();
        let is_known = |name: &&String| COORDINATES.contains(&name.as_str());
        if let Some((name, _)) = asked.iter().find(|(name, _)| !is_known(name)) {
            return Err(unknown_coordinate(name));
        }
        let find = |name: &str| asked.iter().find(|(own, _)| *own == name);
        let given = |name: &str| find(name).map(|(_, value)| **value);
        if self.design.mechanism().is_some() {
            let all = COORDINATES.into_iter();
            let named = all.filter_map(|name| Some((name.to_owned(), given(name)?)));
            return Ok(named.collect());
        }
        let taken = self.design.coordinates();
        let own = |place: usize| match (taken[place], self.pose) {
            (true, Some(pose)) => pose[place],
            _ => 0.0,
        };
        let all = COORDINATES.into_iter().enumerate();
        let value = |(place, name): (usize, &str)| {
            (name.to_owned(), given(name).unwrap_or_else(|| own(place)))
        };
        Ok(all.map(value).collect())
    }
}

impl JobInfo {
    fn of(job: &Job) -> Self {
        Self {
            name: job.name.clone(),
            poses: job.len(),
            designs: job.designs(),
        }
    }
}

/// The whole pose of a study, and the values of its drives.
fn own_pose(study: &Study, job: &Job, design: &Design) -> (Option<[f64; 6]>, Option<Vec<f64>>) {
    let pose = study.job().map_or(0, |(_, pose)| pose);
    if pose >= job.len() {
        return (None, None);
    }
    let mut geometry: Geometry = study.model().geometry().clone();
    let mut placing: Placing = placing();
    placing.keep_drives();
    let geometries = std::slice::from_mut(&mut geometry);
    let [first, ..] = design.place_lanes(pose..pose + 1, geometries, &mut placing);
    let reached = first.and_then(Result::ok);
    (reached, placing.drives(0).map(<[f64]>::to_vec))
}

/// A coordinate that there is not.
pub(super) fn unknown_coordinate(name: &str) -> Refused {
    Refused::Unknown {
        message: format!("`{name}` is no coordinate of a pose"),
        help: format!("those are {}", COORDINATES.join(", ")),
    }
}
