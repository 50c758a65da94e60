//! Why a result is not written, and what would be right.

use std::io;
use std::path::{Path, PathBuf};

use hyperstat_figures::FigureError;
use hyperstat_mechanisms::Location;
use thiserror::Error;

/// Why a result is not written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OutputError {
    /// An output that is a file that was read.
    #[error("{} would be overwritten: {}", .output.display(), read_as(.output, .input))]
    Overwrites {
        /// The output.
        output: PathBuf,
        /// The name that it was read by.
        input: PathBuf,
    },
    /// Two outputs that are one file.
    #[error("{} and {} are the same file", .first.display(), .second.display())]
    SameOutput {
        /// One of them.
        first: PathBuf,
        /// The other.
        second: PathBuf,
    },
    /// A job whose outputs have names that are too long.
    #[error(
        "the name of job `{job}` is too long: {file} would have a name of {length} bytes while it is written"
    )]
    NameTooLong {
        /// Where the job is.
        location: Box<Location>,
        /// Its name.
        job: String,
        /// The file.
        file: String,
        /// Bytes that its name would have.
        length: u64,
        /// What the longest name of a job would have.
        longest: u64,
    },
    /// A result that could not be written.
    #[error("cannot write {}: {source}", .path.display())]
    Write {
        /// Its file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A figure that could not be drawn.
    #[error("cannot draw {}: {source}", .path.display())]
    Figure {
        /// Its file.
        path: PathBuf,
        /// Why.
        source: FigureError,
    },
}

impl OutputError {
    /// The error of a file that could not be written.
    pub fn write(path: &Path) -> impl Fn(io::Error) -> Self {
        |source| Self::Write {
            path: path.into(),
            source,
        }
    }

    /// Whether a disk is to blame, not what was asked for.
    pub fn is_of_disk(&self) -> bool {
        match self {
            Self::Write { .. } => true,
            Self::Figure { source, .. } => matches!(
                source,
                FigureError::Png(_) | FigureError::Pdf(_) | FigureError::Gif(_)
            ),
            _ => false,
        }
    }

    /// The place in the input that it is about.
    pub fn location(&self) -> Option<&Location> {
        match self {
            Self::NameTooLong { location, .. } => Some(location),
            _ => None,
        }
    }

    /// What would be right.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Overwrites { .. } => {
                Some("write to another folder or name: what is read stays as it is".into())
            }
            Self::SameOutput { .. } => Some("remove the link, or write to another folder".into()),
            Self::NameTooLong { longest, .. } => Some(format!(
                "give it a name of at most {longest} characters: that of each of its files must \
                 fit the file system"
            )),
            _ => None,
        }
    }
}

/// How an output that would be overwritten was read.
fn read_as(output: &Path, input: &Path) -> String {
    match output == input {
        true => "it was read".into(),
        false => format!("it was read as {}", input.display()),
    }
}
