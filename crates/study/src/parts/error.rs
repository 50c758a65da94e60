//! What is wrong with parts of a run, and what would be right.

use std::io;

use thiserror::Error;

/// What is wrong with parts of a run. Names are of files in the folder of results.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PartsError {
    /// A file that cannot be read.
    #[error("cannot read {name}: {source}")]
    Read {
        /// Its name.
        name: String,
        /// Why.
        source: io::Error,
    },
    /// A file that cannot be written.
    #[error("cannot write {name}: {source}")]
    Write {
        /// Its name.
        name: String,
        /// Why.
        source: io::Error,
    },
    /// Parts without the file that says what was read for them.
    #[error("{name}, which has all that was read for the parts, cannot be used: {why}")]
    NoOrigin {
        /// Its name.
        name: String,
        /// Why.
        why: String,
    },
    /// Parts that another version of hyperstat began.
    #[error("the parts are of hyperstat {then}, and this is {now}")]
    Version {
        /// That version.
        then: String,
        /// This version.
        now: &'static str,
    },
    /// Parts of another run where those of this one are to be.
    #[error("{folder} has parts of another run{}", because(.difference))]
    Other {
        /// The folder.
        folder: String,
        /// What was different; empty where it is not known.
        difference: String,
    },
    /// Parts of several runs that are to be one.
    #[error("{first} and {second} are parts of different runs{}", because(.difference))]
    Several {
        /// A manifest.
        first: String,
        /// Another.
        second: String,
        /// What was different, seen from the first.
        difference: String,
    },
    /// No parts at all.
    #[error("there are no parts of a run")]
    Nothing,
    /// Parts that were to be joined when somebody ended it.
    #[error("interrupted before all parts were joined")]
    Stopped,
    /// Rows that stand in two files of a dataset.
    #[error("{name} has rows that other parts have, too, or none that can be trusted")]
    Twice {
        /// The file that is too much.
        name: String,
    },
}

fn because(difference: &str) -> String {
    match difference {
        "" => String::new(),
        difference => format!(": {difference}"),
    }
}

impl PartsError {
    /// What would be right.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::NoOrigin { .. } => Some(
                "`hyperstat run` with the files and options of one of the parts writes it again"
                    .into(),
            ),
            Self::Version { then, .. } => Some(format!(
                "go on with hyperstat {then}: bytes may differ from version to version"
            )),
            Self::Other { .. } => Some(
                "write to another folder, or give `--fresh`, which removes them and begins anew"
                    .into(),
            ),
            Self::Several { .. } => Some(
                "run the parts that are not wanted again with `--fresh`, or remove their files"
                    .into(),
            ),
            Self::Nothing => {
                Some("`hyperstat run BATCH --out DIR --shard 0/4` writes the first of four".into())
            }
            Self::Stopped => Some("give the same command again: the parts are there".into()),
            Self::Twice { .. } => Some("remove it, or merge without `--dataset`".into()),
            _ => None,
        }
    }

    pub(super) fn read(name: &str) -> impl FnOnce(io::Error) -> Self {
        |source| Self::Read {
            name: name.into(),
            source,
        }
    }

    pub(super) fn write(name: &str) -> impl Fn(io::Error) -> Self {
        |source| Self::Write {
            name: name.into(),
            source,
        }
    }
}
