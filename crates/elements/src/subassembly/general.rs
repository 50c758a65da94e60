//! The general form `K (I + C K)⁻¹` for any elastic body with any number of nodes.

use nalgebra::{DMatrix, Matrix6};

use crate::error::ElementError;

/// Stiffness of an elastic body with elastic joints at its nodes, K_s = K (I + C K)⁻¹.
///
/// `stiffness`: the body's own, 6n×6n, singular as it is; `compliances`: one per node, in the
/// same axes, zero where there is no elastic joint. Exact for rigid joints, but it cancels where
/// a joint is far softer than the body: it serves as a check on the running form.
///
/// # Errors
/// [`ElementError::NotPositive`] if I + C K is singular, which no positive semidefinite C makes it.
///
/// # Panics
/// If the stiffness has not 6 rows and columns for each compliance.
pub fn softened_stiffness(
    stiffness: &DMatrix<f64>,
    compliances: &[Matrix6<f64>],
) -> Result<DMatrix<f64>, ElementError> {
    let size = 6 * compliances.len();
    assert_eq!(stiffness.shape(), (size, size), "one compliance per node");
    let mut sum = DMatrix::identity(size, size);
    for (node, compliance) in compliances.iter().enumerate() {
        let mut columns = sum.columns_mut(6 * node, 6);
        columns += stiffness.columns(6 * node, 6) * compliance;
    }
    // K (I + C K)⁻¹ = (I + K C)⁻¹ K
    sum.lu().solve(stiffness).ok_or(ElementError::NotPositive)
}
