//! Springs: elastic directions that no subassembly absorbs.

use hyperstat_model::JointId;
use nalgebra::Vector6;

use crate::plan::Plan;
use crate::plan::blocks::{read, shift};
use crate::plan::elements::ElementPlan;
use crate::plan::workspace::Workspace;
use crate::posture::Posture;
use crate::state::offsets::offset;
use crate::state::preload::spring_misfit;

pub(crate) fn spring_element(
    plan: &Plan,
    element: &ElementPlan,
    joint: JointId,
    at: &Posture<'_>,
    workspace: &mut Workspace,
) {
    let Posture {
        model, geometry, ..
    } = *at;
    let entry = &model.joints()[joint.0];
    let role = &plan.topology.joints[joint.0];
    let local = at.direction_map(joint);
    let rows = element.rows;
    let start = element.operator_start;
    workspace.operators[start..start + rows * element.columns.len()].fill(0.0);
    for (node, places) in &element.nodes {
        let sign = if entry.between[0] == Some(*node) {
            1.0
        } else {
            -1.0
        };
        let carrier = plan.topology.carrier_of[node.0];
        let to_node = local * shift(geometry, plan.topology.carriers[carrier].reference, *node);
        for (k, place) in places.iter().enumerate() {
            if *place >= element.columns.len() {
                continue;
            }
            let relative = to_node * read(plan.block(workspace, carrier), 6 * k);
            for (row, dof) in role.springs.iter().enumerate() {
                workspace.operators[start + rows * place + row] += sign * relative[dof.index()];
            }
        }
    }
    for (c, column) in role.springs.iter().enumerate() {
        for (r, row) in role.springs.iter().enumerate() {
            workspace.stiffnesses[element.stiffness_start + rows * c + r] =
                role.directions.stiffness[(row.index(), column.index())];
        }
    }
}

/// Forms the deformations that a spring starts from in each state: its misfit, and what its bodies
/// are displaced by with all IDCs zero.
pub(crate) fn spring_initial(
    plan: &Plan,
    element: &ElementPlan,
    joint: JointId,
    at: &Posture<'_>,
    workspace: &mut Workspace,
) {
    let Posture {
        model, geometry, ..
    } = *at;
    let entry = &model.joints()[joint.0];
    let role = &plan.topology.joints[joint.0];
    let own = model.misfit(joint);
    let mut start = own.map_or(Vector6::zeros(), |own| spring_misfit(&role.directions, own));
    let mut relative = Vector6::zeros();
    for (node, sign) in entry.between.iter().zip([1.0, -1.0]) {
        let Some(node) = node else { continue };
        relative += offset(plan, geometry, workspace, *node) * sign;
    }
    let local = at.direction_map(joint);
    start += local * relative;
    for state in workspace.initial.chunks_exact_mut(plan.deformations) {
        let rows = &mut state[element.initial_start..element.initial_start + element.rows];
        for (row, dof) in rows.iter_mut().zip(role.springs.iter()) {
            *row = start[dof.index()];
        }
    }
}
