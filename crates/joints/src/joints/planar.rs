//! The planar joint. The paper has none; its form follows from Eqs. 17–19 and 23.

use crate::dof::{Dof, DofSet};
use crate::joint::Joint;

/// Two free translations, along x and z, and the free rotation about the plane's normal, y.
///
/// The translations along y are the same, and the rotations differ along y only. The IDCs of
/// body i are its translations along the two global axes k, l nearest to the plane, and its
/// rotation about the global axis m nearest to the normal. With `ρ = y / y_m` and `e` the unit
/// vectors of those axes:
///
/// ```text
///             Δ_ik            Δ_il            φ_im   Δ_j      φ_j
/// N =  Δ_i  [  e_k − ρ_k e_m   e_l − ρ_l e_m   0      e_m ρᵀ   0          ]
///      φ_i  [  0               0               ρ      0        E − ρ e_mᵀ ]
/// ```
///
/// Body to ground: the first three columns. (Where components of y tie, the axis of the
/// rotation may be another than the one left out of the translations.)
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Planar;

impl Joint for Planar {
    fn kind(&self) -> &str {
        "Planar"
    }

    fn free(&self) -> DofSet {
        DofSet::new(&[Dof::X, Dof::Z, Dof::V])
    }

    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(*self)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};

    use super::*;
    use crate::joints::oracle::{assert_closed_form, block_diagonal, equation_23, stack};

    #[test]
    fn the_closed_form_is_the_general_method() {
        let choices = assert_closed_form(&Planar, |r, idcs| {
            let normal = r.column(1);
            let (k, l) = (idcs[0].index(), idcs[1].index());
            let m = 3 - k - l;
            let in_plane = |k: usize| -> Vector3<f64> {
                Vector3::ith(k, 1.0) - Vector3::ith(m, normal[k] / normal[m])
            };
            let mut delta_j = Matrix3::zeros();
            delta_j.set_row(m, &(normal.transpose() / normal[m]));
            let (about_normal, phi_j) = equation_23(r, idcs[2].index() - 3);
            let zero = Vector3::zeros();
            let n_i = vec![
                stack(in_plane(k), zero),
                stack(in_plane(l), zero),
                stack(zero, about_normal),
            ];
            (n_i, block_diagonal(&delta_j, &phi_j))
        });
        assert!(choices.len() >= 3, "every plane is chosen in some frame");
    }
}
