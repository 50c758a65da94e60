//! How bodies have turned between two configurations, by what turns with them.

use hyperstat_joints::Dof;
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::{BodyId, Geometry, Model, NodeMass};

/// Sine of the angle between two directions below which they are one.
const ONE_DIRECTION: f64 = 1e-6;

impl Model {
    /// The masses of the nodes in another configuration: their inertia turns with their bodies.
    pub(crate) fn masses_at(&self, geometry: &Geometry) -> Vec<NodeMass> {
        let masses = self.masses.iter();
        masses
            .map(|mass| {
                if mass.mass.inertia().iter().all(|entry| *entry == 0.0) {
                    return mass.clone();
                }
                let turn = self.turn(self.nodes[mass.node.0].body, geometry);
                NodeMass {
                    node: mass.node,
                    mass: mass.mass.turned(&turn),
                }
            })
            .collect()
    }

    /// The rotation of a body from the model's configuration to another, from the directions that
    /// are fixed in it: between its nodes, and the axes of its joints that allow no other turn.
    /// The smallest one where all of these are parallel.
    fn turn(&self, body: BodyId, geometry: &Geometry) -> Rotation3<f64> {
        let own = &self.geometry;
        let nodes = &self.bodies[body.0].nodes;
        let arm = |g: &Geometry, n: usize| g.positions[n] - g.positions[nodes[0].0];
        let arms = nodes.iter().map(|n| (arm(own, n.0), arm(geometry, n.0)));
        let joints = self.joints.iter().enumerate();
        let axes = joints.filter_map(|(k, joint)| {
            let mut ends = joint.between.iter().flatten();
            let free = joint.joint.free();
            let fixed = !free.is_empty() && !free.contains(Dof::U) && !free.contains(Dof::W);
            let on_body = ends.any(|node| self.nodes[node.0].body == body);
            let axis = |g: &Geometry| g.frames[k].matrix().column(1).into_owned();
            (fixed && on_body).then(|| (axis(own), axis(geometry)))
        });
        let directions: Vec<_> = arms
            .chain(axes)
            .filter(|(from, to)| from.norm() > 0.0 && to.norm() > 0.0)
            .map(|(from, to)| (from.normalize(), to.normalize()))
            .collect();
        let Some(first) = directions.first() else {
            return Rotation3::identity();
        };
        let beside = |pair: &&(Vector3<f64>, Vector3<f64>)| first.0.cross(&pair.0).norm();
        let second = directions
            .iter()
            .max_by(|a, b| beside(a).total_cmp(&beside(b)))
            .filter(|pair| beside(pair) > ONE_DIRECTION);
        match second {
            Some(second) => {
                let from = axes_of(&first.0, &second.0);
                Rotation3::from_matrix_unchecked(axes_of(&first.1, &second.1) * from.transpose())
            }
            None => Rotation3::rotation_between(&first.0, &first.1).unwrap_or_default(),
        }
    }
}

/// Orthonormal axes: the first direction, and one normal to it on the second's side.
fn axes_of(first: &Vector3<f64>, second: &Vector3<f64>) -> Matrix3<f64> {
    let z = first.cross(second).normalize();
    Matrix3::from_columns(&[*first, z.cross(first), z])
}
