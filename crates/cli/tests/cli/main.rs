//! The binary as a user meets it: files in, reports, files and exit statuses out.

mod cases;
mod check;
mod designs;
mod diagnosis;
mod doubts;
mod export;
mod extremes;
mod help;
mod messages;
mod misfits;
mod modes;
mod parameters;
mod plot;
mod run;
mod shapes;
mod solve;
mod states;
mod support;
mod tables;
mod tutorials;
mod vtu;
mod why;
