//! The tests of the independent solver: one program, so that they are linked once.

mod closed_forms;
mod common;
mod counts;
mod every_joint;
mod states;
mod traditional;
