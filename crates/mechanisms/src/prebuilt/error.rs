//! What can be wrong with a prebuilt mechanism's parameters or with a pose asked of it.

use hyperstat_closure::ClosureError;
use hyperstat_joints::JointError;
use hyperstat_model::ModelError;
use thiserror::Error;

/// A pose for which there is no configuration.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PoseError {
    /// The mechanism's parts are too short or too long for the pose.
    #[error("out of reach: {what}")]
    Unreachable {
        /// Which part, why, and by which lengths.
        what: String,
    },
    /// At the pose the mechanism's configuration is not defined: a direction or a place of one
    /// of its parts may be any of infinitely many.
    #[error("singular pose: {what}")]
    Singular {
        /// Which part, and why.
        what: String,
    },
    /// There are configurations with the pose, but in another assembly mode.
    #[error("another assembly mode: {what}")]
    Branch {
        /// Where the way to them ends.
        what: String,
    },
    /// A mechanism of a file that cannot be moved, or not there.
    #[error(transparent)]
    Closure(ClosureError),
    /// A pose of the wrong number of coordinates.
    #[error("`{kind}` takes {expected} pose coordinates, {found} are given")]
    Coordinates {
        /// The mechanism's kind.
        kind: String,
        /// Number of coordinates it takes.
        expected: usize,
        /// Number of coordinates given.
        found: usize,
    },
    /// Values of drives, asked of a mechanism that is moved by its output.
    #[error("`{kind}` takes poses of its output, no values of drives")]
    Drives {
        /// The mechanism's kind.
        kind: String,
    },
    /// A pose coordinate that is not a finite number.
    #[error("pose coordinate {index} is {value}, not a finite number")]
    NotFinite {
        /// Place of the coordinate, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A geometry that belongs to another model.
    #[error(
        "the geometry holds {found:?} nodes, segments and joints, \
         this mechanism's model {expected:?}"
    )]
    ForeignGeometry {
        /// Numbers of nodes, segments and joints of the mechanism.
        expected: [usize; 3],
        /// Those of the geometry.
        found: [usize; 3],
    },
    /// A parameter of the mechanism out of its physical range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// A joint frame that cannot be formed at this pose.
    #[error(transparent)]
    Joint(#[from] JointError),
    /// A body or joint that cannot be part of a model at this pose.
    #[error(transparent)]
    Model(#[from] ModelError),
}

impl From<ClosureError> for PoseError {
    fn from(error: ClosureError) -> Self {
        match error {
            ClosureError::Unreachable { what } => Self::Unreachable { what },
            ClosureError::CannotFollow { what } => Self::Unreachable {
                what: format!("the output cannot follow: {what}"),
            },
            ClosureError::Singular { what } => Self::Singular { what },
            ClosureError::Branch { what } => Self::Branch { what },
            other => Self::Closure(other),
        }
    }
}

/// A parameter of a prebuilt mechanism out of its physical range.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("`{field}`: {message}")]
pub struct ParameterError {
    /// Name of the field.
    pub field: &'static str,
    /// What is wrong with it, with its value.
    pub message: String,
    /// What would be right, where that can be said.
    pub help: Option<String>,
}

impl PoseError {
    /// The outcome in a word, as in the column `status` of tables: `unreachable`, `singular`, `branch`, or
    /// `failed` for all else. A pose that is reached is `ok`.
    pub fn status(&self) -> &'static str {
        match self {
            Self::Unreachable { .. } => "unreachable",
            Self::Singular { .. } => "singular",
            Self::Branch { .. } => "branch",
            _ => "failed",
        }
    }

    #[cold]
    pub(super) fn unreachable(what: String) -> Self {
        Self::Unreachable { what }
    }

    #[cold]
    pub(super) fn singular(what: String) -> Self {
        Self::Singular { what }
    }
}

/// A length (m) or an angle (rad) in a message: six decimals, or an exponent where they say
/// nothing.
pub(super) fn shown(value: f64) -> String {
    if value == 0.0 || (1e-3..1e6).contains(&value.abs()) {
        format!("{value:.6}")
    } else {
        format!("{value:.6e}")
    }
}

#[cfg(test)]
mod tests {
    use super::shown;

    #[test]
    fn numbers_of_every_size_are_short() {
        let numbers = [0.0, 0.25, -3.0, 1e300, -1.5e-9];
        let wanted = [
            "0.000000",
            "0.250000",
            "-3.000000",
            "1.000000e300",
            "-1.500000e-9",
        ];
        assert_eq!(numbers.map(shown), wanted);
    }
}
