//! Rank and null spaces: dense and sparse elimination with pivoting, and orders for it.

pub(crate) mod dense;
pub(crate) mod dissection;
pub(crate) mod echelon;
pub(crate) mod sparse;
pub(crate) mod substitution;
