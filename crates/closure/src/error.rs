//! What keeps a mechanism from a target.

use hyperstat_joints::Dof;
use thiserror::Error;

/// A target that is not reached, or a mechanism that cannot be moved.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ClosureError {
    /// The model has no output node.
    #[error("the model has no output")]
    NoOutput,
    /// A model whose parts do not belong together, or a geometry that is not of it.
    #[error(transparent)]
    Model(#[from] hyperstat_model::ModelError),
    /// A joint that is not one of the model.
    #[error("joint {joint} is not one of this model, which has {count}")]
    ForeignJoint {
        /// The id.
        joint: usize,
        /// Number of joints of the model.
        count: usize,
    },
    /// A configuration of another mechanism.
    #[error("the configuration is one of another mechanism")]
    ForeignConfiguration,
    /// A mechanism with more joint coordinates than the dense matrices of loop closure should have.
    #[error(
        "the mechanism has {coordinates} joint coordinates, and {conditions} conditions of its loops; \
         loop closure takes at most {limit} of each"
    )]
    TooLarge {
        /// Coordinates of all joints that move.
        coordinates: usize,
        /// Conditions of the joints that close loops.
        conditions: usize,
        /// Most of either.
        limit: usize,
    },
    /// A target that is not a finite number.
    #[error("the target {value} is not a finite number")]
    NotFinite {
        /// Its value.
        value: f64,
    },
    /// A segment whose frame cannot be formed.
    #[error(transparent)]
    Element(#[from] hyperstat_elements::ElementError),
    /// A kind of joint whose basis does not say how it moves by finite amounts.
    #[error(
        "joint `{joint}`: the free motions of `{kind}` do not stay those of its basis when it moves \
         by more than a little"
    )]
    Motions {
        /// Name of the joint.
        joint: String,
        /// Its kind.
        kind: String,
    },
    /// A value for a direction that is no drive.
    #[error("`{joint}.{direction}` is not a drive: {why}")]
    NotADrive {
        /// Name of the joint.
        joint: String,
        /// The direction.
        direction: Dof,
        /// What it is instead.
        why: &'static str,
    },
    /// No configuration has the target.
    #[error("out of reach: {what}")]
    Unreachable {
        /// How far the mechanism comes.
        what: String,
    },
    /// Coordinates of the target that the mechanism does not give the output.
    #[error("out of reach: the output cannot follow: {what}")]
    CannotFollow {
        /// Which coordinates, what is asked and what they are.
        what: String,
    },
    /// The target, or all of the way to it, is singular.
    #[error("singular pose: {what}")]
    Singular {
        /// Where.
        what: String,
    },
    /// There are configurations with the target, but in another assembly mode.
    #[error("another assembly mode: {what}")]
    Branch {
        /// Where the way to them ends.
        what: String,
    },
    /// A sliding joint between two bodies of which neither can slide past the other.
    #[error(
        "joint `{joint}` slides by {travel:.6} m, but neither `{first}` nor `{second}` can be moved \
         past it: {help}"
    )]
    Slides {
        /// Name of the joint.
        joint: String,
        /// Name of its first body.
        first: String,
        /// Name of its second body.
        second: String,
        /// By how much its two points have come apart (m).
        travel: f64,
        /// What would be right.
        help: &'static str,
    },
}
