//! Runs that are larger than they were probably meant to be: they ask first.

use std::path::Path;

use hyperstat_study::disk::Room;
use hyperstat_study::parts::Part;
use hyperstat_study::sweep::{Columns, Sweep};
use hyperstat_study::table::{self, TableFormat};

use crate::args;
use crate::error::CliError;
use crate::terminal;

/// Rows that a run may have before it asks.
const MANY_ROWS: u64 = 1_000_000_000;

/// Share of the free disk that its tables may fill before it asks.
const MUCH_OF_DISK: f64 = 0.9;

/// Bytes of a number in a table of text with its comma: 17 digits mostly, a point, an exponent now
/// and then. Where a pose has no result, or numbers are round, they are fewer.
const TEXT: u64 = 19;

/// Bytes of a number in a table of Parquet.
const BINARY: u64 = 8;

/// Asks before a run of very many rows, or of more than the disk of `out` takes.
pub(crate) fn ask(sweeps: &[Sweep<'_>], part: &Part, args: &args::Run) -> Result<(), CliError> {
    let run = Size::of(sweeps, part, args.format.into());
    let free = Room::of(&args.out).map(|room| room.free);
    let Some(why) = run.doubt(free, &args.out) else {
        return Ok(());
    };
    match args.yes || terminal::ask(&format!("{why}; go on?")) == Some(true) {
        true => Ok(()),
        false => Err(CliError::NotAgreed { why }),
    }
}

/// How much a run writes.
#[derive(Debug, Default)]
pub(crate) struct Size {
    pub(crate) rows: u64,
    pub(crate) bytes: u64,
}

impl Size {
    /// Of a part of every job's rows.
    pub(crate) fn of(sweeps: &[Sweep<'_>], part: &Part, format: TableFormat) -> Self {
        let mut run = Self::default();
        for sweep in sweeps {
            let columns = table::columns(&Columns::of(sweep.job())).count();
            let rows = part.rows(sweep.len()).len();
            run.add(rows as u64, columns as u64, format);
        }
        run
    }

    fn add(&mut self, rows: u64, columns: u64, format: TableFormat) {
        let number = match format {
            TableFormat::Csv => TEXT,
            TableFormat::Parquet => BINARY,
        };
        self.rows = self.rows.saturating_add(rows);
        let bytes = rows.saturating_mul(columns.saturating_mul(number));
        self.bytes = self.bytes.saturating_add(bytes);
    }

    /// What is unusual about it, where anything is; `free` bytes are left on the disk of `out`.
    fn doubt(&self, free: Option<u64>, out: &Path) -> Option<String> {
        let size = format!(
            "the run has {} rows, up to about {}",
            self.rows,
            amount(self.bytes)
        );
        match free {
            Some(free) if self.bytes as f64 > MUCH_OF_DISK * free as f64 => Some(format!(
                "{size}, and the disk of {} has {} left",
                out.display(),
                amount(free)
            )),
            _ if self.rows > MANY_ROWS => Some(size),
            _ => None,
        }
    }
}

/// A number of bytes in words.
pub(crate) fn amount(bytes: u64) -> String {
    const UNITS: [&str; 7] = ["B", "kB", "MB", "GB", "TB", "PB", "EB"];
    let mut value = bytes as f64;
    let mut unit = 0;
    while value >= 999.5 && unit + 1 < UNITS.len() {
        value /= 1e3;
        unit += 1;
    }
    let digits = usize::from(value < 9.95 && unit > 0);
    format!("{value:.digits$} {}", UNITS[unit])
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{Size, amount};
    use hyperstat_study::table::TableFormat;

    fn doubt(rows: u64, format: TableFormat, free: Option<u64>) -> Option<String> {
        let mut size = Size::default();
        size.add(rows, 35, format);
        size.doubt(free, Path::new("out"))
    }

    #[test]
    fn large_runs_are_doubted_by_rows_and_by_the_disk() {
        let (csv, parquet) = (TableFormat::Csv, TableFormat::Parquet);
        assert_eq!(doubt(1_000_000_000, csv, None), None);
        let why = doubt(1_000_000_001, csv, Some(u64::MAX)).unwrap();
        assert!(why.contains("1000000001 rows, up to about 665 GB"), "{why}");
        // 35 columns of 19 bytes or 8: 665 kB and 280 kB.
        assert_eq!(doubt(1000, csv, Some(740_000)), None);
        let why = doubt(1000, csv, Some(738_000)).unwrap();
        assert!(why.contains("the disk of out has 738 kB left"), "{why}");
        assert_eq!(doubt(1000, parquet, Some(312_000)), None);
        assert!(doubt(1000, parquet, Some(310_000)).is_some());
        assert!(doubt(u64::MAX, csv, None).unwrap().contains("18 EB"));
    }

    #[test]
    fn amounts_are_told_with_two_digits_or_three() {
        let told = [
            (0, "0 B"),
            (999, "999 B"),
            (1000, "1.0 kB"),
            (9_949, "9.9 kB"),
        ];
        let more = [(9_951, "10 kB"), (999_499, "999 kB"), (999_500, "1.0 MB")];
        for (bytes, words) in told.into_iter().chain(more) {
            assert_eq!(amount(bytes), words);
        }
    }
}
