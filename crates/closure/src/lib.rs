//! Loop closure of rigid mechanisms.
//!
#![doc = include_str!("../README.md")]
//!
//! # The way through
//!
//! [`LoopClosure::new`] takes a model at home → [`LoopClosure::reach`] follows a [`Target`] from a
//! [`Configuration`] to the next → [`LoopClosure::write`] makes a geometry of it, with which
//! `hyperstat_assembly` solves the model in that pose. [`LoopClosure::place_at`] does all of it from
//! home.

mod adjust;
mod closure;
mod equations;
mod error;
mod lanes;
mod linkage;
mod motion;
mod newton;
mod path;
mod place;
mod reach;
mod span;
mod target;
mod twist;

pub use adjust::{Adjusted, Adjusting, Rounded, Unadjusted};
pub use closure::LoopClosure;
pub use error::ClosureError;
pub use hyperstat_model::LANES;
pub use lanes::{Lanes, Work};
pub use linkage::Configuration;
pub use reach::Reached;
pub use target::{Drive, Target};
