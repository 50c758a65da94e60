//! The binary as a user meets it: files in, reports, files and exit statuses out.

mod answer;
mod cases;
mod check;
mod designs;
mod diagnosis;
mod export;
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
mod strains;
mod support;
mod tables;
mod tutorials;
mod vtu;
mod why;
