//! Answers: objects as JSON, with numbers beside them.

use serde::Serialize;

use super::refused::Refused;
use crate::scene::Span;

/// An answer: an object as JSON, and the numbers that spans in it point into.
#[derive(Debug, Default)]
pub struct Answer {
    /// The object, or `{"error": …}`.
    pub json: String,
    /// The numbers.
    pub numbers: Vec<f64>,
}

impl Answer {
    pub(super) fn of(value: &impl Serialize) -> Result<Self, Refused> {
        Self::with(value, Vec::new())
    }

    pub(super) fn with(value: &impl Serialize, numbers: Vec<f64>) -> Result<Self, Refused> {
        Ok(Self {
            json: serde_json::to_string(value)?,
            numbers,
        })
    }
}

/// Adds numbers to others, and says where they are.
pub(super) fn append(all: &mut Vec<f64>, numbers: impl IntoIterator<Item = f64>) -> Span {
    let first = all.len();
    all.extend(numbers);
    [first, all.len() - first]
}
