//! The figures from data.

mod figures;
mod lines;
mod maps;
