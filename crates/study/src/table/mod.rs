//! The table of a job: a row a pose, as CSV or Parquet.

mod cells;
mod csv;
#[cfg(feature = "parquet")]
mod parquet;
#[cfg(feature = "figures")]
mod read;

use std::io::{self, Write};

use crate::sweep::{Chunk, Columns};
#[cfg(feature = "figures")]
pub use read::{Column, TableReader};

/// Name of the column that says how a pose came out.
pub(crate) const STATUS: &str = "status";

/// Name of the column of a job that varies with the number of the design.
pub(crate) const DESIGN: &str = "design";

/// Names of the columns: the number of the pose, the pose, the status, and the numbers found; of a
/// job whose poses are values of drives these after them; of a job that varies the number of the design
/// and its values last.
pub fn columns(columns: &Columns<'_>) -> impl Iterator<Item = String> {
    let varied = columns.varied;
    let pose = ["pose", "x", "y", "z", "rx", "ry", "rz"];
    let displacement = ["dx", "dy", "dz", "drx", "dry", "drz"];
    let first = pose.into_iter().chain([STATUS]).chain(displacement);
    let stiffness = (1..=6).flat_map(|row| (row..=6).map(move |column| format!("k{row}{column}")));
    let design = (!varied.is_empty()).then(|| DESIGN.to_owned());
    let values = varied.iter().map(|varied| varied.path.clone());
    let found = first.map(String::from).chain(stiffness);
    let found = found.chain(columns.further.iter().cloned());
    let found = found.chain(columns.drives.iter().cloned());
    found.chain(design).chain(values)
}

/// Names of the columns that hold numbers.
pub fn numeric(of: &Columns<'_>) -> Vec<String> {
    let is_text = |name: &String| {
        let mut varied = of.varied.iter();
        name == STATUS || varied.any(|varied| varied.path == *name && !varied.numeric)
    };
    columns(of).filter(|name| !is_text(name)).collect()
}

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
        let form = match format {
            TableFormat::Csv => Form::Csv(csv::Csv::new(writer, columns)?),
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => {
                Form::Parquet(Box::new(parquet::Parquet::new(writer, columns)?))
            }
        };
        Ok(Self { form })
    }

    /// Appends the next rows, rendered.
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

/// What can be done for a chunk before its turn to be written: on any thread, in any order.
pub fn render(format: TableFormat, chunk: &mut Chunk) {
    match format {
        TableFormat::Csv => csv::render(chunk),
        #[cfg(feature = "parquet")]
        TableFormat::Parquet => {}
    }
}

#[cfg(test)]
mod tests {
    use super::Columns;

    #[test]
    fn the_columns_are_those_of_the_format() {
        let names: Vec<_> = super::columns(&Columns::default()).collect();
        let expected = "pose,x,y,z,rx,ry,rz,status,dx,dy,dz,drx,dry,drz,k11,k12,k13,k14,k15,k16,\
                        k22,k23,k24,k25,k26,k33,k34,k35,k36,k44,k45,k46,k55,k56,k66";
        assert_eq!(names.join(","), expected);
    }
}
