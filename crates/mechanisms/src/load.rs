//! The way in: a path or a text becomes a mechanism or a batch.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::error::LoadError;
use crate::file::include;
use crate::file::mechanism::Mechanism;
use crate::file::registry::Registry;
use crate::job::batch::Batch;
use crate::text::files::Files;
use crate::text::fragment::Fragment;
use crate::text::named::{is_batch, mechanism_in};
use crate::text::source::Source;

/// What a file holds.
#[derive(Debug)]
#[allow(clippy::large_enum_variant)]
pub enum Input {
    /// One mechanism.
    Mechanism(Mechanism),
    /// A batch of jobs.
    Batch(Batch),
}

/// Reads a mechanism or a batch file: a batch has `jobs`.
///
/// # Errors
/// The file cannot be read, or the first mistake in it or in a file that it names.
pub fn load(path: &Path, files: &dyn Files, registry: &Registry) -> Result<Input, LoadError> {
    read(&Source::read(path, files)?, registry)
}

/// Reads a mechanism or a batch from `text`, which messages call `path`; other files that it
/// names are found relative to `path`.
///
/// # Errors
/// As [`load`].
pub fn load_str(
    text: &str,
    path: &Path,
    files: &dyn Files,
    registry: &Registry,
) -> Result<Input, LoadError> {
    read(&Source::new(path, text, files), registry)
}

/// Reads a mechanism file.
///
/// # Errors
/// As [`load`]; a file that holds a batch.
pub fn load_mechanism(
    path: &Path,
    files: &dyn Files,
    registry: &Registry,
) -> Result<Mechanism, LoadError> {
    read_mechanism(&Source::read(path, files)?, registry)
}

/// Reads a mechanism from `text`, which messages call `path`.
///
/// # Errors
/// As [`load_mechanism`].
pub fn mechanism_from_str(
    text: &str,
    path: &Path,
    files: &dyn Files,
    registry: &Registry,
) -> Result<Mechanism, LoadError> {
    read_mechanism(&Source::new(path, text, files), registry)
}

/// Reads a batch file.
///
/// # Errors
/// As [`load`]; a file that holds a mechanism.
pub fn load_batch(path: &Path, files: &dyn Files, registry: &Registry) -> Result<Batch, LoadError> {
    read_batch(&Source::read(path, files)?, registry)
}

/// Reads a batch from `text`, which messages call `path`; other files that it names are found
/// relative to `path`.
///
/// # Errors
/// As [`load_batch`].
pub fn batch_from_str(
    text: &str,
    path: &Path,
    files: &dyn Files,
    registry: &Registry,
) -> Result<Batch, LoadError> {
    read_batch(&Source::new(path, text, files), registry)
}

impl Input {
    /// All files that were read for it: the one that was asked for and those that it names.
    pub fn files(&self) -> Vec<PathBuf> {
        match self {
            Self::Mechanism(mechanism) => mechanism.files(),
            Self::Batch(batch) => batch.files(),
        }
    }
}

fn read(source: &Arc<Source>, registry: &Registry) -> Result<Input, LoadError> {
    let value = Fragment::of_file(source)?;
    if is_batch(value) {
        return Batch::read(value, registry).map(Input::Batch);
    }
    match value.variant("") {
        Ok((kind, _)) if registry.prebuilt(kind.text()).is_some() => {
            return Err(kind
                .error(format!("`{}` stands in a job of a batch", kind.text()))
                .with_help("write `(jobs: [(name: \"…\", mechanism: …, poses: …)])`"));
        }
        _ => {}
    }
    Mechanism::read(include::mechanism(value)?, registry).map(Input::Mechanism)
}

fn read_mechanism(source: &Arc<Source>, registry: &Registry) -> Result<Mechanism, LoadError> {
    Mechanism::read(include::mechanism(mechanism_in(source)?)?, registry)
}

fn read_batch(source: &Arc<Source>, registry: &Registry) -> Result<Batch, LoadError> {
    let value = Fragment::of_file(source)?;
    if !is_batch(value) {
        return Err(value
            .error("expected a batch of jobs, found no field `jobs`")
            .with_help("a batch is `(jobs: [(name: …, mechanism: File(\"file.ron\"))])`"));
    }
    Batch::read(value, registry)
}
