//! Joint frames of directions that are known to be of unit length and normal to each other.

use nalgebra::{Matrix3, Rotation3, Vector3};

/// The frame with these x and y, z = x × y. Both are unit vectors, and normal to each other but
/// for rounding, which is taken off x.
#[inline]
pub(super) fn frame(x: &Vector3<f64>, y: &Vector3<f64>) -> Rotation3<f64> {
    let x = x - y * y.dot(x);
    let z = x.cross(y);
    Rotation3::from_matrix_unchecked(Matrix3::new(
        x.x, y.x, z.x, //
        x.y, y.y, z.y, //
        x.z, y.z, z.z,
    ))
}
