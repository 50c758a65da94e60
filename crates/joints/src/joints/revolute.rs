//! The revolute joint (paper §2.2.1.2).

use crate::dof::{Dof, DofSet};
use crate::joint::Joint;

/// One free rotation, about y.
///
/// `Δ_i = Δ_j`, and the rotations differ along y only (Eq. 22). The IDC of body i is the
/// rotation about the global axis k nearest to y (Eq. 24 has k = y). With `ρ = y / y_k` and
/// `e_k` the unit vector of that axis (Eq. 23):
///
/// ```text
///             φ_ik   Δ_j   φ_j
/// N =  Δ_i  [  0      E     0          ]
///      φ_i  [  ρ      0     E − ρ e_kᵀ ]
/// ```
///
/// Body to ground: the first column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Revolute;

impl Joint for Revolute {
    fn kind(&self) -> &str {
        "Revolute"
    }

    fn free(&self) -> DofSet {
        DofSet::new(&[Dof::V])
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
    fn equation_23_is_the_general_method() {
        let choices = assert_closed_form(&Revolute, |r, idcs| {
            let (column, block) = equation_23(r, idcs[0].index() - 3);
            let n_j = block_diagonal(&Matrix3::identity(), &block);
            (vec![stack(Vector3::zeros(), column)], n_j)
        });
        assert_eq!(choices.len(), 3, "every axis is chosen in some frame");
    }
}
