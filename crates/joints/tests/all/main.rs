//! The tests of the joints crate: one program, so that they are linked once.

mod broken_joints;
mod conformance;
mod coupled_joints;
mod dof;
mod frame;
mod mapping;
mod orientations;
mod rigid_motion;
