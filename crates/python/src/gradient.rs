//! Quantities with their derivatives, pose after pose.

use hyperstat_study::{Job, Measure, Quantity, Study, StudyError};
use pyo3::prelude::*;

use crate::error::Ended;
use crate::pool;

/// Poses between two looks at the interpreter.
const POSES: usize = 64;

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
    let (mut values, mut slopes) = (Vec::new(), Vec::new());
    let one = |pose: usize| match Study::of_job(job.clone(), 0, pose) {
        Ok(mut study) => match study.value_and_gradient(quantity, paths, case) {
            Ok(found) => Ok(found),
            // A pose without a result raises nothing; what is asked wrongly does.
            Err(StudyError::Unsolvable { .. } | StudyError::FreeOutput { .. }) => Ok(none(paths)),
            Err(error) => Err(error),
        },
        Err(StudyError::Pose { .. }) => Ok(none(paths)),
        Err(error) => Err(error),
    };
    for first in (0..job.len()).step_by(POSES) {
        Python::attach(|py| py.check_signals())?;
        let poses = first..job.len().min(first + POSES);
        for found in threads.each(poses, one) {
            let (value, gradient) = found?;
            values.push(value);
            slopes.extend(gradient);
        }
    }
    Ok((values, slopes))
}

fn none(paths: &[String]) -> (f64, Vec<f64>) {
    (f64::NAN, vec![f64::NAN; paths.len()])
}
