//! The figures from data.

mod bars;
mod drawn;
mod figures;
mod lines;
mod maps;
mod marks;
mod moving;
