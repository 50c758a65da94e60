//! Files on a disk: regular ones only, and not without end.

use std::fs::{self, File, Metadata};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::files::{Files, LARGEST, too_large};

/// The files of this computer, by their paths.
#[derive(Debug, Clone, Copy, Default)]
pub struct Disk;

impl Files for Disk {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        read(path)
    }

    fn resolve(&self, path: &Path) -> io::Result<PathBuf> {
        fs::canonicalize(path)
    }

    fn clone_box(&self) -> Box<dyn Files> {
        Box::new(*self)
    }
}

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
