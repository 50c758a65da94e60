//! The tests of the assembly crate: one program, so that they are linked once.

mod misfit;
mod output;
mod parts;
mod semidefinite;
mod states;
