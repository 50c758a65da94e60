//! Sweeps: arrays of what was found, filled while the next rows are computed.

use std::ops::Range;
use std::sync::Arc;

use hyperstat_study::sweep::{Cell, Chunk, Columns, Record, Sweep, Way};
use hyperstat_study::{Job, Measure, Value};
use numpy::{PyArray1, PyArrayDyn, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;
use pyo3::types::PyList;

use crate::arrays::{array, known};
use crate::error::{Ended, apart};
use crate::kept::unforked;
use crate::pool;
use crate::watched::Watch;

/// How a sweep is run.
pub(crate) struct Asking {
    /// From one row to before another, of those of a sweep of one design.
    pub(crate) rows: Option<(usize, usize)>,
    pub(crate) threads: usize,
    pub(crate) one_by_one: bool,
}

/// A further column.
enum Further {
    Numbers(Vec<f64>),
    Words(Vec<Option<Arc<str>>>),
}

/// What was found, by rows.
#[derive(Default)]
pub(crate) struct Rows {
    count: usize,
    pose: Vec<f64>,
    displacement: Vec<f64>,
    stiffness: Vec<f64>,
    codes: Vec<u8>,
    /// The word of every code, and why its first row has no result.
    words: Vec<(&'static str, Option<String>)>,
    further: Vec<Further>,
    names: Vec<String>,
    cases: Vec<String>,
    drives: (Vec<String>, Vec<f64>),
    designs: usize,
    varied: Varied,
}

/// Of designs that a job varies: the number of the first, and path by path the values of each.
#[derive(Default)]
pub(crate) struct Varied {
    first: usize,
    paths: Vec<(String, Vec<Value>)>,
}

impl Varied {
    /// Of these designs of a job.
    pub(crate) fn of(job: &Job, designs: Range<usize>) -> Self {
        let first = designs.start;
        let mut paths: Vec<(String, Vec<Value>)> = (job.varied().iter())
            .map(|varied| (varied.path.clone(), Vec::new()))
            .collect();
        for design in designs {
            for ((_, own), value) in paths.iter_mut().zip(job.values(design)) {
                own.push(value);
            }
        }
        Self { first, paths }
    }
}

impl Asking {
    /// Solves these rows of a job.
    pub(crate) fn run(
        &self,
        job: &Job,
        rows: Range<usize>,
        varied: Varied,
        watch: &Watch,
    ) -> Result<Rows, Ended> {
        let way = match self.one_by_one {
            true => Way::OneByOne,
            false => Way::Lanes,
        };
        let sweep = unforked(|| Sweep::new(job, way))?;
        let rows = match self.rows {
            Some((from, to)) => rows.end.min(rows.start + from)..rows.end.min(rows.start + to),
            None => rows,
        };
        let threads = pool::threads(self.threads)?;
        let mut found = Rows {
            varied,
            ..Rows::new(job, &rows)
        };
        if self.rows.is_some() {
            found.designs = 1;
        }
        let total = rows.len();
        let mut done = 0;
        watch.at(done, total)?;
        sweep.run(
            &threads,
            rows,
            |_| (),
            |chunk: &mut Chunk| {
                found.add(chunk);
                done += chunk.records.len();
                watch.at(done, total)
            },
        )?;
        Ok(found)
    }
}

impl Rows {
    fn new(job: &Job, rows: &Range<usize>) -> Self {
        let names = Columns::of(job).further;
        let empty = || Further::Numbers(Vec::new());
        let count = rows.len();
        Self {
            count,
            pose: Vec::with_capacity(6 * count),
            displacement: Vec::with_capacity(6 * count),
            stiffness: Vec::with_capacity(36 * count),
            codes: Vec::with_capacity(count),
            words: vec![("ok", None)],
            further: names.iter().map(|_| empty()).collect(),
            names,
            cases: job.cases().to_vec(),
            drives: (job.drives().to_vec(), Vec::new()),
            designs: rows.len() / job.len().max(1),
            varied: Varied::default(),
        }
    }

    fn add(&mut self, chunk: &Chunk) {
        for record in &chunk.records {
            self.add_record(record);
        }
        self.drives.1.extend_from_slice(&chunk.drives);
    }

    fn add_record(&mut self, record: &Record) {
        let row = self.codes.len();
        self.pose.extend(record.pose.map(known));
        let code = self.code(record);
        self.codes.push(code);
        let cells = match record.known() {
            Some((displacement, further)) => {
                self.displacement.extend_from_slice(displacement.as_slice());
                further
            }
            None => {
                self.displacement.extend([f64::NAN; 6]);
                &[]
            }
        };
        match &record.result {
            // Stored by columns.
            Ok(found) => (self.stiffness).extend_from_slice(found.stiffness.transpose().as_slice()),
            Err(_) => self.stiffness.extend([f64::NAN; 36]),
        }
        for (k, column) in self.further.iter_mut().enumerate() {
            column.add(row, cells.get(k).unwrap_or(&Cell::Empty));
        }
    }

    /// The number of a status.
    fn code(&mut self, record: &Record) -> u8 {
        let status = record.status();
        let known = self.words.iter().position(|(word, _)| *word == status);
        let place = known.unwrap_or_else(|| {
            let why = record.result.as_ref().err();
            self.words.push((status, why.map(|why| why.in_words())));
            self.words.len() - 1
        });
        // There are some ten words.
        u8::try_from(place).unwrap_or(u8::MAX)
    }

    /// As arrays.
    pub(crate) fn handed_over(self, py: Python<'_>) -> PyResult<Found> {
        let n = self.count;
        let mut further = Vec::with_capacity(self.names.len());
        for (name, column) in self.names.into_iter().zip(self.further) {
            let column = match column {
                Further::Numbers(numbers) => PyArray1::from_vec(py, numbers).into_any(),
                Further::Words(words) => {
                    let words = words.iter().map(Option::as_deref);
                    PyList::new(py, words.collect::<Vec<_>>())?.into_any()
                }
            };
            further.push((name, column.unbind()));
        }
        let mut varied = Vec::with_capacity(self.varied.paths.len());
        for (path, values) in self.varied.paths {
            let each = values.into_iter().map(|value| match value {
                Value::Number(number) => Ok(number.into_pyobject(py)?.into_any()),
                Value::Text(text) => Ok(text.into_pyobject(py)?.into_any()),
            });
            let each = each.collect::<PyResult<Vec<_>>>()?;
            varied.push((path, PyList::new(py, each)?.unbind()));
        }
        let (drives, values) = self.drives;
        let values = array(py, values, &[n, drives.len()])?;
        Ok(Found {
            pose: array(py, self.pose, &[n, 6])?.unbind(),
            displacement: array(py, self.displacement, &[n, 6])?.unbind(),
            stiffness: array(py, self.stiffness, &[n, 6, 6])?.unbind(),
            codes: PyArray1::from_vec(py, self.codes).unbind(),
            words: (self.words.into_iter())
                .map(|(word, why)| (word.to_owned(), why))
                .collect(),
            cases: self.cases,
            further,
            drives: (drives, values.unbind()),
            designs: self.designs,
            varied: (self.varied.first, varied),
        })
    }
}

impl Further {
    fn add(&mut self, row: usize, cell: &Cell) {
        if let (Self::Numbers(_), Some(_)) = (&*self, cell.text()) {
            *self = Self::Words(vec![None; row]);
        }
        match self {
            Self::Numbers(numbers) => numbers.push(known(cell.number())),
            Self::Words(words) => words.push(match cell {
                Cell::Text(text) => Some(Arc::clone(text)),
                _ => None,
            }),
        }
    }
}

/// What a sweep found, as arrays.
#[pyclass(frozen, get_all, module = "hyperstat._hyperstat")]
pub(crate) struct Found {
    pose: Py<PyArrayDyn<f64>>,
    displacement: Py<PyArrayDyn<f64>>,
    stiffness: Py<PyArrayDyn<f64>>,
    codes: Py<PyArray1<u8>>,
    words: Vec<(String, Option<String>)>,
    cases: Vec<String>,
    further: Vec<(String, Py<PyAny>)>,
    drives: (Vec<String>, Py<PyArrayDyn<f64>>),
    designs: usize,
    varied: (usize, Vec<(String, Py<PyList>)>),
}

/// The measure of this name.
pub(crate) fn measure_named(name: &str) -> Result<&'static Measure, Ended> {
    Measure::named(name).ok_or_else(|| {
        let known: Vec<&str> = Measure::all().iter().map(|own| own.name).collect();
        let help = format!("the measures are {}", known.join(", "));
        Ended::argument(format!("unknown measure `{name}`"), &help)
    })
}

/// A measure of every row; NaN where it has none.
#[pyfunction]
pub(crate) fn measure<'py>(
    py: Python<'py>,
    name: &str,
    stiffness: PyReadonlyArray3<'py, f64>,
    displacement: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (stiffness, displacement) = (stiffness.as_array(), displacement.as_array());
    let values = apart(py, || {
        let measure = measure_named(name)?;
        let rows = stiffness.outer_iter().zip(displacement.outer_iter());
        let value = rows.map(|(stiffness, displacement)| {
            let mut k = [0.0; 36];
            k.iter_mut()
                .zip(stiffness.iter())
                .for_each(|(own, k)| *own = *k);
            let mut u = [0.0; 6];
            u.iter_mut()
                .zip(displacement.iter())
                .for_each(|(own, u)| *own = *u);
            known(measure.at(&k, &u))
        });
        Ok(value.collect())
    })?;
    Ok(PyArray1::from_vec(py, values))
}
