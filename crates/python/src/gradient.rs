//! Quantities with their derivatives, some poses after the others.

use std::time::{Duration, Instant};

use hyperstat_study::{Gradient, Job, Measure, Quantity};

use crate::error::Ended;
use crate::kept::unforked;
use crate::pool;
use crate::watched::Watch;

/// Poses between two looks at whoever waits, at first; then as many as take no longer than this.
const POSES: usize = 512;
const LEAST: usize = 16;
const LONG: Duration = Duration::from_millis(200);

/// Values, and derivatives by rows, in all poses of a job.
pub(crate) fn of(
    job: &Job,
    quantity: &str,
    paths: &[String],
    case: Option<&str>,
    threads: usize,
    watch: &Watch,
) -> Result<(Vec<f64>, Vec<f64>), Ended> {
    let quantity = Quantity::named(quantity).ok_or_else(|| {
        let known: Vec<&str> = Measure::all().iter().map(|own| own.name).collect();
        let help = format!(
            "give `k11` to `k66`, `dx` to `drz`, or {}",
            known.join(", ")
        );
        Ended::argument(format!("unknown measure `{quantity}`"), &help)
    })?;
    let threads = pool::threads(threads)?;
    let gradient = unforked(|| Gradient::new(job, quantity, paths, case))?;
    let (mut values, mut slopes) = (Vec::new(), Vec::new());
    let (mut first, mut count) = (0, POSES);
    while first < job.len() {
        watch.at(first, job.len())?;
        let begun = Instant::now();
        let poses = first..job.len().min(first + count);
        first = poses.end;
        let (own, by_paths) = gradient.of(poses, &threads)?;
        values.extend(own);
        slopes.extend(by_paths);
        if begun.elapsed() > LONG {
            count = (count / 4).max(LEAST);
        } else if begun.elapsed() < LONG / 4 {
            count *= 2;
        }
    }
    Ok((values, slopes))
}
