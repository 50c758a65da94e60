//! The tables of `hyperstat run`, read back: CSV or Parquet, only the columns that are asked for.

use std::collections::HashMap;
use std::io::{BufRead, BufReader, Read};
#[cfg(feature = "parquet")]
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[cfg(feature = "fs")]
use hyperstat_mechanisms::files;
use hyperstat_mechanisms::{Location, Varied};
#[cfg(feature = "parquet")]
use parquet::errors::ParquetError;
#[cfg(feature = "parquet")]
use parquet::file::metadata::FileMetaData;
#[cfg(feature = "parquet")]
use parquet::file::reader::{FileReader, SerializedFileReader};
#[cfg(feature = "parquet")]
use parquet::record::Field;
#[cfg(feature = "parquet")]
use parquet::schema::types::Type;

use super::TableFormat;
use super::cells;
use crate::plot_error::PlotError;
use crate::schema::{COORDINATES, DESIGN, POSE, STATUS, holds_words, unit};

/// A column of numbers; `None` where a cell is empty.
pub type Column = Vec<Option<f64>>;

/// A table, of which the names of the columns are read.
#[derive(Debug)]
pub struct TableReader {
    path: PathBuf,
    /// Names of the columns.
    names: Vec<String>,
    /// SI units of columns whose names do not tell them.
    units: HashMap<String, String>,
    form: TableFormat,
    source: Content,
}

/// Where the bytes of a table are.
#[derive(Debug, Clone)]
enum Content {
    /// On the disk, at the table's path.
    #[cfg(feature = "fs")]
    Disk,
    Memory(Arc<[u8]>),
}

impl TableReader {
    /// Opens a table, CSV or Parquet by its name, and reads the names of its columns.
    ///
    /// # Errors
    /// The file cannot be read, or is no table as a sweep writes it.
    #[cfg(feature = "fs")]
    pub fn open(path: &Path) -> Result<Self, PlotError> {
        Self::new(path, Content::Disk)
    }

    /// A table of this name, CSV or Parquet by its ending, whose content is here.
    ///
    /// # Errors
    /// It is no table as a sweep writes it.
    pub fn of(path: &Path, content: impl Into<Arc<[u8]>>) -> Result<Self, PlotError> {
        Self::new(path, Content::Memory(content.into()))
    }

    fn new(path: &Path, source: Content) -> Result<Self, PlotError> {
        let extension = path.extension().and_then(|extension| extension.to_str());
        let form = match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("csv") => TableFormat::Csv,
            #[cfg(feature = "parquet")]
            Some("parquet") => TableFormat::Parquet,
            _ => return Err(PlotError::Extension { path: path.into() }),
        };
        let (names, units) = match form {
            TableFormat::Csv => {
                let mut reader = csv_reader(path, &source)?;
                let header = reader.headers().map_err(|error| csv_error(path, error))?;
                let names = header.iter().map(|name| cells::text(name).into());
                (names.collect(), HashMap::new())
            }
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => {
                let reader = parquet_reader(path, &source)?;
                let metadata = reader.metadata().file_metadata();
                let columns = metadata.schema().get_fields().iter();
                let names = columns.map(|column| column.name().to_string());
                (names.collect(), units(metadata))
            }
        };
        // Columns that every table has.
        let mut first = [POSE].into_iter().chain(COORDINATES).chain([STATUS]);
        let table = Self {
            path: path.into(),
            names,
            units,
            form,
            source,
        };
        match first.find(|name| table.find(name).is_none()) {
            Some(missing) => Err(PlotError::NoRun {
                location: Box::new(table.location(1, 0)),
                missing,
            }),
            None => Ok(table),
        }
    }

    /// Its path, or its name.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Name of the job: that of the file without its extension.
    pub fn job(&self) -> String {
        let stem = self.path.file_stem().unwrap_or_default();
        stem.to_string_lossy().into_owned()
    }

    /// The same table; the units of what varies are these.
    pub(crate) fn varying(mut self, varied: &[Varied]) -> Self {
        let known = varied.iter();
        let known = known.filter_map(|own| Some((own.path.clone(), own.unit.clone()?)));
        self.units.extend(known);
        self
    }

    /// The SI unit of a column; empty where it has none or is unknown.
    pub(crate) fn unit(&self, name: &str) -> &str {
        self.units
            .get(name)
            .map_or_else(|| unit(name), String::as_str)
    }

    /// Names of its columns.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Names of the columns of drives: those after the stiffness, before the designs, that end as
    /// the direction of a joint does.
    pub(crate) fn drives(&self) -> impl Iterator<Item = String> {
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
    pub(crate) fn varied(&self) -> &[String] {
        let first = self
            .find(DESIGN)
            .map_or(self.names.len(), |place| place + 1);
        self.names.get(first..).unwrap_or_default()
    }

    /// Whether it is of several designs.
    pub(crate) fn varies(&self) -> bool {
        self.find(DESIGN).is_some()
    }

    /// Whether a column may hold words.
    pub(crate) fn may_hold_words(&self, name: &str) -> bool {
        let varied = self.varied().iter().any(|varied| varied == name);
        name == STATUS || holds_words(name) || varied
    }

    /// The place of a column.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Reads columns of numbers, by their places, each a number a row.
    ///
    /// # Errors
    /// A column holds no numbers, a line has another number of cells than there are columns, or the
    /// table cannot be read.
    pub fn read(&self, places: &[usize]) -> Result<Vec<Column>, PlotError> {
        if let Some(place) = places.iter().find(|place| **place >= self.names.len()) {
            return Err(PlotError::UnknownColumn {
                path: self.path.clone(),
                name: format!("number {place}"),
                help: format!("it has {} columns, counted from 0", self.names.len()),
            });
        }
        match self.form {
            TableFormat::Csv => self.read_csv(places),
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => self.read_parquet(places),
        }
    }

    /// Reads a column as the words it holds, each a text a row; a number as it is written.
    pub(crate) fn words(&self, place: usize) -> Result<Vec<String>, PlotError> {
        let mut words = Vec::new();
        match self.form {
            TableFormat::Csv => self.each_record(|_, record| {
                words.push(record[place].to_string());
                Ok(())
            })?,
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => self.each_row(&[place], |cells| {
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
        let mut reader = csv_reader(&self.path, &self.source)?;
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

    #[cfg(feature = "parquet")]
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
    #[cfg(feature = "parquet")]
    fn each_row(
        &self,
        places: &[usize],
        mut take: impl FnMut(&[&Field]) -> Result<(), PlotError>,
    ) -> Result<(), PlotError> {
        let error = |source| PlotError::Parquet {
            path: self.path.clone(),
            source,
        };
        let reader = parquet_reader(&self.path, &self.source)?;
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
        // Files that are spoilt can make the reader panic.
        let spoilt = |_| error(ParquetError::General("the file is spoilt".into()));
        let opened = catch_unwind(AssertUnwindSafe(|| reader.get_row_iter(Some(projection))));
        let mut rows = opened.map_err(spoilt)?.map_err(error)?;
        while let Some(row) = catch_unwind(AssertUnwindSafe(|| rows.next())).map_err(spoilt)? {
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
            TableFormat::Csv => self.source.open(&self.path).ok().and_then(|content| {
                let mut lines = BufReader::new(content).lines();
                lines.nth(line - 1).and_then(Result::ok)
            }),
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => None,
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

impl Content {
    /// The content from its beginning.
    fn open(&self, path: &Path) -> Result<Box<dyn Read + '_>, PlotError> {
        match self {
            #[cfg(feature = "fs")]
            Self::Disk => Ok(Box::new(file(path)?)),
            Self::Memory(content) => {
                let _ = path;
                Ok(Box::new(&**content))
            }
        }
    }
}

#[cfg(feature = "fs")]
fn file(path: &Path) -> Result<std::fs::File, PlotError> {
    files::open(path).map_err(|source| PlotError::Read {
        path: path.into(),
        source,
    })
}

fn csv_reader<'s>(
    path: &Path,
    source: &'s Content,
) -> Result<csv::Reader<Box<dyn Read + 's>>, PlotError> {
    let content = source.open(path)?;
    Ok(csv::ReaderBuilder::new()
        .flexible(true)
        .from_reader(content))
}

fn csv_error(path: &Path, error: csv::Error) -> PlotError {
    PlotError::Read {
        path: path.into(),
        source: error.into(),
    }
}

/// The units that a table says its columns have.
#[cfg(feature = "parquet")]
fn units(metadata: &FileMetaData) -> HashMap<String, String> {
    let mut notes = metadata.key_value_metadata().into_iter().flatten();
    let units = notes.find(|note| note.key == "units");
    let units = units.and_then(|note| serde_json::from_str(note.value.as_deref()?).ok());
    units.unwrap_or_default()
}

#[cfg(feature = "parquet")]
fn parquet_reader(path: &Path, source: &Content) -> Result<Box<dyn FileReader>, PlotError> {
    let error = |source| PlotError::Parquet {
        path: path.into(),
        source,
    };
    Ok(match source {
        #[cfg(feature = "fs")]
        Content::Disk => Box::new(SerializedFileReader::new(file(path)?).map_err(error)?),
        Content::Memory(content) => {
            let content = bytes::Bytes::from_owner(Arc::clone(content));
            Box::new(SerializedFileReader::new(content).map_err(error)?)
        }
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
