//! Where what is written to a path goes.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

/// Where what is written to a path goes.
#[derive(Debug)]
pub(crate) enum Destination {
    /// A regular file, there or not, at this path, which is no link.
    File(PathBuf),
    /// What is there and no regular file, such as a device or a pipe, or what the process has open
    /// already, such as `/dev/stdout`: written to as it is.
    Stream(PathBuf),
}

/// Links that are followed before they are taken for a ring.
const MOST_LINKS: usize = 40;

impl Destination {
    /// Follows symbolic links, also to where nothing is yet.
    ///
    /// # Errors
    /// A folder is there, or links lead round in a ring, or nobody may look.
    pub(crate) fn of(path: &Path) -> io::Result<Self> {
        let mut path = path.to_owned();
        for _ in 0..MOST_LINKS {
            if is_open(&path) {
                return Ok(Self::Stream(path));
            }
            let found = match fs::symlink_metadata(&path) {
                Ok(found) => found.file_type(),
                Err(error) if error.kind() == io::ErrorKind::NotFound => {
                    return Ok(Self::File(path));
                }
                Err(error) => return Err(error),
            };
            if found.is_symlink() {
                // A relative target is seen from the folder of the link.
                let target = fs::read_link(&path)?;
                path = path
                    .parent()
                    .map_or_else(|| target.clone(), |folder| folder.join(&target));
            } else if found.is_dir() {
                return Err(io::ErrorKind::IsADirectory.into());
            } else if found.is_file() {
                return Ok(Self::File(path));
            } else {
                return Ok(Self::Stream(path));
            }
        }
        Err(io::Error::other("too many symbolic links"))
    }
}

/// The folder of a path without links; `None` where there is none.
pub(crate) fn folder(path: &Path) -> Option<PathBuf> {
    let parent = path.parent()?;
    let here = parent.as_os_str().is_empty();
    let parent = if here { Path::new(".") } else { parent };
    parent.canonicalize().ok()
}

/// Whether a path is one of the names that a system gives to what a process has open.
fn is_open(path: &Path) -> bool {
    cfg!(unix)
        && folder(path).is_some_and(|folder| {
            folder == Path::new("/dev/fd")
                || (folder.starts_with("/proc") && folder.ends_with("fd"))
        })
}

/// Opens what is no regular file to be written to.
pub(crate) fn open(path: &Path) -> io::Result<File> {
    match own(path)? {
        Some(file) => Ok(file),
        // What was written before stays where it is a file after all.
        None => OpenOptions::new().append(true).open(path),
    }
}

/// Standard output or standard error, where a path is a name of them: opened anew, a file would be
/// written to from its start again.
#[cfg(unix)]
fn own(path: &Path) -> io::Result<Option<File>> {
    use std::os::fd::AsFd;

    let process = Path::new("/proc").join(std::process::id().to_string());
    let is_own = folder(path)
        .is_some_and(|folder| folder == Path::new("/dev/fd") || folder.starts_with(&process));
    let name = path.file_name().filter(|_| is_open(path) && is_own);
    let descriptor = match name.and_then(|name| name.to_str()) {
        Some("1") => io::stdout().as_fd().try_clone_to_owned()?,
        Some("2") => io::stderr().as_fd().try_clone_to_owned()?,
        _ => return Ok(None),
    };
    Ok(Some(descriptor.into()))
}

#[cfg(not(unix))]
fn own(_: &Path) -> io::Result<Option<File>> {
    Ok(None)
}
