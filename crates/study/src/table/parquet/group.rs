//! Rows of a table that are not written yet, by columns.

use std::io::Write;

use hyperstat_mechanisms::{Value, Varied};
use parquet::column::reader::get_typed_column_reader;
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::reader::RowGroupReader;
use parquet::file::writer::SerializedRowGroupWriter;

use crate::schema;
use crate::sweep::{Cell, Chunk, Columns, NUMBERS};

/// Columns of the displacement, the first of the numbers.
const DISPLACEMENT: usize = 6;

/// The rows that are not written yet, by columns.
#[derive(Default)]
pub(super) struct Group {
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

    fn read(&mut self, from: &mut Columnwise<'_>) -> Result<(), ParquetError> {
        from.next::<DoubleType>(&mut self.numbers, Some(&mut self.levels))
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

    fn read(&mut self, from: &mut Columnwise<'_>) -> Result<(), ParquetError> {
        match self {
            Self::Numbers(column) => column.read(from),
            Self::Texts(levels, texts) => from.next::<ByteArrayType>(texts, Some(levels)),
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

impl Group {
    /// No rows of a table with these columns.
    pub(super) fn new(columns: &Columns<'_>) -> Self {
        let further = columns.further.iter();
        Self {
            further: further.map(|name| Further::of(name)).collect(),
            drives: vec![Vec::new(); columns.drives.len()],
            values: columns.varied.iter().map(Values::of).collect(),
            ..Self::default()
        }
    }

    pub(super) fn len(&self) -> usize {
        self.pose.len()
    }

    pub(super) fn add(&mut self, chunk: &Chunk) {
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

    /// Writes all columns of the rows.
    pub(super) fn write<W: Write + Send>(
        &self,
        writer: &mut SerializedRowGroupWriter<'_, W>,
    ) -> Result<(), ParquetError> {
        write::<Int64Type, _>(writer, &self.pose, None)?;
        for column in &self.coordinates {
            column.write(writer)?;
        }
        write::<ByteArrayType, _>(writer, &self.status, None)?;
        let [displaced, stiff] = &self.levels;
        for (k, column) in self.numbers.iter().enumerate() {
            let levels = if k < DISPLACEMENT { displaced } else { stiff };
            write::<DoubleType, _>(writer, column, Some(levels))?;
        }
        for column in &self.further {
            column.write(writer)?;
        }
        for column in &self.drives {
            write::<DoubleType, _>(writer, column, None)?;
        }
        if !self.values.is_empty() {
            write::<Int64Type, _>(writer, &self.design, None)?;
        }
        for column in &self.values {
            match column {
                Values::Numbers(column) => write::<DoubleType, _>(writer, column, None)?,
                Values::Texts(column) => write::<ByteArrayType, _>(writer, column, None)?,
            }
        }
        Ok(())
    }
    /// Appends the rows of a group of another table with the same columns.
    pub(super) fn read(&mut self, group: &dyn RowGroupReader) -> Result<(), ParquetError> {
        let from = &mut Columnwise {
            group,
            rows: group.metadata().num_rows() as usize,
            column: 0,
        };
        from.next::<Int64Type>(&mut self.pose, None)?;
        for column in &mut self.coordinates {
            column.read(from)?;
        }
        from.next::<ByteArrayType>(&mut self.status, None)?;
        for (k, column) in self.numbers.iter_mut().enumerate() {
            // Those of the displacement are the same, and those of the stiffness.
            let mut levels = Vec::new();
            from.next::<DoubleType>(column, Some(&mut levels))?;
            match k {
                0 => self.levels[0].append(&mut levels),
                DISPLACEMENT => self.levels[1].append(&mut levels),
                _ => {}
            }
        }
        for column in &mut self.further {
            column.read(from)?;
        }
        for column in &mut self.drives {
            from.next::<DoubleType>(column, None)?;
        }
        if !self.values.is_empty() {
            from.next::<Int64Type>(&mut self.design, None)?;
        }
        for column in &mut self.values {
            match column {
                Values::Numbers(column) => from.next::<DoubleType>(column, None)?,
                Values::Texts(column) => from.next::<ByteArrayType>(column, None)?,
            }
        }
        Ok(())
    }

    fn status(&mut self, word: &'static str) -> ByteArray {
        if let Some((_, shared)) = self.statuses.iter().find(|(known, _)| *known == word) {
            return shared.clone();
        }
        let shared = ByteArray::from(word);
        self.statuses.push((word, shared.clone()));
        shared
    }

    pub(super) fn clear(&mut self) {
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

/// A group of rows being read, column by column.
struct Columnwise<'g> {
    group: &'g dyn RowGroupReader,
    rows: usize,
    column: usize,
}

impl Columnwise<'_> {
    /// Appends the values of the next column, and the level of every row where it has levels.
    fn next<T: DataType>(
        &mut self,
        values: &mut Vec<T::T>,
        mut levels: Option<&mut Vec<i16>>,
    ) -> Result<(), ParquetError> {
        let column = self.group.get_column_reader(self.column)?;
        self.column += 1;
        let mut reader = get_typed_column_reader::<T>(column);
        let mut left = self.rows;
        while left > 0 {
            let (rows, ..) = reader.read_records(left, levels.as_deref_mut(), None, values)?;
            if rows == 0 {
                let message = "a column ends before its last row".into();
                return Err(ParquetError::General(message));
            }
            left -= rows;
        }
        Ok(())
    }
}
