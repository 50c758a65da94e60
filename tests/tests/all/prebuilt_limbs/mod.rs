//! Tripteron, Orthoglide, Exechon, spherical and planar 3-RRR: mobility and over-constraint of the
//! literature, results against the independent solver, loops that close in every pose, refusals,
//! and the files that name or write out the mechanisms.

mod files;
mod kinematics;
mod parameters;
mod reach;
mod results;
