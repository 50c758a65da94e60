//! A table in Apache Parquet: columns of doubles, without a detour through decimal numbers.
//!
//! Rows are gathered and written in groups of a fixed size, so that memory stays flat (only the
//! index at the end of the file holds a line for each group) and the bytes do not depend on how the
//! rows arrive.

use std::fmt;
use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as PhysicalType};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{ColumnPath, Type};

use hyperstat_mechanisms::{Value, Varied};

use crate::entries::Entries;
use crate::schema::{self, STATUS};
use crate::sweep::{Cell, Chunk, Columns, NUMBERS};

/// Rows of a group: 16 MB of numbers.
const GROUP: usize = 1 << 16;

/// A table being written as Parquet.
pub(super) struct Parquet<W: Write + Send> {
    writer: SerializedFileWriter<W>,
    group: Group,
}

impl<W: Write + Send> fmt::Debug for Parquet<W> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rows = self.group.len();
        f.debug_struct("Parquet")
            .field("rows", &rows)
            .finish_non_exhaustive()
    }
}

/// Columns of the displacement, the first of the numbers.
const DISPLACEMENT: usize = 6;

/// The rows that are not written yet, by columns.
#[derive(Default)]
struct Group {
    pose: Vec<i64>,
    coordinates: [Known; 6],
    status: Vec<ByteArray>,
    /// 1 where a row has a displacement and a stiffness, 0 where it has none.
    levels: [Vec<i16>; 2],
    /// Of the rows that have them.
    numbers: [Vec<f64>; NUMBERS],
    further: Vec<Further>,
    /// Of a job whose poses are values of drives.
    drives: Vec<Vec<f64>>,
    /// A copy of every status met, which others share.
    statuses: Vec<(&'static str, ByteArray)>,
    /// Of a job that varies.
    design: Vec<i64>,
    values: Vec<Values>,
}

/// A column of numbers of which not every row has one.
#[derive(Clone, Default)]
struct Known {
    /// 1 where a row has a number, 0 where it has none.
    levels: Vec<i16>,
    /// Of the rows that have them.
    numbers: Vec<f64>,
}

impl Known {
    fn push(&mut self, number: Option<f64>) {
        self.levels.push(i16::from(number.is_some()));
        self.numbers.extend(number);
    }

    fn write<W: Write + Send>(
        &self,
        writer: &mut SerializedRowGroupWriter<'_, W>,
    ) -> Result<(), ParquetError> {
        write::<DoubleType, _>(writer, &self.numbers, Some(&self.levels))
    }

    fn clear(&mut self) {
        self.levels.clear();
        self.numbers.clear();
    }
}

/// A further column.
enum Further {
    Numbers(Known),
    /// 1 where a row has a text, 0 where it has none, and the texts of those that have.
    Texts(Vec<i16>, Vec<ByteArray>),
}

impl Further {
    fn of(name: &str) -> Self {
        match schema::holds_words(name) {
            true => Self::Texts(Vec::new(), Vec::new()),
            false => Self::Numbers(Known::default()),
        }
    }

    fn push(&mut self, cell: Option<&Cell>) {
        match self {
            Self::Numbers(column) => column.push(cell.and_then(Cell::number)),
            Self::Texts(levels, texts) => {
                let text = cell.and_then(Cell::text);
                levels.push(i16::from(text.is_some()));
                texts.extend(text.map(ByteArray::from));
            }
        }
    }

    fn write<W: Write + Send>(
        &self,
        writer: &mut SerializedRowGroupWriter<'_, W>,
    ) -> Result<(), ParquetError> {
        match self {
            Self::Numbers(column) => column.write(writer),
            Self::Texts(levels, texts) => write::<ByteArrayType, _>(writer, texts, Some(levels)),
        }
    }

    fn clear(&mut self) {
        match self {
            Self::Numbers(column) => column.clear(),
            Self::Texts(levels, texts) => {
                levels.clear();
                texts.clear();
            }
        }
    }
}

/// A column of varied values.
enum Values {
    Numbers(Vec<f64>),
    /// Where some are no numbers, all are text.
    Texts(Vec<ByteArray>),
}

impl Values {
    fn of(varied: &Varied) -> Self {
        match varied.numeric {
            true => Self::Numbers(Vec::new()),
            false => Self::Texts(Vec::new()),
        }
    }

    fn push(&mut self, value: &Value) {
        match (self, value) {
            (Self::Numbers(column), Value::Number(number)) => column.push(*number),
            // A column of numbers has no texts.
            (Self::Numbers(column), Value::Text(_)) => column.push(f64::NAN),
            (Self::Texts(column), value) => column.push(value.to_string().as_str().into()),
        }
    }

    fn clear(&mut self) {
        match self {
            Self::Numbers(column) => column.clear(),
            Self::Texts(column) => column.clear(),
        }
    }
}

impl<W: Write + Send> Parquet<W> {
    pub(super) fn new(writer: W, columns: &Columns<'_>) -> io::Result<Self> {
        let properties = WriterProperties::builder()
            .set_dictionary_enabled(false)
            .set_column_dictionary_enabled(ColumnPath::from(STATUS), true)
            .set_statistics_enabled(EnabledStatistics::Chunk)
            .set_offset_index_disabled(true)
            .set_key_value_metadata(described(columns))
            .build();
        let schema = schema(columns).map_err(io_error)?;
        let writer = SerializedFileWriter::new(writer, Arc::new(schema), Arc::new(properties));
        Ok(Self {
            writer: writer.map_err(io_error)?,
            group: Group {
                further: columns
                    .further
                    .iter()
                    .map(|name| Further::of(name))
                    .collect(),
                drives: vec![Vec::new(); columns.drives.len()],
                values: columns.varied.iter().map(Values::of).collect(),
                ..Group::default()
            },
        })
    }

    pub(super) fn append(&mut self, chunk: &Chunk) -> io::Result<()> {
        self.group.add(chunk);
        if self.group.len() >= GROUP {
            self.write_group().map_err(io_error)?;
        }
        Ok(())
    }

    pub(super) fn finish(mut self) -> io::Result<W> {
        if self.group.len() > 0 {
            self.write_group().map_err(io_error)?;
        }
        self.writer.into_inner().map_err(io_error)
    }

    fn write_group(&mut self) -> Result<(), ParquetError> {
        let group = &mut self.group;
        let mut writer = self.writer.next_row_group()?;
        write::<Int64Type, _>(&mut writer, &group.pose, None)?;
        for column in &group.coordinates {
            column.write(&mut writer)?;
        }
        write::<ByteArrayType, _>(&mut writer, &group.status, None)?;
        let [displaced, stiff] = &group.levels;
        for (k, column) in group.numbers.iter().enumerate() {
            let levels = if k < DISPLACEMENT { displaced } else { stiff };
            write::<DoubleType, _>(&mut writer, column, Some(levels))?;
        }
        for column in &group.further {
            column.write(&mut writer)?;
        }
        for column in &group.drives {
            write::<DoubleType, _>(&mut writer, column, None)?;
        }
        if !group.values.is_empty() {
            write::<Int64Type, _>(&mut writer, &group.design, None)?;
        }
        for column in &group.values {
            match column {
                Values::Numbers(column) => write::<DoubleType, _>(&mut writer, column, None)?,
                Values::Texts(column) => write::<ByteArrayType, _>(&mut writer, column, None)?,
            }
        }
        writer.close()?;
        group.clear();
        Ok(())
    }
}

impl Group {
    fn len(&self) -> usize {
        self.pose.len()
    }

    fn add(&mut self, chunk: &Chunk) {
        for row in chunk.table_rows() {
            let record = row.record;
            self.pose.push(row.pose as i64);
            if let Some((number, values)) = row.design {
                self.design.push(number as i64);
                for (column, value) in self.values.iter_mut().zip(values) {
                    column.push(value);
                }
            }
            for (column, value) in self.coordinates.iter_mut().zip(record.pose) {
                column.push(value);
            }
            let status = self.status(record.status());
            self.status.push(status);
            let known = record.known();
            let [displaced, stiff] = &mut self.levels;
            displaced.push(i16::from(known.is_some()));
            stiff.push(i16::from(record.result.is_ok()));
            for (k, column) in self.further.iter_mut().enumerate() {
                column.push(known.and_then(|(_, further)| further.get(k)));
            }
            for (column, value) in self.drives.iter_mut().zip(row.drives) {
                column.push(*value);
            }
            let displacement = known.into_iter().flat_map(|(displacement, _)| displacement);
            for (column, value) in self.numbers.iter_mut().zip(displacement) {
                column.push(*value);
            }
            if let Ok(found) = &record.result {
                for (column, value) in self.numbers[DISPLACEMENT..].iter_mut().zip(found.upper()) {
                    column.push(value);
                }
            }
        }
    }

    fn status(&mut self, word: &'static str) -> ByteArray {
        if let Some((_, shared)) = self.statuses.iter().find(|(known, _)| *known == word) {
            return shared.clone();
        }
        let shared = ByteArray::from(word);
        self.statuses.push((word, shared.clone()));
        shared
    }

    fn clear(&mut self) {
        self.pose.clear();
        self.coordinates.iter_mut().for_each(Known::clear);
        self.status.clear();
        self.levels.iter_mut().for_each(Vec::clear);
        self.numbers.iter_mut().for_each(Vec::clear);
        self.further.iter_mut().for_each(Further::clear);
        self.drives.iter_mut().for_each(Vec::clear);
        self.design.clear();
        self.values.iter_mut().for_each(Values::clear);
    }
}

/// Writes the next column of a group. `levels` says which rows have a value; all, where not given.
fn write<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: &[T::T],
    levels: Option<&[i16]>,
) -> Result<(), ParquetError> {
    if let Some(mut column) = group.next_column()? {
        column.typed::<T>().write_batch(values, levels, None)?;
        column.close()?;
    }
    Ok(())
}

/// What the file says of its columns, where any are asked for: their units, and what they are, each as a
/// JSON object by their names.
fn described(columns: &Columns<'_>) -> Option<Vec<KeyValue>> {
    if columns.asked == 0 {
        return None;
    }
    let of = |key: &str, what: &dyn Fn(&str) -> String| {
        let named = schema::columns(columns).map(|name| (name.clone(), what(&name)));
        let object: Entries<String> = named.collect();
        // Texts always have a JSON.
        KeyValue::new(key.into(), serde_json::to_string(&object).ok())
    };
    let units = of("units", &|name| schema::unit(name).into());
    Some(vec![units, of("meanings", &schema::words)])
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
