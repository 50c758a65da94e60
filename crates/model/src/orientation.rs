//! How a body lies: a frame that turns with it, from what turns with it in every pose, and its turn
//! from one configuration to another.

use hyperstat_joints::{Dof, DofSet};
use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3};

use crate::model::Model;
use crate::parts::{BodyId, BodyKind, Geometry, NodeId, SegmentId};

/// Two directions of a body whose angle has a smaller sine do not make a frame; a direction shorter
/// than this part of the longest is none.
const ACROSS: f64 = 1e-6;

impl Model {
    /// A frame that turns with a body, in the model's configuration: from its points, the local y
    /// of its segments where it was given, its stiffness's axes, and the axes of joints that are
    /// fixed in it. A point that slides along its body with a joint is left out. `None` where these
    /// lie along one line, so that the body's turn about it is not known, or where the body is not
    /// one of this model.
    ///
    /// The frame itself means nothing; the turn between two configurations is `now · thenᵀ`.
    pub fn body_frame(&self, body: BodyId) -> Option<Rotation3<f64>> {
        self.bodies().get(body.0)?;
        body_frame(self, self.geometry(), body)
    }
}

/// The same in any configuration.
pub fn body_frame(model: &Model, geometry: &Geometry, body: BodyId) -> Option<Rotation3<f64>> {
    let entry = &model.bodies()[body.0];
    match (entry.kind, entry.flexible) {
        (BodyKind::Flexible, Some(id)) => Some(geometry.rotations[id.0]),
        _ => frame_of(&directions(model, geometry, body)),
    }
}

/// The rotation of a body from the model's configuration to another; the smallest one where all
/// that is known of it lies along one line.
pub fn turn(model: &Model, geometry: &Geometry, body: BodyId) -> Rotation3<f64> {
    let frames = [model.geometry(), geometry].map(|g| body_frame(model, g, body));
    if let [Some(then), Some(now)] = frames {
        return now * then.inverse();
    }
    let first = |g: &Geometry| {
        let directions = directions(model, g, body);
        directions.into_iter().find(|d| d.norm() > 0.0)
    };
    match (first(model.geometry()), first(geometry)) {
        (Some(then), Some(now)) => Rotation3::rotation_between(&then, &now).unwrap_or_default(),
        _ => Rotation3::identity(),
    }
}

/// Directions that turn with a body.
fn directions(model: &Model, geometry: &Geometry, body: BodyId) -> Vec<Vector3<f64>> {
    let entry = &model.bodies()[body.0];
    let mut directions = Vec::new();
    let fixed = entry.nodes.iter().filter(|node| !slides(model, **node));
    let mut points = fixed.map(|node| geometry.positions[node.0]);
    if let Some(first) = points.next() {
        directions.extend(points.map(|point| point - first));
    }
    let given = |s: &&SegmentId| model.segments()[s.0].y_axis_given;
    let segments = entry.segments.iter().filter(given);
    directions.extend(segments.filter_map(|s| geometry.y_axes[s.0]));
    for (joint, frame) in model.joints().iter().zip(&geometry.frames) {
        for (side, node) in joint.between.iter().enumerate() {
            if node.is_some_and(|n| model.nodes()[n.0].body == body) {
                for column in fixed_axes(joint.released(), side) {
                    directions.push(frame.matrix().column(*column).into_owned());
                }
            }
        }
    }
    directions
}

/// Whether a node may lie at another point of its body in another pose: it belongs to one joint
/// alone, along which the two bodies slide.
fn slides(model: &Model, node: NodeId) -> bool {
    let joints = model.joints().iter();
    let mut on_node = joints.filter(|joint| joint.between.contains(&Some(node)));
    let (Some(joint), None) = (on_node.next(), on_node.next()) else {
        return false;
    };
    let travels = [Dof::X, Dof::Y, Dof::Z];
    let free = joint.released();
    model.output() != Some(node)
        && (travels.iter().any(|dof| free.contains(*dof))
            || joint.joint.basis() != Matrix6::identity())
}

/// Columns of a joint's frame that are fixed in a body, the first (0) or second (1) of its two.
fn fixed_axes(free: DofSet, side: usize) -> &'static [usize] {
    let turns = [Dof::U, Dof::V, Dof::W].map(|dof| free.contains(dof));
    match turns {
        [false, false, false] if !free.is_empty() => &[1, 0],
        [false, true, false] => &[1],
        // The first of two axes is fixed in the first body, the second in the second.
        [true, true, false] if side == 0 => &[0],
        [true, true, false] => &[1],
        _ => &[],
    }
}

/// The frame of the first direction and one that is far from its line.
fn frame_of(directions: &[Vector3<f64>]) -> Option<Rotation3<f64>> {
    let longest = directions.iter().map(Vector3::norm).fold(0.0, f64::max);
    let units: Vec<_> = directions
        .iter()
        .filter_map(|d| d.try_normalize(ACROSS * longest))
        .collect();
    let x = *units.first()?;
    // The first that is far enough, not the farthest: rounding could change that choice.
    let farthest = units.iter().map(|d| x.cross(d).norm()).fold(0.0, f64::max);
    let across = |d: &&Vector3<f64>| x.cross(d).norm() > 0.3 * farthest;
    let z = x.cross(units.iter().find(across)?);
    if farthest < ACROSS {
        return None;
    }
    let z = z.normalize();
    Some(Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[
        x,
        z.cross(&x),
        z,
    ])))
}
