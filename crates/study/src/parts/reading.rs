//! Files, with a memory of what was read from them.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use hyperstat_mechanisms::Files;

/// Files of which each is read once, and then kept: what was read later is what was read first, and all of it
/// is known.
#[derive(Debug)]
pub struct Reading {
    files: Box<dyn Files>,
    read: Arc<Mutex<BTreeMap<PathBuf, Arc<[u8]>>>>,
}

impl Reading {
    /// Of which nothing is read yet.
    pub fn of(files: &dyn Files) -> Self {
        Self {
            files: files.clone_box(),
            read: Arc::default(),
        }
    }

    /// All that was read, by the names that it was asked for by.
    pub(super) fn all(&self) -> Vec<(PathBuf, Arc<[u8]>)> {
        let read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        let all = read.iter();
        all.map(|(path, content)| (path.clone(), Arc::clone(content)))
            .collect()
    }
}

impl Files for Reading {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(content) = read.get(path) {
            return Ok(content.to_vec());
        }
        let content = self.files.read(path)?;
        read.insert(path.into(), content.as_slice().into());
        Ok(content)
    }

    fn resolve(&self, path: &Path) -> io::Result<PathBuf> {
        self.files.resolve(path)
    }

    fn clone_box(&self) -> Box<dyn Files> {
        Box::new(Self {
            files: self.files.clone_box(),
            read: Arc::clone(&self.read),
        })
    }
}
