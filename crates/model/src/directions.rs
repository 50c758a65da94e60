//! What each direction of a joint does in the model: rigid, elastic or free.

use hyperstat_joints::{Dof, DofSet};
use nalgebra::{DMatrix, Matrix6, Rotation3, RowVector6, Vector6};

use crate::parts::{Connection, JointStiffness};

/// The directions of a joint, sorted by what they do, with the elastic ones' stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct Directions {
    /// Held without give.
    pub rigid: DofSet,
    /// Held by a spring.
    pub elastic: DofSet,
    /// Not held.
    pub free: DofSet,
    /// Stiffness over the directions; zero outside the elastic ones.
    pub stiffness: Matrix6<f64>,
    /// Whether that is all: a joint's own compliance may be singular, rigid in some combination
    /// of its directions, and then serves only inside a subassembly.
    pub has_stiffness: bool,
    /// Inverse of the stiffness over the elastic directions, zero outside; `None` where it has
    /// none.
    pub compliance: Option<Matrix6<f64>>,
}

impl Connection {
    /// The directions that count as free, in mobility and over-constraint as in loop closure: those
    /// that are free by the joint's kind, be they locked or elastic, and those that a stiffness of
    /// zero frees. Every other direction counts as a constraint, elastic or not.
    pub fn released(&self) -> DofSet {
        let elasticity = Elasticity::of(self);
        self.joint.free().union(elasticity.freed(self))
    }

    /// The directions that a spring holds.
    pub fn elastic(&self) -> DofSet {
        Elasticity::of(self).elastic
    }

    /// The drives: directions that are free by the joint's kind, and locked or elastic.
    pub fn drives(&self) -> DofSet {
        self.joint
            .free()
            .intersection(self.locked.union(self.elastic()))
    }
}

impl Directions {
    /// Directions of a connection, by the rules of the file format: a stiffness in the file
    /// replaces the joint's own; zero on a locked direction leaves it locked, on a constrained
    /// one frees it.
    pub fn of(connection: &Connection) -> Self {
        let elasticity = Elasticity::of(connection);
        let open = connection.joint.free().difference(connection.locked);
        let free = open
            .difference(elasticity.elastic)
            .union(elasticity.freed(connection));
        Self {
            rigid: free.union(elasticity.elastic).complement(),
            elastic: elasticity.elastic,
            free,
            stiffness: elasticity.stiffness.unwrap_or_default(),
            has_stiffness: elasticity.stiffness.is_some(),
            compliance: elasticity.compliance,
        }
    }

    /// Whether elastic directions share stiffness.
    pub fn is_coupled(&self) -> bool {
        let diagonal = |m: &Matrix6<f64>| *m == Matrix6::from_diagonal(&m.diagonal());
        !(diagonal(&self.stiffness) && self.compliance.is_none_or(|c| diagonal(&c)))
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

/// What is said of a joint's elasticity, in the file or by the joint itself.
struct Elasticity {
    /// Directions of which anything is said.
    given: DofSet,
    elastic: DofSet,
    stiffness: Option<Matrix6<f64>>,
    compliance: Option<Matrix6<f64>>,
}

impl Elasticity {
    /// Directions that a stiffness of zero frees although the kind holds them.
    fn freed(&self, connection: &Connection) -> DofSet {
        let zero = self.given.difference(self.elastic);
        zero.difference(connection.joint.free().union(connection.locked))
    }

    fn of(connection: &Connection) -> Self {
        match (&connection.stiffness, connection.joint.compliance()) {
            (JointStiffness::Matrix(k), _) => {
                Self::of_stiffness(DofSet::ALL, (k + k.transpose()) * 0.5)
            }
            (JointStiffness::Directions(values), Some(own))
                if values.iter().all(Option::is_none) =>
            {
                let give = positive(&own);
                Self {
                    given: give,
                    elastic: give,
                    stiffness: inverse_on(&own, give),
                    compliance: Some(own),
                }
            }
            (JointStiffness::Directions(values), _) => {
                let given = Dof::ALL.into_iter();
                let given = given.filter(|d| values[d.index()].is_some()).collect();
                let diagonal = Vector6::from(values.map(Option::unwrap_or_default));
                Self::of_stiffness(given, Matrix6::from_diagonal(&diagonal))
            }
        }
    }

    fn of_stiffness(given: DofSet, stiffness: Matrix6<f64>) -> Self {
        let elastic = positive(&stiffness);
        Self {
            given,
            elastic,
            stiffness: Some(stiffness),
            compliance: inverse_on(&stiffness, elastic),
        }
    }
}

/// Directions with a positive diagonal entry.
fn positive(matrix: &Matrix6<f64>) -> DofSet {
    let all = Dof::ALL.into_iter();
    all.filter(|d| matrix[(d.index(), d.index())] > 0.0)
        .collect()
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
pub fn to_directions(basis: &Matrix6<f64>, frame: &Rotation3<f64>) -> Matrix6<f64> {
    let inverse = if *basis == Matrix6::identity() {
        *basis
    } else {
        basis.try_inverse().unwrap_or(Matrix6::zeros())
    };
    inverse * rotation6(frame).transpose()
}

/// `diag(R, R)`.
pub fn rotation6(rotation: &Rotation3<f64>) -> Matrix6<f64> {
    let mut out = Matrix6::zeros();
    out.fixed_view_mut::<3, 3>(0, 0)
        .copy_from(rotation.matrix());
    out.fixed_view_mut::<3, 3>(3, 3)
        .copy_from(rotation.matrix());
    out
}

/// Unit rows of a joint's conditions on the relative twist at the joint, in global axes with
/// translations over `size`.
pub fn condition_rows(
    to_directions: &Matrix6<f64>,
    set: DofSet,
    size: f64,
) -> impl Iterator<Item = RowVector6<f64>> {
    let local = *to_directions;
    set.iter().map(move |dof| {
        let mut row = local.row(dof.index()).into_owned();
        for c in 0..3 {
            row[c] *= size;
        }
        let norm = row.norm();
        row / norm
    })
}
