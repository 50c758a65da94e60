//! Which rows of a table are drawn.

use crate::plot_error::PlotError;
use crate::table::{Column, DESIGN, STATUS, TableReader};

/// What the status of a pose with a result is.
const SOLVED: [&str; 2] = ["ok", "rigid"];

/// What chooses rows.
#[derive(Debug, Clone, Copy, Default)]
pub struct Choice {
    /// Of this design.
    pub design: Option<usize>,
    /// This pose.
    pub pose: Option<usize>,
}

/// The first design of a table with a pose that has a result, as a job's figures are of; the first
/// where none has. `None` where the table is of one design.
pub fn first_design(table: &TableReader) -> Result<Option<usize>, PlotError> {
    let Some(place) = table.find(DESIGN) else {
        return Ok(None);
    };
    let designs = table.read(&[place])?.remove(0);
    let statuses = table.words(table.find(STATUS).unwrap_or(0))?;
    let mut solved = designs.iter().zip(&statuses);
    let found = solved.find_map(|(design, status)| match SOLVED.contains(&&**status) {
        true => *design,
        false => None,
    });
    Ok(Some(found.unwrap_or(0.0) as usize))
}

impl Choice {
    /// The design in words, where the table is of several.
    pub(super) fn in_words(self, table: &TableReader) -> Option<String> {
        let design = self.design.filter(|_| table.varies())?;
        Some(format!("design {design}"))
    }

    /// The rows that are chosen.
    pub(super) fn rows(self, table: &TableReader) -> Result<Vec<usize>, PlotError> {
        let pose = table.read(&[table.find("pose").unwrap_or(0)])?.remove(0);
        if pose.is_empty() {
            return Err(PlotError::Empty {
                path: table.path().into(),
            });
        }
        let mut rows: Vec<usize> = (0..pose.len()).collect();
        let designs = match table.find(DESIGN) {
            Some(place) => table.read(&[place])?.remove(0),
            None => vec![Some(0.0); pose.len()],
        };
        let choices = [("design", self.design, designs), ("pose", self.pose, pose)];
        for (what, number, column) in choices {
            let Some(number) = number else { continue };
            rows.retain(|&row| column[row] == Some(number as f64));
            if rows.is_empty() {
                let last = column
                    .iter()
                    .flatten()
                    .fold(0.0_f64, |last, k| last.max(*k));
                return Err(PlotError::NoRows {
                    path: table.path().into(),
                    what,
                    number,
                    last: last as usize,
                });
            }
        }
        Ok(rows)
    }
}

/// The chosen rows of a column.
pub(super) fn chosen(column: &Column, rows: &[usize]) -> Column {
    rows.iter().map(|&row| column[row]).collect()
}
