//! Mechanisms of three equal limbs about z: limb 1 stands over +y, and limb i is limb 1 turned by
//! 120° (i − 1).

use nalgebra::Vector3;

use crate::prebuilt::PoseError;

/// Number of limbs.
pub(super) const LIMBS: usize = 3;

/// Sine and cosine of the turn of every limb.
const TURNS: [[f64; 2]; LIMBS] = [[0.0, 1.0], [SIN_120, -0.5], [-SIN_120, -0.5]];

/// √3/2.
const SIN_120: f64 = 0.866_025_403_784_438_6;

/// The outward direction of limb `index` (from 0).
#[inline]
pub(super) fn outward(index: usize) -> Vector3<f64> {
    let [sin, cos] = TURNS[index];
    Vector3::new(-sin, cos, 0.0)
}

/// z × outward.
#[inline]
pub(super) fn tangent(index: usize) -> Vector3<f64> {
    let [sin, cos] = TURNS[index];
    Vector3::new(-cos, -sin, 0.0)
}

/// The outward direction of limb `index` (from 0), turned about z by an angle of this sine and
/// cosine.
#[inline]
pub(super) fn turned_outward(index: usize, (sin, cos): (f64, f64)) -> Vector3<f64> {
    outward(index) * cos + tangent(index) * sin
}

/// What `limb` gives for each limb, by index from 0.
#[inline(always)]
pub(super) fn per_limb<T>(
    limb: impl Fn(usize) -> Result<T, PoseError>,
) -> Result<[T; LIMBS], PoseError> {
    Ok([limb(0)?, limb(1)?, limb(2)?])
}
