//! Why a question has no answer: what is wrong, where the input says so, and what would be right.

use std::path::{Path, PathBuf};

use hyperstat_assembly::SolveError;
use hyperstat_mechanisms::{
    LoadError, Location, MOST_ROUNDINGS, NotAdjusted, PoseError, WriteError,
};
use hyperstat_reference::ReferenceError;
use serde::Serialize;
use thiserror::Error;

use crate::drives::MissingDrives;
#[cfg(feature = "figures")]
use crate::plot_error::PlotError;

/// A question without its answer. `Display` says what is wrong, [`StudyError::location`] where,
/// [`StudyError::help`] what would be right.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StudyError {
    /// A file that cannot be read or means nothing.
    #[error("{}", load_message(.0))]
    Load(#[from] LoadError),
    /// A choice among jobs, with a mechanism file.
    #[error("`{what}` chooses from a batch file; {} is a mechanism file", .path.display())]
    NotABatch {
        /// `job`, `design` or `pose`.
        what: &'static str,
        /// The file.
        path: PathBuf,
    },
    /// A batch of several jobs of which none is chosen.
    #[error("{} holds several jobs: choose one", .path.display())]
    ChooseJob {
        /// The file.
        path: PathBuf,
        /// Names of its jobs.
        known: Vec<String>,
    },
    /// A job that the batch does not hold.
    #[error("{} holds no job `{job}`", .path.display())]
    UnknownJob {
        /// The file.
        path: PathBuf,
        /// The name that was given.
        job: String,
        /// Names of its jobs.
        known: Vec<String>,
    },
    /// A pose that a job does not have.
    #[error("job `{job}` has no pose {pose}: it has {}, counted from 0", poses(*.count))]
    NoSuchPose {
        /// Where the job is.
        location: Box<Location>,
        /// Its name.
        job: String,
        /// The number that was given.
        pose: usize,
        /// How many it has.
        count: usize,
    },
    /// A design that a job does not have.
    #[error("job `{job}` has no design {design}: it has {count}, counted from 0")]
    NoSuchDesign {
        /// Where the job is.
        location: Box<Location>,
        /// Its name.
        job: String,
        /// The number that was given.
        design: usize,
        /// How many it has.
        count: usize,
    },
    /// A load case that the mechanism or the job does not hold.
    #[error("{of} holds no case `{case}`")]
    UnknownCase {
        /// The mechanism file, or the job.
        of: String,
        /// The name that was given.
        case: String,
        /// Names of its cases.
        known: Vec<String>,
    },
    /// Two columns of a table that would have one name.
    #[error("the table would have two columns `{name}`")]
    SameColumn {
        /// Where one of them is asked for.
        location: Box<Location>,
        /// The name.
        name: String,
    },
    /// A pose that the mechanism cannot take.
    #[error("job `{job}`, pose {pose}: {source}")]
    Pose {
        /// Where the job is.
        location: Box<Location>,
        /// Its name.
        job: String,
        /// Number of the pose.
        pose: usize,
        /// Why.
        source: Box<PoseError>,
        /// The freedoms that the mechanism misses by rounding, in words.
        near: Option<String>,
    },
    /// A mechanism file whose coordinates are not adjusted.
    #[error("{}", unadjusted(.path, *.why))]
    Unadjusted {
        /// The file.
        path: PathBuf,
        /// Why.
        why: NotAdjusted,
        /// Coordinates that are no numbers of the file, by their paths.
        held: Vec<String>,
    },
    /// A mechanism that has no solution.
    #[error("{source}")]
    Unsolvable {
        /// The part that is to blame.
        location: Box<Location>,
        /// Why.
        source: SolveError,
        /// What could hold what moves.
        drives: Box<MissingDrives>,
    },
    /// An output that moves without energy.
    #[error("the output `{output}` moves freely, drives locked: {}", .motions.join("; "))]
    FreeOutput {
        /// Where the output is stated.
        location: Box<Location>,
        /// Its name.
        output: String,
        /// How it moves, in words.
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
        /// Where its output is stated.
        location: Box<Location>,
        /// Why.
        source: WriteError,
    },
    /// A value by which nothing can be differentiated.
    #[error("there is no derivative by `{path}`")]
    NoDerivative {
        /// Its path.
        path: String,
        /// The path that may be meant.
        nearest: Option<String>,
        /// Those by which there are some.
        known: Vec<String>,
    },
    /// A table that cannot be made in memory.
    #[error("the table cannot be made: {source}")]
    Table {
        /// Why.
        source: std::io::Error,
    },
    /// Threads that cannot be had.
    #[error("the threads cannot be started: {why}")]
    Threads {
        /// Why.
        why: String,
    },
    /// A table that cannot be drawn, or does not hold what is asked for.
    #[cfg(feature = "figures")]
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// A figure that the job cannot have.
    #[cfg(feature = "figures")]
    #[error("{source}")]
    JobMap {
        /// The figure in the job.
        location: Box<Location>,
        /// Why.
        source: Box<PlotError>,
    },
}

impl StudyError {
    /// The place in the input that the error is about.
    pub fn location(&self) -> Option<&Location> {
        match self {
            Self::Load(error) => error.location(),
            #[cfg(feature = "figures")]
            Self::Plot(error) => error.location(),
            #[cfg(feature = "figures")]
            Self::JobMap { location, .. } => Some(location),
            Self::NoSuchPose { location, .. }
            | Self::NoSuchDesign { location, .. }
            | Self::SameColumn { location, .. }
            | Self::Pose { location, .. }
            | Self::Unsolvable { location, .. }
            | Self::FreeOutput { location, .. }
            | Self::Export { location, .. } => Some(location),
            _ => None,
        }
    }

    /// A word for the kind of error that programs can rely on: it stays when messages change.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Load(_) => "input",
            Self::NotABatch { .. } => "no-batch",
            Self::ChooseJob { .. } => "job-not-chosen",
            Self::UnknownJob { .. } => "unknown-job",
            Self::NoSuchPose { .. } => "unknown-pose",
            Self::NoSuchDesign { .. } => "unknown-design",
            Self::UnknownCase { .. } => "unknown-case",
            Self::SameColumn { .. } => "same-column",
            Self::Pose { source, .. } => match **source {
                PoseError::Unreachable { .. } => "unreachable",
                PoseError::Singular { .. } => "singular",
                PoseError::Branch { .. } => "branch",
                _ => "pose",
            },
            Self::Unsolvable { source, .. } => match source {
                SolveError::Unheld { .. }
                | SolveError::LoadOnFreeMotion { .. }
                | SolveError::PreloadOnFreeMotion { .. } => "unrestrained",
                SolveError::TooLarge { .. } => "too-large",
                SolveError::Misfit { .. } => "misfit",
                SolveError::NoDensity { .. } | SolveError::NoMass => "no-mass",
                _ => "unsolvable",
            },
            Self::FreeOutput { .. } => "free-output",
            Self::Unverified(_) => "unverified",
            Self::Export { .. } => "export",
            Self::Unadjusted { .. } => "not-adjusted",
            Self::Threads { .. } => "threads",
            Self::Table { .. } => "table",
            Self::NoDerivative { .. } => "no-derivative",
            #[cfg(feature = "figures")]
            Self::Plot(_) | Self::JobMap { .. } => "figure",
        }
    }

    /// What would be right.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Load(error) => error.help().map(Into::into),
            #[cfg(feature = "figures")]
            Self::Plot(error) => error.help(),
            #[cfg(feature = "figures")]
            Self::JobMap { source, .. } => source.help(),
            Self::NotABatch { what, .. } => Some(format!("leave the {what} out")),
            Self::ChooseJob { known, .. } | Self::UnknownJob { known, .. } => {
                Some(format!("its jobs are {}", known.join(", ")))
            }
            Self::UnknownCase { known, .. } => Some(match &**known {
                [] => "it has no cases: leave the case out".into(),
                known => format!("its cases are {}", known.join(", ")),
            }),
            Self::SameColumn { .. } => Some(
                "rename the parameter, case, body or joint that has it, or name a varied parameter \
                 `parameters.…`; or leave the columns out"
                    .into(),
            ),
            Self::NoSuchPose { count: 1, .. } => Some("leave the pose out".into()),
            Self::NoSuchPose { count, .. } => Some(format!(
                "choose a pose from 0 to {}",
                count.saturating_sub(1)
            )),
            Self::NoSuchDesign { count: 1, .. } => Some("leave the design out".into()),
            Self::NoSuchDesign { count, .. } => Some(format!(
                "choose a design from 0 to {}",
                count.saturating_sub(1)
            )),
            Self::Pose { near, .. } => {
                let near = near.as_ref().map(|near| format!("{near}; else "));
                Some(format!(
                    "{}choose a pose in reach",
                    near.unwrap_or_default()
                ))
            }
            Self::Unadjusted { why, held, .. } => Some(numbers_needed(*why, held)),
            Self::Unsolvable { source, drives, .. } => unsolvable(source, drives),
            Self::FreeOutput { drives, .. } => Some(drives.help()),
            Self::Threads { .. } => Some("give a smaller number of threads".into()),
            Self::NoDerivative { nearest, known, .. } => Some(match nearest {
                Some(nearest) => format!("did you mean `{nearest}`?"),
                None => format!("there are those by {}", known.join(", ")),
            }),
            Self::Unverified(_) | Self::Export { .. } | Self::Table { .. } => None,
        }
    }

    /// The error as part of a JSON report.
    pub fn problem(&self) -> Problem {
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

/// Why a file cannot be solved, and where it says so. Field names are those of the JSON output.
#[derive(Debug, Clone, Serialize)]
pub struct Problem {
    /// What is wrong.
    pub message: String,
    /// What would be right.
    pub help: Option<String>,
    /// The file.
    pub path: Option<String>,
    /// Line in it, from 1.
    pub line: Option<usize>,
    /// Character of the line, from 1.
    pub column: Option<usize>,
}

/// What would be right of a mechanism without a solution.
fn unsolvable(source: &SolveError, drives: &MissingDrives) -> Option<String> {
    let help = match source {
        SolveError::Unheld { .. }
        | SolveError::LoadOnFreeMotion { .. }
        | SolveError::PreloadOnFreeMotion { .. } => return Some(drives.help()),
        SolveError::Singular | SolveError::Overflow => {
            "look for numbers of too different size: units are m, N, rad and kg, so a length \
             in mm, a modulus in MPa or a stiffness far above all others is a slip"
        }
        SolveError::TooLarge { .. } => {
            "weld rigid bodies that move as one into one body, make links elastic (`Beam`), or \
             joints (`stiffness`): loops and chains of rigid bodies alone are eliminated as dense \
             matrices"
        }
        SolveError::Misfit { .. } => {
            "give a `stiffness` in that direction to a joint of the loop, make one of its \
             bodies elastic, or change the misfit"
        }
        SolveError::NoDensity { .. } => {
            "give its material a `density` in kg/m³; 0.0 is one without mass"
        }
        SolveError::NoMass => "give a material a `density`, or the mechanism `masses`",
        _ => return None,
    };
    Some(help.into())
}

/// The message, without the place where there is one to show.
fn load_message(error: &LoadError) -> String {
    match error {
        LoadError::At { message, .. } => message.clone(),
        other => other.to_string(),
    }
}

fn poses(count: usize) -> String {
    match count {
        1 => "1 pose".into(),
        _ => format!("{count} poses"),
    }
}

/// Why a file is not adjusted.
fn unadjusted(path: &Path, why: NotAdjusted) -> String {
    let why = match why {
        NotAdjusted::NoNumbers => {
            "no coordinate of a point or an axis is a number of few digits".into()
        }
        NotAdjusted::Nothing => format!(
            "no moves of its coordinates by up to {MOST_ROUNDINGS} roundings give it more freedoms that \
             hold when it moves"
        ),
        _ => "its loops cannot be closed, so that its freedoms are not known".to_owned(),
    };
    format!("{} is not adjusted: {why}", path.display())
}

/// What would be right of a file that is not adjusted.
fn numbers_needed(why: NotAdjusted, held: &[String]) -> String {
    const SHOWN: usize = 4;
    if held.is_empty() || why == NotAdjusted::Unknown {
        return "write its coordinates with all their digits, as `hyperstat export` does".into();
    }
    let shown: Vec<String> = held
        .iter()
        .take(SHOWN)
        .map(|path| format!("`{path}`"))
        .collect();
    let more = match held.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!(
        "expressions and what other files hold stay as they are: write {}{more} as numbers, or with more \
         digits where they come from",
        shown.join(", ")
    )
}
