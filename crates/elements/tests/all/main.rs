//! The tests of the elements crate: one program, so that they are linked once.

mod beam;
mod delta;
mod flexible;
mod frequencies;
mod loads;
mod mass;
mod mass_derivatives;
mod stress;
mod subassembly;
mod support;
mod taper;
