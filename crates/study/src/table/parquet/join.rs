//! Rows of a table that is written already, appended to one that is being written.

use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use bytes::Bytes;
use parquet::errors::{ParquetError, Result};
use parquet::file::reader::{ChunkReader, FileReader, Length, SerializedFileReader};

use super::{Parquet, io_error};
use crate::table::content::{Content, Reader};

/// A content as Parquet reads it.
struct Chunks(Arc<dyn Content>);

impl Length for Chunks {
    fn len(&self) -> u64 {
        self.0.length()
    }
}

impl ChunkReader for Chunks {
    type T = io::BufReader<Reader>;

    fn get_read(&self, start: u64) -> Result<Self::T> {
        let reader = Reader::new(Arc::clone(&self.0), start);
        Ok(io::BufReader::new(reader))
    }

    fn get_bytes(&self, start: u64, length: usize) -> Result<Bytes> {
        let mut bytes = vec![0; length];
        let mut reader = Reader::new(Arc::clone(&self.0), start);
        io::Read::read_exact(&mut reader, &mut bytes)?;
        Ok(bytes.into())
    }
}

impl<W: Write + Send> Parquet<W> {
    /// Appends the rows of a table with the same columns, which are the next ones of the whole table.
    pub(in crate::table) fn join(&mut self, content: &Arc<dyn Content>) -> io::Result<()> {
        // Files that are spoilt can make the reader panic.
        let joined = catch_unwind(AssertUnwindSafe(|| self.join_groups(content)));
        let spoilt = |_| ParquetError::General("the file is spoilt".into());
        joined.map_err(spoilt).flatten().map_err(io_error)
    }

    fn join_groups(&mut self, content: &Arc<dyn Content>) -> Result<()> {
        let reader = SerializedFileReader::new(Chunks(Arc::clone(content)))?;
        for group in 0..reader.num_row_groups() {
            // Decoded and written anew: a group that is copied is not, byte for byte, the one that would be written.
            self.group.read(&*reader.get_row_group(group)?)?;
            let rows = reader.metadata().row_group(group).num_rows();
            self.next += rows as usize;
            self.end_of_group()?;
        }
        Ok(())
    }
}
