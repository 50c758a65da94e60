//! One pose, as a row of a sweep.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use hyperstat_study::sweep::{Cell, Columns, Failure, Poser, Record};
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
            Err(StudyError::Pose { source, .. }) => {
                let result = Err(Failure::Pose(*source));
                let pose = target;
                Ok(Err(Pose::new(Record { pose, result }, names)))
            }
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
        Ok(Pose::new(self.poser.at(&target), Arc::clone(&self.names)))
    }
}

/// What was found at one pose, as plain data.
#[pyclass(frozen, module = "hyperstat._hyperstat")]
pub(crate) struct Pose {
    status: Cow<'static, str>,
    why: Option<String>,
    pose: [f64; 6],
    /// NaN where it is not known.
    displacement: [f64; 6],
    /// By rows; `None` without a result.
    stiffness: Option<Box<[f64; 36]>>,
    /// Empty where they are not known.
    further: Vec<Cell>,
    names: Arc<Names>,
}

impl Pose {
    fn new(record: Record, names: Arc<Names>) -> Self {
        let mut own = Self {
            status: record.status().into(),
            why: record.result.as_ref().err().map(Failure::in_words),
            pose: record.pose.map(known),
            displacement: [f64::NAN; 6],
            stiffness: None,
            further: Vec::new(),
            names,
        };
        if let Some((displacement, _)) = record.known() {
            own.displacement.copy_from_slice(displacement.as_slice());
        }
        match record.result {
            Ok(found) => {
                let mut by_rows = Box::new([0.0; 36]);
                // Stored by columns.
                by_rows.copy_from_slice(found.stiffness.transpose().as_slice());
                own.stiffness = Some(by_rows);
                own.further = found.further;
            }
            Err(Failure::Rigid(held)) => own.further = held.further,
            Err(_) => {}
        }
        own
    }

    fn number(&self, place: usize) -> f64 {
        known(self.further.get(place).and_then(Cell::number))
    }
}

/// What stands in a further column, as Python has it: a number, a text or nothing.
#[derive(FromPyObject, IntoPyObject)]
pub(crate) enum CellGiven {
    Number(f64),
    Text(String),
}

type Array<'py> = Bound<'py, PyArrayDyn<f64>>;
/// What a pose is made of again: words, pose, displacement, stiffness, further, names.
type Made = (
    (String, Option<String>),
    [f64; 6],
    [f64; 6],
    Option<Vec<f64>>,
    Vec<Option<CellGiven>>,
    (Vec<String>, Vec<String>),
);

/// One that was pickled.
#[pyfunction]
pub(crate) fn pose_again(py: Python<'_>, made: Made) -> PyResult<Pose> {
    let ((status, why), pose, displacement, stiffness, further, (cases, names)) = made;
    let stiffness = stiffness.map(<[f64; 36]>::try_from).transpose();
    let stiffness = stiffness.map_err(|_| {
        Ended::argument(
            "a stiffness of other than 36 numbers",
            "give those of a pickle",
        )
        .raised(py)
    })?;
    let cell = |given: Option<CellGiven>| match given {
        None => Cell::Empty,
        Some(CellGiven::Number(number)) => Cell::Number(number),
        Some(CellGiven::Text(text)) => Cell::Text(text.into()),
    };
    Ok(Pose {
        status: status.into(),
        why,
        pose,
        displacement,
        stiffness: stiffness.map(Box::new),
        further: further.into_iter().map(cell).collect(),
        names: Arc::new(Names {
            cases,
            further: names,
        }),
    })
}

#[pymethods]
impl Pose {
    /// `ok`, or a word that says why there is no result.
    #[getter]
    fn status(&self) -> &str {
        &self.status
    }

    /// Why there is no result, in words; `None` where there is one.
    #[getter]
    fn why(&self) -> Option<&str> {
        self.why.as_deref()
    }

    /// Pose of the output: x, y, z [m], rotation vector rx, ry, rz [rad]; shape (6,), NaN where unknown.
    #[getter]
    fn pose<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        array(py, self.pose.to_vec(), &[6])
    }

    /// Displacement of the output under the loads [m, rad], global; shape (6,), NaN without a result.
    #[getter]
    fn displacement<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        array(py, self.displacement.to_vec(), &[6])
    }

    /// Stiffness of the output [N/m, N/rad; N, N·m/rad], global; shape (6, 6), NaN without a result.
    #[getter]
    fn stiffness<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let numbers = match &self.stiffness {
            Some(numbers) => numbers.to_vec(),
            None => vec![f64::NAN; 36],
        };
        array(py, numbers, &[6, 6])
    }

    /// Displacement of the output in every case [m, rad], by its name; shape (6,) each.
    #[getter]
    fn cases<'py>(&self, py: Python<'py>) -> PyResult<BTreeMap<String, Array<'py>>> {
        let case = |(k, name): (usize, &String)| {
            let numbers = (6 * k..6 * k + 6).map(|place| self.number(place));
            Ok((name.clone(), array(py, numbers.collect(), &[6])?))
        };
        self.names.cases.iter().enumerate().map(case).collect()
    }

    /// What stands in a further column of a table; NaN for a number that there is not.
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let place = self.names.further.iter().position(|own| own == name);
        let place = place.ok_or_else(|| pyo3::exceptions::PyKeyError::new_err(name.to_owned()))?;
        match self.further.get(place).and_then(Cell::text) {
            Some(text) => Ok(text.into_pyobject(py)?.into_any()),
            None => Ok(self.number(place).into_pyobject(py)?.into_any()),
        }
    }

    /// Names of further columns.
    fn keys(&self) -> Vec<String> {
        self.names.further.clone()
    }

    /// A measure, such as `deflection` or `softest_force`, SI; NaN where there is none.
    fn measure(&self, py: Python<'_>, name: &str) -> PyResult<f64> {
        let measure = measure_named(name).map_err(|unknown| unknown.raised(py))?;
        let stiffness = self.stiffness.as_ref();
        Ok(known(
            stiffness.and_then(|own| measure.at(own, &self.displacement)),
        ))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (Made,))> {
        let again = py.import("hyperstat._hyperstat")?.getattr("pose_again")?;
        let cell = |own: &Cell| match own.text() {
            Some(text) => Some(CellGiven::Text(text.into())),
            None => own.number().map(CellGiven::Number),
        };
        let made = (
            (self.status.to_string(), self.why.clone()),
            self.pose,
            self.displacement,
            self.stiffness.as_ref().map(|own| own.to_vec()),
            self.further.iter().map(cell).collect(),
            (self.names.cases.clone(), self.names.further.clone()),
        );
        Ok((again, (made,)))
    }

    fn __repr__(&self) -> String {
        let at = self.pose.map(|own| match own.is_nan() {
            true => "nan".into(),
            false => format!("{own:.6}"),
        });
        format!("<hyperstat.Pose at ({}): {}>", at.join(", "), self.status)
    }
}
