//! Files as they are read: regular ones only, and not without end.

use std::fs::{self, File, Metadata};
use std::io::{self, Read};
use std::path::Path;
use std::sync::Arc;

use super::fragment::Fragment;
use super::source::{Place, Source};
use crate::error::LoadError;

/// Largest file that is read as a whole \[bytes\]: some ten million poses.
const LARGEST: u64 = 1 << 30;

/// Opens a regular file, or what a link to one leads to. Devices, pipes and folders are refused
/// before they are opened: reading some of them never ends, and opening others waits for a writer.
///
/// # Errors
/// The file cannot be opened, or is no regular file.
pub fn open(path: &Path) -> io::Result<File> {
    regular(&fs::metadata(path)?)?;
    let file = File::open(path)?;
    // Another may stand there by now.
    regular(&file.metadata()?)?;
    Ok(file)
}

/// Reads a regular file of at most 1 GiB.
///
/// # Errors
/// As [`open`]; the file is larger, or cannot be read.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let file = open(path)?;
    let too_large = || {
        let message = format!("it is larger than {} GiB", LARGEST >> 30);
        io::Error::new(io::ErrorKind::FileTooLarge, message)
    };
    if file.metadata()?.len() > LARGEST {
        return Err(too_large());
    }
    // Some files are longer than they say.
    let mut bytes = Vec::new();
    file.take(LARGEST + 1).read_to_end(&mut bytes)?;
    match bytes.len() as u64 > LARGEST {
        true => Err(too_large()),
        false => Ok(bytes),
    }
}

fn regular(metadata: &Metadata) -> io::Result<()> {
    if metadata.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    match metadata.is_file() {
        true => Ok(()),
        false => Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "it is no regular file but a device or a pipe",
        )),
    }
}

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
