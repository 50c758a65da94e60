//! Kinds of joints that Python has: what they are is asked of it when a file is read, and never again.

use std::collections::BTreeMap;
use std::str::FromStr;
use std::sync::{Arc, Mutex, PoisonError};

use hyperstat_study::{
    Arguments, Dof, DofSet, Joint, LoadError, Orientation, ParsedJoint, Registry,
};
use nalgebra::Matrix6;
use pyo3::prelude::*;

use crate::error::Ended;

/// A kind of joint that files may name.
#[pyclass(frozen, module = "hyperstat._hyperstat")]
pub(crate) struct JointKind {
    name: Arc<str>,
    free: DofSet,
    frame: Frame,
    /// What a file gives: the frame's axes, where it has some, and numbers in the order that `make` takes them.
    known: &'static [&'static str],
    /// Gives the basis and the compliance, by rows.
    make: Py<PyAny>,
}

/// How a file says how the joint's frame is turned.
#[derive(Clone, Copy)]
enum Frame {
    Global,
    Axis,
    Axes,
}

/// What `make` gives: the basis and the compliance by rows, where there are some.
type Made = (Option<[f64; 36]>, Option<[f64; 36]>);

#[pymethods]
impl JointKind {
    #[new]
    fn new(
        py: Python<'_>,
        name: &str,
        free: Vec<String>,
        frame: &str,
        arguments: Vec<String>,
        make: Py<PyAny>,
    ) -> PyResult<Self> {
        let frame = match frame {
            "axis" => Frame::Axis,
            "axes" => Frame::Axes,
            _ => Frame::Global,
        };
        let free = free.iter().map(|own| Dof::from_str(own));
        let free = free.collect::<Result<DofSet, _>>().map_err(|error| {
            Ended::argument(error.to_string(), "give some of x, y, z, u, v, w").raised(py)
        })?;
        let own = match frame {
            Frame::Global => None,
            Frame::Axis => Some("axis"),
            Frame::Axes => Some("axes"),
        };
        let own = own.map(String::from).into_iter();
        let known = lasting(own.chain(arguments).collect());
        Ok(Self {
            name: name.into(),
            free,
            frame,
            known,
            make,
        })
    }
}

impl JointKind {
    fn read(&self, given: &Arguments<'_>) -> Result<ParsedJoint, LoadError> {
        let orientation = match self.frame {
            Frame::Global => Orientation::Global,
            Frame::Axis => Orientation::Axis(given.direction("axis")?),
            Frame::Axes => {
                let [first, second] = given.two_directions("axes")?;
                Orientation::Axes(first, second)
            }
        };
        let axes = usize::from(!matches!(self.frame, Frame::Global));
        let numbers = self.known[axes..].iter().map(|name| given.number(name));
        let numbers = numbers.collect::<Result<Vec<f64>, _>>()?;
        let made =
            Python::attach(|py| -> PyResult<Made> { self.make.call1(py, (numbers,))?.extract(py) });
        // It is about the whole joint: no argument has this name.
        let (basis, compliance) =
            made.map_err(|error| given.error("", format!("`{}`: {error}", self.name)))?;
        let matrix = |by_rows: [f64; 36]| Matrix6::from_row_slice(&by_rows);
        let joint = OwnJoint {
            kind: Arc::clone(&self.name),
            free: self.free,
            basis: basis.map_or_else(Matrix6::identity, matrix),
            compliance: compliance.map(matrix),
        };
        Ok(ParsedJoint {
            joint: Box::new(joint),
            orientation,
        })
    }
}

/// The built-in kinds, and these.
pub(crate) fn registry(joints: &[Bound<'_, JointKind>]) -> Registry {
    let mut registry = Registry::builtin();
    for kind in joints {
        let kind = kind.clone().unbind();
        let (name, known) = (Arc::clone(&kind.get().name), kind.get().known);
        registry.register(&name, known, move |given| kind.get().read(given));
    }
    registry
}

/// Names that the registry may keep: the same ones once, however often a kind is made.
fn lasting(names: Vec<String>) -> &'static [&'static str] {
    static KNOWN: Mutex<BTreeMap<Vec<String>, &'static [&'static str]>> =
        Mutex::new(BTreeMap::new());
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let last = |own: &String| -> &'static str { own.clone().leak() };
    (known.entry(names))
        .or_insert_with_key(|names| names.iter().map(last).collect::<Vec<_>>().leak())
}

/// A joint of such a kind.
#[derive(Debug, Clone)]
struct OwnJoint {
    kind: Arc<str>,
    free: DofSet,
    basis: Matrix6<f64>,
    compliance: Option<Matrix6<f64>>,
}

impl Joint for OwnJoint {
    fn kind(&self) -> &str {
        &self.kind
    }

    fn free(&self) -> DofSet {
        self.free
    }

    fn basis(&self) -> Matrix6<f64> {
        self.basis
    }

    fn compliance(&self) -> Option<Matrix6<f64>> {
        self.compliance
    }

    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(self.clone())
    }
}
