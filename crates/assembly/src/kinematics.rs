//! Mobility, over-constraint and motions without energy, from the rigid bodies' Jacobian.
//!
//! Every body is taken as rigid, with a twist at its first node. Lengths are divided by the
//! mechanism's size and every condition is a unit row, so that zero and not zero are far apart
//! (measured: zeros stay below 1e-15, non-zeros above 1e-4) and one tolerance serves all counts.

use hyperstat_joints::{Dof, rigid_motion};
use nalgebra::{DVector, Vector3, Vector6};

use crate::directions::{Directions, to_directions};
use crate::elimination::RANK_TOLERANCE;
use crate::error::SolveError;
use crate::jacobian::Jacobian;
use crate::model::{BodyId, BodyKind, Geometry, JointId, Model, NodeId};
use crate::solution::Motion;

/// Counts and motions of a mechanism whose bodies are all rigid, at one configuration.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Kinematics {
    /// Instantaneous mobility, with every direction that is free by its joint's kind released
    /// (locked or elastic though it may be), and those that a stiffness of zero frees; idle motions
    /// included.
    pub mobility: usize,
    /// Constraints less their rank.
    pub overconstraint: usize,
    /// A basis of the motions that need no energy: drives locked, springs at rest.
    pub motions: Vec<Motion>,
    /// A pivot between zero and not zero (1e-12 to 1e-4), where there is one: the counts are then
    /// those of a geometry that is only nearly the one meant.
    pub doubtful: Option<f64>,
    /// Where that is among the conditions of the held mechanism: the motion that they only
    /// nearly prevent, the softest of the mechanism.
    pub nearly_free: Option<Motion>,
}

/// Mobility, over-constraint and motions without energy of a model as it stands.
///
/// # Errors
/// [`SolveError::TooLarge`]: motions too many, of too many bodies each.
pub fn analyse(model: &Model) -> Result<Kinematics, SolveError> {
    analyse_at(model, model.geometry())
}

/// [`analyse`] in another configuration.
pub(crate) fn analyse_at(model: &Model, geometry: &Geometry) -> Result<Kinematics, SolveError> {
    let constraints = Jacobian::released(model, geometry);
    let released = constraints.eliminated();
    let conditions = Jacobian::held(model, geometry);
    let held = conditions.eliminated();
    let size = characteristic_length(geometry);
    let nearly_free = match held.doubtful() {
        Some(_) => conditions.nearly_free(size)?,
        None => None,
    };
    let motions = conditions.motions(&held, size)?;
    Ok(Kinematics {
        mobility: 6 * model.bodies().len() - released.rank(),
        overconstraint: constraints.directions.len() - released.rank(),
        motions,
        doubtful: held.doubtful().or(released.doubtful()),
        nearly_free,
    })
}

/// Diagonal of the box around all nodes (m); 1 where they coincide.
pub(crate) fn characteristic_length(geometry: &Geometry) -> f64 {
    let first = geometry
        .positions
        .first()
        .map_or(Vector3::zeros(), |p| p.coords);
    let (mut low, mut high) = (first, first);
    for p in &geometry.positions {
        low = low.inf(&p.coords);
        high = high.sup(&p.coords);
    }
    let diagonal = (high - low).norm();
    if diagonal > 0.0 { diagonal } else { 1.0 }
}

/// A basis of the same space in reduced echelon form by complete pivoting: motions of few bodies
/// each, largest entry 1, so that a person can name them.
pub(crate) fn echelon(mut basis: Vec<DVector<f64>>) -> Vec<DVector<f64>> {
    for k in 0..basis.len() {
        let mut best = (k, 0, 0.0);
        for (c, column) in basis.iter().enumerate().skip(k) {
            for (r, value) in column.iter().enumerate() {
                if value.abs() > best.2 * (1.0 + 1e-9) {
                    best = (c, r, value.abs());
                }
            }
        }
        let (column, row, _) = best;
        basis.swap(k, column);
        let pivot = &basis[k] / basis[k][row];
        for (c, other) in basis.iter_mut().enumerate() {
            if c != k {
                let factor = other[row];
                *other -= &pivot * factor;
            }
        }
        basis[k] = pivot;
    }
    for column in &mut basis {
        let largest = column.amax();
        for value in column.iter_mut() {
            *value /= largest;
            if value.abs() < 1e-9 {
                *value = 0.0;
            }
        }
    }
    basis
}

/// The displacement of a node under a motion.
pub(crate) fn node_twist(
    motion: &Motion,
    model: &Model,
    geometry: &Geometry,
    node: usize,
) -> Vector6<f64> {
    let body = model.nodes()[node].body;
    let Ok(place) = motion.twists.binary_search_by_key(&body, |(b, _)| *b) else {
        return Vector6::zeros();
    };
    let twist = motion.twists[place].1;
    let origin = model.bodies()[body.0].nodes[0];
    rigid_motion(&(geometry.positions[node] - geometry.positions[origin.0])) * twist
}

impl Motion {
    /// The motion in words, such as "`rod3` turns about (0, 0.6, 0.8) through rod3.B".
    pub fn describe(&self, model: &Model) -> String {
        self.describe_at(model, model.geometry())
    }

    /// The motion in words, of the model in another configuration than its own.
    pub(crate) fn describe_at(&self, model: &Model, geometry: &Geometry) -> String {
        describe(self, model, geometry, characteristic_length(geometry))
    }

    /// The free directions of joints along which the motion goes, in the order of the joints. A
    /// drive that holds any one of them stops this motion.
    pub fn free_directions(&self, model: &Model) -> Vec<(JointId, Dof)> {
        let geometry = model.geometry();
        let size = characteristic_length(geometry);
        let at = |node: Option<NodeId>| {
            node.map_or(Vector6::zeros(), |n| node_twist(self, model, geometry, n.0))
        };
        let mut moved = Vec::new();
        for (k, joint) in model.joints().iter().enumerate() {
            let relative = at(joint.between[0]) - at(joint.between[1]);
            let along = to_directions(&joint.joint.basis(), &geometry.frames[k]) * relative;
            for dof in Directions::of(joint).free.iter() {
                let unit = if dof.index() < 3 { size } else { 1.0 };
                if along[dof.index()].abs() > RANK_TOLERANCE * unit {
                    moved.push((JointId(k), dof));
                }
            }
        }
        moved
    }
}

/// Motions in words, as [`Motion::describe`] puts one.
pub fn describe_motions(motions: &[Motion], model: &Model) -> Vec<String> {
    let geometry = model.geometry();
    let size = characteristic_length(geometry);
    let in_words = |motion| describe(motion, model, geometry, size);
    motions.iter().map(in_words).collect()
}

/// A motion of a mechanism of this size in words.
fn describe(motion: &Motion, model: &Model, geometry: &Geometry, size: f64) -> String {
    const SHOWN: usize = 4;
    let mut parts: Vec<String> = motion
        .twists
        .iter()
        .take(SHOWN)
        .map(|(body, twist)| describe_body(*body, twist, model, geometry, size))
        .collect();
    if motion.twists.len() > SHOWN {
        parts.push(format!(
            "and {} more bodies move",
            motion.twists.len() - SHOWN
        ));
    }
    parts.join("; ")
}

fn describe_body(
    body: BodyId,
    twist: &Vector6<f64>,
    model: &Model,
    geometry: &Geometry,
    size: f64,
) -> String {
    let entry = &model.bodies()[body.0];
    let name = &entry.name;
    let (v, w) = (twist.fixed_rows::<3>(0), twist.fixed_rows::<3>(3));
    if w.norm() * size < 1e-9 * v.norm() {
        return format!("`{name}` moves along {}", vector(&v.normalize()));
    }
    let axis = w.normalize();
    let along = v.dot(&axis);
    let origin = geometry.positions[entry.nodes[0].0];
    let arm = w.cross(&v) / w.norm_squared();
    let on_axis = |p: &nalgebra::Point3<f64>| (p - origin - arm).cross(&axis).norm() < 1e-6 * size;
    let own = entry.nodes.len() > 1
        && entry
            .nodes
            .iter()
            .all(|n| on_axis(&geometry.positions[n.0]));
    let pitch = along / w.norm();
    if pitch.abs() > 1e-6 * size {
        return format!(
            "`{name}` screws about {} by {} m per rad",
            vector(&axis),
            short(pitch)
        );
    }
    if own {
        let verb = if entry.kind == BodyKind::Elastic {
            "spins"
        } else {
            "turns"
        };
        return format!("`{name}` {verb} about its own axis {}", vector(&axis));
    }
    let through = entry
        .nodes
        .iter()
        .find(|n| on_axis(&geometry.positions[n.0]));
    match through {
        Some(node) => format!(
            "`{name}` turns about {} through {}",
            vector(&axis),
            model.nodes()[node.0].point
        ),
        None => format!(
            "`{name}` turns about {} through {} m",
            vector(&axis),
            vector(&(origin.coords + arm))
        ),
    }
}

fn vector(v: &Vector3<f64>) -> String {
    format!("({}, {}, {})", short(v[0]), short(v[1]), short(v[2]))
}

/// A number to four digits, without needless zeros.
fn short(value: f64) -> String {
    let rounded = (value * 1e4).round() / 1e4;
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}
