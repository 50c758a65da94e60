//! A file that appears under its name only when it is complete.

use std::ffi::{OsStr, OsString};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::destination::{self, Destination};

/// A file being written under a temporary name in the folder of its final one. A link stays, and what
/// it leads to is replaced; what is no regular file is written to as it is.
///
/// [`AtomicFile::commit`] gives it its name; dropped before that, it is removed. The temporary file is
/// locked as long as it is written, so that those of dead runs can be told and are removed.
#[derive(Debug)]
pub(crate) struct AtomicFile {
    // `None` where nothing is replaced.
    replaced: Option<Replaced>,
    // `None` once committed.
    writer: Option<BufWriter<File>>,
}

#[derive(Debug)]
struct Replaced {
    path: PathBuf,
    temporary: PathBuf,
}

/// What a temporary name is longer than its final one, at most: `.`, `.4294967295-99.part`.
pub(crate) const LONGER: usize = 20;

/// Temporary names that are tried.
const TRIES: usize = 99;

impl AtomicFile {
    /// Opens the temporary file for `path`, which must name a file, not a folder.
    pub(crate) fn create(path: &Path) -> io::Result<Self> {
        let (replaced, file) = match Destination::of(path)? {
            Destination::Stream(path) => (None, destination::open(&path)?),
            Destination::File(path) => {
                let (temporary, file) = temporary(&path)?;
                (Some(Replaced { path, temporary }), file)
            }
        };
        Ok(Self {
            replaced,
            writer: Some(BufWriter::new(file)),
        })
    }

    /// Writes a whole file.
    pub(crate) fn write(path: &Path, content: &[u8]) -> io::Result<()> {
        let mut file = Self::create(path)?;
        file.write_all(content)?;
        file.commit()
    }

    /// Puts the complete file in place of what had its name before.
    pub(crate) fn commit(mut self) -> io::Result<()> {
        let Some(writer) = &mut self.writer else {
            return Ok(());
        };
        writer.flush()?;
        if let Some(Replaced { path, temporary }) = &self.replaced {
            writer.get_ref().sync_all()?;
            fs::rename(temporary, path)?;
        }
        self.writer = None;
        Ok(())
    }
}

/// Opens a new file to become `path`, locked; those of dead runs are removed before.
fn temporary(path: &Path) -> io::Result<(PathBuf, File)> {
    let name = path
        .file_name()
        .ok_or(io::Error::from(io::ErrorKind::InvalidFilename))?;
    remove_dead(path, name);
    // The process id keeps two runs apart, and the number two of machines that share the folder.
    for number in 0..TRIES {
        let mut hidden = OsString::from(".");
        hidden.push(name);
        hidden.push(match number {
            0 => format!(".{}.part", std::process::id()),
            number => format!(".{}-{number}.part", std::process::id()),
        });
        let temporary = path.with_file_name(hidden);
        let opened = OpenOptions::new()
            .write(true)
            .create_new(true)
            .open(&temporary);
        let file = match opened {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => continue,
            opened => opened?,
        };
        // Where a file system has no locks, nobody else can take it for dead either.
        let taken = matches!(file.try_lock(), Err(TryLockError::WouldBlock));
        // Another run may have taken it for dead before it was locked.
        if !taken && temporary.exists() {
            return Ok((temporary, file));
        }
    }
    Err(io::ErrorKind::AlreadyExists.into())
}

/// Removes the temporary files of runs that ended before they completed `path`. What cannot be
/// removed stays.
fn remove_dead(path: &Path, name: &OsStr) {
    let Some(folder) = destination::folder(path) else {
        return;
    };
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let regular = entry.file_type().is_ok_and(|kind| kind.is_file());
        if !regular || !is_temporary(&entry.file_name(), name) {
            continue;
        }
        let path = entry.path();
        // It is locked as long as somebody writes it.
        let file = OpenOptions::new().write(true).open(&path);
        if file.is_ok_and(|file| file.try_lock().is_ok()) {
            let _ = fs::remove_file(&path);
        }
    }
}

/// Whether a file has a temporary name of the file `name`.
fn is_temporary(file: &OsStr, name: &OsStr) -> bool {
    let file = file.as_encoded_bytes().strip_prefix(b".");
    let rest = file.and_then(|file| file.strip_prefix(name.as_encoded_bytes()));
    let id = rest.and_then(|rest| rest.strip_prefix(b".")?.strip_suffix(b".part"));
    id.is_some_and(|id| !id.is_empty() && id.iter().all(|b| b.is_ascii_digit() || *b == b'-'))
}

impl Write for AtomicFile {
    fn write(&mut self, content: &[u8]) -> io::Result<usize> {
        match &mut self.writer {
            Some(writer) => writer.write(content),
            None => Ok(content.len()),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.as_mut().map_or(Ok(()), Write::flush)
    }
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        if let (Some(writer), Some(replaced)) = (self.writer.take(), &self.replaced) {
            drop(writer.into_parts());
            // Nothing more can be done about a temporary file that cannot be removed.
            let _ = fs::remove_file(&replaced.temporary);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::ffi::OsStr;
    use std::fs;
    use std::io::Write;
    use std::path::{Path, PathBuf};

    use super::{AtomicFile, LONGER, is_temporary};

    /// A folder of the test `name`.
    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("hyperstat-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<_> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn what_dead_runs_left_is_removed_and_what_lives_stays() {
        let folder = folder("dead");
        let path = folder.join("a.csv");
        for left in [
            ".a.csv.1.part",
            ".a.csv.99999-3.part",
            ".b.csv.1.part",
            ".a.csv.x.part",
        ] {
            fs::write(folder.join(left), "half").unwrap();
        }
        let mut first = AtomicFile::create(&path).unwrap();
        // A second run of the same name leaves the first one's alone, though its process is the same.
        AtomicFile::write(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        first.write_all(b"first").unwrap();
        first.commit().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"first");
        assert_eq!(names(&folder), [".a.csv.x.part", ".b.csv.1.part", "a.csv"]);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn temporary_names_are_told_from_others() {
        let is = |file: &str| is_temporary(OsStr::new(file), OsStr::new("a.csv"));
        assert!(is(".a.csv.12.part") && is(".a.csv.12-3.part"));
        for other in [
            "a.csv.12.part",
            ".a.csv..part",
            ".a.csv.part",
            ".b.csv.12.part",
            ".a.csv.1",
        ] {
            assert!(!is(other), "{other}");
        }
        assert_eq!("..4294967295-99.part".len(), LONGER);
    }
}
