//! Loads on coordinates.

use hyperstat_model::{Geometry, NodeId};
use nalgebra::Vector6;

use crate::plan::Plan;
use crate::plan::blocks::{read, shift};
use crate::plan::workspace::{LOADS, Workspace};
use crate::state::acting::Acting;

/// Loads on the IDCs: what acts in each state (`Σ Hᵀ F` over all nodes) in a column of its own, unit
/// forces on the output in the columns before where its coordinates are not independent.
pub(crate) fn load(plan: &Plan, geometry: &Geometry, acting: &[Acting], workspace: &mut Workspace) {
    workspace.loads.fill(0.0);
    if !plan.output_is_independent() {
        for k in 0..6 {
            let mut unit = Vector6::zeros();
            unit[k] = 1.0;
            add_load(plan, geometry, workspace, k, plan.output, &unit);
        }
    }
    for (set, acting) in acting.iter().enumerate() {
        for (node, wrench) in &acting.nodes {
            add_load(plan, geometry, workspace, LOADS + set, *node, wrench);
        }
    }
}

/// Adds the loads on the IDCs that a wrench on a node gives to a column of loads.
pub(crate) fn add_load(
    plan: &Plan,
    geometry: &Geometry,
    workspace: &mut Workspace,
    column: usize,
    node: NodeId,
    wrench: &Vector6<f64>,
) {
    let carrier = plan.topology.carrier_of[node.0];
    let to_node = shift(geometry, plan.topology.carriers[carrier].reference, node);
    let at_reference = to_node.transpose() * wrench;
    for (k, &idc) in plan.columns[carrier].iter().enumerate() {
        let share = read(plan.block(workspace, carrier), 6 * k).dot(&at_reference);
        workspace.loads[column * plan.unknowns + idc] += share;
    }
}
