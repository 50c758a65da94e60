//! The prismatic joint (paper §2.2.1.4).

use crate::dof::{Dof, DofSet};
use crate::joint::Joint;

/// One free translation, along y.
///
/// `φ_i = φ_j`, and the translations differ along y only. The IDC of body i is the translation
/// along the global axis k nearest to y (Eq. 27 has k = y). With `ρ = y / y_k` and `e_k` the
/// unit vector of that axis (Eq. 28):
///
/// ```text
///             Δ_ik   Δ_j          φ_j
/// N =  Δ_i  [  ρ      E − ρ e_kᵀ   0 ]
///      φ_i  [  0      0            E ]
/// ```
///
/// Body to ground: the first column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Prismatic;

impl Joint for Prismatic {
    fn kind(&self) -> &str {
        "Prismatic"
    }

    fn free(&self) -> DofSet {
        DofSet::new(&[Dof::Y])
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
    fn equation_28_is_the_general_method() {
        let choices = assert_closed_form(&Prismatic, |r, idcs| {
            let (column, block) = equation_23(r, idcs[0].index());
            let n_j = block_diagonal(&block, &Matrix3::identity());
            (vec![stack(column, Vector3::zeros())], n_j)
        });
        assert_eq!(choices.len(), 3, "every axis is chosen in some frame");
    }
}
