//! How a body lies: a frame that turns with it, from what turns with it in every pose.

use hyperstat_joints::{Dof, DofSet};
use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::model::{BodyId, BodyKind, Geometry, Model};

/// Two directions of a body whose angle has a smaller sine do not make a frame; a direction shorter
/// than this part of the longest is none.
const ACROSS: f64 = 1e-6;

impl Model {
    /// A frame that turns with a body, in the model's configuration: from its points, the local y
    /// of its segments, its stiffness's axes, and the axes of joints that are fixed in it. `None`
    /// where these lie along one line, so that the body's turn about it is not known.
    ///
    /// The frame itself means nothing; the turn between two configurations is `now · thenᵀ`.
    ///
    /// # Panics
    /// If the body is not one of this model.
    pub fn body_frame(&self, body: BodyId) -> Option<Rotation3<f64>> {
        body_frame(self, self.geometry(), body)
    }
}

/// The same in any configuration.
pub(crate) fn body_frame(
    model: &Model,
    geometry: &Geometry,
    body: BodyId,
) -> Option<Rotation3<f64>> {
    let entry = &model.bodies()[body.0];
    if let (BodyKind::Flexible, Some(id)) = (entry.kind, entry.flexible) {
        return Some(geometry.rotations[id.0]);
    }
    let mut directions = Vec::new();
    let first = geometry.positions[entry.nodes[0].0];
    let nodes = entry.nodes[1..].iter();
    directions.extend(nodes.map(|n| geometry.positions[n.0] - first));
    let segments = entry.segments.iter();
    directions.extend(segments.filter_map(|s| geometry.y_axes[s.0]));
    for (joint, frame) in model.joints().iter().zip(&geometry.frames) {
        for (side, node) in joint.between.iter().enumerate() {
            if node.is_some_and(|n| model.nodes()[n.0].body == body) {
                for column in fixed_axes(joint.joint.free(), side) {
                    directions.push(frame.matrix().column(*column).into_owned());
                }
            }
        }
    }
    frame_of(&directions)
}

/// Columns of a joint's frame that are fixed in a body, the first (0) or second (1) of its two.
fn fixed_axes(free: DofSet, side: usize) -> &'static [usize] {
    let turns = [Dof::U, Dof::V, Dof::W].map(|dof| free.contains(dof));
    match turns {
        [false, _, false] if !free.is_empty() => &[1],
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
