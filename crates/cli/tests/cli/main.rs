//! The binary as a user meets it: files in, reports, files and exit statuses out.

mod cases;
mod check;
mod designs;
mod diagnosis;
mod doubts;
mod everything;
mod export;
mod extremes;
mod floors;
mod help;
mod maps;
mod messages;
mod misfits;
mod modes;
mod parameters;
mod plot;
mod run;
mod safety;
mod shapes;
mod solve;
mod states;
mod support;
mod tables;
mod tutorials;
mod vtu;
mod why;
