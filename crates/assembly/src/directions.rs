//! What each direction of a joint does in the model: rigid, elastic or free.

use hyperstat_joints::{Dof, DofSet};
use nalgebra::{DMatrix, Matrix6, Rotation3, Vector6};

use crate::model::{Connection, JointStiffness};

/// The directions of a joint, sorted by what they do, with the elastic ones' stiffness.
#[derive(Debug, Clone)]
pub(crate) struct Directions {
    /// Held without give.
    pub rigid: DofSet,
    /// Held by a spring.
    pub elastic: DofSet,
    /// Not held.
    pub free: DofSet,
    /// Stiffness over the directions; zero outside the elastic ones.
    pub stiffness: Matrix6<f64>,
    /// Its inverse over the elastic directions, zero outside; `None` where it has none.
    pub compliance: Option<Matrix6<f64>>,
}

impl Directions {
    /// Directions of a connection, by the rules of the file format: a stiffness in the file
    /// replaces the joint's own; zero on a locked direction leaves it locked, on a constrained
    /// one frees it.
    pub fn of(connection: &Connection) -> Self {
        let (given, stiffness) = given_stiffness(connection);
        let by_kind = connection.joint.free();
        let mut this = Self {
            rigid: DofSet::EMPTY,
            elastic: DofSet::EMPTY,
            free: DofSet::EMPTY,
            stiffness,
            compliance: None,
        };
        for dof in Dof::ALL {
            let d = dof.index();
            let freed = given.contains(dof) && !by_kind.contains(dof);
            let open = by_kind.contains(dof) && !connection.locked.contains(dof);
            let set = if stiffness[(d, d)] > 0.0 {
                &mut this.elastic
            } else if freed || open {
                &mut this.free
            } else {
                &mut this.rigid
            };
            set.insert(dof);
        }
        this.compliance = inverse_on(&stiffness, this.elastic);
        this
    }

    /// Whether elastic directions share stiffness.
    pub fn is_coupled(&self) -> bool {
        let diagonal = Matrix6::from_diagonal(&self.stiffness.diagonal());
        self.stiffness != diagonal
    }

    /// The compliance of some of the elastic directions, zero elsewhere.
    pub fn compliance_of(&self, set: DofSet) -> Matrix6<f64> {
        let mut out = self.compliance.unwrap_or_default();
        for dof in set.complement().iter() {
            out.row_mut(dof.index()).fill(0.0);
            out.column_mut(dof.index()).fill(0.0);
        }
        out
    }
}

/// The directions whose stiffness is given, and the stiffness over all six.
fn given_stiffness(connection: &Connection) -> (DofSet, Matrix6<f64>) {
    match (&connection.stiffness, connection.joint.compliance()) {
        (JointStiffness::Matrix(k), _) => (DofSet::ALL, (k + k.transpose()) * 0.5),
        (JointStiffness::Directions(values), Some(own)) if values.iter().all(Option::is_none) => {
            let given: DofSet = Dof::ALL
                .into_iter()
                .filter(|d| own[(d.index(), d.index())] > 0.0)
                .collect();
            (given, inverse_on(&own, given).unwrap_or_default())
        }
        (JointStiffness::Directions(values), _) => {
            let given = Dof::ALL
                .into_iter()
                .filter(|d| values[d.index()].is_some())
                .collect();
            let diagonal = values.map(Option::unwrap_or_default);
            (given, Matrix6::from_diagonal(&Vector6::from(diagonal)))
        }
    }
}

/// Inverse of the block of `matrix` over `set`, zero elsewhere; `None` where the block, scaled to
/// a unit diagonal, is singular to 1e-10.
pub(crate) fn inverse_on(matrix: &Matrix6<f64>, set: DofSet) -> Option<Matrix6<f64>> {
    let places: Vec<usize> = set.iter().map(Dof::index).collect();
    let scale: Vec<f64> = places.iter().map(|&d| matrix[(d, d)].sqrt()).collect();
    let block = DMatrix::from_fn(places.len(), places.len(), |r, c| {
        matrix[(places[r], places[c])] / (scale[r] * scale[c])
    });
    let factor = block.cholesky()?;
    if factor.l_dirty().diagonal().iter().any(|p| *p < 1e-5) {
        return None;
    }
    let inverse = factor.inverse();
    let mut out = Matrix6::zeros();
    for (r, &d) in places.iter().enumerate() {
        for (c, &e) in places.iter().enumerate() {
            out[(d, e)] = inverse[(r, c)] / (scale[r] * scale[c]);
        }
    }
    Some(out)
}

/// Maps a relative twist in global axes to the joint's directions: `q = basis⁻¹ Tᵀ (u_i − u_j)`.
pub(crate) fn to_directions(basis: &Matrix6<f64>, frame: &Rotation3<f64>) -> Matrix6<f64> {
    let inverse = if *basis == Matrix6::identity() {
        *basis
    } else {
        basis.try_inverse().unwrap_or(Matrix6::zeros())
    };
    inverse * rotation6(frame).transpose()
}

/// `diag(R, R)`.
pub(crate) fn rotation6(rotation: &Rotation3<f64>) -> Matrix6<f64> {
    let mut out = Matrix6::zeros();
    out.fixed_view_mut::<3, 3>(0, 0)
        .copy_from(rotation.matrix());
    out.fixed_view_mut::<3, 3>(3, 3)
        .copy_from(rotation.matrix());
    out
}
