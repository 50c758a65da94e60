//! The content of a table that is written already, wherever it lies.

use std::fmt::Debug;
use std::io::{self, Read};
use std::sync::Arc;

/// Bytes that can be read from any place, by several readers at once.
pub trait Content: Debug + Send + Sync {
    /// How many there are.
    fn length(&self) -> u64;

    /// Reads some of them from a place on; none at the end.
    ///
    /// # Errors
    /// They cannot be read.
    fn read_at(&self, place: u64, into: &mut [u8]) -> io::Result<usize>;
}

impl Content for Vec<u8> {
    fn length(&self) -> u64 {
        self.len() as u64
    }

    fn read_at(&self, place: u64, into: &mut [u8]) -> io::Result<usize> {
        let start = usize::try_from(place).map_or(self.len(), |place| place.min(self.len()));
        (&self[start..]).read(into)
    }
}

/// A reader of a content, from a place on.
#[derive(Debug)]
pub(crate) struct Reader {
    content: Arc<dyn Content>,
    place: u64,
}

impl Reader {
    pub(crate) fn new(content: Arc<dyn Content>, place: u64) -> Self {
        Self { content, place }
    }
}

impl Read for Reader {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.content.read_at(self.place, into)?;
        self.place += count as u64;
        Ok(count)
    }
}
