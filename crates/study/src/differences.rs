//! A quantity in all poses of a job with its derivatives by values of the mechanism: those that
//! `solve --why` lists, exactly, and by any other number that `vary` takes, a length, a point's coordinate, an axis, as
//! differences of designs that go through the lanes.
//!
//! The exact ones are found beside the quantity in the lanes, any number of them from a few states
//! ([`hyperstat_assembly::Slopes`]); where a value changes the weight too, or a pose does not go through the
//! lanes, from the whole solution of the pose.
//!
//! Such a difference is that of four designs around the one that is asked about ([`crate::steps`]), in the same
//! pose of the output: the inverse kinematics, and with it the drives, follow the value.

use std::convert::Infallible;
use std::ops::Range;
use std::sync::atomic::AtomicU64;
use std::sync::atomic::Ordering::Relaxed;

use hyperstat_assembly::{Floor, Model, Parameter, Slopes};
use hyperstat_mechanisms::{Job, Value};

use crate::error::StudyError;
use crate::gradient::{Quantity, is_named, no_derivative};
use crate::measures::Pose;
use crate::steps::{STEPS, step_of};
use crate::study::Study;
use crate::sweep::{Record, Sought, Sweep, Threads, Way};

/// Poses that are looked at for one that has a solution.
const TRIED: usize = 64;

/// A quantity in the poses of a job with its derivatives by values of the mechanism.
#[derive(Debug)]
pub struct Gradient {
    job: Job,
    quantity: Quantity,
    /// The case by its number.
    case: Option<usize>,
    /// By which the derivatives are exact.
    exact: Vec<Exact>,
    /// Parameters of the model that lanes find those of.
    parameters: Vec<Parameter>,
    /// By which they are differences.
    differences: Vec<Difference>,
    paths: usize,
    /// Poses so far whose exact derivatives the lanes did not find.
    one_by_one: AtomicU64,
}

/// A value by which the derivative is exact.
#[derive(Debug)]
struct Exact {
    place: usize,
    path: String,
    /// Numbers of the parameters that it is the sum of, with their weights; none where the lanes do not find it.
    parts: Vec<(usize, f64)>,
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
        let mut job = job.clone();
        job.leave_columns();
        let job = &job;
        let mut known = Vec::new();
        let mut model = None;
        let mut size = 1.0;
        let tried = if paths.is_empty() && case.is_none() {
            0
        } else {
            TRIED
        };
        for pose in 0..job.len().min(tried) {
            let Ok(mut study) = Study::of_job(job.clone(), 0, pose) else {
                continue;
            };
            match study.exact_sensitivities(case) {
                Ok(found) => {
                    size = Floor::of(study.model()).map_or(1.0, |floor| floor.size);
                    known = found;
                    model = Some(study.model().clone());
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
            exact: Vec::new(),
            parameters: Vec::new(),
            differences: Vec::new(),
            paths: paths.len(),
            one_by_one: AtomicU64::new(0),
        };
        for (place, path) in paths.iter().enumerate() {
            let own = known.iter().find(|own| is_named(own, path));
            if let Some(own) = own.filter(|own| !own.by_differences) {
                gradient.add_exact(model.as_ref(), place, path, &own.parts);
                continue;
            }
            let number = job.number_at(0, path);
            let number = number.map_err(|_| no_derivative(&known, path))?;
            let step = step_of(number, size);
            let design = |(k, _): (f64, f64)| -> Result<Job, StudyError> {
                let value = Value::Number(number + k * step);
                let mut beside = job.with_values(0, &[(path.as_str(), value)])?;
                beside.leave_columns();
                Ok(beside)
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

    /// Number of paths by which the derivatives are exact and found beside the quantity, where the lanes take
    /// the poses: they cost hardly more than the poses themselves.
    pub fn beside(&self) -> usize {
        self.exact
            .iter()
            .filter(|own| !own.parts.is_empty())
            .count()
    }

    /// Poses so far whose exact derivatives the lanes did not find: each of them was solved by itself.
    pub fn one_by_one(&self) -> u64 {
        self.one_by_one.load(Relaxed)
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
        let (mut values, found) = self.values(&self.job, &poses, threads, self.sought())?;
        if values.iter().any(|value| value.is_nan()) && !self.parameters.is_empty() {
            // Weight that changes may move what the weight itself does not.
            (values, _) = self.values(&self.job, &poses, threads, None)?;
        }
        let mut slopes = vec![f64::NAN; values.len() * self.paths];
        let rows = slopes.chunks_exact_mut(self.paths.max(1));
        for (row, found) in rows.zip(found.chunks_exact(self.parameters.len().max(1))) {
            for own in self.exact.iter().filter(|own| !own.parts.is_empty()) {
                let parts = own.parts.iter();
                row[own.place] = parts.map(|(part, weight)| weight * found[*part]).sum();
            }
        }
        // What the lanes did not find of a pose that has a result.
        let open = |pose: usize| {
            let row = &slopes[(pose - poses.start) * self.paths..];
            let known = !values[pose - poses.start].is_nan();
            let open = |own: &&Exact| known && row[own.place].is_nan();
            let own: Vec<&Exact> = self.exact.iter().filter(open).collect();
            (!own.is_empty()).then_some((pose, own))
        };
        let open: Vec<(usize, Vec<&Exact>)> = poses.clone().filter_map(open).collect();
        self.one_by_one.fetch_add(open.len() as u64, Relaxed);
        let found = threads.each(0..open.len(), |k| self.exact_at(open[k].0, &open[k].1));
        for ((pose, own), found) in open.iter().zip(found) {
            for (own, slope) in own.iter().zip(found?) {
                slopes[(pose - poses.start) * self.paths + own.place] = slope;
            }
        }
        for own in &self.differences {
            let mut sums = vec![0.0; values.len()];
            for (design, (_, weight)) in own.designs.iter().zip(STEPS) {
                let (beside, _) = self.values(design, &poses, threads, None)?;
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

    /// Adds a path by which there is an exact derivative.
    fn add_exact(
        &mut self,
        model: Option<&Model>,
        place: usize,
        path: &str,
        parts: &[(Parameter, f64)],
    ) {
        let mut own = Exact {
            place,
            path: path.into(),
            parts: Vec::new(),
        };
        let wanted: Vec<Parameter> = parts.iter().map(|(own, _)| own.clone()).collect();
        let of_loads = self.quantity.is_of_loads();
        let slopes = model.map(|model| {
            let mut model = model.clone();
            Slopes::add_cases(&mut model, &wanted)?;
            Slopes::new(&model, &wanted, of_loads)
        });
        if let Some(Ok(Some(_))) = slopes {
            for (parameter, weight) in parts {
                let known = self.parameters.iter().position(|own| own == parameter);
                let number = known.unwrap_or_else(|| {
                    self.parameters.push(parameter.clone());
                    self.parameters.len() - 1
                });
                own.parts.push((number, *weight));
            }
        }
        self.exact.push(own);
    }

    fn sought(&self) -> Option<Sought> {
        (!self.parameters.is_empty()).then(|| Sought {
            quantity: self.quantity,
            case: self.case,
            parameters: self.parameters.clone(),
        })
    }

    /// The quantity in some poses of a job's first design, and the derivatives that are sought, NaN where they
    /// are not found.
    fn values(
        &self,
        job: &Job,
        poses: &Range<usize>,
        threads: &Threads,
        sought: Option<Sought>,
    ) -> Result<(Vec<f64>, Vec<f64>), StudyError> {
        let count = sought.as_ref().map_or(0, |sought| sought.parameters.len());
        let (mut values, mut slopes) = (Vec::new(), Vec::new());
        match Sweep::seeking(job, Way::Lanes, sought) {
            Ok(sweep) => {
                let ran = sweep.run(
                    threads,
                    poses.clone(),
                    |_| (),
                    |chunk| {
                        for record in &chunk.records {
                            values.push(self.value(record));
                            let further = record.known().map_or(&[][..], |(_, further)| further);
                            let own = &further[further.len().saturating_sub(count)..];
                            slopes.extend(own.iter().map(|own| own.number().unwrap_or(f64::NAN)));
                            slopes.resize(values.len() * count, f64::NAN);
                        }
                        Ok::<(), Infallible>(())
                    },
                );
                let Ok(()) = ran;
            }
            Err(StudyError::Unsolvable { .. } | StudyError::FreeOutput { .. }) => {
                values.resize(poses.len(), f64::NAN);
                slopes.resize(poses.len() * count, f64::NAN);
            }
            Err(error) => return Err(error),
        }
        Ok((values, slopes))
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
    fn exact_at(&self, pose: usize, by: &[&Exact]) -> Result<Vec<f64>, StudyError> {
        let paths: Vec<String> = by.iter().map(|own| own.path.clone()).collect();
        let case = self.case.map(|case| self.job.cases()[case].as_str());
        let found = Study::of_job(self.job.clone(), 0, pose)
            .and_then(|mut study| study.value_and_gradient(self.quantity, &paths, case));
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
