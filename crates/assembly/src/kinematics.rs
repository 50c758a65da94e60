//! Mobility, over-constraint and motions without energy, from the rigid bodies' Jacobian.
//!
//! Every body is taken as rigid, with a twist at its first node. Lengths are divided by the
//! mechanism's size and every condition is a unit row, so that zero and not zero are far apart
//! (measured: zeros stay below 1e-15, non-zeros above 1e-4) and one tolerance serves all counts.

use hyperstat_joints::{Dof, DofSet, rigid_motion};
use nalgebra::{DMatrix, DVector, Matrix6, RowVector6, Vector3, Vector6};

use crate::directions::{Directions, to_directions};
use crate::elimination::{Elimination, RANK_TOLERANCE};
use crate::model::{BodyId, BodyKind, Connection, Geometry, JointId, Model, NodeId};
use crate::solution::Motion;

/// Counts and motions of a mechanism whose bodies are all rigid, at one configuration.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Kinematics {
    /// Instantaneous mobility, with every direction that is free by its joint's kind released
    /// (locked or elastic though it may be); idle motions included.
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
pub fn analyse(model: &Model) -> Kinematics {
    analyse_at(model, model.geometry())
}

/// [`analyse`] in another configuration.
pub(crate) fn analyse_at(model: &Model, geometry: &Geometry) -> Kinematics {
    let released = Jacobian::released(model, geometry);
    let constraints = released.rows.len();
    let released = released.eliminated();
    let conditions = Jacobian::held(model, geometry);
    let held = conditions.eliminated();
    let size = characteristic_length(geometry);
    let nearly_free = held.doubtful.and_then(|_| {
        let column = conditions.nearly_free()?;
        Some(motion(model, size, &column))
    });
    let motions = echelon(held.null_space())
        .iter()
        .map(|column| motion(model, size, column))
        .collect();
    Kinematics {
        mobility: 6 * model.bodies().len() - released.rank(),
        overconstraint: constraints - released.rank(),
        motions,
        doubtful: held.doubtful.or(released.doubtful),
        nearly_free,
    }
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

/// Unit rows of a joint's conditions on the relative twist at the joint, in global axes with
/// translations over `size`.
pub(crate) fn condition_rows(
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

/// Conditions on the scaled twists of all bodies, sparse by rows.
pub(crate) struct Jacobian {
    columns: usize,
    rows: Vec<Vec<(usize, RowVector6<f64>)>>,
    /// Joint and direction of every row.
    pub directions: Vec<(JointId, Dof)>,
}

impl Jacobian {
    /// Rows of the directions that every joint constrains by kind.
    pub fn released(model: &Model, geometry: &Geometry) -> Self {
        Self::new(model, geometry, |joint, local, size| {
            let set = joint.joint.free().complement();
            let rows = condition_rows(local, set, size);
            set.iter().zip(rows).collect()
        })
    }

    /// Rows of the rigid and elastic directions of every joint.
    pub fn held(model: &Model, geometry: &Geometry) -> Self {
        Self::new(model, geometry, |joint, local, size| {
            let held = Directions::of(joint);
            let rigid = held.rigid.iter();
            let rigid = rigid.zip(condition_rows(local, held.rigid, size));
            let elastic = held.elastic.iter().zip(elastic_rows(local, &held, size));
            rigid.chain(elastic).collect()
        })
    }

    /// Rows of every joint by `conditions`, which gets the joint, the map from a relative twist to
    /// its directions, and the mechanism's size.
    fn new(
        model: &Model,
        geometry: &Geometry,
        conditions: impl Fn(&Connection, &Matrix6<f64>, f64) -> Vec<(Dof, RowVector6<f64>)>,
    ) -> Self {
        let size = characteristic_length(geometry);
        let mut rows = Vec::new();
        let mut directions = Vec::new();
        for (k, joint) in model.joints().iter().enumerate() {
            let local = to_directions(&joint.joint.basis(), &geometry.frames[k]);
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
            columns: 6 * model.bodies().len(),
            rows,
            directions,
        }
    }

    /// The conditions as a matrix, six columns a body.
    pub fn dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.rows.len(), self.columns);
        for (r, row) in self.rows.iter().enumerate() {
            for (body, entries) in row {
                let mut view = dense.fixed_view_mut::<1, 6>(r, 6 * body);
                view += entries;
            }
        }
        dense
    }

    pub fn eliminated(&self) -> Elimination {
        Elimination::new(self.dense(), 0)
    }

    /// With doubtful conditions left out, the motion that breaks them most.
    fn nearly_free(&self) -> Option<DVector<f64>> {
        let conditions = self.dense();
        let basis = echelon(Elimination::without_doubtful(conditions.clone()).null_space());
        basis
            .into_iter()
            .map(|motion| ((&conditions * &motion).amax(), motion))
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, motion)| motion)
    }
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

/// The motion of a column of scaled twists: translations back in metres.
fn motion(model: &Model, size: f64, column: &DVector<f64>) -> Motion {
    let twists = (0..model.bodies().len()).filter_map(|b| {
        let mut twist: Vector6<f64> = column.fixed_rows::<6>(6 * b).into_owned();
        for k in 0..3 {
            twist[k] *= size;
        }
        (twist.amax() > 0.0).then_some((BodyId(b), twist))
    });
    Motion {
        twists: twists.collect(),
    }
}

/// The displacement of a node under a motion.
pub(crate) fn node_twist(
    motion: &Motion,
    model: &Model,
    geometry: &Geometry,
    node: usize,
) -> Vector6<f64> {
    let body = model.nodes()[node].body;
    let Some((_, twist)) = motion.twists.iter().find(|(b, _)| *b == body) else {
        return Vector6::zeros();
    };
    let origin = model.bodies()[body.0].nodes[0];
    rigid_motion(&(geometry.positions[node] - geometry.positions[origin.0])) * twist
}

impl Motion {
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

/// A motion in words.
pub(crate) fn describe(motion: &Motion, model: &Model) -> String {
    const SHOWN: usize = 4;
    let mut parts: Vec<String> = motion
        .twists
        .iter()
        .take(SHOWN)
        .map(|(body, twist)| describe_body(*body, twist, model))
        .collect();
    if motion.twists.len() > SHOWN {
        parts.push(format!(
            "and {} more bodies move",
            motion.twists.len() - SHOWN
        ));
    }
    parts.join("; ")
}

fn describe_body(body: BodyId, twist: &Vector6<f64>, model: &Model) -> String {
    let geometry = model.geometry();
    let size = characteristic_length(geometry);
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
