//! Mechanisms of three equal limbs about z.

use nalgebra::Vector3;

use super::PoseError;

/// Number of limbs.
pub(super) const LIMBS: usize = 3;

/// The outward direction of limb `index` (from 0), turned by `turn` (rad) about z: limb 1's is
/// +y, and limb i is limb 1 turned by 120° (i − 1).
pub(super) fn outward(index: usize, turn: f64) -> Vector3<f64> {
    let (sin, cos) = ((120.0 * index as f64).to_radians() + turn).sin_cos();
    Vector3::new(-sin, cos, 0.0)
}

/// What `limb` gives for each limb, by index from 0.
pub(super) fn per_limb<T>(
    limb: impl Fn(usize) -> Result<T, PoseError>,
) -> Result<[T; LIMBS], PoseError> {
    Ok([limb(0)?, limb(1)?, limb(2)?])
}
