//! What a full solve says: displacements, wrenches, section forces, worst points, measures.

pub(crate) mod curve;
pub(crate) mod forces;
pub(crate) mod mass;
pub mod measures;
pub(crate) mod pose_result;
pub(crate) mod solution;
pub(crate) mod worst;
