//! Which rows of a table are drawn.

use super::error::PlotError;
use super::table::{Column, Table};

/// What chooses rows.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Choice {
    /// Of this design.
    pub(crate) design: Option<usize>,
    /// This pose.
    pub(crate) pose: Option<usize>,
}

impl Choice {
    /// The rows that are chosen.
    pub(super) fn rows(self, table: &Table) -> Result<Vec<usize>, PlotError> {
        let pose = table.read(&[table.find("pose").unwrap_or(0)])?.remove(0);
        let mut rows: Vec<usize> = (0..pose.len()).collect();
        let designs = match table.find("design") {
            Some(place) => table.read(&[place])?.remove(0),
            None => vec![Some(0.0); pose.len()],
        };
        let choices = [("design", self.design, designs), ("pose", self.pose, pose)];
        for (what, number, column) in choices {
            let Some(number) = number else { continue };
            rows.retain(|&row| column[row] == Some(number as f64));
            if rows.is_empty() {
                return Err(PlotError::NoRows {
                    path: table.path().into(),
                    what,
                    number,
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
