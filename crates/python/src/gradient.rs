//! Quantities with their derivatives, some poses after the others.

use hyperstat_study::{Gradient, Job, Measure, Quantity};
use pyo3::prelude::*;

use crate::error::Ended;
use crate::pool;

/// Poses between two looks at the interpreter.
const POSES: usize = 1024;

/// Values, and derivatives by rows, in all poses of a job.
pub(crate) fn of(
    job: &Job,
    quantity: &str,
    paths: &[String],
    case: Option<&str>,
    threads: usize,
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
    let gradient = Gradient::new(job, quantity, paths, case)?;
    let (mut values, mut slopes) = (Vec::new(), Vec::new());
    for first in (0..job.len()).step_by(POSES) {
        Python::attach(|py| py.check_signals())?;
        let poses = first..job.len().min(first + POSES);
        let (own, by_paths) = gradient.of(poses, &threads)?;
        values.extend(own);
        slopes.extend(by_paths);
    }
    Ok((values, slopes))
}
