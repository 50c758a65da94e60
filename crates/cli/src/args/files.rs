//! Commands about files themselves: written, begun, put in order, described.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::input::{Format, Input};

pub(super) const EXPORT_HELP: &str = "\
The file has every point, body and joint of the mechanism in that pose, and the job's loads; it
solves to the same numbers.

Examples:
  hyperstat export paper.ron > delta.ron
  hyperstat export paper.ron --job delta --pose 12 --out delta.ron
  hyperstat export portal.ron --format json > portal.json";

pub(super) const NEW_HELP: &str = "\
`mechanism` is a small mechanism, everything else a batch of one job of that prebuilt mechanism, with
poses that it reaches. Case and dashes do not matter. Each passes `check` and `run` or `solve`.

Examples:
  hyperstat new mechanism > arm.ron
  hyperstat new delta > robot.ron
  hyperstat new three-rps --format json > robot.json";

pub(super) const SCHEMA_HELP: &str = "\
JSON Schema, draft 2020-12, of mechanism and batch files. An editor that is told of it completes names in
JSON files and marks what is wrong, by its settings or by a first field
\"$schema\": \"hyperstat.schema.json\".

Example:
  hyperstat schema > hyperstat.schema.json";

pub(super) const COMPLETIONS_HELP: &str = "\
Examples:
  hyperstat completions bash > ~/.local/share/bash-completion/completions/hyperstat
  hyperstat completions zsh > ~/.zfunc/_hyperstat
  hyperstat completions fish > ~/.config/fish/completions/hyperstat.fish";

pub(super) const FMT_HELP: &str = "\
Comments, names, numbers and texts stay as they are, and what the file says. A file whose grammar is
wrong is left alone.

Examples:
  hyperstat fmt robot.ron
  hyperstat fmt --check *.ron              Ends with 1 where a file would change";

pub(super) const ADJUST_HELP: &str = "\
Points and axes that are written as numbers move by the least amount, each measured by its last digit,
that gives the mechanism the freedoms which it nearly has, by finite amounts; and so that beams stay
straight along which joints slide. No number moves by more than five roundings. Comments, layout, units
and expressions stay. Without --out it says what would move.

Examples:
  hyperstat adjust robot.ron --out exact.ron
  hyperstat adjust robot.ron --format json";

/// `hyperstat adjust`
#[derive(Debug, Args)]
pub(crate) struct Adjust {
    /// Mechanism file (RON or JSON)
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// File to write
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Form of the report on standard output
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

/// `hyperstat export`
#[derive(Debug, Args)]
pub(crate) struct Export {
    #[command(flatten)]
    pub(crate) input: Input,
    /// File to write; standard output without it
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Form of the file
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: FileFormat,
}

/// `hyperstat new`
#[derive(Debug, Args)]
pub(crate) struct New {
    /// `mechanism`, or a prebuilt mechanism such as `delta`
    #[arg(value_name = "KIND")]
    pub(crate) kind: String,
    /// Form of the file; JSON has no comments
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: FileFormat,
}

/// `hyperstat completions`
#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// The shell
    #[arg(value_name = "SHELL", value_enum)]
    pub(crate) shell: Shell,
}

/// `hyperstat fmt`
#[derive(Debug, Args)]
pub(crate) struct Fmt {
    /// Mechanism or batch files, RON or JSON
    #[arg(value_name = "FILE", required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Name the files that would change, and change none
    #[arg(long)]
    pub(crate) check: bool,
}

/// Form of a mechanism or batch file.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum FileFormat {
    /// Rusty Object Notation
    #[default]
    Ron,
    /// JSON, the same names
    Json,
}

/// A shell that completions are written for.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum Shell {
    Bash,
    Zsh,
    Fish,
}
