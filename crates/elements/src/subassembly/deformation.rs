//! Deformation of a body with nodes 0..=n: displacements relative to node 0's rigid motion.

use nalgebra::{Matrix6, Vector3, Vector6};

use super::blocks::{block, set_block};
use crate::frame::transport;

/// Displacements of nodes 1..=n relative to node 0's rigid motion, δ_r = u_r − X_r u_0: what
/// strains the body.
///
/// `displacements`: of nodes 0..=n; `arms`: from node 0 to nodes 1..=n \[m\]; `out`: n, overwritten.
///
/// # Panics
/// If the lengths do not agree.
pub fn relative_displacements(
    displacements: &[Vector6<f64>],
    arms: &[Vector3<f64>],
    out: &mut [Vector6<f64>],
) {
    assert_eq!(displacements.len(), arms.len() + 1, "nodes 0..=n");
    assert_eq!(out.len(), arms.len(), "nodes 1..=n");
    for (node, arm) in arms.iter().enumerate() {
        out[node] = displacements[node + 1] - transport(arm) * displacements[0];
    }
}

/// The matrix G of [`relative_displacements`]: δ = G u, with −X_r in the columns of node 0 and
/// the identity in those of node r.
///
/// `out`: column-major, (6n)×(6(n+1)), overwritten.
///
/// # Panics
/// If `out` has not 6n·6(n+1) entries.
pub fn deformation_operator(arms: &[Vector3<f64>], out: &mut [f64]) {
    let rows = 6 * arms.len();
    assert_eq!(out.len(), rows * (rows + 6), "6n rows, 6(n+1) columns");
    out.fill(0.0);
    for (node, arm) in arms.iter().enumerate() {
        set_block(out, rows, node, 0, &-transport(arm));
        set_block(out, rows, node, node + 1, &Matrix6::identity());
    }
}

/// Stiffness over all nodes 0..=n from the one with node 0 held: Gᵀ K G, the rows and columns of
/// node 0 by equilibrium (Eqs. 3 and 7).
///
/// `held`: column-major, (6n)×(6n), symmetric; `out`: column-major, (6(n+1))×(6(n+1)), overwritten,
/// symmetric to the last bit.
///
/// # Panics
/// If the lengths do not agree.
pub fn unheld_stiffness(held: &[f64], arms: &[Vector3<f64>], out: &mut [f64]) {
    let size = 6 * arms.len();
    assert_eq!(held.len(), size * size, "a stiffness of 6n rows");
    assert_eq!(out.len(), (size + 6) * (size + 6), "of 6(n+1) rows");
    let mut first = Matrix6::zeros();
    for (column, column_arm) in arms.iter().enumerate() {
        let mut below_first = Matrix6::zeros();
        for (row, row_arm) in arms.iter().enumerate() {
            let block = block(held, size, row, column);
            set_block(out, size + 6, row + 1, column + 1, &block);
            below_first -= transport(row_arm).transpose() * block;
        }
        set_block(out, size + 6, 0, column + 1, &below_first);
        set_block(out, size + 6, column + 1, 0, &below_first.transpose());
        first -= below_first * transport(column_arm);
    }
    set_block(out, size + 6, 0, 0, &((first + first.transpose()) * 0.5));
}
