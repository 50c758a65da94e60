//! The table of a job: a row a pose, as CSV or Parquet.

mod csv;
mod parquet;

use std::io;
use std::path::Path;

use super::record::Columns;
use super::sweep::Chunk;
use crate::args::TableFormat;

/// Name of the column that says how a pose came out.
const STATUS: &str = "status";

/// Name of the column of a job that varies with the number of the design.
const DESIGN: &str = "design";

/// Names of the columns: the number of the pose, the pose, the status, and the numbers found; of a
/// job whose poses are values of drives these after them; of a job that varies the number of the design
/// and its values last.
pub(crate) fn columns(columns: &Columns<'_>) -> impl Iterator<Item = String> {
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
pub(crate) fn numeric(of: &Columns<'_>) -> Vec<String> {
    let is_text = |name: &String| {
        let mut varied = of.varied.iter();
        name == STATUS || varied.any(|varied| varied.path == *name && !varied.numeric)
    };
    columns(of).filter(|name| !is_text(name)).collect()
}

/// A table being written; its file gets its name when it is complete.
pub(crate) enum Table {
    Csv(csv::Csv),
    Parquet(Box<parquet::Parquet>),
}

impl Table {
    /// Opens the table for `path`.
    pub(crate) fn create(
        path: &Path,
        format: TableFormat,
        columns: &Columns<'_>,
    ) -> io::Result<Self> {
        Ok(match format {
            TableFormat::Csv => Self::Csv(csv::Csv::create(path, columns)?),
            TableFormat::Parquet => {
                Self::Parquet(Box::new(parquet::Parquet::create(path, columns)?))
            }
        })
    }

    /// What can be done for a chunk before its turn to be written.
    pub(crate) fn render(format: TableFormat, chunk: &mut Chunk) {
        match format {
            TableFormat::Csv => csv::render(chunk),
            TableFormat::Parquet => {}
        }
    }

    /// Appends the next rows, rendered.
    pub(crate) fn append(&mut self, chunk: &Chunk) -> io::Result<()> {
        match self {
            Self::Csv(table) => table.append(chunk),
            Self::Parquet(table) => table.append(chunk),
        }
    }

    /// Completes the file.
    pub(crate) fn commit(self) -> io::Result<()> {
        match self {
            Self::Csv(table) => table.commit(),
            Self::Parquet(table) => table.commit(),
        }
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
