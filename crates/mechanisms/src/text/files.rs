//! Where files are read from: by name, from a disk or from memory.

use std::collections::BTreeMap;
use std::fmt::Debug;
use std::io;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

#[cfg(feature = "fs")]
pub use super::disk::{Disk, open, read};

/// Largest file that is read as a whole \[bytes\]: some ten million poses.
pub(crate) const LARGEST: u64 = 1 << 30;

/// Files by name. Whatever is read goes through one: mechanisms, batches, tables of poses and of
/// stiffness. A name in a file is relative to the folder of that file.
pub trait Files: Debug + Send + Sync {
    /// The content of a file.
    ///
    /// # Errors
    /// There is none of this name, it is no regular file, is larger than 1 GiB, or cannot be read.
    fn read(&self, path: &Path) -> io::Result<Vec<u8>>;

    /// The one name that a file or a folder has, without links, `.` and `..`. By it is told whether
    /// a file lies in a folder: messages show the text of a file only where it lies below the folder
    /// of the file that was asked for, or is known to be what it was taken for.
    ///
    /// # Errors
    /// It has none.
    fn resolve(&self, path: &Path) -> io::Result<PathBuf>;

    /// A copy that leads to the same files: what was read may name files that are needed later, as
    /// the designs of a job do.
    fn clone_box(&self) -> Box<dyn Files>;
}

/// Files that are held in memory, by name.
///
/// `.`, `..` and the separators of names do not matter: `a/../b.csv` is `b.csv`.
#[derive(Debug, Clone, Default)]
pub struct MemoryFiles(Arc<BTreeMap<PathBuf, Arc<[u8]>>>);

impl MemoryFiles {
    /// No files.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a file, or replaces the one of this name.
    pub fn insert(&mut self, name: impl AsRef<Path>, content: impl Into<Vec<u8>>) {
        let content: Vec<u8> = content.into();
        Arc::make_mut(&mut self.0).insert(plain(name.as_ref()), content.into());
    }
}

impl<N: AsRef<Path>, C: Into<Vec<u8>>> FromIterator<(N, C)> for MemoryFiles {
    fn from_iter<I: IntoIterator<Item = (N, C)>>(files: I) -> Self {
        let mut all = Self::new();
        for (name, content) in files {
            all.insert(name, content);
        }
        all
    }
}

impl Files for MemoryFiles {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        let found = self.0.get(&plain(path));
        let missing = || {
            io::Error::new(
                io::ErrorKind::NotFound,
                "no file of this name was handed in",
            )
        };
        found.map(|content| content.to_vec()).ok_or_else(missing)
    }

    fn resolve(&self, path: &Path) -> io::Result<PathBuf> {
        Ok(plain(path))
    }

    fn clone_box(&self) -> Box<dyn Files> {
        Box::new(self.clone())
    }
}

/// A name without `.`, and without `..` as far as there is a folder to go back from.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if plain.file_name().is_some() => {
                plain.pop();
            }
            part => plain.push(part),
        }
    }
    plain
}

/// Reads a file of at most [`LARGEST`] bytes.
pub(crate) fn read_from(files: &dyn Files, path: &Path) -> io::Result<Vec<u8>> {
    let bytes = files.read(path)?;
    match bytes.len() as u64 > LARGEST {
        true => Err(too_large()),
        false => Ok(bytes),
    }
}

pub(crate) fn too_large() -> io::Error {
    let message = format!("it is larger than {} GiB", LARGEST >> 30);
    io::Error::new(io::ErrorKind::FileTooLarge, message)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_has_one_name() {
        let files = MemoryFiles::from_iter([("tables/poses.csv", "x,y,z")]);
        for name in [
            "tables/poses.csv",
            "./tables/poses.csv",
            "tables/../tables/./poses.csv",
            "other/../tables/poses.csv",
        ] {
            assert_eq!(files.read(Path::new(name)).unwrap(), b"x,y,z", "{name}");
        }
        for name in ["poses.csv", "../tables/poses.csv", "/tables/poses.csv", ""] {
            let error = files.read(Path::new(name)).unwrap_err();
            assert_eq!(error.kind(), io::ErrorKind::NotFound, "{name}");
        }
    }

    #[test]
    fn a_copy_stays_as_it_is() {
        let mut files = MemoryFiles::new();
        files.insert("a", "1");
        let copy = files.clone_box();
        files.insert("a", "2");
        files.insert("b", "3");
        assert_eq!(copy.read(Path::new("a")).unwrap(), b"1");
        assert!(copy.read(Path::new("b")).is_err());
        assert_eq!(files.read(Path::new("a")).unwrap(), b"2");
    }
}
