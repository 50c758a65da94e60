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
mod budget;
mod cluster;
mod condense;
mod coordinates;
mod directions;
mod dissection;
mod elimination;
mod error;
mod floor;
mod form;
mod influence;
mod jacobian;
mod kinematics;
mod lanes;
mod load_change;
mod loads;
pub mod measures;
mod misfit;
mod modal;
mod model;
mod numeric;
mod orientation;
mod parameters;
mod parts;
mod plan;
mod precision;
mod recover;
mod redundancy;
mod restraint;
mod room;
mod sensitivity;
mod solution;
mod solve;
mod sparse;
mod sparse_elimination;
mod topology;
mod worst;

pub use budget::{Budget, Deformation, MisfitEffect, Part, PartSource, larger_first};
pub use error::{ModelError, SolveError};
pub use floor::Floor;
pub use influence::Influence;
pub use kinematics::{Kinematics, analyse, describe_motions};
pub use lanes::{LANES, Lanes};
pub use modal::{
    BeamMass, FrequencySensitivity, ModalOptions, ModalPlan, ModalSensitivities, Mode, Modes, modes,
};
pub use model::{
    Axes, Body, BodyId, BodyKind, Connection, Doubt, Flexible, FlexibleId, Geometry, JointId,
    JointStiffness, LineLoad, Load, LoadCase, LoadSet, Member, Misfit, Model, Node, NodeId,
    NodeMass, Segment, SegmentId, Tapering, ValuePlace,
};
pub use parameters::Parameter;
pub use plan::{Plan, Workspace};
pub use recover::segment_displacement;
pub use redundancy::{Redundancy, redundant_constraints};
pub use sensitivity::Sensitivity;
pub use solution::{CaseSolution, Motion, Output, SegmentForces, Solution, State, Warning};
pub use solve::{PoseResult, solve};
pub use worst::{WorstPoint, section_strain, section_wrench, stations};
