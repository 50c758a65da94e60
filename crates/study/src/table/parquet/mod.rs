//! A table in Apache Parquet: columns of doubles, without a detour through decimal numbers.
//!
//! Rows are gathered and written in groups that end at fixed rows of the whole table, so that memory stays
//! flat (only the index at the end of the file holds a line for each group) and the bytes do not depend on how
//! the rows arrive. Each group says the least and the greatest value of every column: whoever reads a part of
//! the workspace leaves out the groups of the rest.

mod group;
#[cfg(feature = "parts")]
mod join;

use std::fmt;
use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as PhysicalType, ZstdLevel};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, Type};

use crate::entries::Entries;
use crate::schema::{self, STATUS};
use crate::sweep::{Chunk, Columns, NUMBERS};
use group::Group;

/// Rows of a group: 16 MB of numbers.
const GROUP: usize = 1 << 16;

/// A table being written as Parquet.
pub(super) struct Parquet<W: Write + Send> {
    writer: SerializedFileWriter<W>,
    group: Group,
    /// The next row of the whole table.
    next: usize,
}

impl<W: Write + Send> fmt::Debug for Parquet<W> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rows = self.group.len();
        f.debug_struct("Parquet")
            .field("rows", &rows)
            .finish_non_exhaustive()
    }
}

impl<W: Write + Send> Parquet<W> {
    /// Begins a table of the rows from this one on, which says these things of itself.
    pub(super) fn new(
        writer: W,
        columns: &Columns<'_>,
        first: usize,
        notes: &[(&str, &str)],
    ) -> io::Result<Self> {
        let properties = WriterProperties::builder()
            .set_compression(Compression::ZSTD(ZstdLevel::default()))
            .set_dictionary_enabled(false)
            .set_column_dictionary_enabled(ColumnPath::from(STATUS), true)
            .set_statistics_enabled(EnabledStatistics::Chunk)
            .set_offset_index_disabled(true)
            .set_key_value_metadata(Some(described(columns, notes)))
            .build();
        let schema = schema(columns).map_err(io_error)?;
        let writer = SerializedFileWriter::new(writer, Arc::new(schema), Arc::new(properties));
        Ok(Self {
            writer: writer.map_err(io_error)?,
            group: Group::new(columns),
            next: first,
        })
    }

    pub(super) fn append(&mut self, chunk: &Chunk) -> io::Result<()> {
        self.group.add(chunk);
        self.next = chunk.rows.end;
        self.end_of_group().map_err(io_error)
    }

    pub(super) fn finish(mut self) -> io::Result<W> {
        if self.group.len() > 0 {
            self.write_group().map_err(io_error)?;
        }
        self.writer.into_inner().map_err(io_error)
    }

    /// Writes a group where one ends: at every so many rows of the whole table, wherever this one begins.
    fn end_of_group(&mut self) -> Result<(), ParquetError> {
        let ends = self.next.is_multiple_of(GROUP) || self.group.len() >= GROUP;
        match ends && self.group.len() > 0 {
            true => self.write_group(),
            false => Ok(()),
        }
    }

    fn write_group(&mut self) -> Result<(), ParquetError> {
        let mut writer = self.writer.next_row_group()?;
        self.group.write(&mut writer)?;
        writer.close()?;
        self.group.clear();
        Ok(())
    }
}

/// What the file says of itself: the units of its columns, and what they are, each as a JSON object by their
/// names, the version of hyperstat, and these notes.
fn described(columns: &Columns<'_>, notes: &[(&str, &str)]) -> Vec<KeyValue> {
    let of = |key: &str, what: &dyn Fn(&str) -> String| {
        let named = schema::columns(columns).map(|name| (name.clone(), what(&name)));
        let object: Entries<String> = named.collect();
        // Texts always have a JSON.
        KeyValue::new(key.into(), serde_json::to_string(&object).ok())
    };
    let units = of("units", &|name| {
        let varied = columns.varied.iter().find(|own| own.path == name);
        let known = varied.and_then(|own| own.unit.clone());
        known.unwrap_or_else(|| schema::unit(name).into())
    });
    let mut all = vec![units, of("meanings", &schema::words)];
    let version = ("hyperstat.version", env!("CARGO_PKG_VERSION"));
    let notes = [version].into_iter().chain(notes.iter().copied());
    all.extend(notes.map(|(key, value)| KeyValue::new(key.into(), value.to_string())));
    all
}

/// The columns: what is found is null where a pose has no result, a coordinate where it is not known.
fn schema(given: &Columns<'_>) -> Result<Type, ParquetError> {
    let mut columns = Vec::new();
    let first = 8 + NUMBERS;
    let drives = first + given.further.len();
    let design = drives + given.drives.len();
    for (place, name) in schema::columns(given).enumerate() {
        let text = match place.checked_sub(design + 1) {
            None if (first..drives).contains(&place) => schema::holds_words(&name),
            None => name == STATUS,
            Some(value) => !given.varied[value].numeric,
        };
        let (kind, meaning) = match place {
            _ if text => (PhysicalType::BYTE_ARRAY, Some(LogicalType::String)),
            _ if place == 0 || place == design => (PhysicalType::INT64, None),
            _ => (PhysicalType::DOUBLE, None),
        };
        let repetition = match place {
            _ if (1..7).contains(&place) || (8..drives).contains(&place) => Repetition::OPTIONAL,
            _ => Repetition::REQUIRED,
        };
        let column = Type::primitive_type_builder(&name, kind)
            .with_logical_type(meaning)
            .with_repetition(repetition)
            .build()?;
        columns.push(Arc::new(column));
    }
    Type::group_type_builder("poses")
        .with_fields(columns)
        .build()
}

/// The disk's own error, where it is one.
fn io_error(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(source) => match source.downcast() {
            Ok(error) => *error,
            Err(source) => io::Error::other(source),
        },
        error => io::Error::other(error),
    }
}
