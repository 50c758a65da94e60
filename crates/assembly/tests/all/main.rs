//! The tests of the assembly crate: one program, so that they are linked once.

mod belonging;
mod doubts;
mod misfit;
mod output;
mod parts;
mod room;
mod semidefinite;
mod states;
