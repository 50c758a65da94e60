//! What is chosen of a batch file.

use std::path::Path;

use hyperstat_mechanisms::{Batch, Job};

use crate::error::StudyError;

/// What is chosen of a batch file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Selection {
    /// Name of the job; may be left out where there is only one.
    pub job: Option<String>,
    /// Number of the design, from 0, which is the default.
    pub design: Option<usize>,
    /// Number of the pose, from 0, which is the default.
    pub pose: Option<usize>,
}

impl Selection {
    /// The job of a batch that is meant; `path` is the file that it is from.
    ///
    /// # Errors
    /// The batch holds no such job, or several of which none is named.
    pub fn job_of(&self, batch: Batch, path: &Path) -> Result<Job, StudyError> {
        choose(batch.jobs, path, self)
    }

    /// Name of the first choice that is made.
    pub(crate) fn given(&self) -> Option<&'static str> {
        let made = [
            ("job", self.job.is_some()),
            ("design", self.design.is_some()),
            ("pose", self.pose.is_some()),
        ];
        made.into_iter()
            .find_map(|(what, made)| made.then_some(what))
    }
}

/// The job that is meant.
pub(crate) fn choose(
    mut jobs: Vec<Job>,
    path: &Path,
    selection: &Selection,
) -> Result<Job, StudyError> {
    let path = || path.into();
    let known: Vec<String> = jobs.iter().map(|job| job.name.clone()).collect();
    let place = match &selection.job {
        Some(name) => {
            known
                .iter()
                .position(|job| job == name)
                .ok_or_else(|| StudyError::UnknownJob {
                    path: path(),
                    job: name.clone(),
                    known: known.clone(),
                })?
        }
        None if jobs.len() == 1 => 0,
        None => {
            return Err(StudyError::ChooseJob {
                path: path(),
                known,
            });
        }
    };
    Ok(jobs.swap_remove(place))
}
