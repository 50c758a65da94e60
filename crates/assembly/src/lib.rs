//! The elastostatic stiffness model of a mechanism (paper §2.3).
//!
#![doc = include_str!("../README.md")]
//!
//! # The way through
//!
//! [`Model`] (plain data) → [`Plan`] (once a topology: which joints are absorbed in subassemblies,
//! spanning trees of the others, numbering of the IDCs, sparsity pattern, symbolic factorization) →
//! one numeric pass a pose (joint mappings N, the mapping H of every carrier, elements, assembled
//! stiffness, factor, condensation to the output) → [`PoseResult`] in a sweep, [`Solution`] in a
//! full solve, which also refines, recovers and diagnoses.

mod acting;
mod cluster;
mod condense;
mod coordinates;
mod directions;
mod elimination;
mod error;
mod jacobian;
mod kinematics;
mod lanes;
mod loads;
pub mod measures;
mod modal;
mod model;
mod numeric;
mod orientation;
mod parts;
mod plan;
mod recover;
mod redundancy;
mod restraint;
mod solution;
mod solve;
mod sparse;
mod sparse_elimination;
mod topology;

pub use error::{ModelError, SolveError};
pub use kinematics::{Kinematics, analyse, describe_motions};
pub use lanes::{LANES, Lanes};
pub use modal::{BeamMass, ModalOptions, ModalPlan, Mode, Modes, modes};
pub use model::{
    Axes, Body, BodyId, BodyKind, Connection, Flexible, FlexibleId, Geometry, JointId,
    JointStiffness, LineLoad, Load, LoadCase, LoadSet, Member, Model, Node, NodeId, NodeMass,
    Segment, SegmentId,
};
pub use plan::{Plan, Workspace};
pub use recover::segment_displacement;
pub use redundancy::{Redundancy, redundant_constraints};
pub use solution::{CaseSolution, Motion, Output, SegmentForces, Solution, State, Warning};
pub use solve::{PoseResult, solve};
