//! Misfits and preloads of joints, brought to one configuration.
//!
//! The misfit m of a joint is what its second body stands off from its first when no force acts.
//! Along rigid directions it displaces all that hangs from the joint in its tree: a carrier's
//! displacement is `block · q + offset`. Along elastic ones the joint's spring starts from it. A
//! preload p along elastic directions is the misfit `C p`; along free ones it is a pair of wrenches
//! (the book, "Loads and states").

use hyperstat_joints::JointError;
use hyperstat_model::{Geometry, JointId, NodeId, condition_rows};
use nalgebra::Vector6;

use super::preload::{along, displacement_by_misfit};
use crate::error::SolveError;
use crate::plan::blocks::{read, shift};
use crate::plan::closing::{Conditions, over};
use crate::plan::coordinates::TreeBlocks;
use crate::plan::fault::Fault;
use crate::plan::workspace::Workspace;
use crate::plan::{Closed, Plan};
use crate::posture::Posture;
use crate::rank::dense::RANK_TOLERANCE;

/// Misfits that leave a larger share of the largest open in a loop do not fit it: the conditions
/// that count as redundant are so to this much and no better.
const FITS: f64 = RANK_TOLERANCE;

/// Displacements of all carriers that misfits of rigid directions make with all IDCs zero.
///
/// # Errors
/// Misfits that do not fit loops of rigid bodies and joints.
pub(crate) fn offsets(
    plan: &Plan,
    at: &Posture<'_>,
    tree: &TreeBlocks,
) -> Result<Vec<Vector6<f64>>, Fault> {
    let model = at.model;
    let rigid: Vec<(JointId, Vector6<f64>)> = (model.misfits().iter())
        .map(|entry| {
            let own = along(
                &entry.misfit,
                plan.topology.joints[entry.joint.0].directions.rigid,
            );
            (entry.joint, displacement_by_misfit(at, entry.joint, &own))
        })
        .filter(|(_, apart)| *apart != Vector6::zeros())
        .collect();
    let pass = Pass { plan, at, tree };
    let mut offsets = pass.along_trees(&rigid)?;
    for closed in &plan.closed {
        let Gap { particular, open } = pass.close(closed, &rigid, &offsets);
        if open > FITS {
            return Err(SolveError::Misfit {
                joints: pass.misfitting(closed, &rigid)?,
            }
            .into());
        }
        let component = &plan.topology.components[closed.component];
        for carrier in component.members() {
            let coordinates = &plan.topology.carriers[carrier].coordinates;
            for (k, &coordinate) in coordinates.iter().enumerate() {
                let weight = particular[coordinate - component.coordinates.start];
                offsets[carrier] += read(&tree.values, tree.starts[carrier] + 6 * k) * weight;
            }
        }
    }
    Ok(offsets)
}

/// A configuration whose offsets are looked for. Misfits in its methods are displacements of
/// second bodies from first ones along rigid directions, global axes, in the joints' order.
struct Pass<'a> {
    plan: &'a Plan,
    at: &'a Posture<'a>,
    tree: &'a TreeBlocks,
}

/// How a loop's closing joints take misfits.
struct Gap {
    /// The component's coordinates, the independent ones zero.
    particular: Vec<f64>,
    /// Largest condition that is not met, over the largest displacement.
    open: f64,
}

impl Pass<'_> {
    /// Displacements of the carriers with all tree coordinates zero.
    fn along_trees(
        &self,
        misfits: &[(JointId, Vector6<f64>)],
    ) -> Result<Vec<Vector6<f64>>, JointError> {
        let topology = &self.plan.topology;
        let mut offsets = vec![Vector6::zeros(); topology.carriers.len()];
        for tie in topology.components.iter().flat_map(|c| &c.ties) {
            let mut stands = self.apart(misfits, tie.joint);
            let connection = &self.at.model.joints()[tie.joint.0];
            if connection.between[1] != Some(tie.child_node) {
                stands = -stands;
            }
            if let (Some(parent), Some(node)) = (tie.parent, tie.parent_node) {
                let reference = topology.carriers[parent].reference;
                stands += shift(self.at.geometry, reference, node) * offsets[parent];
            }
            if stands != Vector6::zeros() {
                let moving = topology.joints[tie.joint.0].moving;
                let frame = &self.at.geometry.frames[tie.joint.0];
                offsets[tie.child] = connection.joint.mapping(frame, moving)?.n_j() * stands;
            }
        }
        Ok(offsets)
    }

    /// Finds the coordinates of a component that its closing joints ask for.
    fn close(
        &self,
        closed: &Closed,
        misfits: &[(JointId, Vector6<f64>)],
        offsets: &[Vector6<f64>],
    ) -> Gap {
        let topology = &self.plan.topology;
        let component = &topology.components[closed.component];
        let conditions = Conditions::new(component, self.tree, topology, self.at);
        let length = conditions.length;
        let mut right_side = Vec::new();
        let mut largest = 0.0_f64;
        for joint in &component.closings {
            let connection = &self.at.model.joints()[joint.0];
            let mut asked = -over(length, self.apart(misfits, *joint));
            largest = largest.max(asked.amax());
            for (node, sign) in connection.between.iter().zip([-1.0, 1.0]) {
                let Some(node) = node else { continue };
                let carrier = topology.carrier_of[node.0];
                let reference = topology.carriers[carrier].reference;
                let moved = shift(self.at.geometry, reference, *node) * offsets[carrier];
                let own = over(length, moved);
                largest = largest.max(own.amax());
                asked += own * sign;
            }
            let local = self.at.direction_map(*joint);
            let rigid = topology.joints[joint.0].moving.complement();
            let rows = condition_rows(&local, rigid, length);
            right_side.extend(rows.map(|condition| (condition * asked)[0]));
        }
        let (particular, open) = conditions.met(&right_side, &closed.order, largest);
        Gap { particular, open }
    }

    /// Names of the joints whose misfits alone do not fit a component; all, where each of them fits by
    /// a little.
    fn misfitting(
        &self,
        closed: &Closed,
        misfits: &[(JointId, Vector6<f64>)],
    ) -> Result<Vec<String>, JointError> {
        let mut alone = Vec::new();
        for own in misfits.chunks(1) {
            let offsets = self.along_trees(own)?;
            if self.close(closed, own, &offsets).open > FITS {
                alone.extend_from_slice(own);
            }
        }
        let named = if alone.is_empty() { misfits } else { &alone };
        let name = |(joint, _): &(JointId, _)| self.at.model.joints()[joint.0].name.clone();
        Ok(named.iter().map(name).collect())
    }

    /// Misfit of a joint.
    fn apart(&self, misfits: &[(JointId, Vector6<f64>)], joint: JointId) -> Vector6<f64> {
        let place = misfits.binary_search_by_key(&joint, |(joint, _)| *joint);
        place.map_or(Vector6::zeros(), |place| misfits[place].1)
    }
}

/// What misfits displace a node by with all IDCs zero; some misfit acts.
pub(crate) fn offset(
    plan: &Plan,
    geometry: &Geometry,
    workspace: &Workspace,
    node: NodeId,
) -> Vector6<f64> {
    let carrier = plan.topology.carrier_of[node.0];
    let reference = plan.topology.carriers[carrier].reference;
    shift(geometry, reference, node) * workspace.offsets[carrier]
}
