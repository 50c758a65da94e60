//! What can be wrong with a model.

use hyperstat_model::{BodyId, ModelError, NoBodyFrame};
use thiserror::Error;

/// A model that cannot be solved as it stands.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The model has no output node.
    #[error("the model has no output")]
    NoOutput,
    /// A model whose parts do not belong together, a load or geometry that is not of it.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// Results, or buffers, of another model.
    #[error("these are results or buffers of another model")]
    ForeignModel,
    /// Buffers that another mechanism made, or this one before it was changed.
    #[error("these buffers were made by another mechanism, or before this one was changed")]
    ForeignWorkspace,
    /// Bodies that no chain of joints connects to the ground.
    #[error("nothing holds {}", names(bodies))]
    Unheld {
        /// Names of the bodies.
        bodies: Vec<String>,
    },
    /// A load that works on a motion that nothing resists.
    #[error("a load on `{node}` works on a motion that nothing resists: {motion}")]
    LoadOnFreeMotion {
        /// `body.point` of the load.
        node: String,
        /// The body of that node.
        body: BodyId,
        /// Index of the load in the model; `None` where it is one of a case, or a weight.
        load: Option<usize>,
        /// The motion in words.
        motion: String,
    },
    /// A preload that works on a motion that nothing resists.
    #[error("the preload of joint `{joint}` works on a motion that nothing resists: {motion}")]
    PreloadOnFreeMotion {
        /// Name of the joint.
        joint: String,
        /// A body of that joint that moves.
        body: BodyId,
        /// The motion in words.
        motion: String,
    },
    /// The stiffness is not positive definite although the rigid mechanism is held: numbers of
    /// too different size.
    #[error("the stiffness matrix is singular to working precision")]
    Singular,
    /// A joint whose own compliance is rigid in some combination of its directions, where there
    /// is no elastic body to absorb it.
    #[error(
        "the compliance of joint `{joint}` is singular, and no beam's end or middle of its own \
         takes it in: give it some compliance in every combination of its directions"
    )]
    SingularCompliance {
        /// Name of the joint.
        joint: String,
    },
    /// Misfits that the rigid bodies and joints of a loop cannot take up.
    #[error(
        "the misfit of {} does not fit: loops of rigid bodies and joints leave it no room, and the \
         force would be infinite",
        joint_names(joints)
    )]
    Misfit {
        /// Names of the joints whose misfits do not fit.
        joints: Vec<String>,
    },
    /// Loads or stiffnesses so large or small that results overflow.
    #[error("the results overflow: loads or stiffnesses are out of all proportion")]
    Overflow,
    /// A model of which something grows too large to be held in memory.
    #[error("the model is too large: {what} ask for {numbers} numbers, and {limit} are the limit")]
    TooLarge {
        /// What asks for them.
        what: &'static str,
        /// How many numbers it asks for.
        numbers: usize,
        /// How many it may.
        limit: usize,
    },
    /// An elastic body whose mass is not known.
    #[error(
        "the material of body `{body}` has no density, which its weight and natural frequencies need"
    )]
    NoDensity {
        /// Name of the body.
        body: String,
    },
    /// Natural frequencies of what has no mass.
    #[error("nothing has mass, so there are no natural frequencies")]
    NoMass,
    /// Natural modes that do not converge.
    #[error("the natural modes do not converge: {found} were found")]
    ModesNotFound {
        /// Number of those that have converged.
        found: usize,
    },
    /// Natural frequencies of exact masses of which a count does not say that none is missing.
    #[error("the natural frequencies cannot be counted: one of the lowest {found} may be missing")]
    ModesUncounted {
        /// Number of those that were found.
        found: usize,
    },
    /// A load in axes that turn with a body of which nothing says how it lies.
    #[error(transparent)]
    NoBodyFrame(#[from] NoBodyFrame),
    /// An element that cannot be formed.
    #[error(transparent)]
    Element(#[from] hyperstat_elements::ElementError),
    /// A joint that cannot be formed.
    #[error(transparent)]
    Joint(#[from] hyperstat_joints::JointError),
}

fn joint_names(joints: &[String]) -> String {
    match joints {
        [joint] => format!("joint {}", names(std::slice::from_ref(joint))),
        _ => format!("joints {}", names(joints)),
    }
}

fn names(bodies: &[String]) -> String {
    let quoted: Vec<String> = bodies.iter().map(|b| format!("`{b}`")).collect();
    quoted.join(", ")
}
