//! The cylindrical joint (paper §2.2.1.5).

use crate::dof::{Dof, DofSet};
use crate::joint::Joint;

/// A free translation along y and a free rotation about it.
///
/// A prismatic and a revolute joint in one. The IDCs of body i are the translation along and
/// the rotation about the global axis k nearest to y (Eq. 29 has k = y). With `ρ = y / y_k` and
/// `e_k` the unit vector of that axis (Eq. 30):
///
/// ```text
///             Δ_ik   φ_ik   Δ_j          φ_j
/// N =  Δ_i  [  ρ      0      E − ρ e_kᵀ   0          ]
///      φ_i  [  0      ρ      0            E − ρ e_kᵀ ]
/// ```
///
/// Body to ground: the first two columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cylindrical;

impl Joint for Cylindrical {
    fn kind(&self) -> &str {
        "Cylindrical"
    }

    fn free(&self) -> DofSet {
        DofSet::new(&[Dof::Y, Dof::V])
    }

    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(*self)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::joints::oracle::{assert_closed_form, block_diagonal, equation_23, stack};

    #[test]
    fn equation_30_is_the_general_method() {
        let choices = assert_closed_form(&Cylindrical, |r, idcs| {
            assert_eq!(idcs[0].index() + 3, idcs[1].index(), "the same axis twice");
            let (column, block) = equation_23(r, idcs[0].index());
            let zero = Vector3::zeros();
            let n_i = vec![stack(column, zero), stack(zero, column)];
            (n_i, block_diagonal(&block, &block))
        });
        assert_eq!(choices.len(), 3, "every axis is chosen in some frame");
    }
}
