//! Platforms that turn about x and then about their own y.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

/// A turn about x followed by one about the turned y, each by its sine and cosine.
pub(super) struct Tilt {
    pub(super) about_x: [f64; 2],
    pub(super) about_y: [f64; 2],
}

impl Tilt {
    /// Columns are the turned x, y and z.
    #[inline]
    pub(super) fn rotation(&self) -> Rotation3<f64> {
        let ([sx, cx], [sy, cy]) = (self.about_x, self.about_y);
        Rotation3::from_matrix_unchecked(Matrix3::new(
            cy,
            0.0,
            sy, //
            sx * sy,
            cx,
            -sx * cy, //
            -cx * sy,
            sx,
            cx * cy,
        ))
    }

    /// The rotation vector (rad).
    #[inline]
    pub(super) fn rotation_vector(&self) -> Vector3<f64> {
        let ([sx, cx], [sy, cy]) = (half(self.about_x), half(self.about_y));
        let turn = Quaternion::new(cx * cy, sx * cy, cx * sy, sx * sy);
        UnitQuaternion::new_unchecked(turn).scaled_axis()
    }
}

/// Sine and cosine of half an angle in -π to π.
#[inline]
fn half([sin, cos]: [f64; 2]) -> [f64; 2] {
    if cos >= 0.0 {
        let half_cos = (0.5 * (1.0 + cos)).sqrt();
        [0.5 * sin / half_cos, half_cos]
    } else {
        let half_sin = (0.5 * (1.0 - cos)).sqrt().copysign(sin);
        [half_sin, 0.5 * sin / half_sin]
    }
}
