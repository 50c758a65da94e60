//! What can be wrong with a file, and where.

use std::path::PathBuf;
use std::{fmt, io};

use thiserror::Error;

use crate::words;

/// A place in a text file: what an error message points at.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Location {
    /// The file, as it was named; the name of the argument for what a program hands in.
    pub path: PathBuf,
    /// Line, from 1; 0 where the whole of an argument is meant.
    pub line: usize,
    /// Column in characters, from 1; 0 where the whole of an argument is meant.
    pub column: usize,
    /// Number of characters of that line that are meant, at least 1.
    pub width: usize,
    /// Text of that line, without its line break.
    pub text: String,
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => write!(f, "{}", self.path.display()),
            line => write!(f, "{}:{line}:{}", self.path.display(), self.column),
        }
    }
}

/// A file that cannot be used. The text of the error is `path:line:column: message`.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LoadError {
    /// A file that cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why it cannot be read.
        source: io::Error,
    },
    /// A mistake at a place of a file.
    #[error("{location}: {message}")]
    At {
        /// Where.
        location: Box<Location>,
        /// What is wrong.
        message: String,
        /// What would be right, where that can be said.
        help: Option<String>,
        /// Whether it is no value of its kind at all, whatever stands elsewhere: an unknown name, a
        /// text in place of a number, a field that is missing.
        unreadable: bool,
        /// Whether the place is in a JSON file: what would be right is then said in JSON.
        json: bool,
    },
}

impl LoadError {
    /// The place of the mistake; `None` where the file could not be read at all.
    pub fn location(&self) -> Option<&Location> {
        match self {
            Self::Read { .. } => None,
            Self::At { location, .. } => Some(location),
        }
    }

    /// What is wrong, without the place.
    pub fn message(&self) -> String {
        match self {
            Self::Read { source, .. } => format!("cannot be read: {source}"),
            Self::At { message, .. } => message.clone(),
        }
    }

    /// What would be right, where that can be said.
    pub fn help(&self) -> Option<&str> {
        match self {
            Self::Read { .. } => None,
            Self::At { help, .. } => help.as_deref(),
        }
    }

    /// Whether what stands there is no value of its kind at all, whatever stands elsewhere.
    pub(crate) fn is_unreadable(&self) -> bool {
        match self {
            Self::Read { .. } => true,
            Self::At { unreadable, .. } => *unreadable,
        }
    }

    /// The error once more, where it is told at another time.
    pub(crate) fn again(&self) -> Self {
        match self {
            Self::Read { path, source } => Self::Read {
                path: path.clone(),
                source: io::Error::new(source.kind(), source.to_string()),
            },
            Self::At {
                location,
                message,
                help,
                unreadable,
                json,
            } => Self::At {
                json: *json,
                location: location.clone(),
                message: message.clone(),
                help: help.clone(),
                unreadable: *unreadable,
            },
        }
    }

    /// The same error, of what is no value of its kind at all.
    #[must_use]
    pub(crate) fn unreadable(mut self) -> Self {
        if let Self::At { unreadable, .. } = &mut self {
            *unreadable = true;
        }
        self
    }

    /// The same error with this help; nothing changes for a file that cannot be read.
    #[must_use]
    pub fn with_help(mut self, text: impl Into<String>) -> Self {
        if let Self::At { help, json, .. } = &mut self {
            let text = text.into();
            *help = Some(match json {
                true => words::help(&text),
                false => text,
            });
        }
        self
    }
}
