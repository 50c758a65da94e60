//! A mechanism as data (paper §2.3): bodies, nodes, joints, loads, misfits, masses, and one
//! configuration of them.
//!
#![doc = include_str!("../README.md")]

mod directions;
mod error;
mod loads;
mod masses;
mod model;
mod orientation;
mod parts;
mod revision;
mod segment_beam;
mod size;
mod stiffness;

pub use directions::{Directions, condition_rows, rotation6, to_directions};
pub use error::{ModelError, NoBodyFrame};
pub use loads::{Axes, LineLoad, Load, LoadCase, LoadSet};
pub use masses::{BeamMass, ModalOptions};
pub use model::Model;
pub use model::doubts::Doubt;
pub use orientation::{body_frame, turn};
pub use parts::ValuePlace;
pub use parts::{
    Body, BodyId, BodyKind, Connection, Flexible, FlexibleId, Geometry, JointId, JointStiffness,
    LANES, Member, Misfit, Node, NodeId, NodeMass, Segment, SegmentId, Tapering,
};
pub use revision::fresh_revision;
pub use segment_beam::{SegmentBeam, segment_beam, unit_beam};
pub use size::characteristic_length;
pub use stiffness::check_stiffness;
