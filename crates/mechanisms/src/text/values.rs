//! Evenly spaced numbers: an axis of a grid of poses, a range of a varied value.

use super::dimension::Dimension;
use super::fragment::Fragment;
use crate::error::LoadError;

/// Evenly spaced numbers, both ends exact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Values {
    first: f64,
    last: f64,
    count: usize,
    /// What they measure, where that is said.
    dimension: Option<Dimension>,
}

impl Values {
    /// Zero alone.
    pub(crate) const ZERO: Self = Self::new(0.0, 0.0, 1);

    pub(crate) const fn new(first: f64, last: f64, count: usize) -> Self {
        Self {
            first,
            last,
            count,
            dimension: None,
        }
    }

    /// Reads `(first, last, count)`, of this dimension, or of any; `expected` says that in words.
    pub(crate) fn read(
        fragment: Fragment<'_>,
        expected: &str,
        wanted: Option<Dimension>,
    ) -> Result<Self, LoadError> {
        let [first, last, count] = fragment.array(expected)?;
        let expected = "a whole number of values, 1 or more";
        let (from, dimension) = first.measured(wanted)?;
        let dimension = wanted.or(dimension);
        let what = "a value of the range";
        if let Some(dimension) = dimension {
            first.quantity(what, dimension)?;
        }
        let to = match dimension {
            Some(dimension) => last.quantity(what, dimension)?,
            None => last.number()?,
        };
        let values = Self {
            dimension,
            ..Self::new(from, to, count.count(expected)?)
        };
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

    /// What they measure, where that is said.
    pub(crate) fn dimension(&self) -> Option<Dimension> {
        self.dimension
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
