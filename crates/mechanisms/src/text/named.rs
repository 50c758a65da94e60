//! Files that a file names, and what kind of file a text is.

use std::sync::Arc;

use super::fragment::Fragment;
use super::source::{Place, Source};
use crate::error::LoadError;

/// Where the mechanism stands in the file whose path stands at `path` in another file.
pub(crate) fn mechanism_at(path: Fragment<'_>) -> Result<Place, LoadError> {
    let source = read_named(path)?;
    mechanism_in(&source).map(Fragment::place)
}

/// Reads the file whose path stands at `path` in another file, relative to that file.
pub(crate) fn read_named(path: Fragment<'_>) -> Result<Arc<Source>, LoadError> {
    let file = path.source().relative(&path.string()?);
    path.source()
        .read_named(&file)
        .map_err(|error| match error {
            LoadError::Read { path: file, source } => path
                .error(format!("cannot read {}: {source}", file.display()))
                .with_help("a path is relative to the folder of the file that names it"),
            other => other,
        })
}

/// The value of a file, unless it is a batch.
pub(crate) fn mechanism_in(source: &Arc<Source>) -> Result<Fragment<'_>, LoadError> {
    let value = Fragment::of_file(source)?;
    if is_batch(value) {
        return Err(value
            .error("expected a mechanism, found a batch of jobs")
            .with_help("name one of the mechanism files that the batch uses"));
    }
    if has_field(value, "bodies") {
        source.understood();
    }
    Ok(value)
}

pub(crate) fn is_batch(value: Fragment<'_>) -> bool {
    has_field(value, "jobs")
}

pub(crate) fn has_field(value: Fragment<'_>, field: &str) -> bool {
    let fields = value.named("").unwrap_or_default();
    fields.iter().any(|(name, _)| name.text() == field)
}
