//! Evenly spaced numbers: an axis of a grid of poses, a range of a varied value.

use super::fragment::Fragment;
use crate::error::LoadError;

/// Evenly spaced numbers, both ends exact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Values {
    first: f64,
    last: f64,
    count: usize,
}

impl Values {
    /// Zero alone.
    pub(crate) const ZERO: Self = Self::new(0.0, 0.0, 1);

    pub(crate) const fn new(first: f64, last: f64, count: usize) -> Self {
        Self { first, last, count }
    }

    /// Reads `(first, last, count)`; `expected` says that in words.
    pub(crate) fn read(fragment: Fragment<'_>, expected: &str) -> Result<Self, LoadError> {
        let [first, last, count] = fragment.array(expected)?;
        let expected = "a whole number of values, 1 or more";
        let values = Self::new(first.number()?, last.number()?, count.parse(expected)?);
        if values.count == 0 {
            return Err(count.expected(expected));
        }
        if values.count == 1 && values.first != values.last {
            return Err(count
                .error("one value cannot be both the first and the last, which differ")
                .with_help("raise the count to 2, or give the same number twice"));
        }
        Ok(values)
    }

    /// How many they are, at least 1.
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// The first and the last.
    pub(crate) fn ends(&self) -> [f64; 2] {
        [self.first, self.last]
    }

    /// Number `k`, from 0.
    pub(crate) fn get(&self, k: usize) -> f64 {
        if k == 0 {
            return self.first;
        }
        let t = k as f64 / (self.count - 1) as f64;
        self.first * (1.0 - t) + self.last * t
    }
}
