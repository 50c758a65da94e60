//! Why a request is refused.

use hyperstat_mechanisms::{LoadError, PoseError};
use serde::Serialize;
use thiserror::Error;

use crate::error::{Problem, StudyError};
use crate::sweep::Failure;

/// Why a request is refused.
#[derive(Debug, Error)]
pub(super) enum Refused {
    /// The mechanism has no such answer.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// It cannot take the pose.
    #[error("{0}")]
    Pose(#[from] PoseError),
    /// It has no answer in the pose.
    #[error("{0}")]
    Failed(#[from] Failure),
    /// A request before anything was loaded.
    #[error("no mechanism is loaded")]
    NothingLoaded,
    /// What is asked about is not there.
    #[error("{message}")]
    Unknown {
        /// What is wrong.
        message: String,
        /// What would be right.
        help: String,
    },
    /// No request, or an answer that no JSON holds.
    #[error("{0}")]
    Json(#[from] serde_json::Error),
}

/// What is wrong, as a program is told. Field names are those of the JSON.
#[derive(Debug, Clone, Serialize)]
pub struct Refusal {
    /// A word that stays when messages change.
    pub code: String,
    /// What is wrong, and where.
    #[serde(flatten)]
    pub problem: Problem,
    /// Number of characters that are meant, from there on.
    pub length: Option<usize>,
}

impl From<LoadError> for Refused {
    fn from(error: LoadError) -> Self {
        Self::Study(error.into())
    }
}

impl From<&StudyError> for Refusal {
    fn from(error: &StudyError) -> Self {
        Self {
            code: error.code().into(),
            problem: error.problem(),
            length: error.location().map(|location| location.width),
        }
    }
}

impl From<&Refused> for Refusal {
    fn from(refused: &Refused) -> Self {
        let (code, help) = match refused {
            Refused::Study(error) => return error.into(),
            Refused::Pose(error) => (error.status(), None),
            Refused::Failed(failure) => (failure.status(), None),
            Refused::NothingLoaded => ("nothing-loaded", Some("load a file first".into())),
            Refused::Unknown { help, .. } => ("request", Some(help.clone())),
            Refused::Json(_) => ("request", None),
        };
        Self {
            code: code.into(),
            problem: Problem {
                message: refused.to_string(),
                help,
                path: None,
                line: None,
                column: None,
            },
            length: None,
        }
    }
}
