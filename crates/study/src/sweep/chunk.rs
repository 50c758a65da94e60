//! Neighbouring rows of a sweep.

use std::ops::Range;

use hyperstat_mechanisms::Value;

use super::record::Record;
use super::statistics::Values;

/// Neighbouring rows of a job's table. Used again and again, so that nothing is allocated for it.
#[derive(Debug, Default)]
pub struct Chunk {
    /// The rows, counted from 0 over the whole table.
    pub rows: Range<usize>,
    /// A record for each of them.
    pub records: Vec<Record>,
    /// Their measures, where a summary is wanted.
    pub measures: Vec<Option<Values>>,
    /// Their lines, where the table is one of text.
    pub text: String,
    /// Rows of a design.
    pub poses: usize,
    /// Further numbers that a row has where it has a result.
    pub further: usize,
    /// Values of the drives that make its pose, of every row those of a job that gives them.
    pub drives: Vec<f64>,
    /// Of a job that varies the designs, by number, that the rows are of, and their values.
    pub designs: Vec<(usize, Vec<Value>)>,
}

/// A row of a job's table.
#[derive(Debug, Clone, Copy)]
pub struct Row<'c> {
    /// Number of the pose in its design.
    pub pose: usize,
    /// What was found there.
    pub record: &'c Record,
    /// Further numbers that it has where it has a result.
    pub further: usize,
    /// Values of the drives, in a job that gives them.
    pub drives: &'c [f64],
    /// Number of the design and its values, in a job that varies.
    pub design: Option<(usize, &'c [Value])>,
}

impl Chunk {
    /// Empties it for other rows.
    pub(super) fn clear(&mut self) {
        self.records.clear();
        self.measures.clear();
        self.text.clear();
        self.drives.clear();
        self.designs.clear();
    }

    /// The rows in order.
    pub fn table_rows(&self) -> impl Iterator<Item = Row<'_>> {
        let first = self.rows.start.checked_div(self.poses).unwrap_or(0);
        let drives = self.drives.len() / self.records.len().max(1);
        self.rows
            .clone()
            .zip(self.records.iter().enumerate())
            .map(move |(row, (place, record))| {
                let design = row.checked_div(self.poses).unwrap_or(0);
                let of_design = self.designs.get(design - first);
                Row {
                    pose: row - design * self.poses,
                    record,
                    further: self.further,
                    drives: &self.drives[place * drives..][..drives],
                    design: of_design.map(|(number, values)| (*number, values.as_slice())),
                }
            })
    }
}
