//! What can be wrong with a material, a section, a beam or a subassembly.

use thiserror::Error;

/// An input this crate cannot use.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ElementError {
    /// A number outside its physical range.
    #[error("`{field}` is {value}, it must be {wanted}")]
    OutOfRange {
        /// Name of the field, as in the file format.
        field: &'static str,
        /// The value given.
        value: f64,
        /// What would be right.
        wanted: &'static str,
    },
    /// A beam whose two nodes coincide, or whose span is not finite.
    #[error("a beam of length {length} m has no direction, its two points must lie apart")]
    NoLength {
        /// Distance between the nodes \[m\].
        length: f64,
    },
    /// A direction of the local y axis that is zero or not finite.
    #[error("`y_axis` ({x}, {y}, {z}) has no direction, give a vector that is not zero")]
    NoDirection {
        /// Component along global x.
        x: f64,
        /// Component along global y.
        y: f64,
        /// Component along global z.
        z: f64,
    },
    /// A direction of the local y axis along the beam.
    #[error(
        "`y_axis` ({x}, {y}, {z}) lies along the beam, give a direction across it (or leave it out)"
    )]
    AlongBeam {
        /// Component along global x.
        x: f64,
        /// Component along global y.
        y: f64,
        /// Component along global z.
        z: f64,
    },
    /// A flexibility that has no inverse: a compliance in it is not positive semidefinite, or a
    /// joint is so soft that nothing of the body is left beside it.
    #[error(
        "the flexibility has no inverse: row {row} keeps {part:e} of its diagonal; compliances \
         must be symmetric positive semidefinite, and no joint softer than about 1e-12 of the body"
    )]
    NoInverse {
        /// Row of the flexibility, from 0.
        row: usize,
        /// The pivot of that row, as a part of its diagonal entry.
        part: f64,
    },
    /// A stiffness or compliance that is not finite or not positive definite.
    #[error("a stiffness or compliance is not finite or not symmetric positive semidefinite")]
    NotPositive,
}

/// `value`, if it is a finite number above zero.
pub(crate) fn positive(field: &'static str, value: f64) -> Result<f64, ElementError> {
    check(
        value.is_finite() && value > 0.0,
        field,
        value,
        "a finite number above zero",
    )
}

/// `value`, if `right`.
pub(crate) fn check(
    right: bool,
    field: &'static str,
    value: f64,
    wanted: &'static str,
) -> Result<f64, ElementError> {
    if right {
        Ok(value)
    } else {
        Err(ElementError::OutOfRange {
            field,
            value,
            wanted,
        })
    }
}
