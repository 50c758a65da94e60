//! The table of a job: a row a pose, as CSV or Parquet.

mod cells;
#[cfg(feature = "parts")]
mod content;
mod csv;
#[cfg(feature = "parquet")]
mod parquet;
#[cfg(feature = "figures")]
mod read;

use std::io::{self, Write};
#[cfg(feature = "parts")]
use std::sync::Arc;

pub use crate::schema::{columns, is_frequency, numeric, unit, words};

use crate::schema::Columns;
use crate::sweep::Chunk;
#[cfg(feature = "parts")]
pub use content::Content;
#[cfg(feature = "parts")]
pub(crate) use content::Reader;
#[cfg(feature = "figures")]
pub use read::{Column, TableReader};

/// Form of a table.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum TableFormat {
    /// Comma-separated values, numbers that read back to the same double.
    #[default]
    Csv,
    /// Apache Parquet: binary columns.
    #[cfg(feature = "parquet")]
    Parquet,
}

impl TableFormat {
    /// The extension of its files.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            #[cfg(feature = "parquet")]
            Self::Parquet => "parquet",
        }
    }
}

/// A table being written, chunk by chunk, to anything that takes bytes.
#[derive(Debug)]
pub struct TableWriter<W: Write + Send> {
    form: Form<W>,
}

#[derive(Debug)]
enum Form<W: Write + Send> {
    Csv(csv::Csv<W>),
    #[cfg(feature = "parquet")]
    Parquet(Box<parquet::Parquet<W>>),
}

impl<W: Write + Send> TableWriter<W> {
    /// Begins a table.
    ///
    /// # Errors
    /// Its first line cannot be written.
    pub fn new(writer: W, format: TableFormat, columns: &Columns<'_>) -> io::Result<Self> {
        Self::from_row(writer, format, columns, 0, &[])
    }

    /// Begins a table of a job's rows from this one on. In Parquet it says these things of itself, each a name and a
    /// text.
    ///
    /// # Errors
    /// As [`TableWriter::new`].
    pub fn from_row(
        writer: W,
        format: TableFormat,
        columns: &Columns<'_>,
        first: usize,
        notes: &[(&str, &str)],
    ) -> io::Result<Self> {
        let form = match format {
            TableFormat::Csv => {
                let _ = (first, notes);
                Form::Csv(csv::Csv::new(writer, columns)?)
            }
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => {
                let table = parquet::Parquet::new(writer, columns, first, notes)?;
                Form::Parquet(Box::new(table))
            }
        };
        Ok(Self { form })
    }

    /// Appends the next rows, which stand in a table of the same form and with the same columns.
    ///
    /// # Errors
    /// It is none of these, cannot be read, or they cannot be written.
    #[cfg(feature = "parts")]
    pub fn join(&mut self, content: &Arc<dyn Content>) -> io::Result<()> {
        match &mut self.form {
            Form::Csv(table) => table.join(content),
            #[cfg(feature = "parquet")]
            Form::Parquet(table) => table.join(content),
        }
    }

    /// Appends the next rows, rendered or not.
    ///
    /// # Errors
    /// They cannot be written.
    pub fn append(&mut self, chunk: &Chunk) -> io::Result<()> {
        match &mut self.form {
            Form::Csv(table) => table.append(chunk),
            #[cfg(feature = "parquet")]
            Form::Parquet(table) => table.append(chunk),
        }
    }

    /// Writes what is left, and gives back what was written to.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn finish(self) -> io::Result<W> {
        match self.form {
            Form::Csv(table) => Ok(table.finish()),
            #[cfg(feature = "parquet")]
            Form::Parquet(table) => table.finish(),
        }
    }
}

/// What can be done for a chunk before its turn to be written, on any thread, in any order: then
/// [`TableWriter::append`] has less to do.
pub fn render(format: TableFormat, chunk: &mut Chunk) {
    match format {
        TableFormat::Csv => csv::render(chunk),
        #[cfg(feature = "parquet")]
        TableFormat::Parquet => {}
    }
}
