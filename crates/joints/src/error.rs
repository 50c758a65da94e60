//! What can be wrong with a joint, its frame or its mapping.

use nalgebra::Vector3;
use thiserror::Error;

use crate::dof::Dof;

/// A joint, a joint frame or a mapping that cannot be formed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum JointError {
    /// A vector without direction.
    #[error("the {what} is zero; it needs a direction")]
    ZeroAxis {
        /// Which vector.
        what: &'static str,
    },
    /// A NaN or an infinity.
    #[error("the {what} is not finite")]
    NotFinite {
        /// Which quantity.
        what: &'static str,
    },
    /// An `x_axis` along the joint's axis.
    #[error("x_axis ({}) is along the joint's axis ({}); give another direction or leave it out", numbers(.x_axis), numbers(.axis))]
    XAxisAlongAxis {
        /// The `x_axis` as given.
        x_axis: Vector3<f64>,
        /// The axis as given.
        axis: Vector3<f64>,
    },
    /// An `x_axis` for a joint without an axis.
    #[error("an x_axis needs an axis that it can be made normal to")]
    XAxisWithoutAxis,
    /// The two axes of a universal joint are parallel.
    #[error("the two axes ({}) and ({}) are parallel; they must differ in direction", numbers(.a), numbers(.b))]
    ParallelAxes {
        /// First axis as given.
        a: Vector3<f64>,
        /// Second axis as given.
        b: Vector3<f64>,
    },
    /// A name that is not one of `x y z u v w`.
    #[error("`{text}` is not a direction; directions are x, y, z, u, v, w")]
    UnknownDirection {
        /// The name as given.
        text: String,
    },
    /// Motions of a joint that are not independent of each other: its basis is singular.
    #[error("the motion along {direction} adds nothing to the joint's other motions")]
    DependentMotions {
        /// A direction that adds nothing to the others.
        direction: Dof,
    },
    /// A mapping with another number of columns than IDCs.
    #[error("a mapping with {idcs} IDCs needs as many columns, not {columns}")]
    ColumnCount {
        /// Number of IDCs.
        idcs: usize,
        /// Number of columns given.
        columns: usize,
    },
    /// A row of N at an IDC that does not give back the IDC itself.
    #[error("the row of N at its IDC {idc} is not a row of the identity")]
    NotIdentity {
        /// The IDC.
        idc: Dof,
    },
}

/// The components of a vector, with commas between them.
fn numbers(v: &Vector3<f64>) -> String {
    format!("{}, {}, {}", v.x, v.y, v.z)
}
