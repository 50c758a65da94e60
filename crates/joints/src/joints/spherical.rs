//! The spherical joint (paper §2.2.1.3).

use crate::dof::{Dof, DofSet};
use crate::joint::Joint;

/// Three free rotations.
///
/// `Δ_i = Δ_j` (Eq. 25). The IDCs of body i are its three rotations (Eq. 26), in every
/// orientation:
///
/// ```text
///             φ_i   Δ_j   φ_j
/// N =  Δ_i  [  0     E     0  ]
///      φ_i  [  E     0     0  ]
/// ```
///
/// Body to ground: the first three columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Spherical;

impl Joint for Spherical {
    fn kind(&self) -> &str {
        "Spherical"
    }

    fn free(&self) -> DofSet {
        DofSet::new(&[Dof::U, Dof::V, Dof::W])
    }

    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(*self)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix6, Vector6};

    use super::*;
    use crate::joints::oracle::assert_closed_form;

    #[test]
    fn equations_25_and_26_are_the_general_method() {
        let n_j = Matrix6::from_diagonal(&Vector6::new(1.0, 1.0, 1.0, 0.0, 0.0, 0.0));
        let choices = assert_closed_form(&Spherical, |_, _| {
            (
                vec![
                    Vector6::ith(3, 1.0),
                    Vector6::ith(4, 1.0),
                    Vector6::ith(5, 1.0),
                ],
                n_j,
            )
        });
        assert_eq!(choices, [Spherical.free()]);
    }
}
