//! Rows brought to echelon form.

use nalgebra::DVector;

/// A basis of the same space in reduced echelon form by complete pivoting: motions of few bodies
/// each, largest entry 1, so that a person can name them.
pub(crate) fn echelon(mut basis: Vec<DVector<f64>>) -> Vec<DVector<f64>> {
    for k in 0..basis.len() {
        let mut best = (k, 0, 0.0);
        for (c, column) in basis.iter().enumerate().skip(k) {
            for (r, value) in column.iter().enumerate() {
                if value.abs() > best.2 * (1.0 + 1e-9) {
                    best = (c, r, value.abs());
                }
            }
        }
        let (column, row, _) = best;
        basis.swap(k, column);
        let pivot = &basis[k] / basis[k][row];
        for (c, other) in basis.iter_mut().enumerate() {
            if c != k {
                let factor = other[row];
                *other -= &pivot * factor;
            }
        }
        basis[k] = pivot;
    }
    for column in &mut basis {
        let largest = column.amax();
        for value in column.iter_mut() {
            *value /= largest;
            if value.abs() < 1e-9 {
                *value = 0.0;
            }
        }
    }
    basis
}
