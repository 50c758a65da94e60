//! Batch files: jobs, their poses, what they vary.

pub(crate) mod batch;
pub(crate) mod columns;
pub(crate) mod commanded;
pub(crate) mod design;
pub(crate) mod figures;
pub(crate) mod look;
pub(crate) mod made;
pub(crate) mod modes;
pub(crate) mod mover;
pub(crate) mod parameters;
pub(crate) mod place;
pub(crate) mod poses;
pub(crate) mod subject;
pub(crate) mod targets;
pub(crate) mod template;
pub(crate) mod value_names;
pub(crate) mod vary;
pub(crate) mod whole;
