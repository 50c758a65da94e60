//! Values of drives as they are measured: from where the parts of a mechanism are in two poses.
//!
//! Inverse kinematics says where the parts are in every pose that it reaches, also where no way of loop
//! closure leads there from another pose. How far a slide is out, and how far a crank is turned, then
//! follows from points of its two bodies; whole turns do not.

use hyperstat_joints::Dof;
use hyperstat_model::{
    BodyId, Connection, Geometry, JointId, Model, NodeId, characteristic_length,
};
use nalgebra::{Point3, Unit, Vector3};

use super::placing::SAME;

/// How far (sizes of the mechanism) from an axis a point must be to show a turn about it.
const ASIDE: f64 = 1e-3;

/// What shows the value of a drive.
#[derive(Debug, Clone)]
pub(super) struct Gauge {
    joint: JointId,
    /// The direction, in the joint's frame.
    direction: Vector3<f64>,
    kind: Kind,
}

#[derive(Debug, Clone)]
enum Kind {
    /// A point of either body: how far they are apart along the direction. The ground's is the origin.
    Slide([Option<NodeId>; 2]),
    /// Two points of either body, the first on the axis, the second aside of it: the angle between the two
    /// arms. The ground's arm stays as it is.
    Turn([Option<[NodeId; 2]>; 2]),
}

impl Gauge {
    /// One for every drive of a model, in the order of [`Model::drives`], where each has one; `fixed` nodes
    /// are those that stay where they are on their bodies.
    pub(super) fn all(model: &Model, fixed: &[NodeId]) -> Option<Vec<Self>> {
        let own = |(joint, dof): (JointId, Dof)| Self::new(model, joint, dof, fixed);
        model.drives().map(own).collect()
    }

    /// `None`: a joint that moves in several directions, or along and about one; bodies without such points.
    fn new(model: &Model, joint: JointId, dof: Dof, fixed: &[NodeId]) -> Option<Self> {
        let connection = &model.joints()[joint.0];
        if connection.joint.free().iter().count() != 1 {
            return None;
        }
        let basis = connection.joint.basis();
        let column = basis.column(dof.index());
        let [along, about] = [0, 3].map(|row| column.fixed_rows::<3>(row).into_owned());
        let (direction, kind) = match (along.norm() > 0.0, about.norm() > 0.0) {
            (true, false) => (along, slide(model, connection, fixed)?),
            (false, true) => (about, turn(model, joint, &about, fixed)?),
            _ => return None,
        };
        Some(Self {
            joint,
            direction,
            kind,
        })
    }

    /// The value in a pose (m, rad; a turn of −π to π) relative to `home`, where the bodies' points show
    /// that they have moved as the drive does.
    pub(super) fn value(&self, home: &Geometry, there: &Geometry) -> Option<f64> {
        let [from, to] = [home, there].map(|at| self.sight(home, at));
        let (from, to) = (from?, to?);
        let off = (from.rest - to.rest).amax();
        if off > SAME * characteristic_length(home) {
            return None;
        }
        let moved = to.value - from.value;
        Some(match self.kind {
            Kind::Slide(_) => moved,
            Kind::Turn(_) => {
                moved - std::f64::consts::TAU * (moved / std::f64::consts::TAU).round()
            }
        })
    }

    fn sight(&self, home: &Geometry, at: &Geometry) -> Option<Sight> {
        let axis = Unit::new_normalize(at.frames.get(self.joint.0)? * self.direction);
        let place = |node: NodeId| at.positions.get(node.0).copied();
        match self.kind {
            Kind::Slide(nodes) => {
                let [first, second] = nodes.map(|node| match node {
                    None => Some(Point3::origin()),
                    Some(node) => place(node),
                });
                let apart = second? - first?;
                let along = apart.dot(&axis);
                Some(Sight {
                    value: along,
                    rest: Vector3::new((apart - *axis * along).norm(), 0.0, 0.0),
                })
            }
            Kind::Turn([first, second]) => {
                let arm = |[on, aside]: [NodeId; 2], at: &Geometry| {
                    Some(at.positions.get(aside.0)? - at.positions.get(on.0)?)
                };
                let second = second?;
                let reference = first.map_or_else(|| arm(second, home), |nodes| arm(nodes, at))?;
                let arm = arm(second, at)?;
                let across = |v: &Vector3<f64>| v - *axis * v.dot(&axis);
                let [from, to] = [&reference, &arm].map(across);
                Some(Sight {
                    value: from.cross(&to).dot(&axis).atan2(from.dot(&to)),
                    rest: Vector3::new(arm.dot(&axis), from.norm(), to.norm()),
                })
            }
        }
    }
}

/// What is seen of a drive in a pose.
struct Sight {
    value: f64,
    /// Lengths that the drive does not change (m).
    rest: Vector3<f64>,
}

fn body(model: &Model, node: Option<NodeId>) -> Option<BodyId> {
    Some(model.nodes()[node?.0].body)
}

fn slide(model: &Model, joint: &Connection, fixed: &[NodeId]) -> Option<Kind> {
    let nodes = joint.between.map(|node| {
        let nodes = &model.bodies()[body(model, node)?.0].nodes;
        nodes.iter().copied().find(|node| fixed.contains(node))
    });
    let [first, second] = joint.between;
    match (first, second, nodes) {
        // What slides on the ground takes the joint's own point with it.
        (None, second, [_, on]) => Some(Kind::Slide([None, Some(on.or(second)?)])),
        (first, None, [on, _]) => Some(Kind::Slide([Some(on.or(first)?), None])),
        (_, _, [Some(first), Some(second)]) => Some(Kind::Slide([Some(first), Some(second)])),
        _ => None,
    }
}

fn turn(model: &Model, joint: JointId, about: &Vector3<f64>, fixed: &[NodeId]) -> Option<Kind> {
    let geometry = model.geometry();
    let connection = &model.joints()[joint.0];
    let axis = Unit::new_normalize(geometry.frames[joint.0] * about);
    let least = ASIDE * characteristic_length(geometry);
    let arm = |on: Option<NodeId>| {
        let on = on?;
        let aside = |node: &NodeId| {
            let arm = geometry.positions[node.0] - geometry.positions[on.0];
            (arm - *axis * arm.dot(&axis)).norm()
        };
        let nodes = &model.bodies()[body(model, Some(on))?.0].nodes;
        let nodes = nodes.iter().copied().filter(|node| fixed.contains(node));
        let farthest = nodes.max_by(|a, b| aside(a).total_cmp(&aside(b)))?;
        (aside(&farthest) > least).then_some([on, farthest])
    };
    // The second body has one; the first, if it is one, too.
    let [first, second] = connection.between;
    let arms = connection.between.map(arm);
    match (first, second, arms) {
        (None, Some(_), [_, Some(second)]) => Some(Kind::Turn([None, Some(second)])),
        (Some(_), Some(_), [Some(_), Some(_)]) => Some(Kind::Turn(arms)),
        _ => None,
    }
}
