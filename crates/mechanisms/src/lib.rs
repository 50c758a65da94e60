//! Mechanism and batch files, the registry of joint kinds, and prebuilt mechanisms.
//!
#![doc = include_str!("../README.md")]
//!
//! # Where to start
//!
//! [`load`] reads a file into an [`Input`]: one [`Mechanism`], whose `model` goes to
//! `hyperstat_model`, or a [`Batch`] of [`Job`]s. SI units; vectors in global axes; a pose is
//! x y z \[m\] and a rotation vector rx ry rz \[rad\] from the home orientation.

mod batch;
mod beams;
mod bodies;
mod brackets;
mod commanded;
mod csv;
mod design;
mod error;
mod fields;
mod figures;
pub mod files;
mod flexible;
mod fragment;
mod home;
mod joints;
mod kinds;
mod load;
mod loads;
mod materials;
mod mechanism;
mod modes;
mod mover;
mod names;
mod nodes;
mod overlay;
mod parameters;
mod paths;
mod poses;
pub mod prebuilt;
mod registry;
mod slips;
mod source;
mod subject;
mod syntax;
mod table;
mod targets;
mod value_names;
mod values;
mod vary;
mod write;

pub use batch::{Batch, Job};
pub use commanded::Commanded;
pub use design::{Design, Value, Varied};
pub use error::{LoadError, Location};
pub use figures::{Along, ColorScale, Figure, Scale};
pub use load::{
    Input, batch_from_str, load, load_batch, load_mechanism, load_str, mechanism_from_str,
};
pub use mechanism::Mechanism;
pub use names::nearest;
pub use prebuilt::PoseError;
pub use registry::{Argument, Arguments, Orientation, ParsedJoint, Registry};
pub use write::{WriteError, write};
