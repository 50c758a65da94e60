//! Where a run's files are: the little that parts need of a disk.

use std::fmt::Debug;
use std::io::{self, Write};
use std::sync::Arc;

use crate::table::Content;

/// A folder of results. Names are relative to it, with `/` between a folder's and a file's.
pub trait Shelf: Debug + Sync {
    /// Names of the files and folders in a folder, in any order; none where there is no such folder.
    ///
    /// # Errors
    /// They cannot be read.
    fn names(&self, folder: &str) -> io::Result<Vec<String>>;

    /// A file to be read.
    ///
    /// # Errors
    /// There is none, or it cannot be read.
    fn open(&self, name: &str) -> io::Result<Arc<dyn Content>>;

    /// A new file, which has no name yet: where nobody keeps it, nothing is left of it. `like` is one that it
    /// may get.
    ///
    /// # Errors
    /// It cannot be made.
    fn begin(&self, like: &str) -> io::Result<Box<dyn Draft>>;

    /// Removes a file; nothing where there is none.
    ///
    /// # Errors
    /// It cannot be removed.
    fn remove(&self, name: &str) -> io::Result<()>;

    /// Removes what ended before it was kept from a folder, and the folder where nothing else is in it.
    fn remove_folder(&self, folder: &str);
}

/// A file that is being written.
pub trait Draft: Write + Send {
    /// Gives it its name, in place of another file that has it, when all of it is safe on the disk. Folders
    /// that are missing are made.
    ///
    /// # Errors
    /// It cannot have it, or cannot be written.
    fn keep(self: Box<Self>, name: &str) -> io::Result<()>;
}

/// Writes a whole file.
pub(super) fn write(shelf: &dyn Shelf, name: &str, content: &[u8]) -> io::Result<()> {
    let mut draft = shelf.begin(name)?;
    draft.write_all(content)?;
    draft.keep(name)
}

/// Reads a whole file.
pub(super) fn read(shelf: &dyn Shelf, name: &str) -> io::Result<Vec<u8>> {
    let mut content = Vec::new();
    let mut reader = crate::table::Reader::new(shelf.open(name)?, 0);
    io::Read::read_to_end(&mut reader, &mut content)?;
    Ok(content)
}
