//! 6×6 blocks of column-major matrices.

use nalgebra::Matrix6;

/// Block (row, column) of 6×6 in a column-major matrix with `rows` rows.
pub(super) fn block(matrix: &[f64], rows: usize, row: usize, column: usize) -> Matrix6<f64> {
    Matrix6::from_fn(|i, j| matrix[(6 * column + j) * rows + 6 * row + i])
}

pub(super) fn set_block(
    matrix: &mut [f64],
    rows: usize,
    row: usize,
    column: usize,
    block: &Matrix6<f64>,
) {
    for j in 0..6 {
        let start = (6 * column + j) * rows + 6 * row;
        matrix[start..start + 6].copy_from_slice(block.column(j).as_slice());
    }
}

pub(super) fn add_block(
    matrix: &mut [f64],
    rows: usize,
    row: usize,
    column: usize,
    block: &Matrix6<f64>,
) {
    for j in 0..6 {
        let start = (6 * column + j) * rows + 6 * row;
        for (entry, value) in matrix[start..start + 6].iter_mut().zip(block.column(j)) {
            *entry += value;
        }
    }
}
