//! Motions that need no energy, sorted into idle ones and motions of the output.

use std::collections::{BTreeMap, HashMap};

use hyperstat_model::{BodyId, Geometry, Model, NodeId};
use nalgebra::{Cholesky, DMatrix, DVector, Matrix6, Vector6};

use crate::error::SolveError;
use crate::kinematics::Kinematics;
use crate::kinematics::diagnosis::Diagnosis;
use crate::kinematics::motion::{Motion, describe, node_twist};
use crate::plan::Plan;
use crate::plan::workspace::Workspace;
use crate::posture::Posture;
use crate::rank::dense::{Elimination, RANK_TOLERANCE};
use crate::rank::echelon::echelon;
use crate::rank::sparse::SparseElimination;
use crate::state::acting::Acting;

/// Loads work on a motion where their work is above this share of Σ |wrench| |motion| over the
/// bodies that move.
const WORKING: f64 = 1e-6;

/// More motions than this are held by the pivots of a sparse elimination.
const MANY: usize = 32;

/// What the drives, constraints and springs of a configuration leave without resistance.
#[derive(Debug, Clone)]
pub(crate) struct Restraint {
    /// Motions that leave the output where it is.
    pub idle: Vec<Motion>,
    /// Motions that move the output, one for each of its free twists.
    pub moving: Vec<Motion>,
    /// Twists of the output without energy; orthonormal with translations over `size`.
    pub free_twists: Vec<Vector6<f64>>,
    pub size: f64,
}

impl Restraint {
    /// That of a mechanism of this size \[m\] in which nothing moves without energy.
    pub fn none(size: f64) -> Self {
        Self {
            idle: Vec::new(),
            moving: Vec::new(),
            free_twists: Vec::new(),
            size,
        }
    }

    /// That of a configuration which nothing else is asked of.
    ///
    /// # Errors
    /// Motions too many and too long for memory.
    pub fn of(at: &Posture<'_>, output: NodeId) -> Result<Self, SolveError> {
        let diagnosis = Diagnosis::default();
        Self::new(at, diagnosis.kinematics(at)?, output)
    }

    /// That of a configuration whose motions are known.
    ///
    /// # Errors
    /// Motions too many for memory.
    pub fn new(
        at: &Posture<'_>,
        kinematics: &Kinematics,
        output: NodeId,
    ) -> Result<Self, SolveError> {
        let Posture {
            model,
            geometry,
            size,
            ..
        } = *at;
        let (idle, moving) = split(&kinematics.motions, size, |motion| {
            scaled(&node_twist(motion, model, geometry, output.0), size)
        })?;
        let twists = moving
            .iter()
            .map(|m| scaled(&node_twist(m, model, geometry, output.0), size));
        let free_twists = orthonormal(twists.collect());
        Ok(Self {
            idle,
            moving,
            free_twists,
            size,
        })
    }

    /// Refuses loads that work on a motion that nothing resists.
    pub fn check_loads(&self, at: &Posture<'_>, acting: &[Acting]) -> Result<(), SolveError> {
        acting
            .iter()
            .enumerate()
            .try_for_each(|(set, acting)| self.check_state(at, set, acting))
    }

    fn check_state(&self, at: &Posture<'_>, set: usize, acting: &Acting) -> Result<(), SolveError> {
        let Posture {
            model, geometry, ..
        } = *at;
        let mut loads_on: HashMap<BodyId, Vec<usize>> = HashMap::new();
        for (k, (node, _)) in acting.nodes.iter().enumerate() {
            let body = model.nodes()[node.0].body;
            loads_on.entry(body).or_default().push(k);
        }
        for motion in self.idle.iter().chain(&self.moving) {
            let moved = motion.twists.iter().filter_map(|(b, _)| loads_on.get(b));
            let wrenches = moved.flatten().map(|&k| (k, &acting.nodes[k]));
            if let Some(largest) = working(motion, model, geometry, self.size, wrenches) {
                let (node, _) = acting.nodes[largest];
                let body = model.nodes()[node.0].body;
                let motion = describe(motion, model, geometry, self.size);
                return Err(match acting.preloaded(largest) {
                    Some(joint) => SolveError::PreloadOnFreeMotion {
                        joint: model.joints()[joint.0].name.clone(),
                        body,
                        motion,
                    },
                    None => SolveError::LoadOnFreeMotion {
                        node: model.node_name(node),
                        body,
                        load: Some(largest).filter(|k| set == 0 && *k < model.loads().len()),
                        motion,
                    },
                });
            }
        }
        Ok(())
    }

    /// One inner coordinate a motion without energy, to be held at zero: the coordinates with
    /// the largest minor, by complete pivoting.
    pub fn pins(&self, plan: &Plan, at: &Posture<'_>, workspace: &Workspace) -> Vec<usize> {
        let Posture {
            model, geometry, ..
        } = *at;
        let moving = if plan.output_is_independent() {
            &[][..]
        } else {
            &self.moving[..]
        };
        let motions = self.idle.iter().chain(moving);
        if motions.clone().count() > MANY {
            return self.sparse_pins(motions, plan, model, geometry, workspace);
        }
        let mut columns: Vec<DVector<f64>> = Vec::new();
        for motion in motions {
            let entry = |idc: usize, _: usize| {
                let (node, dof) = workspace.identities[idc];
                scaled(&node_twist(motion, model, geometry, node.0), self.size)[dof.index()]
            };
            columns.push(DVector::from_fn(plan.inner, entry));
        }
        largest_minor(columns, RANK_TOLERANCE)
    }

    /// [`Self::pins`] of many motions, each of few bodies: the pivots of an elimination.
    fn sparse_pins<'m>(
        &self,
        motions: impl Iterator<Item = &'m Motion>,
        plan: &Plan,
        model: &Model,
        geometry: &Geometry,
        workspace: &Workspace,
    ) -> Vec<usize> {
        let mut idcs_of: Vec<Vec<usize>> = vec![Vec::new(); model.bodies().len()];
        for (idc, (node, _)) in workspace.identities[..plan.inner].iter().enumerate() {
            idcs_of[model.nodes()[node.0].body.0].push(idc);
        }
        let rows = motions.map(|motion| {
            let idcs = motion.twists.iter().flat_map(|(body, _)| &idcs_of[body.0]);
            let entries = idcs.map(|&idc| {
                let (node, dof) = workspace.identities[idc];
                let twist = scaled(&node_twist(motion, model, geometry, node.0), self.size);
                (idc, twist[dof.index()])
            });
            let mut row: Vec<_> = entries.filter(|(_, value)| *value != 0.0).collect();
            row.sort_unstable_by_key(|(idc, _)| *idc);
            row
        });
        let solved = SparseElimination::new(rows.collect(), plan.inner);
        solved.pivot_columns().collect()
    }
}

/// Whether numbered wrenches (on nodes, global axes) work on a motion: the number of the one with
/// the largest share, `None` where they do not. `size` is the mechanism's.
pub(crate) fn working<'a>(
    motion: &Motion,
    model: &Model,
    geometry: &Geometry,
    size: f64,
    wrenches: impl Iterator<Item = (usize, &'a (NodeId, Vector6<f64>))>,
) -> Option<usize> {
    let mut work = 0.0;
    let mut scale = 0.0;
    let mut largest = (0, 0.0);
    for (k, (node, wrench)) in wrenches {
        let twist = node_twist(motion, model, geometry, node.0);
        let share = wrench.dot(&twist);
        work += share;
        // A body that moves at all moves a load by rounding: no less is taken.
        let (linear, angular) = (twist.fixed_rows::<3>(0), twist.fixed_rows::<3>(3));
        let travel = linear.norm().max(angular.norm() * size);
        scale += wrench.fixed_rows::<3>(0).norm() * travel;
        scale += wrench.fixed_rows::<3>(3).norm() * angular.norm();
        if share.abs() > largest.1 {
            largest = (k, share.abs());
        }
    }
    (work.abs() > WORKING * scale).then_some(largest.0)
}

/// Rows of the largest minor of some columns, one a column, by complete pivoting; fewer where no
/// more is left than `least`.
pub(crate) fn largest_minor(mut columns: Vec<DVector<f64>>, least: f64) -> Vec<usize> {
    let mut pins = Vec::new();
    for k in 0..columns.len() {
        let mut best = (k, 0, 0.0);
        for (c, column) in columns.iter().enumerate().skip(k) {
            let row = column.iamax();
            if column[row].abs() > best.2 {
                best = (c, row, column[row].abs());
            }
        }
        if best.2 <= least {
            break;
        }
        columns.swap(k, best.0);
        let row = best.1;
        let pivot = &columns[k] / columns[k][row];
        for column in &mut columns[k + 1..] {
            let factor = column[row];
            *column -= &pivot * factor;
        }
        pins.push(row);
    }
    pins
}

/// A twist with its translations over `size`.
pub(crate) fn scaled(twist: &Vector6<f64>, size: f64) -> Vector6<f64> {
    let mut out = *twist;
    for k in 0..3 {
        out[k] /= size;
    }
    out
}

/// Splits a basis of motions into those without a twist of the output and the rest.
fn split(
    motions: &[Motion],
    size: f64,
    twist: impl Fn(&Motion) -> Vector6<f64>,
) -> Result<(Vec<Motion>, Vec<Motion>), SolveError> {
    let twists: Vec<Vector6<f64>> = motions.iter().map(&twist).collect();
    let still = |t: &Vector6<f64>| t.amax() <= RANK_TOLERANCE;
    if twists.iter().all(still) {
        return Ok((motions.to_vec(), Vec::new()));
    }
    if motions.len() > MANY && twists.iter().any(still) {
        // Those that leave the output where it is need not be combined.
        let (at_rest, others): (Vec<_>, Vec<_>) =
            (motions.iter().cloned().zip(&twists)).partition(|(_, t)| still(t));
        let others: Vec<Motion> = others.into_iter().map(|(motion, _)| motion).collect();
        let (mut idle, moving) = split(&others, size, twist)?;
        idle.extend(at_rest.into_iter().map(|(motion, _)| motion));
        return Ok((idle, moving));
    }
    let count = motions.len();
    if count > MANY {
        return sparsely_split(motions, &twists, size);
    }
    let matrix = DMatrix::from_fn(6, count, |r, c| twists[c][r]);
    let idle = echelon(Elimination::new(matrix, 0).null_space());
    // The motions that are no pivot of an idle combination move the output independently.
    let mut pivots = Vec::new();
    for combination in &idle {
        let free = (0..count).filter(|k| !pivots.contains(k));
        let pivot = free.max_by(|a, b| combination[*a].abs().total_cmp(&combination[*b].abs()));
        pivots.extend(pivot);
    }
    let combined = idle.iter().map(|weights| {
        let parts = motions.iter().zip(weights.iter().copied());
        combine(parts, size)
    });
    let combined = combined.collect();
    let rest = (0..count).filter(|k| !pivots.contains(k));
    Ok((combined, rest.map(|k| motions[k].clone()).collect()))
}

/// [`split`] of many motions, all of which move the output: six at the most stay as they are, and
/// each of the others has those taken off that it takes to leave the output at rest.
fn sparsely_split(
    motions: &[Motion],
    twists: &[Vector6<f64>],
    size: f64,
) -> Result<(Vec<Motion>, Vec<Motion>), SolveError> {
    let rows = (0..6).map(|r| {
        let entries = twists.iter().enumerate().map(|(c, twist)| (c, twist[r]));
        entries.filter(|(_, value)| *value != 0.0).collect()
    });
    let solved = SparseElimination::new(rows.collect(), motions.len());
    let combined = solved.null_space()?.into_iter().map(|weights| {
        let parts = weights.into_iter().map(|(k, weight)| (&motions[k], weight));
        combine(parts, size)
    });
    let rest = solved.pivot_columns().map(|k| motions[k].clone());
    Ok((combined.collect(), rest.collect()))
}

fn combine<'m>(parts: impl Iterator<Item = (&'m Motion, f64)>, size: f64) -> Motion {
    let mut twists: BTreeMap<BodyId, Vector6<f64>> = BTreeMap::new();
    for (motion, weight) in parts {
        for (body, twist) in &motion.twists {
            *twists.entry(*body).or_default() += twist * weight;
        }
    }
    let moves = |twist: &Vector6<f64>| scaled(twist, size).amax() > 1e-9;
    let moved = twists.into_iter().filter(|(_, twist)| moves(twist));
    Motion {
        twists: moved.collect(),
    }
}

/// Orthonormal basis of the span of `vectors`.
fn orthonormal(vectors: Vec<Vector6<f64>>) -> Vec<Vector6<f64>> {
    let mut basis: Vec<Vector6<f64>> = Vec::new();
    for mut v in vectors {
        for _ in 0..2 {
            for b in &basis {
                v -= b * b.dot(&v);
            }
        }
        if v.norm() > RANK_TOLERANCE {
            basis.push(v.normalize());
        }
    }
    basis
}

/// Pivots of the scaled output stiffness below this ask for a look at the mechanism's freedom.
pub(crate) const SUSPICIOUS_PIVOT: f64 = 1e-9;

/// Inverse of a symmetric matrix scaled to a unit diagonal; `None` where a pivot is not above
/// `least` (or zero).
pub(crate) fn inverse(matrix: &Matrix6<f64>, least: f64) -> Option<Matrix6<f64>> {
    let scale = matrix.diagonal().map(f64::sqrt);
    if !scale.iter().all(|s| *s > 0.0 && s.is_finite()) {
        return None;
    }
    let unit = Matrix6::from_fn(|r, c| matrix[(r, c)] / (scale[r] * scale[c]));
    let factor = Cholesky::new(unit)?;
    if factor.l_dirty().diagonal().iter().any(|p| p * p <= least) {
        return None;
    }
    let inverse = factor.inverse();
    Some(Matrix6::from_fn(|r, c| {
        inverse[(r, c)] / (scale[r] * scale[c])
    }))
}

/// Length scale of a component: the mechanism's size for translations, 1 for rotations.
pub(crate) fn scale_of(component: usize, size: f64) -> f64 {
    if component < 3 { size } else { 1.0 }
}

/// Whether the output's stiffness along or about some axis is next to nothing beside the largest, those
/// of translations at the mechanism's size: it may be rounding.
pub(crate) fn is_nearly_free(stiffness: &Matrix6<f64>, size: f64) -> bool {
    let along = |k: usize| stiffness[(k, k)] * scale_of(k, size).powi(2);
    let largest = (0..6).map(along).fold(0.0, f64::max);
    (0..6).any(|k| along(k) <= SUSPICIOUS_PIVOT * largest)
}
