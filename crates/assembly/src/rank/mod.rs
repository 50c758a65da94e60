//! Rank and null spaces: dense and sparse elimination with pivoting.

pub(crate) mod dense;
pub(crate) mod echelon;
pub(crate) mod sparse;
