//! One mechanism in one configuration, from a mechanism file or from a pose of a batch's job.

mod poses;

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use hyperstat_assembly::{
    Configuration, ModalOptions, Model, Motion, Prepared, Solution, SolveError,
};
use hyperstat_joints::rigid_motion;
use hyperstat_mechanisms::{
    Dependence, Design, Files, Input, Job, Mechanism, PoseError, Registry, Value,
};

use crate::drives::MissingDrives;
use crate::error::StudyError;
use crate::near::of_mechanism;
use crate::selection::{Selection, choose};
use crate::source::Written;
use crate::title::title;

/// A mechanism in one configuration, ready to be asked.
#[derive(Debug)]
pub struct Study {
    pub(crate) prepared: Prepared,
    /// The file that it is from, else its own name.
    name: String,
    files: Vec<PathBuf>,
    origin: Origin,
}

#[derive(Debug)]
enum Origin {
    Mechanism(Box<Mechanism>),
    Job {
        job: Box<Job>,
        design: Design,
        pose: usize,
        /// What the design is called: its number in the job as it was read, of a job that varies.
        number: Option<usize>,
    },
}

impl Study {
    /// Reads a mechanism file, or one pose of a job of a batch file: the first pose of the first
    /// design of its only job, where `selection` says nothing else.
    ///
    /// # Errors
    /// The file cannot be read, with the place of what is wrong in it; it holds no such job, design
    /// or pose; the pose is out of reach.
    pub fn open(
        path: &Path,
        selection: &Selection,
        files: &dyn Files,
        registry: &Registry,
    ) -> Result<Self, StudyError> {
        let loaded = hyperstat_mechanisms::load(path, files, registry)?;
        Self::of(loaded, path, selection)
    }

    /// The same of what is loaded already, from the file of this name.
    ///
    /// # Errors
    /// As [`Study::open`].
    pub fn of(loaded: Input, path: &Path, selection: &Selection) -> Result<Self, StudyError> {
        let files = loaded.files();
        match loaded {
            Input::Mechanism(mechanism) => {
                if let Some(what) = selection.given() {
                    let path = path.into();
                    return Err(StudyError::NotABatch { what, path });
                }
                Ok(Self {
                    prepared: Prepared::new(mechanism.model.clone()),
                    name: path.display().to_string(),
                    files,
                    origin: Origin::Mechanism(Box::new(mechanism)),
                })
            }
            Input::Batch(batch) => {
                let job = choose(batch.jobs, path, selection)?;
                let (design, pose) = (selection.design.unwrap_or(0), selection.pose.unwrap_or(0));
                Ok(Self {
                    files,
                    ..Self::of_job(job, design, pose)?
                })
            }
        }
    }

    /// A mechanism in its own configuration.
    pub fn of_mechanism(mechanism: Mechanism) -> Self {
        Self {
            prepared: Prepared::new(mechanism.model.clone()),
            name: mechanism.model.name.clone(),
            files: mechanism.files(),
            origin: Origin::Mechanism(Box::new(mechanism)),
        }
    }

    /// A design of a job at one of its poses, both counted from 0.
    ///
    /// # Errors
    /// The job has no such design or pose; the design makes no mechanism; the pose is out of reach.
    pub fn of_job(job: Job, design: usize, pose: usize) -> Result<Self, StudyError> {
        if design >= job.designs() {
            return Err(StudyError::NoSuchDesign {
                location: Box::new(job.location()),
                count: job.designs(),
                job: job.name,
                design,
            });
        }
        if pose >= job.len() {
            return Err(StudyError::NoSuchPose {
                location: Box::new(job.location()),
                count: job.len(),
                job: job.name,
                pose,
            });
        }
        let design = job.design(design)?;
        match design_model(&design, pose) {
            Ok(model) => Ok(Self {
                prepared: Prepared::new(model),
                name: job.name.clone(),
                files: design.mechanism().map_or_else(Vec::new, Mechanism::files),
                origin: Origin::Job {
                    number: (!job.varied().is_empty()).then_some(design.number()),
                    job: Box::new(job),
                    design,
                    pose,
                },
            }),
            Err(source) => Err(StudyError::Pose {
                near: design.mechanism().and_then(of_mechanism),
                location: Box::new(job.location()),
                job: job.name,
                pose,
                source: Box::new(source),
            }),
        }
    }

    /// The same mechanism in the same pose with other values in some places, named by their paths as
    /// `vary` names them (`sections.rod.diameter`, `rod.section.diameter` of a prebuilt mechanism), SI.
    ///
    /// # Errors
    /// A path that leads nowhere, what is wrong with the mechanism that the values make, or a pose that
    /// it does not reach.
    pub fn with_values<P: AsRef<str>, V: Clone + Into<Value>>(
        &self,
        values: &[(P, V)],
    ) -> Result<Self, StudyError> {
        match &self.origin {
            Origin::Mechanism(mechanism) => Ok(Self {
                name: self.name.clone(),
                files: self.files.clone(),
                ..Self::of_mechanism(mechanism.with_values(values)?)
            }),
            Origin::Job {
                job,
                design,
                pose,
                number,
            } => {
                // Beside what the design has already, where the job varies it.
                let changed = job.with_values(design.number(), values)?;
                let mut study = Self::of_job(changed, 0, *pose)?;
                study.files.clone_from(&self.files);
                if let Origin::Job { number: own, .. } = &mut study.origin {
                    // It goes on to be called what it was.
                    *own = *number;
                }
                Ok(study)
            }
        }
    }

    /// The mechanism as data, in its configuration.
    pub fn model(&self) -> &Model {
        self.prepared.model()
    }

    /// The mechanism in its configuration: what is found of it is found once.
    pub fn here(&self) -> Configuration<'_> {
        self.prepared.here()
    }

    /// All files that were read for it.
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// Names values of the model by their paths in the mechanism, as `vary` takes them.
    pub fn name_values(&mut self) {
        match &self.origin {
            Origin::Mechanism(mechanism) => mechanism.name_values(self.prepared.model_mut()),
            Origin::Job { job, design, .. } => job.name_values(design, self.prepared.model_mut()),
        }
    }

    /// The parameters of the mechanism, and what depends on each.
    pub fn dependences(&self) -> Vec<Dependence> {
        match &self.origin {
            Origin::Mechanism(mechanism) => mechanism.dependences(),
            Origin::Job { job, design, .. } => job.dependences(design),
        }
    }

    /// The numbers that say where its parts stand and how long they are, by their paths as `vary` takes them, SI.
    pub(crate) fn placing(&self) -> Vec<(String, f64)> {
        match &self.origin {
            Origin::Mechanism(mechanism) => mechanism.placing(),
            Origin::Job { job, design, .. } => job.placing(design),
        }
    }

    /// What its job varies, by its path, and its value in this design.
    pub(crate) fn varied_values(&self) -> Vec<(String, Value)> {
        match &self.origin {
            Origin::Mechanism(_) => Vec::new(),
            Origin::Job { job, design, .. } => {
                let varied = job.varied().iter().zip(design.values());
                let varied = varied.map(|(varied, value)| (varied.path.clone(), value.clone()));
                varied.collect()
            }
        }
    }

    /// What it is called beside others: its file, or its job, design and pose.
    pub(crate) fn called(&self) -> String {
        match self.job() {
            Some((job, pose)) => title(job, self.design(), Some(pose), None),
            None => self.name.clone(),
        }
    }

    /// Job and pose that it is from.
    pub fn job(&self) -> Option<(&str, usize)> {
        match &self.origin {
            Origin::Mechanism(_) => None,
            Origin::Job { job, pose, .. } => Some((&job.name, *pose)),
        }
    }

    /// The job that it is of, and its pose in it.
    #[cfg(feature = "figures")]
    pub(crate) fn of_pose(&self) -> Option<(&Job, usize)> {
        match &self.origin {
            Origin::Mechanism(_) => None,
            Origin::Job { job, pose, .. } => Some((job, *pose)),
        }
    }

    /// Number of the design that it is, of a job that varies.
    pub fn design(&self) -> Option<usize> {
        match &self.origin {
            Origin::Job { number, .. } => *number,
            Origin::Mechanism(_) => None,
        }
    }

    /// Solves the mechanism.
    ///
    /// # Errors
    /// It has no solution. What is unrestrained is named, with its place in the file.
    pub fn solve(&self) -> Result<Solution, StudyError> {
        self.here().solve().map_err(|error| self.unsolvable(error))
    }

    /// Solves the mechanism, whose output must not move freely.
    ///
    /// # Errors
    /// As [`Study::solve`]; the output moves freely.
    pub fn solve_held(&self) -> Result<Solution, StudyError> {
        let solution = self.solve()?;
        self.free_output(&solution).map_or(Ok(solution), Err)
    }

    /// A solution of it, or what of it a case by this name has.
    ///
    /// # Errors
    /// It has no such case.
    pub fn under<'s>(
        &self,
        solution: &'s Solution,
        case: Option<&str>,
    ) -> Result<Cow<'s, Solution>, StudyError> {
        let Some(name) = case else {
            return Ok(Cow::Borrowed(solution));
        };
        let found = solution.of_case(name).map(Cow::Owned);
        found.ok_or_else(|| StudyError::UnknownCase {
            of: match self.job() {
                Some((job, _)) => format!("job `{job}`"),
                None => self.name.clone(),
            },
            case: name.into(),
            known: (solution.cases.iter())
                .map(|case| case.name.clone())
                .collect(),
        })
    }

    /// The error of the mechanism having no such result, with its place in the file.
    pub(crate) fn unsolvable(&self, error: SolveError) -> StudyError {
        self.source().unsolvable(&self.here(), error)
    }

    /// Title of a figure of it, under the loads of a case.
    pub fn title(&self, case: Option<&str>) -> String {
        match self.job() {
            Some((job, pose)) => title(job, self.design(), Some(pose), case),
            None => title(&self.model().name, None, None, case),
        }
    }

    /// The idle motions, which do not depend on the loads; `None` where there is no solution even
    /// without loads.
    pub(crate) fn idle_motions(&self) -> Option<Vec<Motion>> {
        self.here().idle_motions().ok()
    }

    /// The design of a job that it is a pose of, or the mechanism as one.
    pub(crate) fn as_design(&self) -> Design {
        match &self.origin {
            Origin::Mechanism(mechanism) => mechanism.design(),
            Origin::Job { design, .. } => design.clone(),
        }
    }

    /// The natural frequencies that its job asks for.
    pub(crate) fn modes_of_job(&self) -> Option<&ModalOptions> {
        match &self.origin {
            Origin::Mechanism(_) => None,
            Origin::Job { job, .. } => job.frequencies(),
        }
    }

    /// The job that it is a pose of.
    pub(crate) fn whole_job(&self) -> Option<&Job> {
        match &self.origin {
            Origin::Mechanism(_) => None,
            Origin::Job { job, .. } => Some(job),
        }
    }

    /// The mechanism that it is, where it is one of a file; `None` of a job, which may replace loads and
    /// values of it.
    pub fn mechanism(&self) -> Option<&Mechanism> {
        match &self.origin {
            Origin::Mechanism(mechanism) => Some(mechanism),
            Origin::Job { .. } => None,
        }
    }

    /// The mechanism file that it is from, where it is from one, of a job too.
    pub(crate) fn file(&self) -> Option<&Mechanism> {
        match &self.origin {
            Origin::Mechanism(mechanism) => Some(mechanism),
            Origin::Job { design, .. } => design.mechanism(),
        }
    }

    /// The error of an output that moves freely in a solution of it, in words, with the drives that
    /// could hold it; `None` where it is held.
    pub fn free_output(&self, solution: &Solution) -> Option<StudyError> {
        if solution.output.free_motions.is_empty() {
            return None;
        }
        let model = self.model();
        let output = model.output()?;
        let body = model.nodes()[output.0].body;
        let origin = model.bodies()[body.0].nodes[0];
        let positions = &model.geometry().positions;
        // A motion is given by its twist at the body's first node.
        let shift = rigid_motion(&(positions[origin.0] - positions[output.0]));
        let in_words = |twist| {
            let twists = vec![(body, shift * twist)];
            Motion { twists }.describe(model)
        };
        Some(StudyError::FreeOutput {
            location: Box::new(self.source().output()),
            output: model.node_name(output),
            motions: solution.output.free_motions.iter().map(in_words).collect(),
            drives: Box::new(MissingDrives::of(&self.here(), body)),
        })
    }

    /// The mechanism in this configuration as a mechanism file (RON).
    ///
    /// # Errors
    /// It has parts that no file can state.
    pub fn mechanism_file(&self, registry: &Registry) -> Result<String, StudyError> {
        hyperstat_mechanisms::write(self.model(), registry).map_err(|source| StudyError::Export {
            location: Box::new(self.source().output()),
            source,
        })
    }

    /// The same in JSON.
    ///
    /// # Errors
    /// As [`Study::mechanism_file`].
    pub fn mechanism_file_json(&self, registry: &Registry) -> Result<String, StudyError> {
        let written = hyperstat_mechanisms::write_json(self.model(), registry);
        written.map_err(|source| StudyError::Export {
            location: Box::new(self.source().output()),
            source,
        })
    }

    pub(crate) fn source(&self) -> Written<'_> {
        match &self.origin {
            Origin::Mechanism(mechanism) => Written::Mechanism(mechanism),
            Origin::Job { job, design, .. } => Written::Design(job, design),
        }
    }
}

/// The model of a job's first design that can be, at one of its poses.
pub(crate) fn job_model(job: &Job, pose: usize) -> Result<Model, PoseError> {
    let mut model = job.model()?;
    let mut geometry = model.geometry().clone();
    job.place(pose, &mut geometry)?;
    model.set_geometry(geometry)?;
    Ok(model)
}

/// The model of a design at one of its poses.
fn design_model(design: &Design, pose: usize) -> Result<Model, PoseError> {
    let mut model = design.model()?;
    let mut geometry = model.geometry().clone();
    design.place(pose, &mut geometry)?;
    model.set_geometry(geometry)?;
    Ok(model)
}
