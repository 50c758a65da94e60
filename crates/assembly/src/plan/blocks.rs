//! Small dense blocks: reading, writing, products.

use hyperstat_joints::rigid_motion;
use nalgebra::{Matrix6, Vector6};

use hyperstat_model::{Geometry, NodeId};

/// `vector -= share * other`.
pub(crate) fn subtract(vector: &mut [f64], share: f64, other: &[f64]) {
    for (value, other) in vector.iter_mut().zip(other) {
        *value -= share * other;
    }
}

/// Displacement at `to` from that at `from` on one rigid body (Eq. 37).
pub(crate) fn shift(geometry: &Geometry, from: NodeId, to: NodeId) -> Matrix6<f64> {
    if from == to {
        Matrix6::identity()
    } else {
        rigid_motion(&(geometry.positions[to.0] - geometry.positions[from.0]))
    }
}

pub(crate) fn read(values: &[f64], start: usize) -> Vector6<f64> {
    Vector6::from_column_slice(&values[start..start + 6])
}

pub(crate) fn write(values: &mut [f64], start: usize, column: &Vector6<f64>) {
    values[start..start + 6].copy_from_slice(column.as_slice());
}

/// `out = k d` for a square `k` of `rows`, column by column.
pub(crate) fn multiply(k: &[f64], d: &[f64], rows: usize, out: &mut [f64]) {
    for (column, result) in d.chunks_exact(rows).zip(out.chunks_exact_mut(rows)) {
        result.fill(0.0);
        for (weight, k_column) in column.iter().zip(k.chunks_exact(rows)) {
            for (r, entry) in result.iter_mut().zip(k_column) {
                *r += weight * entry;
            }
        }
    }
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
