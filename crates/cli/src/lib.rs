//! The commands of hyperstat as a library: [`run`] with joint kinds of your own.
//!
#![doc = include_str!("../README.md")]

mod args;
mod compare;
mod consent;
mod diagnostic;
mod error;
mod files;
mod json;
mod plot;
mod report;
mod run;
mod signals;
mod terminal;
mod text;
mod view;

use std::ffi::OsString;
use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

use clap::Parser;
use hyperstat_mechanisms::{Disk, Registry};
use hyperstat_study::disk;
use hyperstat_study::{AdjustReport, Asked, CheckReport, Question, Study};

use args::{Cli, Command, FileFormat, Format};
use error::CliError;
use json::json;

/// Runs the command line `args` (the program's name first) with the kinds of joints in
/// `registry`: a binary with joints of its own registers them and calls this.
///
/// Results go to standard output, errors to standard error. The exit status is 0 where all is
/// done, 1 where a run finished in which some pose has no result, 2 where the input cannot be
/// used (the command line itself too), 3 where an output could not be written, 130 where somebody
/// interrupted a run, which then goes on when it is started again. A panic ends here,
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
        Command::Compare(args) => compare::run(args, registry).and_then(|text| printed(&text)),
        Command::Report(args) => report::run(args, registry).and_then(|page| match page {
            Some(page) => printed(&page),
            None => Ok(true),
        }),
        Command::View(args) => {
            view::run(args, registry).and_then(|text| tell(&text).map(|()| true))
        }
        Command::Export(args) => export(args, registry),
        Command::New(args) => files::new(args).and_then(|text| printed(&text)),
        Command::Fmt(args) => fmt(args),
        Command::Adjust(args) => adjust(args, registry),
        Command::Schema => printed(&hyperstat_study::files::schema(registry)),
        Command::Completions(args) => printed(&files::completions(args)),
        Command::Run(args) => run::run(args, registry, tell),
        Command::Merge(args) => run::merge(args, registry, tell),
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

/// The study of what the command line names.
fn study(input: &args::Input, registry: &Registry) -> Result<Study, CliError> {
    Ok(Study::open(
        &input.file,
        &input.selection(),
        &Disk,
        registry,
    )?)
}

/// `hyperstat solve`
fn solve(args: &args::Solve, registry: &Registry) -> Result<bool, CliError> {
    let mut study = study(&args.input, registry)?;
    disk::refuse(args.vtu.as_deref(), study.files())?;
    let answered = study.answer(&Question {
        verify: args.verify,
        all_nodes: args.all_nodes,
        modes: args.modes(),
        mass: args.mass(),
        why: args.why.then(|| Asked {
            case: args.case.clone(),
            along: args.along,
        }),
    })?;
    if let Some(path) = &args.vtu {
        let text = study.vtu(&answered.solution, answered.modes.as_ref())?;
        disk::write(path, text.as_bytes())?;
    }
    let report = &answered.report;
    print(&match args.format {
        Format::Text if args.full || args.all_nodes => text::full(report, study.model()),
        Format::Text => text::answer(report, study.model()),
        Format::Json => json(report)?,
    })?;
    if args.allow_free {
        return Ok(true);
    }
    // What was found is right and is told all the same.
    let free = study.free_output(&answered.solution);
    free.map_or(Ok(true), |error| Err(error.into()))
}

/// `hyperstat check`
fn check(args: &args::Check, registry: &Registry) -> Result<bool, CliError> {
    let opened = Study::open(&args.input.file, &args.input.selection(), &Disk, registry);
    let (mut report, error) = match opened {
        Ok(study) => {
            let (report, error) = study.check();
            let error = error.or_else(|| study.check_job().err());
            (report, error)
        }
        // There is nothing to tell in words that the error does not.
        Err(error) if args.format == Format::Text => return Err(error.into()),
        Err(error) => (CheckReport::unreadable(&error), Some(error)),
    };
    report.problem = error.as_ref().map(error::problem);
    print(&match args.format {
        Format::Text => text::check(&report),
        Format::Json => json(&report)?,
    })?;
    error.map_or(Ok(true), |error| Err(error.into()))
}

/// `hyperstat export`
fn export(args: &args::Export, registry: &Registry) -> Result<bool, CliError> {
    let study = study(&args.input, registry)?;
    disk::refuse(args.out.as_deref(), study.files())?;
    let text = match args.format {
        FileFormat::Ron => study.mechanism_file(registry)?,
        FileFormat::Json => study.mechanism_file_json(registry)?,
    };
    match &args.out {
        None => print(&text)?,
        Some(path) => disk::write(path, text.as_bytes())?,
    }
    Ok(true)
}

/// `hyperstat fmt`
fn fmt(args: &args::Fmt) -> Result<bool, CliError> {
    let changed = files::fmt(args)?;
    let names = changed.iter().map(|path| format!("{}\n", path.display()));
    tell(&names.collect::<String>())?;
    Ok(changed.is_empty() || !args.check)
}

/// `hyperstat adjust`
fn adjust(args: &args::Adjust, registry: &Registry) -> Result<bool, CliError> {
    let mechanism = hyperstat_mechanisms::load_mechanism(&args.file, &Disk, registry)?;
    disk::refuse(args.out.as_deref(), &mechanism.files())?;
    let (report, text) = AdjustReport::new(&mechanism, &args.file)?;
    if let Some(path) = &args.out {
        let text = text.as_deref().unwrap_or_else(|| mechanism.text());
        disk::write(path, text.as_bytes())?;
    }
    print(&match args.format {
        Format::Text => text::adjust(&report),
        Format::Json => json(&report)?,
    })?;
    Ok(true)
}

/// Prints what a command is asked for.
fn printed(text: &str) -> Result<bool, CliError> {
    print(text).map(|()| true)
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
