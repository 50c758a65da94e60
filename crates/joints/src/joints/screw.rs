//! The screw joint (paper §2.2.1.6).

use nalgebra::Matrix6;

use crate::dof::{Dof, DofSet};
use crate::error::JointError;
use crate::joint::Joint;

/// One free rotation, about y, with a travel along y that is coupled to it (Eq. 32):
/// `Δ_i·y − Δ_j·y = p (φ_i − φ_j)·y`, p the pitch.
///
/// The IDC of body i is always a rotation: the one about the global axis k nearest to y
/// (Eq. 31 has k = y). With `ρ = y / y_k` and `e_k` the unit vector of that axis (Eqs. 33–36):
///
/// ```text
///             φ_ik   Δ_j   φ_j
/// N =  Δ_i  [  pρ     E     −p ρ e_kᵀ  ]
///      φ_i  [  ρ      0     E − ρ e_kᵀ ]
/// ```
///
/// Body to ground: the first column.
///
/// Direction v of the joint is the rotation with its travel, direction y the deviation from
/// the helix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Screw {
    pitch: f64,
}

impl Screw {
    /// A screw that travels `pitch` \[m/rad\], right-handed where it is positive. (A thread's
    /// lead, the travel of one turn, is 2π times that.)
    ///
    /// # Errors
    /// [`JointError::NotFinite`] where the pitch is not finite.
    pub fn new(pitch: f64) -> Result<Self, JointError> {
        if !pitch.is_finite() {
            return Err(JointError::NotFinite { what: "pitch" });
        }
        Ok(Self { pitch })
    }

    /// Travel per angle \[m/rad\].
    pub fn pitch(&self) -> f64 {
        self.pitch
    }
}

impl Joint for Screw {
    fn kind(&self) -> &str {
        "Screw"
    }

    fn free(&self) -> DofSet {
        DofSet::new(&[Dof::V])
    }

    fn basis(&self) -> Matrix6<f64> {
        let mut basis = Matrix6::identity();
        basis[(Dof::Y.index(), Dof::V.index())] = self.pitch;
        basis
    }

    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(*self)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Rotation3, RowVector3, Vector3, Vector6};

    use super::*;
    use crate::joints::oracle::{assert_closed_form, equation_23};

    /// Eqs. 33 and 36, with the vector that Eq. 34 lacks in its last term.
    fn equations_33_and_36(r: &Matrix3<f64>, p: f64, k: usize) -> (Vector6<f64>, Matrix6<f64>) {
        let (n_phi_i, n_phi_j) = equation_23(r, k);
        let inverse = r.transpose();
        let (q_1, q_2) = ([inverse.row(0), inverse.row(2)], inverse.row(1));
        let mut n_i = Vector6::zeros();
        let mut n_j = Matrix6::zeros();
        for row in 0..3 {
            let travel = p * r[(row, 1)];
            let delta_j: RowVector3<f64> =
                q_1[0] * r[(row, 0)] + q_2 * r[(row, 1)] + q_1[1] * r[(row, 2)];
            let phi_j: RowVector3<f64> = q_2 * (n_phi_j - Matrix3::identity()) * travel;
            n_i[row] = travel * (q_2 * n_phi_i)[0];
            n_i[row + 3] = n_phi_i[row];
            n_j.fixed_view_mut::<1, 3>(row, 0).copy_from(&delta_j);
            n_j.fixed_view_mut::<1, 3>(row, 3).copy_from(&phi_j);
            n_j.fixed_view_mut::<1, 3>(row + 3, 3)
                .copy_from(&n_phi_j.row(row));
        }
        (n_i, n_j)
    }

    #[test]
    fn equations_33_to_36_are_the_general_method() {
        for pitch in [0.0008, -0.25, 1.0] {
            let screw = Screw::new(pitch).unwrap();
            let choices = assert_closed_form(&screw, |r, idcs| {
                let (n_i, n_j) = equations_33_and_36(r, pitch, idcs[0].index() - 3);
                (vec![n_i], n_j)
            });
            assert_eq!(choices.len(), 3, "every axis is chosen in some frame");
        }
    }

    #[test]
    fn a_right_handed_screw_travels_along_its_rotation() {
        let mapping = Screw::new(0.002)
            .unwrap()
            .mapping(&Rotation3::identity(), DofSet::new(&[Dof::V]))
            .unwrap();
        let turned = mapping.column(0) * 3.0;
        let travelled = Vector3::new(0.0, 0.006, 0.0);
        assert!((turned.fixed_rows::<3>(0) - travelled).amax() < 1e-18);
    }

    #[test]
    fn a_pitch_must_be_finite() {
        for pitch in [f64::NAN, f64::INFINITY] {
            let error = Screw::new(pitch).unwrap_err();
            assert_eq!(error, JointError::NotFinite { what: "pitch" });
        }
    }
}
