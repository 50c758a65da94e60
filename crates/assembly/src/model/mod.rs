//! The mechanism as data.

pub(crate) mod directions;
pub(crate) mod error;
pub(crate) mod loads;
pub(crate) mod masses;
pub(crate) mod model;
pub(crate) mod orientation;
pub(crate) mod parts;
pub(crate) mod segment_beam;
pub(crate) mod size;
