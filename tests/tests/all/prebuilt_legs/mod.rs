//! Hexapod, linear delta, Tricept, 3-RPS and 3-PRS: mobility and over-constraint of the literature,
//! results against the independent solver and closed forms, loops that close in every pose, refusals,
//! and the files that name or write out the mechanisms.

mod files;
mod kinematics;
mod parameters;
mod parts;
mod reach;
mod results;
