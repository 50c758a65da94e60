//! The conditions that joints put on bodies taken as rigid, and what elimination says of them.
//!
//! Every body has a twist at its first node; the ground has none. A small mechanism is eliminated
//! with complete pivoting, a large one by sparse rows.

use hyperstat_joints::{Dof, rigid_motion};
use hyperstat_model::{BodyId, Connection, Directions, JointId, Model, condition_rows};
use nalgebra::{DMatrix, DVector, Matrix6, RowVector6, Vector6};

use super::motion::Motion;
use crate::error::SolveError;
use crate::posture::Posture;
use crate::rank::dense::Elimination;
use crate::rank::echelon::echelon;
use crate::rank::sparse::{SparseElimination, SparseVector};

/// Most bodies or joints whose conditions are eliminated with complete pivoting.
const SMALL: usize = 40;
/// Most motions that are brought into echelon form in a large mechanism.
const FEW: usize = 8;

/// Conditions on the scaled twists of all bodies, sparse by rows.
#[derive(Debug)]
pub(crate) struct Jacobian {
    bodies: usize,
    /// Length that translations are divided by (m).
    size: f64,
    /// Whether they are too many for complete pivoting.
    large: bool,
    rows: Vec<Vec<(usize, RowVector6<f64>)>>,
    /// Joint and direction of every row.
    pub directions: Vec<(JointId, Dof)>,
}

/// Conditions eliminated.
#[derive(Debug)]
pub(crate) enum Eliminated {
    /// With complete pivoting.
    Dense(Elimination),
    /// By sparse rows.
    Sparse(SparseElimination),
}

impl Eliminated {
    /// Rank of the conditions.
    pub fn rank(&self) -> usize {
        match self {
            Self::Dense(solved) => solved.rank(),
            Self::Sparse(solved) => solved.rank(),
        }
    }

    /// The largest pivot between zero and not zero.
    pub fn doubtful(&self) -> Option<f64> {
        match self {
            Self::Dense(solved) => solved.doubtful,
            Self::Sparse(solved) => solved.doubtful,
        }
    }
}

impl Jacobian {
    /// Rows of the directions that every joint constrains, drives released.
    pub fn released(at: &Posture<'_>) -> Self {
        Self::new(at, released_rows, is_large(at.model))
    }

    /// Rows of the rigid and elastic directions of every joint.
    pub fn held(at: &Posture<'_>) -> Self {
        Self::new(at, held_rows, is_large(at.model))
    }

    /// Rows of every joint by `conditions`, which gets the joint, the map from a relative twist to
    /// its directions, and the length that translations are divided by.
    fn new(
        at: &Posture<'_>,
        conditions: impl Fn(&Connection, &Matrix6<f64>, f64) -> Vec<(Dof, RowVector6<f64>)>,
        large: bool,
    ) -> Self {
        let Posture {
            model, geometry, ..
        } = *at;
        let size = if large { at.arm_length() } else { at.size };
        let mut rows = Vec::new();
        let mut directions = Vec::new();
        for (k, joint) in model.joints().iter().enumerate() {
            let local = at.direction_map(JointId(k));
            for (dof, condition) in conditions(joint, &local, size) {
                let mut row = Vec::with_capacity(2);
                for (node, sign) in joint.between.iter().zip([1.0, -1.0]) {
                    let Some(node) = node else { continue };
                    let body = model.nodes()[node.0].body;
                    let origin = model.bodies()[body.0].nodes[0];
                    let arm = geometry.positions[node.0] - geometry.positions[origin.0];
                    row.push((body.0, condition * rigid_motion(&(arm / size)) * sign));
                }
                rows.push(row);
                directions.push((JointId(k), dof));
            }
        }
        Self {
            bodies: model.bodies().len(),
            size,
            large,
            rows,
            directions,
        }
    }

    /// The conditions as a matrix, six columns a body.
    pub fn dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.rows.len(), 6 * self.bodies);
        for (r, row) in self.rows.iter().enumerate() {
            for (body, entries) in row {
                let mut view = dense.fixed_view_mut::<1, 6>(r, 6 * body);
                view += entries;
            }
        }
        dense
    }

    /// The conditions by their entries, columns as in the matrix.
    fn sparse(&self) -> Vec<SparseVector> {
        let rows = self.rows.iter();
        rows.map(|row| {
            let entries = row.iter().flat_map(|(body, entries)| {
                let entries = entries.iter().enumerate();
                entries.map(move |(k, value)| (6 * body + k, *value))
            });
            let mut entries: SparseVector = entries.filter(|(_, value)| *value != 0.0).collect();
            entries.sort_unstable_by_key(|(column, _)| *column);
            entries
        })
        .collect()
    }

    /// Whether they are too many for complete pivoting.
    #[cfg(test)]
    pub fn is_large(&self) -> bool {
        self.large
    }

    /// Elimination, by sparse rows where the mechanism is large.
    pub fn eliminated(&self) -> Eliminated {
        if self.large {
            Eliminated::Sparse(self.sparsely_eliminated())
        } else {
            Eliminated::Dense(Elimination::new(self.dense(), 0))
        }
    }

    /// Elimination by sparse rows.
    fn sparsely_eliminated(&self) -> SparseElimination {
        SparseElimination::new(self.sparse(), 6 * self.bodies)
    }

    /// A basis of the motions that meet the conditions: of few bodies each, largest entry 1 with
    /// translations over `size`.
    ///
    /// # Errors
    /// Too many motions of too many bodies each.
    pub fn motions(&self, eliminated: &Eliminated, size: f64) -> Result<Vec<Motion>, SolveError> {
        Ok(match eliminated {
            Eliminated::Dense(solved) => self.echelon_motions(solved.null_space(), size),
            Eliminated::Sparse(solved) => {
                let basis = solved.null_space()?;
                if basis.len() > FEW {
                    return Ok(basis.iter().map(|v| self.motion(v, size)).collect());
                }
                let full = |v: &SparseVector| {
                    let mut full = DVector::zeros(6 * self.bodies);
                    for (column, value) in v {
                        full[*column] = self.rescaled(*column, *value, size);
                    }
                    full
                };
                self.echelon_motions(basis.iter().map(full).collect(), size)
            }
        })
    }

    /// With doubtful conditions left out, the motion that breaks them most; translations over
    /// `size`.
    ///
    /// # Errors
    /// Too many motions of too many bodies each.
    pub fn nearly_free(&self, size: f64) -> Result<Option<Motion>, SolveError> {
        let basis: Vec<SparseVector> = if self.large {
            SparseElimination::without_doubtful(self.sparse(), 6 * self.bodies).null_space()?
        } else {
            let solved = Elimination::without_doubtful(self.dense());
            echelon(solved.null_space()).iter().map(entries).collect()
        };
        let rows = self.sparse();
        let mut users = vec![Vec::new(); 6 * self.bodies];
        for (r, row) in rows.iter().enumerate() {
            for (column, _) in row {
                users[*column].push(r);
            }
        }
        let broken = |motion: &SparseVector| {
            let value = |column: &usize| match motion.binary_search_by_key(column, |(c, _)| *c) {
                Ok(place) => motion[place].1,
                Err(_) => 0.0,
            };
            let touched = motion.iter().flat_map(|(column, _)| &users[*column]);
            let products = touched.map(|&r| rows[r].iter().map(|(c, v)| v * value(c)).sum());
            products.fold(0.0, |most: f64, product: f64| most.max(product.abs()))
        };
        let motions = basis.into_iter().map(|motion| (broken(&motion), motion));
        let worst = motions.max_by(|a, b| a.0.total_cmp(&b.0));
        Ok(worst.map(|(_, motion)| self.motion(&motion, size)))
    }

    /// Motions of a basis in echelon form, whose translations are over `size` already.
    fn echelon_motions(&self, basis: Vec<DVector<f64>>, size: f64) -> Vec<Motion> {
        let own = Self {
            size,
            rows: Vec::new(),
            directions: Vec::new(),
            ..*self
        };
        let basis = echelon(basis);
        let motions = basis.iter().map(|v| own.motion(&entries(v), size));
        motions.collect()
    }

    /// An entry of a motion with translations over `size`.
    fn rescaled(&self, column: usize, value: f64, size: f64) -> f64 {
        if column % 6 < 3 {
            value * (self.size / size)
        } else {
            value
        }
    }

    /// The motion of a vector of scaled twists, its largest entry 1 with translations over
    /// `size`; its translations in metres.
    fn motion(&self, vector: &[(usize, f64)], size: f64) -> Motion {
        let rescaled = |(c, v): &(usize, f64)| (*c, self.rescaled(*c, *v, size));
        let entries: SparseVector = vector.iter().map(rescaled).collect();
        let largest = entries
            .iter()
            .fold(0.0_f64, |most, (_, v)| most.max(v.abs()));
        let mut twists: Vec<(BodyId, Vector6<f64>)> = Vec::new();
        for (column, value) in entries {
            let share = value / largest;
            if share.abs() < 1e-9 {
                continue;
            }
            let (body, k) = (BodyId(column / 6), column % 6);
            if twists.last().is_none_or(|(last, _)| *last != body) {
                twists.push((body, Vector6::zeros()));
            }
            if let Some((_, twist)) = twists.last_mut() {
                twist[k] = share * if k < 3 { size } else { 1.0 };
            }
        }
        Motion { twists }
    }
}

/// Whether a mechanism has too many conditions for complete pivoting.
fn is_large(model: &Model) -> bool {
    model.bodies().len().max(model.joints().len()) > SMALL
}

fn entries(vector: &DVector<f64>) -> SparseVector {
    let entries = vector.iter().copied().enumerate();
    entries.filter(|(_, value)| *value != 0.0).collect()
}

/// Rows of the directions that a joint constrains with its drives released.
fn released_rows(
    joint: &Connection,
    local: &Matrix6<f64>,
    size: f64,
) -> Vec<(Dof, RowVector6<f64>)> {
    let set = joint.released().complement();
    set.iter().zip(condition_rows(local, set, size)).collect()
}

/// Rows of the rigid and elastic directions of a joint.
fn held_rows(joint: &Connection, local: &Matrix6<f64>, size: f64) -> Vec<(Dof, RowVector6<f64>)> {
    let held = Directions::of(joint);
    let rigid = held.rigid.iter();
    let rigid = rigid.zip(condition_rows(local, held.rigid, size));
    let elastic = held.elastic.iter().zip(elastic_rows(local, &held, size));
    rigid.chain(elastic).collect()
}

/// Rows that a motion must satisfy for the elastic directions to take no energy.
fn elastic_rows(local: &Matrix6<f64>, directions: &Directions, size: f64) -> Vec<RowVector6<f64>> {
    if directions.compliance.is_some() {
        return condition_rows(local, directions.elastic, size).collect();
    }
    // Rows of `k q`, each of unit length: its null space is that of k.
    let k = &directions.stiffness;
    let mut scaled = *local;
    scaled.fixed_columns_mut::<3>(0).scale_mut(size);
    let elastic = directions.elastic.iter();
    elastic
        .map(|dof| (k.row(dof.index()) * scaled).normalize())
        .collect()
}
