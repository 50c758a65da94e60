//! Errors on their way to Python: each becomes a subclass of `hyperstat.Error`; no panic comes through.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use hyperstat_study::disk::OutputError;
use hyperstat_study::{LoadError, Location, StudyError};
use pyo3::prelude::*;

/// What ends a computation.
pub(crate) enum Ended {
    /// An answer that there is not.
    Study(Box<StudyError>),
    /// An argument that is none.
    Argument(String, Option<String>),
    /// Parts of a run that are not as they should be.
    Parts(String, Option<String>),
    /// A result that is not written.
    Output(Box<OutputError>),
    /// An exception of Python.
    Python(PyErr),
    /// What called it has ended.
    Stopped,
}

impl From<StudyError> for Ended {
    fn from(error: StudyError) -> Self {
        Self::Study(Box::new(error))
    }
}

impl From<LoadError> for Ended {
    fn from(error: LoadError) -> Self {
        Self::Study(Box::new(error.into()))
    }
}

impl From<OutputError> for Ended {
    fn from(error: OutputError) -> Self {
        Self::Output(Box::new(error))
    }
}

impl From<PyErr> for Ended {
    fn from(error: PyErr) -> Self {
        Self::Python(error)
    }
}

impl Ended {
    /// An argument that is wrong, and what would be right.
    pub(crate) fn argument(message: impl Into<String>, help: &str) -> Self {
        Self::Argument(message.into(), Some(help.into()))
    }

    /// A mechanism that is asked about in a pose, and is in none.
    pub(crate) fn unposed() -> Self {
        Self::argument(
            "the mechanism is in no pose yet",
            "bring it to one with `in_pose((x, y, z))`, or give `sweep` and `at` theirs",
        )
    }

    /// The exception.
    pub(crate) fn raised(self, py: Python<'_>) -> PyErr {
        match self {
            Self::Study(error) => raised(py, &error),
            Self::Argument(message, help) => made(py, "argument", &message, help, None),
            Self::Parts(message, help) => made(py, "parts", &message, help, None),
            Self::Output(error) => {
                let place = error.location().map(place);
                made(py, "output", &error.to_string(), error.help(), place)
            }
            Self::Python(error) => error,
            Self::Stopped => pyo3::exceptions::PyKeyboardInterrupt::new_err(()),
        }
    }
}

/// Where an error is: path, line and column, from 1, the number of characters, and the line.
type Place<'e> = (String, usize, usize, usize, &'e str);

fn raised(py: Python<'_>, error: &StudyError) -> PyErr {
    let place = error.location().map(place);
    made(py, error.code(), &error.to_string(), error.help(), place)
}

fn place(at: &Location) -> Place<'_> {
    let path = at.path.display().to_string();
    (path, at.line, at.column, at.width, &*at.text)
}

fn made(
    py: Python<'_>,
    code: &str,
    message: &str,
    help: Option<String>,
    place: Option<Place<'_>>,
) -> PyErr {
    let make = |py: Python<'_>| {
        let module = py.import("hyperstat._errors")?;
        module
            .getattr("make")?
            .call1((code, message, help, place))
            .map(PyErr::from_value)
    };
    make(py).unwrap_or_else(|error| error)
}

/// Computes without the interpreter, which goes on meanwhile.
pub(crate) fn apart<T: Send>(
    py: Python<'_>,
    compute: impl FnOnce() -> Result<T, Ended> + Send,
) -> PyResult<T> {
    // Nothing of what a panic may leave half done is used again.
    match py.detach(|| catch_unwind(AssertUnwindSafe(compute))) {
        Ok(outcome) => outcome.map_err(|ended| ended.raised(py)),
        Err(panic) => Err(burst(py, &*panic)),
    }
}

/// The exception of a panic.
pub(crate) fn burst(py: Python<'_>, panic: &(dyn Any + Send)) -> PyErr {
    let said = panic.downcast_ref::<&str>().map(|said| (*said).to_owned());
    let said = said.or_else(|| panic.downcast_ref::<String>().cloned());
    let message = format!(
        "this is a bug in hyperstat; it is not your fault: {}",
        said.unwrap_or_default()
    );
    let help = "please report it with the file and the call".to_owned();
    made(py, "internal", &message, Some(help), None)
}
