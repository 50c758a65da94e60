//! The tests of the mechanisms crate: one program, so that they are linked once.

mod adjusting;
mod batches;
mod broken;
mod corpus;
mod designs;
mod expressions;
mod fuzzing;
mod json;
mod loading;
mod made;
mod memory;
mod mutations;
mod schema;
mod states;
mod writing;
