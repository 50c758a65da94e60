//! A folder of results in memory, in which anything can fail.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard};

use hyperstat_study::parts::{Draft, Shelf};
use hyperstat_study::table::Content;

/// How something fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// The disk is full, or broken, for once: what follows works.
    Once,
    /// The power is cut: nothing works from then on.
    Dead,
}

/// A folder of results in memory.
#[derive(Debug, Clone, Default)]
pub struct Memory(Arc<Inner>);

#[derive(Debug, Default)]
struct Inner {
    files: Mutex<BTreeMap<String, Vec<u8>>>,
    /// What was done so far that may fail.
    steps: AtomicUsize,
    fault: Mutex<Option<(usize, Fault)>>,
    dead: AtomicBool,
}

impl Memory {
    /// The same files, of which the step of this number fails.
    pub fn failing_at(&self, step: usize, fault: Fault) -> Self {
        let next = Self::default();
        *next.files() = self.files().clone();
        *next.0.fault.lock().unwrap() = Some((step, fault));
        next
    }

    /// The same files, and nothing fails.
    pub fn sound(&self) -> Self {
        let next = Self::default();
        *next.files() = self.files().clone();
        next
    }

    pub fn files(&self) -> MutexGuard<'_, BTreeMap<String, Vec<u8>>> {
        self.0.files.lock().unwrap()
    }

    pub fn names_of_all(&self) -> Vec<String> {
        self.files().keys().cloned().collect()
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        self.files()
            .get(name)
            .unwrap_or_else(|| panic!("no {name}"))
            .clone()
    }

    /// What was done so far that may fail.
    pub fn steps(&self) -> usize {
        self.0.steps.load(Ordering::Relaxed)
    }

    fn step(&self) -> io::Result<()> {
        let step = self.0.steps.fetch_add(1, Ordering::Relaxed);
        let fault = self.0.fault.lock().unwrap().filter(|(at, _)| *at == step);
        if let Some((_, Fault::Dead)) = fault {
            self.0.dead.store(true, Ordering::Relaxed);
        }
        match fault.is_some() || self.0.dead.load(Ordering::Relaxed) {
            true => Err(io::ErrorKind::StorageFull.into()),
            false => Ok(()),
        }
    }
}

impl Shelf for Memory {
    fn names(&self, folder: &str) -> io::Result<Vec<String>> {
        self.step()?;
        let inside = format!("{folder}/");
        let files = self.files();
        let names = files.keys().filter_map(|name| name.strip_prefix(&inside));
        let mut names: Vec<String> = names
            .map(|name| name.split('/').next().unwrap().into())
            .collect();
        names.dedup();
        Ok(names)
    }

    fn open(&self, name: &str) -> io::Result<Arc<dyn Content>> {
        self.step()?;
        match self.files().get(name) {
            Some(content) => Ok(Arc::new(content.clone())),
            None => Err(io::ErrorKind::NotFound.into()),
        }
    }

    fn begin(&self, _: &str) -> io::Result<Box<dyn Draft>> {
        self.step()?;
        Ok(Box::new(InMemory {
            of: self.clone(),
            content: Vec::new(),
        }))
    }

    fn remove(&self, name: &str) -> io::Result<()> {
        self.step()?;
        self.files().remove(name);
        Ok(())
    }

    fn remove_folder(&self, _: &str) {}
}

struct InMemory {
    of: Memory,
    content: Vec<u8>,
}

impl Write for InMemory {
    fn write(&mut self, content: &[u8]) -> io::Result<usize> {
        // What a disk takes before it is full.
        self.content
            .extend_from_slice(&content[..content.len() / 2]);
        self.of.step()?;
        self.content
            .extend_from_slice(&content[content.len() / 2..]);
        Ok(content.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Draft for InMemory {
    fn keep(self: Box<Self>, name: &str) -> io::Result<()> {
        self.of.step()?;
        self.of.files().insert(name.into(), self.content);
        Ok(())
    }
}
