//! A quantity in all poses of a job with its derivatives by values of the mechanism: those that
//! `solve --why` lists, exactly, and by any other number that `vary` takes, a length, a point's coordinate, an axis, as
//! differences of designs that go through the lanes.
//!
//! Such a difference is that of four designs around the one that is asked about,
//! `(f(p − 2h) − 8 f(p − h) + 8 f(p + h) − f(p + 2h)) / 12 h`, in the same pose of the output: the inverse
//! kinematics, and with it the drives, follow the value.

use std::ops::Range;

use hyperstat_assembly::Floor;
use hyperstat_mechanisms::{Job, Value};

use crate::error::StudyError;
use crate::gradient::{Quantity, is_named, no_derivative};
use crate::measures::Pose;
use crate::study::Study;
use crate::sweep::{Record, Sweep, Threads, Way};

/// Steps from the value, over h, with the weights of the quantity there.
const STEPS: [(f64, f64); 4] = [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)];
/// The step h over the value: what it leaves out goes with its fourth power, rounding with its inverse.
const STEP: f64 = 5e-4;
/// A value counts as at least this share of the mechanism's size, so that one that is zero has a step.
const LEAST: f64 = 0.02;
/// Poses that a thread takes at a time.
const CHUNK: usize = 256;
/// Poses that are looked at for one that has a solution.
const TRIED: usize = 64;

/// A quantity in the poses of a job with its derivatives by values of the mechanism.
#[derive(Debug)]
pub struct Gradient {
    job: Job,
    quantity: Quantity,
    /// The case by its number.
    case: Option<usize>,
    /// Paths by which the derivatives are exact, with their places among those asked for.
    exact: (Vec<usize>, Vec<String>),
    /// By which they are differences.
    differences: Vec<Difference>,
    paths: usize,
}

/// Designs around one that is asked about.
#[derive(Debug)]
struct Difference {
    place: usize,
    step: f64,
    /// By [`STEPS`].
    designs: [Job; 4],
}

impl Gradient {
    /// Of a quantity by the values at these paths, as `vary` names them, in the first design of a job, under
    /// the loads or those of a case.
    ///
    /// # Errors
    /// There is no such case; a path that leads to no number.
    pub fn new(
        job: &Job,
        quantity: Quantity,
        paths: &[String],
        case: Option<&str>,
    ) -> Result<Self, StudyError> {
        let mut known = Vec::new();
        let mut size = 1.0;
        for pose in 0..job.len().min(TRIED) {
            let Ok(mut study) = Study::of_job(job.clone(), 0, pose) else {
                continue;
            };
            match study.sensitivities(case) {
                Ok(found) => {
                    size = Floor::of(study.model()).map_or(1.0, |floor| floor.size);
                    known = found;
                    break;
                }
                Err(StudyError::Unsolvable { .. } | StudyError::FreeOutput { .. }) => {}
                Err(error) => return Err(error),
            }
        }
        let case = case.and_then(|name| job.cases().iter().position(|own| own == name));
        let mut gradient = Self {
            job: job.clone(),
            quantity,
            case,
            exact: (Vec::new(), Vec::new()),
            differences: Vec::new(),
            paths: paths.len(),
        };
        for (place, path) in paths.iter().enumerate() {
            if known
                .iter()
                .any(|own| is_named(own, path) && !own.by_differences)
            {
                gradient.exact.0.push(place);
                gradient.exact.1.push(path.clone());
                continue;
            }
            let number = job.number_at(0, path);
            let number = number.map_err(|_| no_derivative(&known, path))?;
            let step = STEP * number.abs().max(LEAST * size);
            let design = |(k, _): (f64, f64)| {
                let value = Value::Number(number + k * step);
                job.with_values(0, &[(path.as_str(), value)])
            };
            let [a, b, c, d] = STEPS.map(design);
            gradient.differences.push(Difference {
                place,
                step,
                designs: [a?, b?, c?, d?],
            });
        }
        Ok(gradient)
    }

    /// The quantity in some of the poses, and its derivatives pose by pose, as many as there are paths \[SI\];
    /// NaN of a pose without a result, and of a quantity that it does not have. Near the border of the
    /// workspace a design beside may be out of reach: its derivative is NaN then.
    ///
    /// # Errors
    /// As [`Sweep::new`].
    pub fn of(
        &self,
        poses: Range<usize>,
        threads: &Threads,
    ) -> Result<(Vec<f64>, Vec<f64>), StudyError> {
        let values = self.values(&self.job, &poses, threads)?;
        let mut slopes = vec![f64::NAN; values.len() * self.paths];
        if !self.exact.0.is_empty() {
            let own = threads.each(poses.clone(), |pose| self.exact_at(pose));
            for (row, own) in slopes.chunks_exact_mut(self.paths).zip(own) {
                for (place, slope) in self.exact.0.iter().zip(own?) {
                    row[*place] = slope;
                }
            }
        }
        for own in &self.differences {
            let mut sums = vec![0.0; values.len()];
            for (design, (_, weight)) in own.designs.iter().zip(STEPS) {
                let beside = self.values(design, &poses, threads)?;
                for (sum, value) in sums.iter_mut().zip(beside) {
                    *sum += weight * value;
                }
            }
            // A pose without a result has no derivative either.
            let known = sums
                .iter()
                .zip(&values)
                .map(|(sum, value)| sum + 0.0 * value);
            for (row, sum) in slopes.chunks_exact_mut(self.paths).zip(known) {
                row[own.place] = sum / (12.0 * own.step);
            }
        }
        Ok((values, slopes))
    }

    /// The quantity in some poses of a job's first design.
    fn values(
        &self,
        job: &Job,
        poses: &Range<usize>,
        threads: &Threads,
    ) -> Result<Vec<f64>, StudyError> {
        let sweep = match Sweep::new(job, Way::Lanes) {
            Ok(sweep) => sweep,
            Err(StudyError::Unsolvable { .. } | StudyError::FreeOutput { .. }) => {
                return Ok(vec![f64::NAN; poses.len()]);
            }
            Err(error) => return Err(error),
        };
        let chunks = threads.each(0..poses.len().div_ceil(CHUNK), |chunk| {
            let first = poses.start + CHUNK * chunk;
            let records = sweep.records(first..poses.end.min(first + CHUNK));
            records
                .iter()
                .map(|own| self.value(own))
                .collect::<Vec<_>>()
        });
        Ok(chunks.concat())
    }

    fn value(&self, record: &Record) -> f64 {
        let Ok(found) = &record.result else {
            return f64::NAN;
        };
        let displacement = match self.case {
            None => Some(found.displacement),
            Some(case) => found.of_case(case),
        };
        let pose = Pose::new(&found.stiffness);
        let value = displacement.and_then(|moved| self.quantity.value(&pose, &moved));
        value.unwrap_or(f64::NAN)
    }

    /// The exact derivatives in a pose.
    fn exact_at(&self, pose: usize) -> Result<Vec<f64>, StudyError> {
        let paths = &self.exact.1;
        let case = self.case.map(|case| self.job.cases()[case].as_str());
        let found = Study::of_job(self.job.clone(), 0, pose)
            .and_then(|mut study| study.value_and_gradient(self.quantity, paths, case));
        match found {
            Ok((_, slopes)) => Ok(slopes),
            // A pose without a result raises nothing; what is asked wrongly does.
            Err(
                StudyError::Unsolvable { .. }
                | StudyError::FreeOutput { .. }
                | StudyError::Pose { .. },
            ) => Ok(vec![f64::NAN; paths.len()]),
            Err(error) => Err(error),
        }
    }
}
