//! Platforms whose three corners are kept in the three planes through z, 120° apart: 3-RPS and
//! 3-PRS.

use nalgebra::{Point3, Rotation3, Vector3};

use super::limbs::{LIMBS, outward, tangent};

/// Such a platform at a pose.
pub(super) struct Platform {
    pub(super) centre: Point3<f64>,
    /// The corners S.
    pub(super) corners: [Point3<f64>; LIMBS],
    /// x, y, z (m) and rx, ry, rz (rad) of the centre.
    pub(super) pose: [f64; 6],
}

impl Platform {
    /// A platform with its corners at `radius` (m) from its centre, at the height z (m) and with
    /// the components rx, ry (rad) of its rotation vector.
    ///
    /// Corner i is in the plane of the outward direction oᵢ and z, so that with the tangent
    /// tᵢ = z × oᵢ, tᵢ · (p + radius R oᵢ) = 0. Summed over the corners, as Σ tᵢ = 0 and
    /// Σ oᵢ oᵢᵀ = 3/2 diag(1, 1, 0), this is R₂₁ = R₁₂: the rotation vector has no component along
    /// z. Multiplied by tᵢ and summed it is the position, 3/2 p = −radius Σ tᵢ tᵢᵀ R oᵢ in x and y.
    #[inline]
    pub(super) fn new(radius: f64, [z, rx, ry]: [f64; 3]) -> Self {
        let rotation = Rotation3::new(Vector3::new(rx, ry, 0.0));
        let out = [0, 1, 2].map(|index| rotation * outward(index) * radius);
        let mut centre = Vector3::new(0.0, 0.0, z);
        for (index, out) in out.iter().enumerate() {
            let tangent = tangent(index);
            centre -= tangent * (tangent.dot(out) / 1.5);
        }
        Self {
            centre: Point3::from(centre),
            corners: out.map(|out| Point3::from(centre + out)),
            pose: [centre.x, centre.y, z, rx, ry, 0.0],
        }
    }
}
