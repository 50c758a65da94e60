//! The elastostatic stiffness model of a mechanism (paper §2.3).
//!
//! A [`Model`] holds bodies, nodes, beams, joints, loads and the output; [`Geometry`] what a pose
//! changes. A [`Plan`] is worked out once a topology and serves every pose; [`Solution`] is
//! everything that one pose gives. See the README for the shortest way through.

mod coordinates;
mod directions;
mod elimination;
mod error;
mod kinematics;
mod model;
mod numeric;
mod plan;
mod recover;
mod restraint;
mod solution;
mod solve;
mod sparse;
mod topology;

pub use error::{ModelError, SolveError};
pub use kinematics::{Kinematics, analyse};
pub use model::{
    Body, BodyId, BodyKind, Connection, Geometry, JointId, JointStiffness, Load, Member, Model,
    Node, NodeId, Segment, SegmentId,
};
pub use plan::{Plan, Workspace};
pub use recover::segment_displacement;
pub use solution::{Motion, Output, SegmentForces, Solution, Warning};
pub use solve::{PoseResult, solve};
