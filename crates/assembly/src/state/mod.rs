//! What acts, worked out once: loads, weight, heat, misfits, preloads.

pub(crate) mod acting;
pub(crate) mod floor;
pub(crate) mod offsets;
pub(crate) mod preload;
pub(crate) mod sources;
