//! Commands about files themselves: what begins them, puts them in order and describes them.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use clap::builder::PossibleValuesParser;
use clap::{Command, CommandFactory};
use hyperstat_mechanisms::{Along, Disk, View};
use hyperstat_study::disk::{self, OutputError};
use hyperstat_study::files;

use crate::args::{Cli, Completions, FileFormat, Fmt, New, Shell};
use crate::error::CliError;

/// `hyperstat new`
pub(crate) fn new(args: &New) -> Result<String, CliError> {
    let text = files::begin(&args.kind).map_err(|meant| CliError::NoBeginning {
        kind: args.kind.clone(),
        meant,
    })?;
    Ok(match args.format {
        FileFormat::Ron => text,
        FileFormat::Json => files::to_json(&text, Path::new(&args.kind))?,
    })
}

/// `hyperstat completions`
pub(crate) fn completions(args: &Completions) -> String {
    let shell = match args.shell {
        Shell::Bash => clap_complete::Shell::Bash,
        Shell::Zsh => clap_complete::Shell::Zsh,
        Shell::Fish => clap_complete::Shell::Fish,
    };
    let mut script = Vec::new();
    clap_complete::generate(
        shell,
        &mut with_words(Cli::command()),
        "hyperstat",
        &mut script,
    );
    String::from_utf8_lossy(&script).into_owned()
}

/// The commands, with the words that may stand where others may, too.
fn with_words(command: Command) -> Command {
    let offer = |command: Command, argument: &'static str, words: Vec<String>| {
        command.mut_arg(argument, |own| {
            own.value_parser(PossibleValuesParser::new(words))
        })
    };
    let words = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect();
    let along = |command| offer(command, "along", words(&Along::WORDS));
    let commands = command.mut_subcommand("new", |new| offer(new, "kind", files::beginnings()));
    let commands = ["compare", "report"]
        .into_iter()
        .fold(commands, |commands, name| {
            commands.mut_subcommand(name, along)
        });
    commands.mut_subcommand("plot", |plot| {
        let plot = offer(along(plot), "view", words(&View::NAMES));
        offer(plot, "scale", words(&["log", "linear"]))
    })
}

/// `hyperstat fmt`: which files change. Nothing is written before all are read.
pub(crate) fn fmt(args: &Fmt) -> Result<Vec<PathBuf>, CliError> {
    let mut changed = Vec::new();
    for path in &args.files {
        if let Some(text) = files::format_file(path, &Disk)? {
            changed.push((path.clone(), text));
        }
    }
    if !args.check {
        for (path, text) in &changed {
            replace(path, text)?;
        }
    }
    Ok(changed.into_iter().map(|(path, _)| path).collect())
}

/// Puts another text in the place of a file, which keeps its permissions.
fn replace(path: &Path, text: &str) -> Result<(), CliError> {
    let failed = |source| CliError::from(OutputError::write(path)(source));
    let permissions = fs::metadata(path).map_err(failed)?.permissions();
    if permissions.readonly() {
        return Err(failed(io::ErrorKind::PermissionDenied.into()));
    }
    disk::write(path, text.as_bytes())?;
    fs::set_permissions(path, permissions).map_err(failed)
}
