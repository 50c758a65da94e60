//! Motions of a mechanism of rigid bodies, and their words.

use hyperstat_joints::rigid_motion;
use hyperstat_model::{BodyId, BodyKind, Geometry, Model, characteristic_length};
use nalgebra::{Vector3, Vector6};

/// A motion of rigid bodies: the twist of every body that moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Bodies that move, and each one's twist in global axes at the body's first node,
    /// scaled so that the motion's largest entry is 1 (rotations in rad, translations over
    /// the mechanism's size).
    pub twists: Vec<(BodyId, Vector6<f64>)>,
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

/// Motions in words, as [`Motion::describe`] puts one.
pub fn describe_motions(motions: &[Motion], model: &Model) -> Vec<String> {
    let geometry = model.geometry();
    let size = characteristic_length(geometry);
    let in_words = |motion| describe(motion, model, geometry, size);
    motions.iter().map(in_words).collect()
}

/// A motion of a mechanism of this size in words.
pub(crate) fn describe(motion: &Motion, model: &Model, geometry: &Geometry, size: f64) -> String {
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

pub(crate) fn describe_body(
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

pub(crate) fn vector(v: &Vector3<f64>) -> String {
    format!("({}, {}, {})", short(v[0]), short(v[1]), short(v[2]))
}

/// A number to four digits, without needless zeros.
pub(crate) fn short(value: f64) -> String {
    let rounded = (value * 1e4).round() / 1e4;
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}
