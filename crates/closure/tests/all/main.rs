//! The tests of loop closure: one program, so that they are linked once.

mod joints;
mod lanes;
mod loops;
mod planar;
mod support;
