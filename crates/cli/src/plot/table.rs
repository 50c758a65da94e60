//! The tables of `hyperstat run`, read back: CSV or Parquet, only the columns that are asked for.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

use hyperstat_mechanisms::{Location, files};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use parquet::schema::types::Type;

use super::error::PlotError;
use crate::cells;

/// The column of a table of designs with their numbers; after it are their values.
const DESIGN: &str = "design";

/// Columns that every table has, in order.
const FIRST: [&str; 8] = ["pose", "x", "y", "z", "rx", "ry", "rz", "status"];

/// The column that says how a pose came out, in a word.
pub(super) const STATUS: &str = "status";

/// A column of numbers; `None` where a cell is empty.
pub(super) type Column = Vec<Option<f64>>;

/// A table, of which the names of the columns are read.
#[derive(Debug)]
pub(crate) struct Table {
    path: PathBuf,
    /// Names of the columns.
    names: Vec<String>,
    form: Form,
}

#[derive(Debug, Clone, Copy)]
enum Form {
    Csv,
    Parquet,
}

impl Table {
    /// Opens a table and reads the names of its columns.
    pub(crate) fn open(path: &Path) -> Result<Self, PlotError> {
        let extension = path.extension().and_then(|extension| extension.to_str());
        let form = match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("csv") => Form::Csv,
            Some("parquet") => Form::Parquet,
            _ => return Err(PlotError::Extension { path: path.into() }),
        };
        let names = match form {
            Form::Csv => {
                let mut reader = csv_reader(path)?;
                let header = reader.headers().map_err(|error| csv_error(path, error))?;
                header.iter().map(|name| cells::text(name).into()).collect()
            }
            Form::Parquet => {
                let reader = parquet_reader(path)?;
                let schema = reader.metadata().file_metadata().schema();
                let columns = schema.get_fields().iter();
                columns.map(|column| column.name().to_string()).collect()
            }
        };
        let table = Self {
            path: path.into(),
            names,
            form,
        };
        match FIRST.into_iter().find(|name| table.find(name).is_none()) {
            Some(missing) => Err(PlotError::NoRun {
                location: Box::new(table.location(1, 0)),
                missing,
            }),
            None => Ok(table),
        }
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Name of the job: that of the file without its extension.
    pub(crate) fn job(&self) -> String {
        super::stem(&self.path)
    }

    pub(crate) fn names(&self) -> &[String] {
        &self.names
    }

    /// Names of the columns of drives: those after the stiffness, before the designs, that end as
    /// the direction of a joint does.
    pub(super) fn drives(&self) -> impl Iterator<Item = String> {
        let first = self.find("k66").map_or(self.names.len(), |place| place + 1);
        let last = self.find(DESIGN).unwrap_or(self.names.len());
        let between = self.names.get(first..last).unwrap_or_default().iter();
        let is_drive = |name: &&String| {
            let direction = name.rsplit_once('.').map(|(_, direction)| direction);
            direction.is_some_and(|d| ["x", "y", "z", "u", "v", "w"].contains(&d))
        };
        between.filter(is_drive).cloned()
    }

    /// Names of the columns of what varies from design to design.
    pub(super) fn varied(&self) -> &[String] {
        let first = self
            .find(DESIGN)
            .map_or(self.names.len(), |place| place + 1);
        self.names.get(first..).unwrap_or_default()
    }

    /// Whether it is of several designs.
    pub(super) fn varies(&self) -> bool {
        self.find(DESIGN).is_some()
    }

    /// Whether a column may hold words.
    pub(super) fn may_hold_words(&self, name: &str) -> bool {
        name == STATUS || self.varied().iter().any(|varied| varied == name)
    }

    /// The place of a column.
    pub(crate) fn find(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Reads columns of numbers, each a number a row.
    pub(crate) fn read(&self, places: &[usize]) -> Result<Vec<Column>, PlotError> {
        match self.form {
            Form::Csv => self.read_csv(places),
            Form::Parquet => self.read_parquet(places),
        }
    }

    /// Reads a column as the words it holds, each a text a row; a number as it is written.
    pub(super) fn words(&self, place: usize) -> Result<Vec<String>, PlotError> {
        let mut words = Vec::new();
        match self.form {
            Form::Csv => self.each_record(|_, record| {
                words.push(record[place].to_string());
                Ok(())
            })?,
            Form::Parquet => self.each_row(&[place], |cells| {
                words.push(match cells[0] {
                    Field::Str(text) => text.clone(),
                    Field::Double(number) => format!("{number:?}"),
                    Field::Null => String::new(),
                    other => other.to_string(),
                });
                Ok(())
            })?,
        }
        Ok(words)
    }

    fn read_csv(&self, places: &[usize]) -> Result<Vec<Column>, PlotError> {
        let mut columns = vec![Column::new(); places.len()];
        self.each_record(|line, record| {
            for (column, &place) in columns.iter_mut().zip(places) {
                let cell = &record[place];
                let number = match cell {
                    "" => None,
                    cell => match cell.parse::<f64>() {
                        Ok(number) if number.is_finite() => Some(number),
                        _ if self.may_hold_words(&self.names[place]) => {
                            return Err(self.texts(place));
                        }
                        _ => {
                            return Err(PlotError::NoNumber {
                                location: Box::new(self.location(line, place)),
                                column: self.names[place].clone(),
                                text: cell.into(),
                            });
                        }
                    },
                };
                column.push(number);
            }
            Ok(())
        })?;
        Ok(columns)
    }

    /// The error of a column of texts where numbers are needed.
    fn texts(&self, place: usize) -> PlotError {
        PlotError::Texts {
            path: self.path.clone(),
            column: self.names[place].clone(),
        }
    }

    /// Does something with every line of a CSV file and its cells, as many as there are columns.
    fn each_record(
        &self,
        mut take: impl FnMut(usize, &csv::StringRecord) -> Result<(), PlotError>,
    ) -> Result<(), PlotError> {
        let mut reader = csv_reader(&self.path)?;
        let mut record = csv::StringRecord::new();
        loop {
            let more = reader.read_record(&mut record);
            if !more.map_err(|error| csv_error(&self.path, error))? {
                return Ok(());
            }
            let line = record.position().map_or(1, csv::Position::line) as usize;
            if record.len() != self.names.len() {
                return Err(PlotError::Cells {
                    location: Box::new(self.location(line, record.len().min(self.names.len()))),
                    expected: self.names.len(),
                    found: record.len(),
                });
            }
            take(line, &record)?;
        }
    }

    fn read_parquet(&self, places: &[usize]) -> Result<Vec<Column>, PlotError> {
        let mut columns = vec![Column::new(); places.len()];
        self.each_row(places, |cells| {
            for ((column, cell), &place) in columns.iter_mut().zip(cells).zip(places) {
                column.push(match cell {
                    Field::Double(number) => Some(*number),
                    Field::Long(number) => Some(*number as f64),
                    Field::Null => None,
                    _ => return Err(self.texts(place)),
                });
            }
            Ok(())
        })?;
        Ok(columns)
    }

    /// Does something with these cells of every row of a Parquet file.
    fn each_row(
        &self,
        places: &[usize],
        mut take: impl FnMut(&[&Field]) -> Result<(), PlotError>,
    ) -> Result<(), PlotError> {
        let error = |source| PlotError::Parquet {
            path: self.path.clone(),
            source,
        };
        let reader = parquet_reader(&self.path)?;
        let schema = reader.metadata().file_metadata().schema();
        // The columns asked for, in the order of the file.
        let fields: Vec<_> = (schema.get_fields().iter().enumerate())
            .filter(|(place, _)| places.contains(place))
            .map(|(_, field)| field.clone())
            .collect();
        let order: Vec<usize> = places
            .iter()
            .map(|place| {
                let before = |name: &&String| fields.iter().any(|field| field.name() == *name);
                self.names[..*place].iter().filter(before).count()
            })
            .collect();
        let projection = Type::group_type_builder(schema.name())
            .with_fields(fields)
            .build()
            .map_err(error)?;
        for row in reader.get_row_iter(Some(projection)).map_err(error)? {
            let row = row.map_err(error)?;
            let cells: Vec<&Field> = row.get_column_iter().map(|(_, field)| field).collect();
            let cells: Vec<&Field> = order.iter().map(|cell| cells[*cell]).collect();
            take(&cells)?;
        }
        Ok(())
    }

    /// The place of a cell of a line of a CSV file.
    fn location(&self, line: usize, cell: usize) -> Location {
        let text = match self.form {
            Form::Csv => files::open(&self.path).ok().and_then(|file| {
                let mut lines = BufReader::new(file).lines();
                lines.nth(line - 1).and_then(Result::ok)
            }),
            Form::Parquet => None,
        };
        let text = text.unwrap_or_else(|| self.names.join(","));
        let (column, width) = cell_span(&text, cell);
        Location {
            path: self.path.clone(),
            line,
            column,
            width,
            text,
        }
    }
}

/// Column, from 1, and width in characters of a cell in a line.
fn cell_span(text: &str, cell: usize) -> (usize, usize) {
    let (mut start, mut seen, mut quoted) = (0, 0, false);
    let mut end = 0;
    for (at, c) in text.chars().enumerate() {
        end = at + 1;
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted && seen == cell => return (start + 1, (at - start).max(1)),
            ',' if !quoted => (seen, start) = (seen + 1, at + 1),
            _ => {}
        }
    }
    (start + 1, (end - start).max(1))
}

fn csv_reader(path: &Path) -> Result<csv::Reader<File>, PlotError> {
    let file = files::open(path).map_err(|source| PlotError::Read {
        path: path.into(),
        source,
    })?;
    Ok(csv::ReaderBuilder::new().flexible(true).from_reader(file))
}

fn csv_error(path: &Path, error: csv::Error) -> PlotError {
    PlotError::Read {
        path: path.into(),
        source: error.into(),
    }
}

fn parquet_reader(path: &Path) -> Result<SerializedFileReader<File>, PlotError> {
    let file = files::open(path).map_err(|source| PlotError::Read {
        path: path.into(),
        source,
    })?;
    SerializedFileReader::new(file).map_err(|source| PlotError::Parquet {
        path: path.into(),
        source,
    })
}

#[cfg(test)]
mod tests {
    use super::cell_span;

    #[test]
    fn a_cell_is_found_in_its_line() {
        assert_eq!(cell_span("ab,c,def", 0), (1, 2));
        assert_eq!(cell_span("ab,c,def", 1), (4, 1));
        assert_eq!(cell_span("ab,c,def", 2), (6, 3));
        assert_eq!(cell_span("\"a,b\",c", 1), (7, 1));
        assert_eq!(cell_span("ab,,c", 1), (4, 1));
        assert_eq!(cell_span("ab", 5), (1, 2));
    }
}
