//! The elastostatic stiffness model of a mechanism (paper §2.3).
//!
#![doc = include_str!("../README.md")]
//!
//! # The way through
//!
//! [`Model`] (plain data) → [`Prepared`] (once a topology: which joints are absorbed in subassemblies,
//! spanning trees of the others, numbering of the IDCs, sparsity pattern, symbolic factorization) →
//! [`Configuration`] (one numeric pass: joint mappings N, the mapping H of every carrier, elements,
//! assembled stiffness, factor, condensation to the output) → [`Solution`], and by the same
//! factorization whatever else is asked of it; or in a sweep [`PoseResult`] a pose, without
//! refinement, recovery and diagnosis.

mod answer;
mod configuration;
mod error;
mod kinematics;
mod lanes;
mod modal;
mod plan;
mod pose;
mod posture;
mod prepared;
mod rank;
mod response;
mod room;
mod sets;
mod solve;
mod state;

pub use answer::curve::segment_displacement;
pub use answer::forces::Forces;
pub use answer::mass::MovingMass;
pub use answer::measures;
pub use answer::pose_result::PoseResult;
pub use answer::solution::{CaseSolution, Output, SegmentForces, Solution, State, Warning};
pub use answer::worst::{
    WorstPoint, section_strain, section_wrench, stations, worst_stress, worst_von_mises,
};
pub use configuration::Configuration;
pub use error::SolveError;
pub use hyperstat_model::{
    Axes, BeamMass, Body, BodyId, BodyKind, Connection, Doubt, Flexible, FlexibleId, Geometry,
    JointId, JointStiffness, LANES, LineLoad, Load, LoadCase, LoadSet, Member, Misfit,
    ModalOptions, Model, ModelError, Node, NodeId, NodeMass, Segment, SegmentId, Tapering,
    ValuePlace,
};
pub use kinematics::Kinematics;
pub use kinematics::motion::{Motion, describe_motions};
pub use kinematics::redundancy::Redundancy;
pub use lanes::single::Single;
pub use lanes::{Beside, Lanes};
pub use modal::{Counted, FrequencySensitivity, ModalPlan, ModalSensitivities, Mode, Modes};
pub use plan::workspace::Workspace;
pub use prepared::{PoseSlopes, Prepared, analyse, modes, redundant_constraints, solve};
pub use response::budget::{
    Budget, Carried, Deformation, MisfitEffect, Part, PartSource, larger_first,
};
pub use response::influence::Influence;
pub use response::parameters::Parameter;
pub use response::sensitivity::Sensitivity;
pub use response::slopes::{Probe, Slopes};
pub use state::floor::Floor;
