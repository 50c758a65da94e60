//! Measures over a workspace, as a table.

use std::fmt;

use hyperstat_study::sweep::{Extreme, MeasureReport};
use hyperstat_study::table;

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
            let name = match report.unit {
                "" => report.words.clone(),
                unit => format!("{} [{unit}]", report.words),
            };
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
        // Where the output is softest, and what is asked for is worst.
        for report in self.0.iter().filter(|report| is_placed(&report.measure)) {
            let place = place(&report.max);
            let (name, row) = (&report.measure, report.max.row);
            writeln!(f, "  {name} is largest at {place}, row {row}")?;
        }
        Ok(())
    }
}

/// Whether it is told where a measure is largest.
fn is_placed(name: &str) -> bool {
    let last = name.rsplit('.').next().unwrap_or(name);
    ["softest_force", "stress", "utilisation"].contains(&last)
}

/// Where a value is, in the coordinates that the poses give; else the place of the output.
fn place(extreme: &Extreme) -> String {
    let told = |(name, value): (&str, &f64)| {
        let unit = table::unit(name);
        format!("{name} = {} {unit}", number(*value))
    };
    let commanded: Vec<String> = extreme.commanded.iter().map(told).collect();
    if commanded.is_empty() {
        let [x, y, z] = [0, 1, 2].map(|k| number(extreme.at[k].unwrap_or_default()));
        return format!("({x}, {y}, {z}) m");
    }
    commanded.join(", ")
}
