//! A study in other poses: the first of a job that can be taken, another one, any.

use std::path::Path;

use hyperstat_assembly::{Geometry, Prepared, SolveError};
use hyperstat_mechanisms::{Design, Input, Job, JobMechanism, JobPoses, Registry};

use super::{Origin, Study};
use crate::error::StudyError;
use crate::near::of_mechanism;
use crate::selection::{Selection, choose};

impl Study {
    /// [`Study::of`] at the first pose of the job that can be taken, where none is chosen.
    ///
    /// # Errors
    /// As there; of a job of which no pose can be taken, why the first cannot.
    pub fn of_first(loaded: Input, path: &Path, selection: &Selection) -> Result<Self, StudyError> {
        let files = loaded.files();
        let batch = match loaded {
            Input::Batch(batch) if selection.pose.is_none() => batch,
            loaded => return Self::of(loaded, path, selection),
        };
        let job = choose(batch.jobs, path, selection)?;
        let number = selection.design.unwrap_or(0);
        let first = Self::of_job(job.clone(), number, 0);
        let found = match &first {
            Err(StudyError::Pose { .. }) => {
                let design = job.design(number)?;
                let taken = |pose: &usize| {
                    let mut geometry = design.model().ok()?.geometry().clone();
                    design.place(*pose, &mut geometry).ok()
                };
                let pose = (1..job.len()).find(|pose| taken(pose).is_some());
                pose.map(|pose| Self::of_job(job, number, pose))
            }
            _ => None,
        };
        Ok(Self {
            files,
            ..found.unwrap_or(first)?
        })
    }

    /// A design of a job in the configuration of its model, which may be no pose of the job: one that is
    /// brought to poses of its own.
    ///
    /// # Errors
    /// No pose of it was found.
    pub(crate) fn of_design(job: &Job, design: &Design) -> Result<Self, StudyError> {
        let model = design.model().map_err(|source| StudyError::Pose {
            near: design.mechanism().and_then(of_mechanism),
            location: Box::new(job.location()),
            job: job.name.clone(),
            pose: 0,
            source: Box::new(source),
        })?;
        Ok(Self {
            prepared: Prepared::new(model),
            name: job.name.clone(),
            files: Vec::new(),
            origin: Origin::Job {
                number: None,
                job: Box::new(job.clone()),
                design: design.clone(),
                pose: 0,
            },
        })
    }

    /// Brings it to another configuration.
    ///
    /// # Errors
    /// A geometry that is not one of its model.
    pub(crate) fn set_geometry(&mut self, geometry: Geometry) -> Result<(), StudyError> {
        let set = self.prepared.model_mut().set_geometry(geometry);
        set.map_err(|error| self.unsolvable(error.into()))
    }

    /// The same design at another pose of its job; `None` where that is out of reach, or it is of no job.
    #[cfg(feature = "figures")]
    pub(crate) fn at_pose(&self, pose: usize) -> Option<Self> {
        let Origin::Job {
            job,
            design,
            number,
            ..
        } = &self.origin
        else {
            return None;
        };
        Some(Self {
            prepared: Prepared::new(super::design_model(design, pose).ok()?),
            name: self.name.clone(),
            files: self.files.clone(),
            origin: Origin::Job {
                job: job.clone(),
                design: design.clone(),
                pose,
                number: *number,
            },
        })
    }

    /// Its design alone, as a job in the poses that its own has.
    pub(crate) fn alone(&self, registry: &Registry) -> Result<Job, StudyError> {
        Ok(match (self.whole_job(), self.mechanism()) {
            (None, Some(own)) => {
                let own = JobMechanism::Loaded(Box::new(own.clone()));
                Job::new("mechanism", own, JobPoses::Own, registry)?
            }
            (Some(job), _) if job.varied().is_empty() => job.clone(),
            (Some(job), _) => {
                let number = self.as_design().number();
                job.with_values(number, &[] as &[(&str, f64)])?
            }
            (None, None) => return Err(self.unsolvable(SolveError::Singular)),
        })
    }
}
