//! What the tests of the joints share: Eq. 23, and the comparison of a closed form with N.

use nalgebra::{Matrix3, Matrix6, RowVector3, Vector3, Vector6};

use crate::dof::{Dof, DofSet};
use crate::joint::Joint;
use crate::mapping::Mapping;
use crate::testing::frames;

/// Largest difference between N and the closed forms, whose denominators are not small on the
/// axes that N chooses.
const ROUNDING: f64 = 1e-14;

/// Eq. 23 with the component `k` as the IDC (printed for k = y): `φ_i = c φ_ik + M φ_j`, or the
/// same of translations; `c` and `M` with the row of the IDC filled in.
pub fn equation_23(r: &Matrix3<f64>, k: usize) -> (Vector3<f64>, Matrix3<f64>) {
    let inverse = r.transpose();
    let q = [inverse.row(0), inverse.row(2)];
    let a = |row: usize| -> RowVector3<f64> { q[0] * r[(row, 0)] + q[1] * r[(row, 2)] };
    let mut column = Vector3::zeros();
    let mut block = Matrix3::zeros();
    for row in 0..3 {
        if row == k {
            column[row] = 1.0;
        } else {
            let ratio = r[(row, 1)] / r[(k, 1)];
            column[row] = ratio;
            block.set_row(row, &(a(row) - a(k) * ratio));
        }
    }
    (column, block)
}

/// `[delta; phi]`
pub fn stack(delta: Vector3<f64>, phi: Vector3<f64>) -> Vector6<f64> {
    let mut column = Vector6::zeros();
    column.fixed_rows_mut::<3>(0).copy_from(&delta);
    column.fixed_rows_mut::<3>(3).copy_from(&phi);
    column
}

/// `[delta 0; 0 phi]`
pub fn block_diagonal(delta: &Matrix3<f64>, phi: &Matrix3<f64>) -> Matrix6<f64> {
    let mut block = Matrix6::zeros();
    block.fixed_view_mut::<3, 3>(0, 0).copy_from(delta);
    block.fixed_view_mut::<3, 3>(3, 3).copy_from(phi);
    block
}

/// Asserts that, in all test frames, N of the free joint is the closed form `expected`, called
/// with the matrix of the frame and the IDCs that were chosen: their columns, and the block of
/// `u_j`. Returns the choices of IDCs that occurred, each once.
pub fn assert_closed_form(
    joint: &dyn Joint,
    expected: impl Fn(&Matrix3<f64>, &[Dof]) -> (Vec<Vector6<f64>>, Matrix6<f64>),
) -> Vec<DofSet> {
    let mut choices = Vec::new();
    for frame in frames() {
        let mapping: Mapping = joint.mapping(&frame, joint.free()).unwrap();
        let idcs: Vec<Dof> = mapping.idcs().iter().collect();
        let (n_i, n_j) = expected(frame.matrix(), &idcs);
        assert_eq!(mapping.len(), n_i.len(), "{frame}");
        for (column, exact) in mapping.n_i().iter().zip(&n_i) {
            assert!((column - exact).amax() < ROUNDING, "{column}{exact}{frame}");
        }
        let block = mapping.n_j();
        assert!((block - n_j).amax() < ROUNDING, "{block}{n_j}{frame}");
        if !choices.contains(&mapping.idcs()) {
            choices.push(mapping.idcs());
        }
    }
    choices
}
