//! The folder of a run's results, as parts of runs need it.

use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use super::shelf::{Draft, Shelf};
use crate::disk::{AtomicFile, remove_all_dead};
use crate::table::Content;

/// A folder of results on a disk.
#[derive(Debug)]
pub struct Folder(PathBuf);

impl Folder {
    /// That at this path, there or not yet.
    pub fn new(path: &Path) -> Self {
        Self(path.into())
    }
}

impl Shelf for Folder {
    fn names(&self, folder: &str) -> io::Result<Vec<String>> {
        let entries = match fs::read_dir(self.0.join(folder)) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            // A file of that name is of somebody else.
            Err(error) if error.kind() == io::ErrorKind::NotADirectory => return Ok(Vec::new()),
            Err(error) => return Err(error),
        };
        let mut names = Vec::new();
        for entry in entries {
            // Names that are no texts are none of a run's.
            if let Ok(name) = entry?.file_name().into_string()
                && !name.starts_with('.')
            {
                names.push(name);
            }
        }
        Ok(names)
    }

    fn open(&self, name: &str) -> io::Result<Arc<dyn Content>> {
        let file = hyperstat_mechanisms::files::open(&self.0.join(name))?;
        let length = file.metadata()?.len();
        Ok(Arc::new(OnDisk {
            file: Mutex::new(file),
            length,
        }))
    }

    fn begin(&self, like: &str) -> io::Result<Box<dyn Draft>> {
        let path = self.0.join(like);
        make_folder_of(&path)?;
        Ok(Box::new(OfFolder {
            file: AtomicFile::draft(&path)?,
            folder: self.0.clone(),
        }))
    }

    fn remove(&self, name: &str) -> io::Result<()> {
        match fs::remove_file(self.0.join(name)) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
            other => other,
        }
    }

    fn remove_folder(&self, folder: &str) {
        let path = self.0.join(folder);
        remove_all_dead(&path);
        // One with something in it stays.
        let _ = fs::remove_dir(path);
    }
}

/// Makes the folder that a file is to be in.
fn make_folder_of(path: &Path) -> io::Result<()> {
    path.parent().map_or(Ok(()), fs::create_dir_all)
}

/// A file of a folder of results that is being written.
struct OfFolder {
    file: AtomicFile,
    folder: PathBuf,
}

impl Write for OfFolder {
    fn write(&mut self, content: &[u8]) -> io::Result<usize> {
        self.file.write(content)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Draft for OfFolder {
    fn keep(self: Box<Self>, name: &str) -> io::Result<()> {
        let path = self.folder.join(name);
        make_folder_of(&path)?;
        self.file.commit_as(&path)
    }
}

/// A file that is read here and there.
#[derive(Debug)]
struct OnDisk {
    file: Mutex<File>,
    length: u64,
}

impl Content for OnDisk {
    fn length(&self) -> u64 {
        self.length
    }

    fn read_at(&self, place: u64, into: &mut [u8]) -> io::Result<usize> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(place))?;
        file.read(into)
    }
}
