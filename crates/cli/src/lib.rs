//! The commands of hyperstat as a library: [`run`] with joint kinds of your own.
//!
#![doc = include_str!("../README.md")]

mod args;
mod atomic;
mod batch;
mod case;
mod cells;
mod destination;
mod diagnostic;
mod disk;
mod drawing;
mod drives;
mod error;
mod outputs;
mod plausibility;
mod plot;
mod report;
mod terminal;
mod verification;
mod vtu;

use std::ffi::OsString;
use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

use clap::Parser;
use hyperstat_mechanisms::Registry;

use args::{Cli, Command, Format};
use atomic::AtomicFile;
use case::Case;
use error::CliError;
use report::{Asked, CheckReport, ModesReport, SolveReport, json};

/// Runs the command line `args` (the program's name first) with the kinds of joints in
/// `registry`: a binary with joints of its own registers them and calls this.
///
/// Results go to standard output, errors to standard error. The exit status is 0 where all is
/// done, 1 where a run finished in which some pose has no result, 2 where the input cannot be
/// used (the command line itself too), 3 where an output could not be written. A panic ends here,
/// with a message that it is a bug, and the status 70.
pub fn run(args: impl IntoIterator<Item = OsString>, registry: &Registry) -> ExitCode {
    // Nothing of what a panic may leave half done is used again.
    let outcome = catch_unwind(AssertUnwindSafe(|| run_commands(args, registry)));
    outcome.unwrap_or_else(|_| {
        // Nothing is left to be told where standard error is closed.
        let _ = io::stderr().write_all(BUG.as_bytes());
        ExitCode::from(70)
    })
}

/// What is said after the message of a panic.
const BUG: &str = "\
error: this is a bug in hyperstat, or in a kind of joint that was added to it; it is not your fault
  = help: please report it to where you have hyperstat from, with the lines above, the command, and
          the files that it reads
";

fn run_commands(args: impl IntoIterator<Item = OsString>, registry: &Registry) -> ExitCode {
    let args: Vec<OsString> = args.into_iter().collect();
    let cli = match Cli::try_parse_from(&args) {
        Ok(cli) => cli,
        Err(error) => {
            // `--help` and `--version` come here too: they go to standard output and end with 0.
            let steers = |arg: &OsString| arg.to_string_lossy().contains(terminal::steers);
            let printed = match error.use_stderr() && args.iter().any(steers) {
                // The message repeats what was typed, or the name of a file.
                true => {
                    io::stderr().write_all(terminal::plain(&error.render().to_string()).as_bytes())
                }
                false => error.print(),
            };
            let status = if error.use_stderr() { 2 } else { 0 };
            return ExitCode::from(if printed.is_err() && status == 0 {
                3
            } else {
                status
            });
        }
    };
    let outcome = match &cli.command {
        Command::Solve(args) => solve(args, registry),
        Command::Check(args) => check(args, registry),
        Command::Export(args) => export(args, registry),
        Command::Run(args) => batch::run(args, registry, tell),
        Command::Plot(args) => plot::run(args, registry, tell),
    };
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            if !error.is_closed_pipe() {
                // Nothing is left to be told where standard error is closed.
                let _ = io::stderr().write_all(diagnostic::render(&error).as_bytes());
            }
            ExitCode::from(error.exit_status())
        }
    }
}

/// `hyperstat solve`
fn solve(args: &args::Solve, registry: &Registry) -> Result<bool, CliError> {
    let mut case = Case::load(&args.input, registry)?;
    outputs::refuse(args.vtu.as_deref(), &case.files)?;
    if args.why {
        case.name_values();
    }
    let solution = case.solve()?;
    let loaded = case.under(&solution, args.case.as_deref(), &args.input.file)?;
    let verification = if args.verify {
        Some(case.verify(&solution)?)
    } else {
        None
    };
    let mut report = SolveReport::new(&case, &solution, verification);
    if args.all_nodes {
        case.add_inner_displacements(&solution, &mut report)?;
    }
    let options = case.modal_options(args.modes(), args.lumped);
    let modal = options.as_ref().map(|options| case.modal(options));
    let modal = modal.transpose()?;
    let modes = modal.as_ref().map(|modal| case.modes(modal));
    let modes = modes.transpose()?;
    if let (Some(options), Some(found)) = (&options, &modes) {
        report.add_modes(ModesReport::new(
            case.model(),
            found,
            options.count,
            args.all_nodes,
        ));
    }
    if let Some(path) = &args.vtu {
        let text = case.vtu(&solution, modes.as_ref())?;
        AtomicFile::write(path, text.as_bytes()).map_err(|source| CliError::Write {
            path: path.clone(),
            source,
        })?;
    }
    if args.why {
        let asked = Asked {
            case: args.case.as_deref(),
            along: args.along,
        };
        report.add_why(case.why(&loaded, asked)?);
        if let Some(modal) = &modal {
            case.add_frequencies(modal, &mut report)?;
        }
    }
    print(&match args.format {
        Format::Text if args.full || args.all_nodes => report.full(),
        Format::Text => report.answer(),
        Format::Json => json(&report)?,
    })?;
    if args.allow_free {
        return Ok(true);
    }
    // What was found is right and is told all the same.
    case.free_output(&solution).map_or(Ok(true), Err)
}

/// `hyperstat check`
fn check(args: &args::Check, registry: &Registry) -> Result<bool, CliError> {
    let case = match Case::load(&args.input, registry) {
        Ok(case) => case,
        Err(error) => {
            if args.format == Format::Json {
                print(&json(&CheckReport::unreadable(&error))?)?;
            }
            return Err(error);
        }
    };
    let here = case.here();
    let kinematics = here.kinematics().ok();
    let (solution, error) = match case.solve() {
        Ok(solution) => {
            let error = case.free_output(&solution);
            (Some(solution), error)
        }
        Err(error) => (None, Some(error)),
    };
    let report = CheckReport::new(&case, kinematics, solution.as_ref(), error.as_ref());
    print(&match args.format {
        Format::Text => report.text(),
        Format::Json => json(&report)?,
    })?;
    error.map_or(Ok(true), Err)
}

/// `hyperstat export`
fn export(args: &args::Export, registry: &Registry) -> Result<bool, CliError> {
    let case = Case::load(&args.input, registry)?;
    outputs::refuse(args.out.as_deref(), &case.files)?;
    let text = case.mechanism_file(registry)?;
    match &args.out {
        None => print(&text)?,
        Some(path) => {
            AtomicFile::write(path, text.as_bytes()).map_err(|source| CliError::Write {
                path: path.clone(),
                source,
            })?;
        }
    }
    Ok(true)
}

/// Prints what is said of results that are files: who closes standard output, as `head` does, has no
/// need of it.
fn tell(text: &str) -> Result<(), CliError> {
    match print(text) {
        Err(error) if error.is_closed_pipe() => Ok(()),
        printed => printed,
    }
}

fn print(text: &str) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    out.write_all(terminal::plain(text).as_bytes())
        .and_then(|()| out.flush())
        .map_err(CliError::Print)
}
