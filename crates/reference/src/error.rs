//! What keeps a model from being solved.

use thiserror::Error;

/// A model that the dense solvers cannot answer for.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ReferenceError {
    /// The model has no output node.
    #[error("the model has no output node")]
    NoOutput,
    /// A model whose parts do not belong together.
    #[error(transparent)]
    Model(#[from] hyperstat_model::ModelError),
    /// Loads that the traditional method is not given.
    #[error(
        "the traditional method takes forces and moments on points in global axes only: no \
         gravity, no temperature, no loads along beams or in axes that turn"
    )]
    Loads,
    /// A load in the axes of a body of which nothing says how it lies.
    #[error("nothing says how body `{body}` lies, in whose axes a load is given")]
    NoBodyFrame {
        /// Name of the body.
        body: String,
    },
    /// A beam without density under gravity.
    #[error("the material of body `{body}` has no density, which its weight needs")]
    NoDensity {
        /// Name of the body.
        body: String,
    },
    /// More coordinates than a dense matrix should have.
    #[error(
        "the model has {coordinates} displacement coordinates; the dense solver takes at most {limit}"
    )]
    TooLarge {
        /// Six for every node, the inner nodes of subdivided segments too.
        coordinates: usize,
        /// Most that are taken.
        limit: usize,
    },
    /// More conditions than a dense matrix should have.
    #[error(
        "the joints and rigid bodies of the model make {conditions} conditions; the dense solver \
         takes at most {limit}"
    )]
    TooManyConditions {
        /// Of rigid bodies, and of every joint all that is rigid or elastic.
        conditions: usize,
        /// Most that are taken.
        limit: usize,
    },
    /// A segment without length, or whose local y runs along it.
    #[error("segment {segment} of body `{body}` has no length, or its y axis runs along it")]
    Segment {
        /// Name of the body.
        body: String,
        /// Index of the segment on the body, from 0.
        segment: usize,
    },
    /// A flexible body whose stiffness, held at its first node, is not positive definite.
    #[error(
        "the stiffness of flexible body `{body}` is not positive definite where its first node is held"
    )]
    Flexible {
        /// Name of the body.
        body: String,
    },
    /// A joint whose six directions are not independent.
    #[error("the six directions of joint `{joint}` are not independent")]
    JointBasis {
        /// Name of the joint.
        joint: String,
    },
    /// A misfit that rigid conditions leave no room for.
    #[error("the conditions of joint `{joint}` do not fit the others: misfits of rigid directions")]
    Misfit {
        /// Name of a joint whose conditions are not met.
        joint: String,
    },
    /// The loads work on a motion that nothing resists.
    #[error("the loads move body `{body}`, and nothing resists the motion")]
    Unrestrained {
        /// Name of the body that moves most.
        body: String,
    },
    /// Elimination met a zero pivot, or numbers that are not finite.
    #[error("the matrix of the system is singular")]
    Singular,
    /// Refinement did not settle.
    #[error(
        "refinement stopped at a relative change of {change:e}: the numbers are not to be trusted"
    )]
    NotConverged {
        /// Last change of the displacements over the displacements.
        change: f64,
    },
}
