//! What is printed for people to read: answers as tables.

mod adjust;
mod answer;
mod cases;
mod check;
mod compare;
mod forces;
mod joints;
mod loads;
mod misfits;
mod modes;
mod parts;
mod segments;
mod sensitivities;
mod solve;
mod statistics;
mod summary;
mod table;
mod why;

pub(crate) use adjust::adjust;
pub(crate) use answer::answer;
pub(crate) use check::check;
pub(crate) use compare::{compared, compared_tables};
pub(crate) use solve::full;
pub(crate) use summary::Said;
