//! The figures from data.

mod bars;
mod figures;
mod lines;
mod maps;
