//! What differs between two mechanisms, or two designs or poses of one: in what is written, and in what is
//! found.

mod input;
mod results;
#[cfg(test)]
mod tests;

use serde::Serialize;

use crate::ask::Focus;
use crate::error::StudyError;
use crate::study::Study;

pub use input::{InputDifference, PartDifference};
pub use results::{BudgetComparison, Results};

/// What differs between two mechanisms, the first `[0]` and the second `[1]`. Field names are those of the
/// JSON output.
#[derive(Debug, Serialize)]
pub struct Comparison {
    /// What each of them is called.
    pub names: [String; 2],
    /// Parameters, and values that a job varies, that differ.
    pub parameters: Vec<InputDifference>,
    /// What of the mechanisms in their configurations differs; `None` where one has parts that no file can
    /// state.
    pub parts: Option<Vec<PartDifference>>,
    /// What is found of each.
    pub results: Results,
}

/// A number of each of the two.
#[derive(Debug, Clone, Serialize)]
pub struct Pair {
    /// What it is.
    pub name: String,
    /// Its SI unit.
    pub unit: String,
    /// The number of each; `None` where it has none.
    pub values: [Option<f64>; 2],
    /// The second over the first, where both are there and the first is not zero.
    pub ratio: Option<f64>,
}

impl Pair {
    fn new(name: impl Into<String>, unit: impl Into<String>, values: [Option<f64>; 2]) -> Self {
        let ratio = match values {
            [Some(first), Some(second)] if first != 0.0 => Some(second / first),
            _ => None,
        };
        Self {
            name: name.into(),
            unit: unit.into(),
            values,
            ratio: ratio.filter(|ratio| ratio.is_finite()),
        }
    }

    /// Whether the two are the same number, or neither is there.
    pub fn is_same(&self) -> bool {
        self.values[0] == self.values[1]
    }
}

impl Comparison {
    /// Compares two studies.
    ///
    /// # Errors
    /// One of them has no solution, or its output moves freely, or it has no case of the name that is
    /// asked about, or not the natural frequencies.
    pub fn new(studies: [&Study; 2], focus: &Focus) -> Result<Self, StudyError> {
        Ok(Self {
            names: studies.map(Study::called),
            parameters: input::parameters(studies),
            parts: input::parts(studies),
            results: Results::new(studies, focus)?,
        })
    }
}
