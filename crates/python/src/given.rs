//! What Python hands in, as the study takes it.

use hyperstat_study::{Along, BeamMass, JobPoses, Value};
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

use crate::error::Ended;

/// A value by its path: a number, or a text as it stands in a file.
#[derive(FromPyObject)]
pub(crate) enum Given {
    Number(f64),
    Text(String),
}

impl From<Given> for Value {
    fn from(given: Given) -> Self {
        match given {
            Given::Number(number) => Self::Number(number),
            Given::Text(text) => Self::Text(text),
        }
    }
}

/// Values by their paths.
pub(crate) fn values(given: Vec<(String, Given)>) -> Vec<(String, Value)> {
    let value = |(path, value): (String, Given)| (path, value.into());
    given.into_iter().map(value).collect()
}

/// Poses of a table whose columns have these names.
pub(crate) fn poses(columns: Vec<String>, rows: &PyReadonlyArray2<'_, f64>) -> JobPoses {
    let rows = rows.as_array().iter().copied().collect();
    JobPoses::Table { columns, rows }
}

/// The direction that budgets are along.
pub(crate) fn along(word: Option<&str>, direction: Option<[f64; 3]>) -> Result<Along, Ended> {
    let help = || format!("give `{}` or three numbers", Along::WORDS.join("`, `"));
    match (word, direction) {
        (_, Some(direction)) => Along::direction(direction)
            .ok_or_else(|| Ended::argument("a direction has a length", &help())),
        (Some(word), None) => Along::named(word)
            .ok_or_else(|| Ended::argument(format!("unknown direction `{word}`"), &help())),
        (None, None) => Ok(Along::Displacement),
    }
}

/// How beams have mass.
pub(crate) fn mass(word: &str) -> Result<BeamMass, Ended> {
    match word {
        "Exact" => Ok(BeamMass::Exact),
        "Consistent" => Ok(BeamMass::Consistent),
        "Lumped" => Ok(BeamMass::Lumped),
        _ => Err(Ended::argument(
            format!("unknown masses of beams `{word}`"),
            "give `Exact`, `Consistent` or `Lumped`",
        )),
    }
}
