//! Elastic joints absorbed into a stiffness, without forming a flexibility.

use nalgebra::{Matrix6, Vector3};

use crate::error::ElementError;
use crate::frame::transport;

/// An elastic joint at a node, by a factor of its compliance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointFactor {
    /// Node of the body, 0..=n.
    pub node: usize,
    /// B in the body's axes: the joint's compliance is B Bᵀ. A stiffness k along the unit
    /// direction d is a column d/√k, a rigid direction a zero column. See
    /// [`ElasticJoint::factor`](super::ElasticJoint::factor).
    pub factor: Matrix6<f64>,
}

/// Entries of the workspace of [`absorb_joints`] for a body with nodes 0..=n and this many joints.
pub fn absorption_workspace(n: usize, joints: usize) -> usize {
    36 * (2 * n * n + 2 * n * joints + joints * joints)
}

/// Absorbs elastic joints at the nodes of an elastic body into its stiffness, node 0 held: the
/// same as adding the joints' compliances to the flexibility and inverting that (Eqs. 5 and 6).
///
/// A deformation δ is shared between the joints and the body. With W the columns of all joints'
/// factors, each carried to the nodes that move with it, the joints take W Q δ and the body
/// P δ = δ − W Q δ, where Q = (I + Wᵀ K W)⁻¹ Wᵀ K makes the energy least. The stiffness is the
/// sum of both energies, Pᵀ K P + Qᵀ Q. As the energy is least at Q, an error in Q enters only
/// squared: the result keeps its digits from rigid joints (no bit changes) to ones many orders
/// softer than the body, in every direction, where a flexibility in axes across the soft
/// direction loses the body's part in the rounding of the joint's.
///
/// `arms`: from node 0 to nodes 1..=n \[m\]. `stiffness`: column-major, (6n)×(6n), symmetric
/// positive semidefinite, changed in place; symmetric to the last bit afterwards. `workspace`:
/// [`absorption_workspace`] entries or more, of any content.
///
/// # Errors
/// [`ElementError::NotPositive`] if the stiffness, an arm or a factor is not finite. The
/// stiffness is left as it was.
///
/// # Panics
/// If a slice is too short, or a joint's node is above n.
pub fn absorb_joints(
    joints: &[JointFactor],
    arms: &[Vector3<f64>],
    stiffness: &mut [f64],
    workspace: &mut [f64],
) -> Result<(), ElementError> {
    let size = 6 * arms.len();
    assert_eq!(stiffness.len(), size * size, "a stiffness of 6n rows");
    let (carried, rest) = workspace.split_at_mut(6 * size * joints.len());
    let elastic = carry(joints, arms, carried);
    if elastic == 0 {
        return Ok(());
    }
    let (w, _) = carried.split_at(size * elastic);
    let (q_transposed, rest) = rest.split_at_mut(size * elastic);
    let (sum, rest) = rest.split_at_mut(elastic * elastic);
    let (p, rest) = rest.split_at_mut(size * size);
    let (k_p, _) = rest.split_at_mut(size * size);
    let at = |row: usize, column: usize| column * size + row;
    let one = |row: usize, column: usize| f64::from(u8::from(row == column));

    // K W and I + Wᵀ K W, then Qᵀ = K W (I + Wᵀ K W)⁻¹.
    fill(q_transposed, size, |i, j| {
        dot(size, |k| stiffness[at(i, k)] * w[at(k, j)])
    });
    fill(sum, elastic, |i, j| {
        one(i, j) + dot(size, |k| w[at(k, i)] * q_transposed[at(k, j)])
    });
    factor(elastic, sum)?;
    solve_rows(elastic, sum, q_transposed);
    // P is formed before K P: taken as K − K W Q, it would lose what is left of a soft direction.
    fill(p, size, |i, j| {
        one(i, j) - dot(elastic, |k| w[at(i, k)] * q_transposed[at(j, k)])
    });
    fill(k_p, size, |i, j| {
        dot(size, |k| stiffness[at(i, k)] * p[at(k, j)])
    });
    for column in 0..size {
        for row in column..size {
            let body = |i, j| dot(size, |k| p[at(k, i)] * k_p[at(k, j)]);
            let joint = dot(elastic, |k| {
                q_transposed[at(row, k)] * q_transposed[at(column, k)]
            });
            let energy = joint + (body(row, column) + body(column, row)) / 2.0;
            stiffness[at(row, column)] = energy;
            stiffness[at(column, row)] = energy;
        }
    }
    Ok(())
}

/// Writes W, one column for each column of a factor that is not zero, and says how many.
fn carry(joints: &[JointFactor], arms: &[Vector3<f64>], out: &mut [f64]) -> usize {
    let mut columns = out.chunks_exact_mut(6 * arms.len());
    let mut count = 0;
    for joint in joints {
        assert!(joint.node <= arms.len(), "node {} of a body", joint.node);
        for direction in joint.factor.column_iter() {
            if direction.iter().all(|v| *v == 0.0) {
                continue;
            }
            let Some(column) = columns.next() else { break };
            column.fill(0.0);
            for (node, arm) in (1..).zip(arms) {
                let moved = match joint.node {
                    0 => transport(arm) * direction,
                    own if own == node => direction.into_owned(),
                    _ => continue,
                };
                column[6 * (node - 1)..6 * node].copy_from_slice(moved.as_slice());
            }
            count += 1;
        }
    }
    count
}

/// The Cholesky factor in the lower triangle of I + A with A positive semidefinite. Its pivots are
/// 1 or more; one that rounding brought below is 1.
fn factor(size: usize, matrix: &mut [f64]) -> Result<(), ElementError> {
    let at = |row: usize, column: usize| column * size + row;
    for column in 0..size {
        for row in column..size {
            let before = dot(column, |k| matrix[at(row, k)] * matrix[at(column, k)]);
            matrix[at(row, column)] -= before;
        }
        let pivot = matrix[at(column, column)];
        if !pivot.is_finite() {
            return Err(ElementError::NotPositive);
        }
        let root = pivot.max(1.0).sqrt();
        matrix[at(column, column)] = root;
        for row in column + 1..size {
            matrix[at(row, column)] /= root;
        }
    }
    Ok(())
}

/// `rows` ← rows · (L Lᵀ)⁻¹, with L in the lower triangle of `cholesky`.
fn solve_rows(size: usize, cholesky: &[f64], rows: &mut [f64]) {
    let height = rows.len() / size;
    let at = |row: usize, column: usize| column * size + row;
    for row in 0..height {
        let entry = |column: usize| column * height + row;
        for column in 0..size {
            let known = dot(column, |k| rows[entry(k)] * cholesky[at(column, k)]);
            rows[entry(column)] = (rows[entry(column)] - known) / cholesky[at(column, column)];
        }
        for column in (0..size).rev() {
            let known = (column + 1..size)
                .map(|k| rows[entry(k)] * cholesky[at(k, column)])
                .sum::<f64>();
            rows[entry(column)] = (rows[entry(column)] - known) / cholesky[at(column, column)];
        }
    }
}

/// Fills a column-major matrix with this many rows, entry by entry.
fn fill(matrix: &mut [f64], rows: usize, value: impl Fn(usize, usize) -> f64) {
    for (column, entries) in matrix.chunks_exact_mut(rows).enumerate() {
        for (row, entry) in entries.iter_mut().enumerate() {
            *entry = value(row, column);
        }
    }
}

fn dot(length: usize, term: impl Fn(usize) -> f64) -> f64 {
    (0..length).map(term).sum()
}
