//! One pose, as a row of a sweep.

use std::collections::BTreeMap;
use std::sync::Arc;

use hyperstat_study::sweep::{Columns, Failure, Poser, Record};
use hyperstat_study::{Job, JobPoses, Study, StudyError, Target};
use numpy::{PyArrayDyn, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::arrays::{array, known};
use crate::error::Ended;
use crate::sweep::measure_named;

const COORDINATES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// A pose as Python gives it.
#[derive(FromPyObject)]
pub(crate) enum PoseGiven<'py> {
    Array(PyReadonlyArray1<'py, f64>),
    Numbers(Vec<f64>),
    Named(BTreeMap<String, f64>),
}

/// The same without the interpreter.
pub(crate) enum PoseAsked {
    Numbers(Vec<f64>),
    Named(BTreeMap<String, f64>),
}

impl PoseGiven<'_> {
    pub(crate) fn owned(self) -> PoseAsked {
        match self {
            Self::Array(numbers) => PoseAsked::Numbers(numbers.as_array().to_vec()),
            Self::Numbers(numbers) => PoseAsked::Numbers(numbers),
            Self::Named(named) => PoseAsked::Named(named),
        }
    }
}

impl PoseAsked {
    /// Refuses a pose of another length.
    pub(crate) fn check(&self) -> Result<(), Ended> {
        match self {
            Self::Numbers(numbers) if ![3, 6].contains(&numbers.len()) => Err(Ended::argument(
                format!("a pose of {} numbers", numbers.len()),
                "give x, y, z [m], or x, y, z, rx, ry, rz [m, rad]",
            )),
            _ => Ok(()),
        }
    }

    /// As the one pose of a job.
    pub(crate) fn poses(&self) -> JobPoses {
        match self {
            Self::Numbers(rows) => JobPoses::Table {
                columns: (0..rows.len())
                    .map(|k| COORDINATES.get(k).map_or(k.to_string(), |n| (*n).into()))
                    .collect(),
                rows: rows.clone(),
            },
            Self::Named(named) => JobPoses::Table {
                columns: named.keys().cloned().collect(),
                rows: named.values().copied().collect(),
            },
        }
    }
}

/// What poses are asked of, one after another.
pub(crate) struct Ready {
    poser: Poser,
    names: Arc<Names>,
    /// What a coordinate is that is not given.
    open: Option<f64>,
}

/// Names of what a pose has beside displacement and stiffness.
pub(crate) struct Names {
    cases: Vec<String>,
    further: Vec<String>,
}

impl Ready {
    /// Of a job, first in this pose; else the pose, where that is out of reach.
    pub(crate) fn new(
        mut job: Job,
        first: &PoseAsked,
        of_file: bool,
    ) -> Result<Result<Self, Pose>, Ended> {
        if !of_file {
            job.set_poses(first.poses())?;
        }
        let names = Arc::new(Names {
            cases: job.cases().to_vec(),
            further: Columns::of(&job).further,
        });
        let open = job.mechanism().is_none().then_some(0.0);
        let target = job.target(0);
        match Study::of_job(job, 0, 0) {
            Ok(study) => Ok(Ok(Self {
                poser: study.poser()?,
                names,
                open,
            })),
            Err(StudyError::Pose { source, .. }) => Ok(Err(Pose {
                record: Record {
                    pose: target,
                    result: Err(Failure::Pose(*source)),
                },
                names,
            })),
            Err(error) => Err(error.into()),
        }
    }

    pub(crate) fn at(&mut self, pose: &PoseAsked) -> Result<Pose, Ended> {
        let mut asked = [self.open; 6];
        let mut drives = Vec::new();
        match pose {
            PoseAsked::Numbers(numbers) => {
                for (own, number) in asked.iter_mut().zip(numbers) {
                    *own = Some(*number);
                }
            }
            PoseAsked::Named(named) => {
                for (name, value) in named {
                    match COORDINATES.iter().position(|own| own == name) {
                        Some(place) => asked[place] = Some(*value),
                        None => drives.push(self.poser.drive(name, *value).ok_or_else(|| {
                            Ended::argument(
                                format!("`{name}` is no coordinate and no direction of a joint"),
                                "give x, y, z, rx, ry, rz or `joint.direction`",
                            )
                        })?),
                    }
                }
                if !drives.is_empty() && drives.len() < named.len() {
                    return Err(Ended::argument(
                        "a pose of coordinates and of drives",
                        "give the one or the others",
                    ));
                }
            }
        }
        let target = match drives.is_empty() {
            true => Target::Output(asked),
            false => Target::Drives(&drives),
        };
        Ok(Pose {
            record: self.poser.at(&target),
            names: Arc::clone(&self.names),
        })
    }
}

/// What was found at one pose.
#[pyclass(frozen, module = "hyperstat._hyperstat")]
pub(crate) struct Pose {
    record: Record,
    names: Arc<Names>,
}

type Array<'py> = Bound<'py, PyArrayDyn<f64>>;

#[pymethods]
impl Pose {
    /// `ok`, or a word that says why there is no result.
    #[getter]
    fn status(&self) -> &'static str {
        self.record.status()
    }

    /// Why there is no result, in words; `None` where there is one.
    #[getter]
    fn why(&self) -> Option<String> {
        self.record.result.as_ref().err().map(Failure::in_words)
    }

    /// Pose of the output: x, y, z [m], rotation vector rx, ry, rz [rad]; shape (6,), NaN where unknown.
    #[getter]
    fn pose<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        array(py, self.record.pose.map(known).to_vec(), &[6])
    }

    /// Displacement of the output under the loads [m, rad], global; shape (6,), NaN without a result.
    #[getter]
    fn displacement<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let numbers = match self.record.known() {
            Some((found, _)) => found.as_slice().to_vec(),
            None => vec![f64::NAN; 6],
        };
        array(py, numbers, &[6])
    }

    /// Stiffness of the output [N/m, N/rad; N, N·m/rad], global; shape (6, 6), NaN without a result.
    #[getter]
    fn stiffness<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let numbers = match &self.record.result {
            Ok(found) => (0..36).map(|k| found.stiffness[(k / 6, k % 6)]).collect(),
            Err(_) => vec![f64::NAN; 36],
        };
        array(py, numbers, &[6, 6])
    }

    /// Displacement of the output in every case [m, rad], by its name; shape (6,) each.
    #[getter]
    fn cases<'py>(&self, py: Python<'py>) -> PyResult<BTreeMap<String, Array<'py>>> {
        let further = self.record.known().map(|(_, further)| further);
        let case = |(k, name): (usize, &String)| {
            let number = |c: usize| known(further.and_then(|all| all.get(6 * k + c)?.number()));
            Ok((name.clone(), array(py, (0..6).map(number).collect(), &[6])?))
        };
        self.names.cases.iter().enumerate().map(case).collect()
    }

    /// What stands in a further column of a table; NaN for a number that there is not.
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let place = self.names.further.iter().position(|own| own == name);
        let place = place.ok_or_else(|| pyo3::exceptions::PyKeyError::new_err(name.to_owned()))?;
        let further = self.record.known().map(|(_, further)| further);
        let cell = further.and_then(|all| all.get(place));
        match cell.and_then(|cell| cell.text()) {
            Some(text) => Ok(text.into_pyobject(py)?.into_any()),
            None => {
                let number = known(cell.and_then(|cell| cell.number()));
                Ok(number.into_pyobject(py)?.into_any())
            }
        }
    }

    /// Names of further columns.
    fn keys(&self) -> Vec<String> {
        self.names.further.clone()
    }

    /// A measure, such as `deflection` or `softest_force`, SI; NaN where there is none.
    fn measure(&self, py: Python<'_>, name: &str) -> PyResult<f64> {
        let _ = measure_named(name).map_err(|unknown| unknown.raised(py))?;
        let found = self.record.result.as_ref().ok();
        Ok(known(found.and_then(|found| found.measure(name))))
    }

    fn __repr__(&self) -> String {
        let at: Vec<String> = (self.record.pose.iter())
            .map(|own| own.map_or("nan".into(), |own| format!("{own:.6}")))
            .collect();
        format!("<hyperstat.Pose at ({}): {}>", at.join(", "), self.status())
    }
}
