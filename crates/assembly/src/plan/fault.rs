//! What went wrong in a pass.

use crate::error::SolveError;

/// Why a plan cannot take a pose.
#[derive(Debug)]
pub(crate) enum Fault {
    /// The rank of the loop conditions is another than the plan's.
    Changed,
    /// Something is wrong with the pose itself.
    Error(SolveError),
}

impl<E: Into<SolveError>> From<E> for Fault {
    fn from(error: E) -> Self {
        Self::Error(error.into())
    }
}
