//! What each direction of a joint does in the model: rigid, elastic or free.

use hyperstat_joints::{Dof, DofSet};
use nalgebra::{DMatrix, Matrix6, Rotation3};

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
        let by_kind = connection.joint.free();
        let open = by_kind.difference(connection.locked);
        let mut this = Self {
            rigid: DofSet::EMPTY,
            elastic: DofSet::EMPTY,
            free: DofSet::EMPTY,
            stiffness: Matrix6::zeros(),
            compliance: Some(Matrix6::zeros()),
        };
        let mut set = |dof: Dof, given: Option<f64>| {
            let target = match given {
                Some(k) if k > 0.0 => &mut this.elastic,
                Some(_) if !by_kind.contains(dof) => &mut this.free,
                _ if open.contains(dof) => &mut this.free,
                _ => &mut this.rigid,
            };
            target.insert(dof);
        };
        match (&connection.stiffness, connection.joint.compliance()) {
            (JointStiffness::Directions(values), None) => {
                for dof in Dof::ALL {
                    set(dof, values[dof.index()]);
                }
                for dof in this.elastic.iter() {
                    let d = dof.index();
                    this.stiffness[(d, d)] = values[d].unwrap_or_default();
                }
            }
            (JointStiffness::Directions(values), Some(own))
                if values.iter().all(Option::is_none) =>
            {
                for dof in Dof::ALL {
                    let c = own[(dof.index(), dof.index())];
                    set(dof, (c > 0.0).then_some(1.0));
                }
                this.stiffness = inverse_on(&own, this.elastic).unwrap_or(Matrix6::zeros());
            }
            (JointStiffness::Directions(values), Some(_)) => {
                for dof in Dof::ALL {
                    set(dof, values[dof.index()]);
                }
                for dof in this.elastic.iter() {
                    let d = dof.index();
                    this.stiffness[(d, d)] = values[d].unwrap_or_default();
                }
            }
            (JointStiffness::Matrix(k), _) => {
                for dof in Dof::ALL {
                    set(dof, Some(k[(dof.index(), dof.index())]));
                }
                this.stiffness = (k + k.transpose()) * 0.5;
            }
        }
        this.compliance = inverse_on(&this.stiffness, this.elastic);
        this
    }

    /// Directions that a coordinate of its own may follow: free and elastic ones.
    pub fn moving(&self) -> DofSet {
        self.free.union(self.elastic)
    }
}

/// Inverse of the block of `matrix` over `set`, zero elsewhere; `None` where the block, scaled to
/// a unit diagonal, is singular to 1e-10.
fn inverse_on(matrix: &Matrix6<f64>, set: DofSet) -> Option<Matrix6<f64>> {
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
