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
    /// A taper between sections of different kinds.
    #[error("a section cannot change from a {from} to a {to}: both ends must be of one kind")]
    DifferentKinds {
        /// Kind at the first node.
        from: &'static str,
        /// Kind at the second node.
        to: &'static str,
    },
    /// A taper between sections of which only one has an optional property.
    #[error("`{field}` is given for one end of a tapered section, give it for both or for none")]
    OneEnd {
        /// Name of the field, as in the file format.
        field: &'static str,
    },
    /// A flexible body with fewer than two nodes.
    #[error("a flexible body needs at least two nodes")]
    TooFewNodes,
    /// A stiffness whose size does not fit the nodes.
    #[error(
        "the stiffness has {rows} rows and {columns} columns, for {nodes} nodes it must have \
         {wanted} of each"
    )]
    StiffnessSize {
        /// Rows given.
        rows: usize,
        /// Columns given.
        columns: usize,
        /// Number of nodes.
        nodes: usize,
        /// Six for each node.
        wanted: usize,
    },
    /// An entry of a stiffness that is not finite.
    #[error("row {row}, column {column} of the stiffness (from 0) is not finite")]
    NotFiniteEntry {
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
    },
    /// Entries of a stiffness that differ across the diagonal.
    #[error(
        "the stiffness is not symmetric: row {row}, column {column} (from 0) is {value}, across \
         the diagonal stands {mirrored}"
    )]
    NotSymmetric {
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
        /// The entry.
        value: f64,
        /// The entry across the diagonal.
        mirrored: f64,
    },
    /// A stiffness that resists a motion of the body as a whole.
    #[error(
        "the stiffness resists {motion} of the whole body with {part:.1e} of its entries; a body \
         that moves as a whole takes no force"
    )]
    ResistsRigidMotion {
        /// The motion, such as "a translation along x".
        motion: &'static str,
        /// The force that is left over, as a part of the forces that should cancel.
        part: f64,
    },
    /// A stiffness that is not positive semidefinite.
    #[error(
        "the stiffness is not positive semidefinite: scaled to a unit diagonal it has the \
         eigenvalue {eigenvalue:.1e}"
    )]
    NegativeEnergy {
        /// The lowest eigenvalue of the scaled matrix.
        eigenvalue: f64,
    },
    /// A stiffness that leaves other motions free than those of the body as a whole.
    #[error(
        "the stiffness has {found} motions without energy instead of six: some part of the body \
         moves freely against the rest"
    )]
    MoreThanSixFreeMotions {
        /// Number of motions without energy.
        found: usize,
    },
    /// An inertia that no distribution of mass has.
    #[error(
        "the inertia has a negative principal moment, {moment:.6e} kg·m²; check the entries and \
         their order: Jxx, Jyy, Jzz, Jxy, Jxz, Jyz"
    )]
    NegativeInertia {
        /// The smallest principal moment \[kg·m²\].
        moment: f64,
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
