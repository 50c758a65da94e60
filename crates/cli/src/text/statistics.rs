//! Measures over a workspace, as a table.

use std::fmt;

use hyperstat_study::sweep::MeasureReport;

use super::table::{Table, number};

/// The statistics as a table.
#[derive(Debug)]
pub(crate) struct Told<'r>(pub(super) &'r [MeasureReport]);

impl fmt::Display for Told<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let heads = [
            "over the workspace",
            "min",
            "5 %",
            "median",
            "mean",
            "95 %",
            "max",
        ];
        let mut table = Table::new(1, &heads);
        for report in self.0 {
            let [low, median, high] = report.percentiles.map(|p| p.value);
            let name = format!("{} [{}]", report.words, report.unit);
            table.row(
                &[&name],
                [
                    report.min.value,
                    low,
                    median,
                    report.mean,
                    high,
                    report.max.value,
                ],
            );
        }
        write!(f, "{table}")?;
        // Where the output is softest.
        if let Some(worst) = self.0.iter().find(|r| r.measure == "softest_force") {
            let [x, y, z] = [0, 1, 2].map(|k| number(worst.max.at[k].unwrap_or_default()));
            writeln!(f, "  softest at ({x}, {y}, {z}) m, row {}", worst.max.row)?;
        }
        Ok(())
    }
}
