//! `run --dry-run`: what a run would be.

use std::fmt::Write as _;
use std::time::Duration;

use hyperstat_study::parts::{Part, took};
use hyperstat_study::sweep::{Sweep, Threads};

use crate::args;
use crate::consent::{Size, amount};

/// How long some rows are solved to tell how long all take.
const MEASURED: Duration = Duration::from_secs(2);

/// How long a shard is to take \[s\].
const SHARD: f64 = 600.0;

/// What a run of a part of these jobs would be.
pub(super) fn told(
    sweeps: &[Sweep<'_>],
    part: &Part,
    threads: &Threads,
    args: &args::Run,
) -> String {
    let mut text = String::new();
    let budget = MEASURED / sweeps.len().max(1) as u32;
    let mut all = 0.0;
    for sweep in sweeps {
        let (job, rows) = (sweep.job(), part.rows(sweep.len()));
        let form = (args.format.into(), args.summary);
        let took = took(sweep, threads, rows.clone(), form, budget);
        let seconds = took.row * rows.len() as f64;
        all += seconds;
        let designs = match job.varied().is_empty() {
            true => String::new(),
            false => format!("{} designs of {} poses, ", job.designs(), job.len()),
        };
        let of = match rows.len() == sweep.len() {
            true => String::new(),
            false => format!(" of {}", sweep.len()),
        };
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{}: {designs}{} rows{of}, about {}, {} a row (measured on {})",
            job.name,
            rows.len(),
            time(seconds),
            time(took.row),
            took.rows
        );
    }
    let size = Size::of(sweeps, part, args.format.into());
    let count = (all / SHARD).ceil().max(1.0);
    let _ = writeln!(text, "rows   {}", size.rows);
    let _ = writeln!(
        text,
        "time   about {} on the threads of this run",
        time(all)
    );
    let _ = writeln!(text, "size   up to about {}", amount(size.bytes));
    let _ = match count {
        1.0 => writeln!(text, "shards none needed: it takes less than ten minutes"),
        count => writeln!(
            text,
            "shards {count} of about ten minutes each, `--shard 0/{count}` to `--shard {}/{count}`",
            count - 1.0
        ),
    };
    text
}

/// A time in words, to two digits.
fn time(seconds: f64) -> String {
    let units = [
        (86_400.0, "d"),
        (3600.0, "h"),
        (60.0, "min"),
        (1.0, "s"),
        (1e-3, "ms"),
        (1e-6, "µs"),
    ];
    let (size, unit) = units
        .into_iter()
        .find(|(size, _)| seconds >= *size)
        .unwrap_or((1e-6, "µs"));
    let value = seconds / size;
    let digits = usize::from(value < 9.95);
    format!("{value:.digits$} {unit}")
}

#[cfg(test)]
mod tests {
    use super::time;

    #[test]
    fn times_are_in_units_that_fit() {
        for (seconds, text) in [
            (1.94e-6, "1.9 µs"),
            (0.012, "12 ms"),
            (1.0, "1.0 s"),
            (600.0, "10 min"),
            (7200.0, "2.0 h"),
            (864_000.0, "10 d"),
            (0.0, "0.0 µs"),
        ] {
            assert_eq!(time(seconds), text);
        }
    }
}
