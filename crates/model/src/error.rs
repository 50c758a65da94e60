//! What can be wrong with a model.

use hyperstat_joints::Dof;
use thiserror::Error;

/// A model that cannot be built.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ModelError {
    /// A body without points.
    #[error("body `{body}` has no point")]
    NoPoints {
        /// Name of the body.
        body: String,
    },
    /// A point named twice on one body.
    #[error("body `{body}` runs through point `{point}` twice")]
    RepeatedPoint {
        /// Name of the body.
        body: String,
        /// Name of the point.
        point: String,
    },
    /// A point that is added to a body that is not rigid.
    #[error("body `{body}` is not rigid: no point can be added to it")]
    NotRigid {
        /// Name of the body.
        body: String,
    },
    /// Two bodies, or two joints, of one name.
    #[error("the name `{name}` is used twice")]
    RepeatedName {
        /// The name.
        name: String,
    },
    /// A beam that runs through fewer than two points.
    #[error("beam `{body}` needs at least two points")]
    TooFewPoints {
        /// Name of the body.
        body: String,
    },
    /// A segment of a beam whose frame or stiffness cannot be formed.
    #[error("segment {segment} of body `{body}`: {source}")]
    Segment {
        /// Name of the body.
        body: String,
        /// Index of the segment on the body, from 0.
        segment: usize,
        /// What is wrong with it.
        source: hyperstat_elements::ElementError,
    },
    /// A point of an elastic body that its members do not connect with its first point.
    #[error("no chain of members connects point `{point}` of body `{body}` with its first point")]
    Loose {
        /// Name of the body.
        body: String,
        /// Name of the point.
        point: String,
    },
    /// A stiffness that a flexible body cannot have.
    #[error("body `{body}`: {source}")]
    Flexible {
        /// Name of the body.
        body: String,
        /// What is wrong with it.
        source: hyperstat_elements::ElementError,
    },
    /// A segment divided into no elements.
    #[error("segment {segment} of body `{body}` is divided into 0 elements: at least 1")]
    NoElements {
        /// Name of the body.
        body: String,
        /// Index of the segment on the body, from 0.
        segment: usize,
    },
    /// An id that is not one of the model: it is one of another model, or no model's.
    #[error("{what} {index} is not one of this model, whose {what} ids end before {count}")]
    ForeignId {
        /// Body, node, segment or joint.
        what: &'static str,
        /// The id.
        index: usize,
        /// How many the model has.
        count: usize,
    },
    /// A geometry that belongs to another model.
    #[error(
        "the geometry holds {found:?} nodes, segments, joints and flexible bodies, this model \
         {expected:?}"
    )]
    ForeignGeometry {
        /// Numbers of nodes, segments, joints and flexible bodies of the model.
        expected: [usize; 4],
        /// Those of the geometry.
        found: [usize; 4],
    },
    /// A joint between two nodes that do not lie at one point.
    #[error(
        "joint `{joint}` joins `{first}` and `{second}`, which lie {distance:.6e} m apart: both nodes \
         of a joint lie at one point; a lever between them is a body of its own"
    )]
    Apart {
        /// Name of the joint.
        joint: String,
        /// `body.point` of its first node.
        first: String,
        /// `body.point` of its second node.
        second: String,
        /// How far apart they are (m).
        distance: f64,
    },
    /// A joint that joins a body to itself or ground to ground.
    #[error("joint `{joint}` joins a body to itself")]
    SelfJoined {
        /// Name of the joint.
        joint: String,
    },
    /// A negative, infinite or not symmetric positive semidefinite joint stiffness.
    #[error("joint `{joint}`: {what}")]
    Stiffness {
        /// Name of the joint.
        joint: String,
        /// What is wrong with the stiffness.
        what: &'static str,
    },
    /// A misfit along a direction in which nothing holds the joint's bodies to each other.
    #[error("joint `{joint}` is free along {direction}: a misfit means nothing there")]
    FreeMisfit {
        /// Name of the joint.
        joint: String,
        /// The direction.
        direction: Dof,
    },
    /// A preload along a direction in which the joint does not give.
    #[error("joint `{joint}` is rigid along {direction}: a preload does nothing there")]
    RigidPreload {
        /// Name of the joint.
        joint: String,
        /// The direction.
        direction: Dof,
    },
    /// Gravity on a body whose material has no density.
    #[error("body `{body}` has no weight: its material has no `density`")]
    NoDensity {
        /// Name of the body.
        body: String,
    },
    /// A temperature of a body that is not made of beams.
    #[error("body `{body}` is not made of beams: it has no temperature")]
    NotOfBeams {
        /// Name of the body.
        body: String,
    },
    /// A temperature of a body whose material has no coefficient of expansion.
    #[error("body `{body}` has a temperature, but its material has no `expansion`")]
    NoExpansion {
        /// Name of the body.
        body: String,
    },
    /// A load or position that is not finite.
    #[error("{what} is not finite")]
    NotFinite {
        /// What is not finite.
        what: &'static str,
    },
}

/// Axes that turn with a body whose points, sections and joints do not say how it lies.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "a load turns with body `{body}`, but its points and the axes of its joints lie along one \
     line: its turn about that line is not known"
)]
pub struct NoBodyFrame {
    /// Name of the body.
    pub body: String,
}
