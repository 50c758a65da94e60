//! Why a command ends without its result, and the exit status that says so.

use std::io;
use std::path::{Path, PathBuf};

use hyperstat_assembly::SolveError;
use hyperstat_figures::FigureError;
use hyperstat_mechanisms::{LoadError, Location, PoseError, WriteError};
use hyperstat_reference::ReferenceError;
use rayon::ThreadPoolBuildError;
use thiserror::Error;

use crate::drives::MissingDrives;
use crate::plot::PlotError;
use crate::report::Problem;

/// A command that ends without its result.
#[derive(Debug, Error)]
#[non_exhaustive]
pub(crate) enum CliError {
    /// A file that cannot be read or means nothing.
    #[error("{}", load_message(.0))]
    Load(#[from] LoadError),
    /// `--job` or `--pose` with a mechanism file.
    #[error("`{option}` chooses from a batch file; {} is a mechanism file", .path.display())]
    NotABatch { option: &'static str, path: PathBuf },
    /// A batch of several jobs without `--job`.
    #[error("{} holds several jobs: choose one with `--job`", .path.display())]
    ChooseJob { path: PathBuf, known: Vec<String> },
    /// A `--job` that the batch does not hold.
    #[error("{} holds no job `{job}`", .path.display())]
    UnknownJob {
        path: PathBuf,
        job: String,
        known: Vec<String>,
    },
    /// A pose that a job does not have.
    #[error("job `{job}` has no pose {pose}: it has {}, counted from 0", poses(*.count))]
    NoSuchPose {
        location: Box<Location>,
        job: String,
        pose: usize,
        count: usize,
    },
    /// A design that a job does not have.
    #[error("job `{job}` has no design {design}: it has {count}, counted from 0")]
    NoSuchDesign {
        location: Box<Location>,
        job: String,
        design: usize,
        count: usize,
    },
    /// A `--case` that the mechanism or the job does not hold.
    #[error("{of} holds no case `{case}`")]
    UnknownCase {
        /// The mechanism file, or the job.
        of: String,
        case: String,
        known: Vec<String>,
    },
    /// A pose that the mechanism cannot take.
    #[error("job `{job}`, pose {pose}: {source}")]
    Pose {
        location: Box<Location>,
        job: String,
        pose: usize,
        source: Box<PoseError>,
    },
    /// A mechanism that has no solution.
    #[error("{source}")]
    Unsolvable {
        location: Box<Location>,
        source: SolveError,
        /// What could hold what moves.
        drives: Box<MissingDrives>,
    },
    /// An output that moves without energy.
    #[error("the output `{output}` moves freely, drives locked: {}", .motions.join("; "))]
    FreeOutput {
        location: Box<Location>,
        output: String,
        motions: Vec<String>,
        /// What could hold it.
        drives: Box<MissingDrives>,
    },
    /// A model that the independent solver does not take.
    #[error("the independent solver has no result to compare with: {0}")]
    Unverified(#[source] ReferenceError),
    /// A mechanism that no mechanism file describes.
    #[error("cannot be exported: {source}")]
    Export {
        location: Box<Location>,
        source: WriteError,
    },
    /// An output that is a file that was read.
    #[error("{} would be overwritten: {}", .output.display(), read_as(.output, .input))]
    Overwrites { output: PathBuf, input: PathBuf },
    /// Two outputs that are one file.
    #[error("{} and {} are the same file", .first.display(), .second.display())]
    SameOutput { first: PathBuf, second: PathBuf },
    /// A job whose outputs have names that are too long.
    #[error(
        "the name of job `{job}` is too long: {file} would have a name of {length} bytes while it is written"
    )]
    NameTooLong {
        location: Box<Location>,
        job: String,
        file: String,
        length: u64,
        /// What the longest name of a job would have.
        longest: u64,
    },
    /// A run that is larger than it was probably meant to be.
    #[error("{why}")]
    NotAgreed { why: String },
    /// Threads that cannot be had.
    #[error("the threads cannot be started: {0}")]
    Threads(#[from] ThreadPoolBuildError),
    /// A result that could not be written.
    #[error("cannot write {}: {source}", .path.display())]
    Write { path: PathBuf, source: io::Error },
    /// Standard output that could not be written.
    #[error("cannot write to standard output: {0}")]
    Print(#[source] io::Error),
    /// A table that cannot be drawn, or does not hold what is asked for.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// A map that the job's table will not hold.
    #[error("{source}")]
    JobMap {
        location: Box<Location>,
        source: Box<PlotError>,
    },
    /// A figure that could not be drawn.
    #[error("cannot draw {}: {source}", .path.display())]
    Figure { path: PathBuf, source: FigureError },
}

impl CliError {
    /// The exit status: 2 for input that cannot be used, 3 for an output that cannot be written.
    pub(crate) fn exit_status(&self) -> u8 {
        match self {
            Self::Write { .. }
            | Self::Print(_)
            | Self::Figure {
                source: FigureError::Png(_),
                ..
            } => 3,
            _ => 2,
        }
    }

    /// The place in the input that the error is about.
    pub(crate) fn location(&self) -> Option<&Location> {
        match self {
            Self::Load(error) => error.location(),
            Self::Plot(error) => error.location(),
            Self::NoSuchPose { location, .. }
            | Self::NoSuchDesign { location, .. }
            | Self::Pose { location, .. }
            | Self::Unsolvable { location, .. }
            | Self::FreeOutput { location, .. }
            | Self::JobMap { location, .. }
            | Self::NameTooLong { location, .. }
            | Self::Export { location, .. } => Some(location),
            _ => None,
        }
    }

    /// What would be right.
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Load(error) => error.help().map(Into::into),
            Self::Plot(error) => error.help(),
            Self::JobMap { source, .. } => source.help(),
            Self::NotABatch { option, .. } => Some(format!("leave `{option}` out")),
            Self::ChooseJob { known, .. } | Self::UnknownJob { known, .. } => {
                Some(format!("its jobs are {}", known.join(", ")))
            }
            Self::UnknownCase { known, .. } => Some(match &**known {
                [] => "it has no cases: leave `--case` out".into(),
                known => format!("its cases are {}", known.join(", ")),
            }),
            Self::NoSuchPose { count: 1, .. } => Some("leave `--pose` out".into()),
            Self::NoSuchPose { count, .. } => {
                Some(format!("choose `--pose` from 0 to {}", count - 1))
            }
            Self::NoSuchDesign { count: 1, .. } => Some("leave `--design` out".into()),
            Self::NoSuchDesign { count, .. } => {
                Some(format!("choose `--design` from 0 to {}", count - 1))
            }
            Self::Pose { .. } => Some("choose a pose in reach with `--pose`".into()),
            Self::Unsolvable {
                source:
                    SolveError::Unheld { .. }
                    | SolveError::LoadOnFreeMotion { .. }
                    | SolveError::PreloadOnFreeMotion { .. },
                drives,
                ..
            } => Some(drives.help()),
            Self::Unsolvable {
                source: SolveError::Singular | SolveError::Overflow,
                ..
            } => Some(
                "look for numbers of too different size: units are m, N, rad and kg, so a length \
                 in mm, a modulus in MPa or a stiffness far above all others is a slip"
                    .into(),
            ),
            Self::Unsolvable {
                source: SolveError::TooLarge { .. },
                ..
            } => Some(
                "weld rigid bodies that move as one into one body, make links elastic (`Beam`), or \
                 joints (`stiffness`): loops and chains of rigid bodies alone are eliminated as dense \
                 matrices"
                    .into(),
            ),
            Self::Unsolvable {
                source: SolveError::Misfit { .. },
                ..
            } => Some(
                "give a `stiffness` in that direction to a joint of the loop, make one of its \
                 bodies elastic, or change the misfit"
                    .into(),
            ),
            Self::Unsolvable {
                source: SolveError::NoDensity { .. },
                ..
            } => Some("give its material a `density` in kg/m³; 0.0 is one without mass".into()),
            Self::Unsolvable {
                source: SolveError::NoMass,
                ..
            } => Some("give a material a `density`, or the mechanism `masses`".into()),
            Self::FreeOutput { drives, .. } => Some(format!(
                "{}; `solve --allow-free` takes it as it is",
                drives.help()
            )),
            Self::Overwrites { .. } => {
                Some("write to another folder or name: what is read stays as it is".into())
            }
            Self::SameOutput { .. } => Some("remove the link, or write to another folder".into()),
            Self::NameTooLong { longest, .. } => Some(format!(
                "give it a name of at most {longest} characters: that of each of its files must \
                 fit the file system"
            )),
            Self::NotAgreed { .. } => Some(
                "give fewer poses or designs, another `--out`, or `--yes` if that is what is meant"
                    .into(),
            ),
            Self::Unverified(_) => Some("leave `--verify` out".into()),
            Self::Threads(_) => Some("give a smaller number of `--threads`".into()),
            _ => None,
        }
    }

    /// Whether the reader of standard output has closed it, as `head` does: nobody wants to be
    /// told.
    pub(crate) fn is_closed_pipe(&self) -> bool {
        matches!(self, Self::Print(error) if error.kind() == io::ErrorKind::BrokenPipe)
    }

    /// The error as part of a JSON report.
    pub(crate) fn problem(&self) -> Problem {
        let location = self.location();
        Problem {
            message: self.to_string(),
            help: self.help(),
            path: location.map(|location| location.path.display().to_string()),
            line: location.map(|location| location.line),
            column: location.map(|location| location.column),
        }
    }
}

/// The message, without the place where there is one to show.
fn load_message(error: &LoadError) -> String {
    match error {
        LoadError::At { message, .. } => message.clone(),
        other => other.to_string(),
    }
}

/// How an output that would be overwritten was read.
fn read_as(output: &Path, input: &Path) -> String {
    match output == input {
        true => "it was read".into(),
        false => format!("it was read as {}", input.display()),
    }
}

fn poses(count: usize) -> String {
    match count {
        1 => "1 pose".into(),
        _ => format!("{count} poses"),
    }
}
