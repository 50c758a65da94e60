//! Joint frames of directions that are known to be of unit length and normal to each other.

use nalgebra::{Rotation3, Vector3};

use crate::prebuilt::wide::{self, frame_at, same};

/// As [`wide::frame`], of one pose.
#[inline]
pub(super) fn frame(x: &Vector3<f64>, y: &Vector3<f64>) -> Rotation3<f64> {
    frame_at(&wide::frame::<1>(&same(x), &same(y)), y, 0)
}
