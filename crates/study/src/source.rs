//! Where the parts of a model are written, for errors with their places.

use hyperstat_assembly::{BodyId, Configuration, Connection, JointId, Model, SolveError};
use hyperstat_mechanisms::{Design, Job, Location, Mechanism};

use crate::drives::MissingDrives;
use crate::error::StudyError;

/// Where the parts of a model are written.
pub(crate) enum Written<'a> {
    /// In a mechanism file.
    Mechanism(&'a Mechanism),
    /// In a job's mechanism file, where it has one, else in the job itself.
    #[cfg(feature = "figures")]
    Job(&'a Job),
    /// The same of one design.
    Design(&'a Job, &'a Design),
}

impl Written<'_> {
    /// The error of a model that has no solution, at the place that is to blame.
    pub(crate) fn unsolvable(&self, here: &Configuration<'_>, error: SolveError) -> StudyError {
        let model = here.model();
        let location = match &error {
            SolveError::Unheld { bodies } => {
                let body = bodies.first().and_then(|name| model.body(name));
                body.map_or_else(|| self.output(), |body| self.body(body))
            }
            SolveError::NoDensity { body } => match (self.job(), model.body(body)) {
                (Some(job), _) => job.masses_location(),
                (None, Some(body)) => self.body(body),
                (None, None) => self.output(),
            },
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
            | SolveError::PreloadOnFreeMotion { body, .. } => MissingDrives::of(here, *body),
            _ => MissingDrives::default(),
        };
        StudyError::Unsolvable {
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

    pub(crate) fn output(&self) -> Location {
        self.at(Mechanism::locate_output)
    }

    fn load(&self, load: usize) -> Location {
        self.at(|mechanism| mechanism.locate_load(load))
    }

    /// The job, where the model is written in it alone.
    fn job(&self) -> Option<&Job> {
        match self {
            Self::Mechanism(_) => None,
            #[cfg(feature = "figures")]
            Self::Job(job) => job.mechanism().is_none().then_some(job),
            Self::Design(job, design) => design.mechanism().is_none().then_some(job),
        }
    }

    fn at(&self, locate: impl Fn(&Mechanism) -> Location) -> Location {
        match self {
            Self::Mechanism(mechanism) => locate(mechanism),
            #[cfg(feature = "figures")]
            Self::Job(job) => job.mechanism().map_or_else(|| job.location(), locate),
            Self::Design(job, design) => {
                let mechanism = design.mechanism();
                mechanism.map_or_else(|| job.location(), locate)
            }
        }
    }
}
