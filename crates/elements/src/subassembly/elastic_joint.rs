//! The elasticity of a joint, in the joint's own frame.

use nalgebra::{Matrix6, Rotation3, Vector6};

use crate::frame::{rotate_matrix6, rotate_vector6};

/// An elastic joint at a node of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticJoint {
    /// Compliance, 6×6, symmetric positive semidefinite, joint frame; zero is a rigid joint.
    pub compliance: Matrix6<f64>,
    /// Joint frame: its columns are the joint's x, y and z in the body's axes.
    pub frame: Rotation3<f64>,
}

impl ElasticJoint {
    /// A rigid joint.
    pub fn rigid() -> Self {
        Self {
            compliance: Matrix6::zeros(),
            frame: Rotation3::identity(),
        }
    }

    /// The compliance in the body's axes, C' = Tᵀ C T (Eq. 4).
    pub fn turned_compliance(&self) -> Matrix6<f64> {
        rotate_matrix6(&self.compliance, &self.frame)
    }

    /// A matrix B in the body's axes with B Bᵀ the [turned compliance](Self::turned_compliance);
    /// rigid directions give zero columns. It is made in the joint frame, so a soft direction
    /// leaves no rounding in the others, as it does in the turned compliance.
    pub fn factor(&self) -> Matrix6<f64> {
        let mut out = factor(&self.compliance);
        for mut column in out.column_iter_mut() {
            let turned = rotate_vector6(&column.clone_owned(), &self.frame);
            column.copy_from(&turned);
        }
        out
    }
}

/// B with B Bᵀ = `compliance`, by Cholesky that takes the largest pivot first, relative to the
/// diagonal entry it started from, and stops where only rounding is left.
fn factor(compliance: &Matrix6<f64>) -> Matrix6<f64> {
    const ROUNDING: f64 = 64.0 * f64::EPSILON;
    let diagonal = compliance.diagonal();
    let mut rest = *compliance;
    let mut out = Matrix6::zeros();
    for column in 0..6 {
        let left = Vector6::from_fn(|d, _| {
            if diagonal[d] > 0.0 {
                rest[(d, d)] / diagonal[d]
            } else {
                0.0
            }
        });
        let pivot = left.imax();
        if left[pivot] <= ROUNDING {
            break;
        }
        let part = rest.column(pivot) / rest[(pivot, pivot)].sqrt();
        rest -= part * part.transpose();
        // Exactly nothing is left of the pivot's own row and column.
        rest.column_mut(pivot).fill(0.0);
        rest.row_mut(pivot).fill(0.0);
        out.set_column(column, &part);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factor_of_a_diagonal_is_its_root() {
        let compliance = Matrix6::from_diagonal(&Vector6::new(1e3, 0.0, 4e-8, 0.0, 9.0, 0.0));
        let b = factor(&compliance);
        assert_eq!(b.iter().filter(|v| **v != 0.0).count(), 3);
        let product = b * b.transpose();
        for d in 0..6 {
            assert!((product[(d, d)] - compliance[(d, d)]).abs() <= 1e-15 * compliance[(d, d)]);
        }
    }

    #[test]
    fn factor_of_a_coupled_semidefinite_matrix() {
        // Rank 2, coupled over translations and rotations of very different size.
        let columns = [
            Vector6::new(1.0, -2.0, 0.0, 3e-3, 0.0, 1e-3),
            Vector6::new(0.0, 5.0, 1.0, 0.0, 2e-3, 0.0),
        ];
        let compliance: Matrix6<f64> = columns.iter().map(|c| c * c.transpose()).sum();
        let b = factor(&compliance);
        assert_eq!(b.column_iter().filter(|c| c.amax() > 0.0).count(), 2);
        let scale = |i, j| f64::sqrt(compliance[(i, i)] * compliance[(j, j)]);
        let error = b * b.transpose() - compliance;
        for i in 0..6 {
            for j in 0..6 {
                assert!(error[(i, j)].abs() <= 1e-15 * scale(i, j));
            }
        }
    }

    #[test]
    fn turned_factor_gives_the_turned_compliance() {
        let joint = ElasticJoint {
            compliance: Matrix6::from_diagonal(&Vector6::new(1.0, 2.0, 0.0, 3.0, 0.0, 4.0)),
            frame: Rotation3::from_euler_angles(0.3, -1.1, 2.0),
        };
        let b = joint.factor();
        assert!((b * b.transpose() - joint.turned_compliance()).amax() < 1e-14);
    }
}
