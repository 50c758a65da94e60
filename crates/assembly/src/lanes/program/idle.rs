//! Coordinates that tell idle motions.

use hyperstat_model::{Geometry, Model, NodeId};
use nalgebra::{DVector, Vector6};

use super::element::Element;
use super::parts::Placed;
use crate::kinematics::motion::node_twist;
use crate::plan::Plan;
use crate::plan::topology::Topology;
use crate::pose::restraint::{Restraint, largest_minor, scaled};
use crate::posture::Posture;
use crate::room;
use crate::room::MOST_NUMBERS;

/// Entries of idle motions below this are none.
const STILL: f64 = 1e-9;
/// How much coordinates count that stay, and those that may go, to tell idle motions by.
const STAYS: f64 = 4.0;
const GOES: f64 = 0.25;

/// One coordinate an idle motion: those with the largest minor, where coordinates count more that
/// stay, since several chains meet at them, and roots' less that could go. `None` where the output
/// moves without energy. `dependent`: coordinates that depend on others.
pub(crate) fn idle_coordinates(
    plan: &Plan,
    topology: &Topology,
    model: &Model,
    geometry: &Geometry,
    placed: &[Option<Placed>],
    (elements, dependent): (&[Element], &[usize]),
) -> Option<Vec<usize>> {
    let restraint = Restraint::of(&Posture::new(model, geometry), plan.output).ok()?;
    let numbers = room::matrix(restraint.idle.len(), topology.coordinates);
    if !restraint.moving.is_empty() || numbers > MOST_NUMBERS {
        return None;
    }
    let mut columns: Vec<DVector<f64>> = Vec::new();
    for motion in &restraint.idle {
        let twist = |node: NodeId| node_twist(motion, model, geometry, node.0);
        let mut column = DVector::zeros(topology.coordinates);
        let nodes = || elements.iter().flat_map(|e| &e.nodes);
        for placed in placed.iter().flatten() {
            if let Some(root) = placed.root {
                let meeting = nodes().filter(|n| n.root == Some(root)).count();
                let rank = if meeting > 2 { STAYS } else { GOES };
                let at = scaled(&twist(placed.reference), restraint.size) * rank;
                column.fixed_rows_mut::<6>(root).copy_from(&at);
            }
        }
        for tie in topology.components.iter().flat_map(|c| &c.ties) {
            let joint = &model.joints()[tie.joint.0];
            let at = |node: Option<NodeId>| node.map_or(Vector6::zeros(), twist);
            let relative = at(joint.between[0]) - at(joint.between[1]);
            let frame = &geometry.frames[tie.joint.0];
            let along = hyperstat_model::to_directions(&joint.joint.basis(), frame) * relative;
            let moving = topology.joints[tie.joint.0].moving;
            for (coordinate, dof) in tie.coordinates.clone().zip(moving.iter()) {
                let unit = if dof.index() < 3 { restraint.size } else { 1.0 };
                let meeting = nodes().filter(|n| n.is_moved_by(coordinate)).count();
                let rank = if meeting > 1 { STAYS } else { 1.0 };
                column[coordinate] = along[dof.index()] / unit * rank;
            }
        }
        for coordinate in dependent {
            column[*coordinate] = 0.0;
        }
        columns.push(column);
    }
    Some(largest_minor(columns, STILL))
}
