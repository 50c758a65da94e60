//! One mechanism in one configuration, from a mechanism file or from a pose of a batch's job.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use hyperstat_assembly::{
    BeamMass, BodyId, Connection, JointId, ModalOptions, ModalPlan, Model, Modes, Motion, Solution,
    SolveError,
};
use hyperstat_joints::rigid_motion;
use hyperstat_mechanisms::{Design, Input, Job, Location, Mechanism, PoseError, Registry};
use hyperstat_reference::ReferenceSolution;

use crate::args;
use crate::drawing;
use crate::drives::MissingDrives;
use crate::error::CliError;
use crate::report::{Asked, FrequencyReport, SolveReport, Why};
use crate::verification::Verification;

/// A mechanism in one configuration, ready to be solved.
#[derive(Debug)]
pub(crate) struct Case {
    pub(crate) model: Model,
    /// All files that were read for it.
    pub(crate) files: Vec<PathBuf>,
    origin: Origin,
}

#[derive(Debug)]
enum Origin {
    Mechanism(Box<Mechanism>),
    Job {
        job: Box<Job>,
        design: Design,
        pose: usize,
    },
}

impl Case {
    /// Loads what the command line names.
    pub(crate) fn load(input: &args::Input, registry: &Registry) -> Result<Self, CliError> {
        let loaded =
            hyperstat_mechanisms::load(&input.file, &hyperstat_mechanisms::Disk, registry)?;
        let files = loaded.files();
        match loaded {
            Input::Mechanism(mechanism) => {
                for (option, given) in [
                    ("--job", input.job.is_some()),
                    ("--design", input.design.is_some()),
                    ("--pose", input.pose.is_some()),
                ] {
                    if given {
                        let path = input.file.clone();
                        return Err(CliError::NotABatch { option, path });
                    }
                }
                Ok(Self {
                    model: mechanism.model.clone(),
                    files,
                    origin: Origin::Mechanism(Box::new(mechanism)),
                })
            }
            Input::Batch(batch) => {
                let job = choose(batch.jobs, input)?;
                let (design, pose) = (input.design.unwrap_or(0), input.pose.unwrap_or(0));
                Self::of_job(job, design, pose, files)
            }
        }
    }

    fn of_job(job: Job, design: usize, pose: usize, files: Vec<PathBuf>) -> Result<Self, CliError> {
        if design >= job.designs() {
            return Err(CliError::NoSuchDesign {
                location: Box::new(job.location()),
                count: job.designs(),
                job: job.name,
                design,
            });
        }
        if pose >= job.len() {
            return Err(CliError::NoSuchPose {
                location: Box::new(job.location()),
                count: job.len(),
                job: job.name,
                pose,
            });
        }
        let design = job.design(design)?;
        match design_model(&design, pose) {
            Ok(model) => Ok(Self {
                model,
                files,
                origin: Origin::Job {
                    job: Box::new(job),
                    design,
                    pose,
                },
            }),
            Err(source) => Err(CliError::Pose {
                location: Box::new(job.location()),
                job: job.name,
                pose,
                source: Box::new(source),
            }),
        }
    }

    /// Names values of the model by their paths in the mechanism, as `vary` takes them.
    pub(crate) fn name_values(&mut self) {
        match &self.origin {
            Origin::Mechanism(mechanism) => mechanism.name_values(&mut self.model),
            Origin::Job { job, design, .. } => job.name_values(design, &mut self.model),
        }
    }

    /// Job and pose that it is from.
    pub(crate) fn job(&self) -> Option<(&str, usize)> {
        match &self.origin {
            Origin::Mechanism(_) => None,
            Origin::Job { job, pose, .. } => Some((&job.name, *pose)),
        }
    }

    /// Number of the design that it is, of a job that varies.
    pub(crate) fn design(&self) -> Option<usize> {
        match &self.origin {
            Origin::Job { job, design, .. } if !job.varied().is_empty() => Some(design.number()),
            _ => None,
        }
    }

    /// Solves the mechanism. What is unrestrained is named, with its place in the file.
    pub(crate) fn solve(&self) -> Result<Solution, CliError> {
        hyperstat_assembly::solve(&self.model).map_err(|error| self.unsolvable(error))
    }

    /// Solves the mechanism, whose output must not move freely.
    pub(crate) fn solve_held(&self) -> Result<Solution, CliError> {
        let solution = self.solve()?;
        self.free_output(&solution).map_or(Ok(solution), Err)
    }

    /// Its solution, or that under the loads of a case by the name that `--case` gives; `file` is what
    /// it was loaded from.
    pub(crate) fn under<'s>(
        &self,
        solution: &'s Solution,
        case: Option<&str>,
        file: &Path,
    ) -> Result<Cow<'s, Solution>, CliError> {
        let Some(name) = case else {
            return Ok(Cow::Borrowed(solution));
        };
        let found = solution.of_case(name).map(Cow::Owned);
        found.ok_or_else(|| CliError::UnknownCase {
            of: match self.job() {
                Some((job, _)) => format!("job `{job}`"),
                None => file.display().to_string(),
            },
            case: name.into(),
            known: (solution.cases.iter())
                .map(|case| case.name.clone())
                .collect(),
        })
    }

    /// The error of the mechanism having no such result, with its place in the file.
    pub(crate) fn unsolvable(&self, error: SolveError) -> CliError {
        self.source().unsolvable(&self.model, error)
    }

    /// Title of a figure of it, under the loads of a case.
    pub(crate) fn title(&self, case: Option<&str>) -> String {
        match self.job() {
            Some((job, pose)) => drawing::title(job, self.design(), Some(pose), case),
            None => drawing::title(&self.model.name, None, None, case),
        }
    }

    /// The natural frequencies that are asked for, by the command line or the job: how many, and
    /// whether masses are lumped.
    pub(crate) fn modal_options(&self, count: Option<usize>, lumped: bool) -> Option<ModalOptions> {
        let of_job = match &self.origin {
            Origin::Mechanism(_) => None,
            Origin::Job { job, .. } => job.modes.clone(),
        };
        let mut options = match (count, of_job) {
            (Some(count), Some(of_job)) => ModalOptions { count, ..of_job },
            (Some(count), None) => ModalOptions::lowest(count),
            (None, of_job) => of_job?,
        };
        if lumped {
            options.mass = BeamMass::Lumped;
        }
        Some(options)
    }

    /// Natural frequencies and modes.
    pub(crate) fn modes(&self, options: &ModalOptions) -> Result<Modes, CliError> {
        hyperstat_assembly::modes(&self.model, options).map_err(|error| self.unsolvable(error))
    }

    /// Adds what changes natural frequencies.
    pub(crate) fn add_frequencies(
        &self,
        options: &ModalOptions,
        report: &mut SolveReport,
    ) -> Result<(), CliError> {
        let found = ModalPlan::new(&self.model, options)
            .and_then(|plan| plan.sensitivities(self.model.geometry()))
            .map_err(|error| self.source().unsolvable(&self.model, error))?;
        report.add_frequencies(FrequencyReport::all(self, &found), found.complete);
        Ok(())
    }

    /// The solution as a VTU file, with its modes where there are some.
    pub(crate) fn vtu(
        &self,
        solution: &Solution,
        modes: Option<&Modes>,
    ) -> Result<String, CliError> {
        crate::vtu::vtu(&self.model, solution, modes).map_err(|error| self.unsolvable(error))
    }

    /// Adds displacements of the nodes inside segments, by the name of each: `body.A-B.k`.
    pub(crate) fn add_inner_displacements(
        &self,
        solution: &Solution,
        report: &mut SolveReport,
    ) -> Result<(), CliError> {
        report
            .add_inner_displacements(&self.model, solution)
            .map_err(|error| self.unsolvable(error))
    }

    /// What is soft and why: the answer to a question about this solution.
    pub(crate) fn why(&self, solution: &Solution, asked: Asked<'_>) -> Result<Why, CliError> {
        Why::new(self, solution, asked).map_err(|error| self.unsolvable(error))
    }

    /// The idle motions, which do not depend on the loads; `None` where there is no solution even
    /// without loads.
    pub(crate) fn idle_motions(&self) -> Option<Vec<Motion>> {
        let mut unloaded = self.model.clone();
        unloaded.clear_loads();
        let solution = hyperstat_assembly::solve(&unloaded).ok()?;
        Some(solution.idle)
    }

    /// The mechanism file that it is from, where it is from one.
    pub(crate) fn mechanism(&self) -> Option<&Mechanism> {
        match &self.origin {
            Origin::Mechanism(mechanism) => Some(mechanism),
            Origin::Job { design, .. } => design.mechanism(),
        }
    }

    /// The error that a solution means on the command line: an output that moves freely.
    pub(crate) fn free_output(&self, solution: &Solution) -> Option<CliError> {
        if solution.output.free_motions.is_empty() {
            return None;
        }
        let model = &self.model;
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
        Some(CliError::FreeOutput {
            location: Box::new(self.source().output()),
            output: model.node_name(output),
            motions: solution.output.free_motions.iter().map(in_words).collect(),
            drives: Box::new(MissingDrives::of(model, body)),
        })
    }

    /// Compares a solution with the independent solver's.
    pub(crate) fn verify(&self, solution: &Solution) -> Result<Verification, CliError> {
        Ok(Verification::new(&self.model, solution, &self.reference()?))
    }

    /// The independent solver's solution.
    pub(crate) fn reference(&self) -> Result<ReferenceSolution, CliError> {
        hyperstat_reference::solve(&self.model).map_err(CliError::Unverified)
    }

    /// The mechanism in this configuration as a mechanism file.
    pub(crate) fn mechanism_file(&self, registry: &Registry) -> Result<String, CliError> {
        hyperstat_mechanisms::write(&self.model, registry).map_err(|source| CliError::Export {
            location: Box::new(self.source().output()),
            source,
        })
    }

    fn source(&self) -> Source<'_> {
        match &self.origin {
            Origin::Mechanism(mechanism) => Source::Mechanism(mechanism),
            Origin::Job { job, design, .. } => Source::Design(job, design),
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

fn choose(mut jobs: Vec<Job>, input: &args::Input) -> Result<Job, CliError> {
    let path = || input.file.clone();
    let known: Vec<String> = jobs.iter().map(|job| job.name.clone()).collect();
    let place = match &input.job {
        Some(name) => {
            known
                .iter()
                .position(|job| job == name)
                .ok_or_else(|| CliError::UnknownJob {
                    path: path(),
                    job: name.clone(),
                    known: known.clone(),
                })?
        }
        None if jobs.len() == 1 => 0,
        None => {
            return Err(CliError::ChooseJob {
                path: path(),
                known,
            });
        }
    };
    Ok(jobs.swap_remove(place))
}

/// Where the parts of a model are written.
pub(crate) enum Source<'a> {
    /// In a mechanism file.
    Mechanism(&'a Mechanism),
    /// In a job's mechanism file, where it has one, else in the job itself.
    Job(&'a Job),
    /// The same of one design.
    Design(&'a Job, &'a Design),
}

impl Source<'_> {
    /// The error of a model that has no solution, at the place that is to blame.
    pub(crate) fn unsolvable(&self, model: &Model, error: SolveError) -> CliError {
        let location = match &error {
            SolveError::Unheld { bodies } => {
                let body = bodies.first().and_then(|name| model.body(name));
                body.map_or_else(|| self.output(), |body| self.body(body))
            }
            SolveError::NoDensity { body } => {
                let body = model.body(body);
                body.map_or_else(|| self.output(), |body| self.body(body))
            }
            SolveError::Misfit { joints } => self.joint(model, joints.first()),
            SolveError::PreloadOnFreeMotion { joint, .. } => self.joint(model, Some(joint)),
            SolveError::LoadOnFreeMotion {
                load: Some(load), ..
            } => self.load(*load),
            SolveError::LoadOnFreeMotion { body, .. } => self.body(*body),
            _ => self.output(),
        };
        let drives = match &error {
            SolveError::LoadOnFreeMotion { body, .. }
            | SolveError::PreloadOnFreeMotion { body, .. } => MissingDrives::of(model, *body),
            _ => MissingDrives::default(),
        };
        CliError::Unsolvable {
            location: Box::new(location),
            source: error,
            drives: Box::new(drives),
        }
    }

    fn body(&self, body: BodyId) -> Location {
        self.at(|mechanism| mechanism.locate_body(body))
    }

    /// Place of a joint by its name; of the output, where none is named.
    fn joint(&self, model: &Model, name: Option<&String>) -> Location {
        let named = |joint: &Connection| name == Some(&joint.name);
        match model.joints().iter().position(named) {
            Some(place) => self.at(|mechanism| mechanism.locate_joint(JointId(place))),
            None => self.output(),
        }
    }

    fn output(&self) -> Location {
        self.at(Mechanism::locate_output)
    }

    fn load(&self, load: usize) -> Location {
        self.at(|mechanism| mechanism.locate_load(load))
    }

    fn at(&self, locate: impl Fn(&Mechanism) -> Location) -> Location {
        match self {
            Self::Mechanism(mechanism) => locate(mechanism),
            Self::Job(job) => job.mechanism().map_or_else(|| job.location(), locate),
            Self::Design(job, design) => {
                let mechanism = design.mechanism();
                mechanism.map_or_else(|| job.location(), locate)
            }
        }
    }
}
