//! Why a command ends without its result, and the exit status that says so.

use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};

use hyperstat_mechanisms::{LoadError, Location};
use hyperstat_study::PlotError;
use hyperstat_study::disk::OutputError;
use hyperstat_study::parts::PartsError;
use hyperstat_study::{Problem, StudyError};
use thiserror::Error;

use crate::signals::INTERRUPTED;

/// A command that ends without its result.
#[derive(Debug, Error)]
#[non_exhaustive]
pub(crate) enum CliError {
    /// A question without its answer.
    #[error("{}", message(.0))]
    Study(#[from] StudyError),
    /// A result that is not written.
    #[error("{0}")]
    Output(#[from] OutputError),
    /// A run that is larger than it was probably meant to be.
    #[error("{why}")]
    NotAgreed { why: String },
    /// Something about parts of a run.
    #[error("{}: {source}", .out.display())]
    Parts { out: PathBuf, source: PartsError },
    /// A run that somebody ended before its last row.
    #[error("interrupted: {done} of {rows} rows are done{}", kept(.done, .out))]
    Interrupted { done: u64, rows: u64, out: PathBuf },
    /// Parts of a run that are not all there.
    #[error("{}: {rows} rows are missing", .out.display())]
    Missing { out: PathBuf, rows: usize },
    /// Parts that are no dataset.
    #[error("`--dataset` is of parts in Parquet; those of {} are CSV", .out.display())]
    NoDataset { out: PathBuf },
    /// Rows that no job has.
    #[error("there is no row {row}: `{job}`, the longest job, has {count}, counted from 0")]
    NoRows {
        row: usize,
        job: String,
        count: usize,
        /// The rows of those that were asked for that there are.
        there: Option<Range<usize>>,
    },
    /// A task of a job array that cannot be told.
    #[error("`--shard auto`: {0}")]
    NoTask(String),
    /// Standard output that could not be written.
    #[error("cannot write to standard output: {0}")]
    Print(#[source] io::Error),
    /// A magnification where colours are meant, or the other way round.
    #[error("`--scale {given}` is none of {of}")]
    Scale { given: String, of: &'static str },
    /// A figure of a mechanism, asked of a file that holds none.
    #[error("`{option}` is drawn of a mechanism; {} holds none", .path.display())]
    NoMechanism { path: PathBuf, option: &'static str },
    /// An option that chooses what the file does not leave open.
    #[error("`{option}` chooses from a batch file; {} is {what}", .path.display())]
    NoChoice {
        path: PathBuf,
        option: &'static str,
        what: &'static str,
    },
    /// A picture that is to move, of what stands still.
    #[error("{} is a picture that moves", .path.display())]
    Still { path: PathBuf },
    /// A file that nothing is named beside.
    #[error("nothing is named that {} is to be compared with", .path.display())]
    NothingToCompare { path: PathBuf },
    /// A table and what is none.
    #[error("{} is a table, and {} is none", .table.display(), .other.display())]
    Unlike { table: PathBuf, other: PathBuf },
    /// A file to begin with that there is none of.
    #[error("there is no file `{kind}` to begin with")]
    NoBeginning { kind: String, meant: Option<String> },
    /// A direction or a case for a budget that is found already.
    #[error("{} is solved already, along the direction and under the loads that it states", .path.display())]
    Answered { path: PathBuf, option: &'static str },
}

impl CliError {
    /// The exit status: 2 for input that cannot be used, 3 for an output that cannot be written.
    pub(crate) fn exit_status(&self) -> u8 {
        match self {
            Self::Interrupted { .. }
            | Self::Parts {
                source: PartsError::Stopped,
                ..
            } => INTERRUPTED,
            Self::Output(error) if error.is_of_disk() => 3,
            Self::Print(_) => 3,
            _ => 2,
        }
    }

    /// The place in the input that the error is about.
    pub(crate) fn location(&self) -> Option<&Location> {
        match self {
            Self::Study(error) => error.location(),
            Self::Output(error) => error.location(),
            _ => None,
        }
    }

    /// What would be right.
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Study(error) => help(error),
            Self::Output(error) => error.help(),
            Self::Parts { source, .. } => source.help(),
            Self::Interrupted { .. } => Some(
                "give the same command again: it goes on from there, to the same bytes".into(),
            ),
            Self::Missing { .. } => Some(
                "give `hyperstat run` with the same file, options and `--out` once with each line of \
                 standard output, then merge again"
                    .into(),
            ),
            Self::NoDataset { .. } => Some("leave `--dataset` out".into()),
            Self::NoRows { there: Some(there), .. } => {
                Some(format!("give `--rows {}..{}`", there.start, there.end))
            }
            Self::NoRows { count, .. } => Some(format!("choose from `--rows 0..{count}`")),
            Self::NotAgreed { .. } => Some(
                "give fewer poses or designs, another `--out`, or `--yes` if that is what is meant"
                    .into(),
            ),
            Self::Scale { of: MAP, .. } => Some("give `log` or `linear`, or leave it out".into()),
            Self::Scale { .. } => Some("give a factor above zero, such as 200".into()),
            Self::NoMechanism { .. } => Some(
                "give the mechanism file, or the batch file with `--job`, `--design` and `--pose`"
                    .into(),
            ),
            Self::NoBeginning {
                meant: Some(meant), ..
            } => Some(format!("did you mean `{meant}`?")),
            Self::NoBeginning { .. } => {
                let known = hyperstat_study::files::beginnings();
                Some(format!("give one of `{}`", known.join("`, `")))
            }
            Self::Still { .. } => {
                Some("give `--animate`, of a mode or a deformed mechanism, or another ending".into())
            }
            Self::NothingToCompare { .. } => Some(
                "give a second file, or `--with-job`, `--with-design` or `--with-pose` for another of the \
                 same batch file"
                    .into(),
            ),
            Self::Unlike { .. } => Some("give two tables of `run`, or two mechanism or batch files".into()),
            Self::NoChoice { option, .. } => Some(format!("leave `{option}` out")),
            Self::Answered { option, .. } => Some(format!(
                "give `{option}` to `hyperstat solve --why`, or draw the mechanism file"
            )),
            _ => None,
        }
    }

    /// Whether the reader of standard output has closed it, as `head` does: nobody wants to be
    /// told.
    pub(crate) fn is_closed_pipe(&self) -> bool {
        matches!(self, Self::Print(error) if error.kind() == io::ErrorKind::BrokenPipe)
    }
}

impl CliError {
    /// Something about parts of a run in this folder.
    pub(crate) fn parts(out: &Path) -> impl Fn(PartsError) -> Self {
        |source| match source {
            PartsError::Write { name, source } => {
                OutputError::write(&out.join(name))(source).into()
            }
            source => Self::Parts {
                out: out.into(),
                source,
            },
        }
    }
}

/// Where what was done is kept.
fn kept(done: &u64, out: &Path) -> String {
    match done {
        0 => String::new(),
        _ => format!(", and kept in {}", out.display()),
    }
}

impl From<LoadError> for CliError {
    fn from(error: LoadError) -> Self {
        Self::Study(error.into())
    }
}

impl From<PlotError> for CliError {
    fn from(error: PlotError) -> Self {
        Self::Study(error.into())
    }
}

/// What a scale of colours is of, and one that magnifies.
pub(crate) const MAP: &str = "a map";
pub(crate) const SHAPE: &str = "what is magnified";

/// An error of a study as part of a JSON report, in the words of the command line.
pub(crate) fn problem(error: &StudyError) -> Problem {
    Problem {
        message: message(error),
        help: help(error),
        ..error.problem()
    }
}

/// The message, with the names of options.
fn message(error: &StudyError) -> String {
    match error {
        StudyError::NotABatch { what, path } => format!(
            "`--{what}` chooses from a batch file; {} is a mechanism file",
            path.display()
        ),
        StudyError::ChooseJob { .. } => format!("{error} with `--job`"),
        other => other.to_string(),
    }
}

/// What would be right, with the names of options.
fn help(error: &StudyError) -> Option<String> {
    let last = |count: usize| count.saturating_sub(1);
    Some(match error {
        StudyError::Plot(error) => return plot_help(error),
        StudyError::NotABatch { what, .. } => format!("leave `--{what}` out"),
        StudyError::UnknownCase { known, .. } if known.is_empty() => {
            "it has no cases: leave `--case` out".into()
        }
        StudyError::NoSuchPose { count: 1, .. } => "leave `--pose` out".into(),
        StudyError::NoSuchPose { count, .. } => {
            format!("choose `--pose` from 0 to {}", last(*count))
        }
        StudyError::NoSuchDesign { count: 1, .. } => "leave `--design` out".into(),
        StudyError::NoSuchDesign { count, .. } => {
            format!("choose `--design` from 0 to {}", last(*count))
        }
        StudyError::Pose { near, .. } => {
            let near = near.as_ref().map(|near| format!("{near}; else "));
            format!(
                "{}choose a pose in reach with `--pose`",
                near.unwrap_or_default()
            )
        }
        StudyError::FreeOutput { .. } => format!(
            "{}; `solve --allow-free` takes it as it is",
            error.help().unwrap_or_default()
        ),
        StudyError::Unverified(_) => "leave `--verify` out".into(),
        StudyError::Threads { .. } => "give a smaller number of `--threads`".into(),
        other => return other.help(),
    })
}

/// The same of a figure of a table.
fn plot_help(error: &PlotError) -> Option<String> {
    Some(match error {
        PlotError::NoShares { .. } => "give another direction with `--along`".into(),
        PlotError::NoMode { count, .. } if *count > 0 => {
            format!("choose `--mode` from 1 to {count}, or give segments more `elements`")
        }
        PlotError::OtherPlanes {
            common: Some(plane),
            ..
        } => {
            let held: String = plane.split_whitespace().take(3).collect();
            format!(
                "choose a plane of both, such as `--plane {}`",
                held.replace('−', "-")
            )
        }
        PlotError::AlongNormal { .. } => "choose other `--axes`, or another `--plane`".into(),
        PlotError::Several { differ, .. } => match &**differ {
            [] => "the same pose is there more than once: draw `--lines` over `pose`".into(),
            differ => {
                let planes = differ.iter().map(|axis| format!("`--plane {axis}=…`"));
                let planes: Vec<_> = planes.collect();
                format!("choose among them with {}", planes.join(" and "))
            }
        },
        PlotError::NoRows { what, last: 0, .. } => {
            format!("{what}s are counted from 0: leave `--{what}` out")
        }
        PlotError::NoRows { what, last, .. } => {
            format!("choose `--{what}` from 0 to {last}: {what}s are counted from 0")
        }
        other => return other.help(),
    })
}
