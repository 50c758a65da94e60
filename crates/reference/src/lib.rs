//! Independent dense solvers for stiffness models of mechanisms.
//!
#![doc = include_str!("../README.md")]

mod along;
mod beam;
mod error;
mod flexible;
mod frequencies;
mod independence;
mod joint;
mod kinematics;
mod row;
mod saddle;
mod solution;
mod states;
mod structure;
mod taper;
mod traditional;

pub use error::ReferenceError;
pub use frequencies::natural_frequencies;
pub use solution::{ReferenceSolution, ReferenceState, solve};
pub use traditional::{TraditionalForm, TraditionalOptions, TraditionalSolution, traditional};
