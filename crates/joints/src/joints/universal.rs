//! The universal joint (paper §2.2.1.1).

use crate::dof::{Dof, DofSet};
use crate::joint::Joint;

/// Two free rotations, about x and y.
///
/// `Δ_i = Δ_j`, and the rotations about z are the same (Eq. 13). The IDCs of body i are the
/// rotations about the two global axes k, l whose plane is nearest to that of the joint's axes;
/// m is the third, along which z is largest. With `ν = z / z_m` and `e` the unit vectors of
/// those axes (Eqs. 17–19, for m = z, y, x):
///
/// ```text
///             φ_ik            φ_il            Δ_j   φ_j
/// N =  Δ_i  [  0               0               E     0      ]
///      φ_i  [  e_k − ν_k e_m   e_l − ν_l e_m   0     e_m νᵀ ]
/// ```
///
/// Body to ground: the first two columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Universal;

impl Joint for Universal {
    fn kind(&self) -> &str {
        "Universal"
    }

    fn free(&self) -> DofSet {
        DofSet::new(&[Dof::U, Dof::V])
    }

    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(*self)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Matrix6, Rotation3, Vector6};

    use super::*;
    use crate::joints::oracle::assert_closed_form;

    /// Eqs. 17, 18, 19 as corrected: the coefficients a of the two IDCs and of `Q φ_j` in the
    /// third rotation, of index `dependent`.
    fn coefficients(r: &Matrix3<f64>, dependent: usize) -> [f64; 3] {
        let r = |row: usize, column: usize| r[(row - 1, column - 1)];
        let (xy, xz, yz) = (
            r(1, 1) * r(2, 2) - r(1, 2) * r(2, 1),
            r(1, 1) * r(3, 2) - r(1, 2) * r(3, 1),
            r(2, 1) * r(3, 2) - r(2, 2) * r(3, 1),
        );
        match dependent {
            2 => [
                (r(3, 1) * r(2, 2) - r(3, 2) * r(2, 1)) / xy,
                (r(1, 1) * r(3, 2) - r(1, 2) * r(3, 1)) / xy,
                r(3, 2) * (r(1, 3) * r(2, 1) - r(1, 1) * r(2, 3)) / xy
                    - r(3, 1) * (r(1, 3) * r(2, 2) - r(1, 2) * r(2, 3)) / xy
                    + r(3, 3),
            ],
            1 => [
                (r(2, 1) * r(3, 2) - r(2, 2) * r(3, 1)) / xz,
                (r(1, 1) * r(2, 2) - r(1, 2) * r(2, 1)) / xz,
                r(2, 3) + r(2, 2) * (r(1, 3) * r(3, 1) - r(1, 1) * r(3, 3)) / xz
                    - r(2, 1) * (r(1, 3) * r(3, 2) - r(1, 2) * r(3, 3)) / xz,
            ],
            _ => [
                (r(1, 1) * r(3, 2) - r(1, 2) * r(3, 1)) / yz,
                (r(1, 2) * r(2, 1) - r(1, 1) * r(2, 2)) / yz,
                r(1, 3) + r(1, 2) * (r(2, 3) * r(3, 1) - r(2, 1) * r(3, 3)) / yz
                    - r(1, 1) * (r(2, 3) * r(3, 2) - r(2, 2) * r(3, 3)) / yz,
            ],
        }
    }

    #[test]
    fn equations_17_to_19_are_the_general_method() {
        let choices = assert_closed_form(&Universal, |r, idcs| {
            let [k, l] = [idcs[0].index(), idcs[1].index()];
            let m = 3 + 4 + 5 - k - l;
            let [a_k, a_l, a_p] = coefficients(r, m - 3);
            let mut n_i = vec![Vector6::ith(k, 1.0), Vector6::ith(l, 1.0)];
            n_i[0][m] = a_k;
            n_i[1][m] = a_l;
            let mut n_j = Matrix6::from_diagonal(&Vector6::new(1.0, 1.0, 1.0, 0.0, 0.0, 0.0));
            let q = r.column(2).transpose() * a_p;
            n_j.fixed_view_mut::<1, 3>(m, 3).copy_from(&q);
            (n_i, n_j)
        });
        assert_eq!(
            choices.len(),
            3,
            "every pair of axes is chosen in some frame"
        );
    }

    /// Eq. 20: with the axes in the x-y plane only φx and φy are independent.
    #[test]
    fn axes_in_a_plane_of_the_global_frame_take_its_axes() {
        let mapping = Universal
            .mapping(&Rotation3::identity(), Universal.free())
            .unwrap();
        assert_eq!(mapping.idcs(), DofSet::new(&[Dof::U, Dof::V]));
        assert_eq!(mapping.column(0), &Vector6::ith(3, 1.0));
        assert_eq!(mapping.column(1), &Vector6::ith(4, 1.0));
    }
}
