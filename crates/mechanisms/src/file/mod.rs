//! Mechanism files: what every field means, and the model that it becomes.

pub(crate) mod beams;
pub(crate) mod bodies;
pub(crate) mod end;
pub(crate) mod flexible;
pub(crate) mod groups;
pub(crate) mod home;
pub(crate) mod include;
pub(crate) mod joints;
pub(crate) mod kinds;
pub(crate) mod loads;
pub(crate) mod materials;
pub(crate) mod mechanism;
pub(crate) mod nodes;
pub(crate) mod registry;
mod releases;
pub(crate) mod through;
pub(crate) mod value_names;
