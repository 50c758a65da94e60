//! Elastic bodies of any shape, by a stiffness that another program computed.

use nalgebra::{DMatrix, Matrix6, Point3, Vector3, Vector6};

use crate::error::ElementError;
use crate::frame::transport;

/// What a symmetric entry may differ by across the diagonal, and a motion of the whole body may be
/// resisted, relative to the diagonal: the rounding of a file with seven digits.
const ROUNDING: f64 = 1e-6;

/// An eigenvalue of the held stiffness, scaled to a unit diagonal, that counts as zero.
const NO_ENERGY: f64 = 1e-12;

/// The motions of a body as a whole, in the order of a displacement's components.
const MOTIONS: [&str; 6] = [
    "a translation along x",
    "a translation along y",
    "a translation along z",
    "a rotation about x",
    "a rotation about y",
    "a rotation about z",
];

/// An elastic body by its stiffness over n nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct FlexibleBody {
    stiffness: DMatrix<f64>,
    held: DMatrix<f64>,
}

impl FlexibleBody {
    /// A body with nodes at `positions` \[m\] and this 6n×6n stiffness \[N/m, N, N·m\]: wrenches on
    /// the nodes per displacement of the nodes, six rows and columns a node in the order of
    /// `positions`, linear part first, in the axes of `positions`.
    ///
    /// The stiffness must be symmetric and positive semidefinite, with the six motions of the body
    /// as a whole its only ones without energy. It may be rounded to about seven digits; the body
    /// is then held at node 0 and the rows and columns of that node follow from equilibrium, so
    /// that a motion of the whole body gives no force at all.
    ///
    /// # Errors
    /// [`ElementError::TooFewNodes`], [`StiffnessSize`](ElementError::StiffnessSize),
    /// [`NotFiniteEntry`](ElementError::NotFiniteEntry), [`NotSymmetric`](ElementError::NotSymmetric),
    /// [`ResistsRigidMotion`](ElementError::ResistsRigidMotion),
    /// [`NegativeEnergy`](ElementError::NegativeEnergy) and
    /// [`MoreThanSixFreeMotions`](ElementError::MoreThanSixFreeMotions): the first that applies.
    pub fn new(positions: &[Point3<f64>], stiffness: &DMatrix<f64>) -> Result<Self, ElementError> {
        let wanted = 6 * positions.len();
        if positions.len() < 2 {
            return Err(ElementError::TooFewNodes);
        }
        if stiffness.shape() != (wanted, wanted) {
            return Err(ElementError::StiffnessSize {
                rows: stiffness.nrows(),
                columns: stiffness.ncols(),
                nodes: positions.len(),
                wanted,
            });
        }
        check_symmetry(stiffness)?;
        check_rigid_motions(positions, stiffness)?;
        let stiffness = (stiffness + stiffness.transpose()) * 0.5;
        let held = stiffness
            .view((6, 6), (wanted - 6, wanted - 6))
            .into_owned();
        check_energy(&held)?;
        Ok(Self { stiffness, held })
    }

    /// Number of nodes n.
    pub fn nodes(&self) -> usize {
        self.stiffness.nrows() / 6
    }

    /// Stiffness over all nodes, 6n×6n, as it was given; symmetric to the last bit.
    pub fn stiffness(&self) -> &DMatrix<f64> {
        &self.stiffness
    }

    /// Stiffness over nodes 1..n with node 0 held, (6n−6)×(6n−6), positive definite.
    pub fn held_stiffness(&self) -> &DMatrix<f64> {
        &self.held
    }

    /// Stiffness of one node with all others held.
    ///
    /// # Panics
    /// If the body has no such node.
    pub fn node_stiffness(&self, node: usize) -> Matrix6<f64> {
        self.stiffness
            .fixed_view::<6, 6>(6 * node, 6 * node)
            .into_owned()
    }
}

/// Square roots of the diagonal; of the largest one where it is zero.
fn scales(matrix: &DMatrix<f64>) -> Vec<f64> {
    let largest = matrix.diagonal().amax();
    let scale = |d: &f64| if *d == 0.0 { largest } else { d.abs() };
    matrix.diagonal().iter().map(|d| scale(d).sqrt()).collect()
}

fn check_symmetry(matrix: &DMatrix<f64>) -> Result<(), ElementError> {
    for row in 0..matrix.nrows() {
        for column in 0..matrix.ncols() {
            if !matrix[(row, column)].is_finite() {
                return Err(ElementError::NotFiniteEntry { row, column });
            }
        }
    }
    let scales = scales(matrix);
    for row in 0..matrix.nrows() {
        for column in 0..row {
            let (value, mirrored) = (matrix[(row, column)], matrix[(column, row)]);
            if (value - mirrored).abs() > ROUNDING * scales[row] * scales[column] {
                return Err(ElementError::NotSymmetric {
                    row,
                    column,
                    value,
                    mirrored,
                });
            }
        }
    }
    Ok(())
}

/// Looks whether a motion of the whole body gives no more force than rounding.
fn check_rigid_motions(
    positions: &[Point3<f64>],
    matrix: &DMatrix<f64>,
) -> Result<(), ElementError> {
    let scales = scales(matrix);
    let count = positions.len() as f64;
    let centre: Vector3<f64> = positions.iter().map(|p| p.coords / count).sum();
    for (component, motion) in MOTIONS.into_iter().enumerate() {
        let twist = Vector6::ith(component, 1.0);
        let displacements: Vec<Vector6<f64>> = positions
            .iter()
            .map(|p| transport(&(p.coords - centre)) * twist)
            .collect();
        let displacement = |k: usize| displacements[k / 6][k % 6];
        let reach: f64 = (0..scales.len())
            .map(|k| scales[k] * displacement(k).abs())
            .sum();
        for row in 0..scales.len() {
            let terms = (0..scales.len()).map(|k| matrix[(row, k)] * displacement(k));
            let part = terms.sum::<f64>().abs() / (scales[row] * reach);
            // A matrix of zeros resists nothing, it is left to the check of the energy.
            if part > ROUNDING {
                return Err(ElementError::ResistsRigidMotion { motion, part });
            }
        }
    }
    Ok(())
}

/// Looks whether the stiffness with node 0 held is positive definite.
fn check_energy(held: &DMatrix<f64>) -> Result<(), ElementError> {
    let scales = scales(held);
    if scales.iter().all(|s| *s == 0.0) {
        return Err(ElementError::MoreThanSixFreeMotions {
            found: 6 + held.nrows(),
        });
    }
    let unit = DMatrix::from_fn(held.nrows(), held.ncols(), |r, c| {
        held[(r, c)] / (scales[r] * scales[c])
    });
    let eigenvalues = unit.symmetric_eigenvalues();
    let lowest = eigenvalues.min();
    if lowest < -ROUNDING {
        return Err(ElementError::NegativeEnergy { eigenvalue: lowest });
    }
    let free = eigenvalues.iter().filter(|e| **e <= NO_ENERGY).count();
    if free > 0 {
        return Err(ElementError::MoreThanSixFreeMotions { found: 6 + free });
    }
    Ok(())
}
