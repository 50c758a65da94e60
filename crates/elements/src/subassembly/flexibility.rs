//! Flexibilities of nodes 1..=n with node 0 held: joints added, and the inverse.

use nalgebra::{Matrix6, Vector3};

use super::blocks::add_block;
use crate::error::ElementError;
use crate::frame::transport;

/// A pivot below this part of the diagonal it started from is rounding.
const PIVOT: f64 = 64.0 * f64::EPSILON;

/// Adds an elastic joint at a node to a flexibility: F += C_r on the node's own block, and for
/// node 0 F += X_r C_0 X_sᵀ on every block, as the whole body moves with it (Eq. 5).
///
/// `compliance`: the joint's, in the chain's axes. `arms`: from node 0 to nodes 1..=n. `out`:
/// column-major, (6n)×(6n).
///
/// # Panics
/// If `out` has not (6n)² entries, or `node` is above n.
pub fn add_joint_compliance(
    node: usize,
    compliance: &Matrix6<f64>,
    arms: &[Vector3<f64>],
    out: &mut [f64],
) {
    let size = 6 * arms.len();
    assert_eq!(out.len(), size * size, "a flexibility of 6n rows");
    assert!(node <= arms.len(), "node {node} of {}", arms.len());
    if node > 0 {
        add_block(out, size, node - 1, node - 1, compliance);
        return;
    }
    for (row, row_arm) in arms.iter().enumerate() {
        let carried = transport(row_arm) * compliance;
        for (column, column_arm) in arms.iter().enumerate() {
            let block = carried * transport(column_arm).transpose();
            add_block(out, size, row, column, &block);
        }
    }
}

/// Inverts a symmetric positive definite matrix in place by Cholesky, reading its lower triangle;
/// the result is symmetric to the last bit.
///
/// Cholesky's rounding does not depend on the scale of a row and its column, so translations and
/// rotations need no scaling; a pivot is judged against the diagonal entry it started from.
///
/// `size`: rows; `matrix`: column-major, size×size.
///
/// # Errors
/// [`ElementError::NoInverse`] if the matrix is not positive definite to working precision; it is
/// then left half worked.
///
/// # Panics
/// If `matrix` has not size² entries.
pub fn invert_flexibility(size: usize, matrix: &mut [f64]) -> Result<(), ElementError> {
    assert_eq!(matrix.len(), size * size, "a square matrix");
    let at = |row: usize, column: usize| column * size + row;
    factor(size, matrix)?;
    // The inverse of L, in place.
    for column in 0..size {
        matrix[at(column, column)] = 1.0 / matrix[at(column, column)];
        for row in column + 1..size {
            let mut sum = 0.0;
            for k in column..row {
                sum += matrix[at(row, k)] * matrix[at(k, column)];
            }
            matrix[at(row, column)] = -sum / matrix[at(row, row)];
        }
    }
    // L⁻ᵀ L⁻¹: each entry needs only entries at or below its own row.
    for row in 0..size {
        for column in 0..=row {
            let sum = (row..size)
                .map(|k| matrix[at(k, row)] * matrix[at(k, column)])
                .sum();
            matrix[at(row, column)] = sum;
            matrix[at(column, row)] = sum;
        }
    }
    Ok(())
}

/// The Cholesky factor L in the lower triangle, column by column.
fn factor(size: usize, matrix: &mut [f64]) -> Result<(), ElementError> {
    let at = |row: usize, column: usize| column * size + row;
    for column in 0..size {
        let diagonal = matrix[at(column, column)];
        for k in 0..column {
            let factor = matrix[at(column, k)];
            for row in column..size {
                matrix[at(row, column)] -= matrix[at(row, k)] * factor;
            }
        }
        let pivot = matrix[at(column, column)];
        // Written so that NaN is refused too.
        if !(pivot > PIVOT * diagonal && pivot.is_finite()) {
            return Err(ElementError::NoInverse {
                row: column,
                part: pivot / diagonal,
            });
        }
        let root = pivot.sqrt();
        for row in column..size {
            matrix[at(row, column)] /= root;
        }
    }
    Ok(())
}
