//! Mechanism and batch files, the registry of joint kinds, and prebuilt mechanisms.
//!
#![doc = include_str!("../README.md")]
//!
//! # Where to start
//!
//! [`load`] reads a file into an [`Input`]: one [`Mechanism`], whose `model` goes to
//! `hyperstat_assembly`, or a [`Batch`] of [`Job`]s. Files come from a [`Files`]: the disk or memory. A
//! program makes what a file says by [`Job::new`], [`Mechanism::with_values`] and
//! [`Mechanism::place_at`]. SI units; vectors in global axes; a pose is x y z \[m\] and a rotation vector
//! rx ry rz \[rad\] from the home orientation.

mod adjust;
mod begin;
mod builtin;
mod error;
mod file;
mod job;
mod layout;
mod load;
mod parameters;
pub mod prebuilt;
mod schema;
mod terms;
mod text;
mod words;
mod write;

pub use adjust::{Adjustment, Digits, MOST as MOST_ROUNDINGS, Moved, NotAdjusted};
pub use begin::{begin, beginnings, to_json};
pub use error::{LoadError, Location};
pub use file::mechanism::Mechanism;
pub use file::registry::{Argument, Arguments, Orientation, ParsedJoint, Registry};
pub use hyperstat_closure::{Drive, LoopClosure, Reached, Target, Work};
pub use job::batch::{Batch, Job};
pub use job::columns::Column;
pub use job::commanded::Commanded;
pub use job::design::Design;
pub use job::figures::{Along, ColorScale, Figure, FigurePose, Scale};
pub use job::look::{Look, Mark, Noted, View, Words};
pub use job::made::{JobLoad, JobMechanism, JobPoses};
pub use job::mover::Placing;
pub use job::vary::Varied;
pub use layout::{format, format_file};
pub use load::{
    Input, batch_from_str, load, load_batch, load_mechanism, load_str, mechanism_from_str,
};
pub use prebuilt::PoseError;
pub use schema::schema;
pub use text::dependence::Dependence;
pub use text::dimension::Dimension;
pub use text::files;
#[cfg(feature = "fs")]
pub use text::files::Disk;
pub use text::files::{Files, MemoryFiles};
pub use text::names::nearest;
pub use text::quantities::unit_of;
pub use text::value::Value;
pub use write::{WriteError, write, write_json};
