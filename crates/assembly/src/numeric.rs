//! The numeric pass of one pose: carriers' blocks, elements, assembled stiffness (Eqs. 40–42).

use nalgebra::Vector6;

use crate::acting::Acting;
use crate::cluster::{cluster_element, cluster_initial};
use crate::condense::LOADS;
use crate::coordinates::{read, shift, write};
use crate::directions::to_directions;
use crate::error::SolveError;
use crate::kinematics::characteristic_length;
use crate::misfit::{offsets, spring_misfit};
use crate::model::{Geometry, JointId, Model, NodeId};
use crate::plan::{ElementPlan, Plan, Source, Workspace};

/// Why a plan cannot take a pose.
#[derive(Debug)]
pub(crate) enum Fault {
    /// The rank of the loop conditions is another than the plan's.
    Changed,
    /// Something is wrong with the pose itself.
    Error(SolveError),
}

impl<E: Into<SolveError>> From<E> for Fault {
    fn from(error: E) -> Self {
        Self::Error(error.into())
    }
}

/// Brings blocks, elements, stiffness and loads of `workspace` to a configuration, with what acts
/// in each state.
pub(crate) fn evaluate(
    plan: &Plan,
    model: &Model,
    geometry: &Geometry,
    acting: &[Acting],
    workspace: &mut Workspace,
) -> Result<(), Fault> {
    plan.check_sets(model, acting.len())?;
    plan.make_room(workspace, acting.len());
    workspace.doubtful = None;
    workspace.tree.evaluate(&plan.topology, model, geometry)?;
    for (coordinate, idc) in plan.idc_of.iter().enumerate() {
        if let Some(idc) = idc {
            workspace.identities[*idc] = workspace.tree.identities[coordinate];
        }
    }
    close_loops(plan, model, geometry, workspace)?;
    workspace.offsets = if acting.iter().any(|a| a.misfits) {
        offsets(plan, model, geometry, &workspace.tree)?
    } else {
        Vec::new()
    };
    workspace.initial.fill(0.0);
    for element in &plan.elements {
        match element.source {
            Source::Cluster(k) => {
                let cluster = &plan.topology.clusters[k];
                cluster_initial(plan, element, cluster, model, geometry, acting, workspace)?;
                cluster_element(plan, element, cluster, model, geometry, workspace)?;
            }
            Source::Spring(joint) => {
                spring_element(plan, element, joint, model, geometry, workspace);
                if !workspace.offsets.is_empty() {
                    spring_initial(plan, element, joint, model, geometry, workspace);
                }
            }
        }
    }
    assemble(plan, workspace);
    load(plan, geometry, acting, workspace);
    Ok(())
}

/// Blocks of the components whose loops are closed by elimination.
fn close_loops(
    plan: &Plan,
    model: &Model,
    geometry: &Geometry,
    workspace: &mut Workspace,
) -> Result<(), Fault> {
    if plan.closed.is_empty() {
        return Ok(());
    }
    let size = characteristic_length(geometry);
    for closed in &plan.closed {
        let component = &plan.topology.components[closed.component];
        let first = component.coordinates.start;
        let solved = workspace.tree.close(
            component,
            &plan.topology,
            model,
            geometry,
            size,
            closed.spared,
        );
        workspace.doubtful = workspace.doubtful.or(solved.doubtful);
        let spared = solved
            .independent
            .iter()
            .take_while(|c| **c < closed.spared)
            .count();
        let full = closed.spared > 0 && spared == closed.spared;
        let expected = closed.spared > 0 && plan.output_is_independent();
        if solved.independent.len() != closed.idcs.len() || full != expected {
            return Err(Fault::Changed);
        }
        // The spared coordinates, first in the component, come last among the IDCs.
        let offset = if full { spared } else { 0 };
        let count = solved.independent.len();
        let order = |position: usize| (position + offset) % count.max(1);
        for (position, &idc) in closed.idcs.iter().enumerate() {
            let coordinate = first + solved.independent[order(position)];
            workspace.identities[idc] = workspace.tree.identities[coordinate];
        }
        let members = component
            .root
            .into_iter()
            .chain(component.ties.iter().map(|t| t.child));
        for carrier in members {
            let Some(start) = plan.reduced_starts[carrier] else {
                continue;
            };
            for position in 0..count {
                let mut column = Vector6::zeros();
                for (k, &coordinate) in plan.topology.carriers[carrier]
                    .coordinates
                    .iter()
                    .enumerate()
                {
                    let weight = solved.map[(coordinate - first, order(position))];
                    let block = workspace.tree.starts[carrier] + 6 * k;
                    column += read(&workspace.tree.values, block) * weight;
                }
                write(&mut workspace.reduced, start + 6 * position, &column);
            }
        }
    }
    Ok(())
}

fn spring_element(
    plan: &Plan,
    element: &ElementPlan,
    joint: JointId,
    model: &Model,
    geometry: &Geometry,
    workspace: &mut Workspace,
) {
    let entry = &model.joints()[joint.0];
    let role = &plan.topology.joints[joint.0];
    let local = to_directions(&entry.joint.basis(), &geometry.frames[joint.0]);
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
fn spring_initial(
    plan: &Plan,
    element: &ElementPlan,
    joint: JointId,
    model: &Model,
    geometry: &Geometry,
    workspace: &mut Workspace,
) {
    let entry = &model.joints()[joint.0];
    let role = &plan.topology.joints[joint.0];
    let own = model.misfit(joint);
    let mut start = own.map_or(Vector6::zeros(), |own| spring_misfit(&role.directions, own));
    let mut relative = Vector6::zeros();
    for (node, sign) in entry.between.iter().zip([1.0, -1.0]) {
        let Some(node) = node else { continue };
        relative += offset(plan, geometry, workspace, *node) * sign;
    }
    let local = to_directions(&entry.joint.basis(), &geometry.frames[joint.0]);
    start += local * relative;
    for state in workspace.initial.chunks_exact_mut(plan.deformations) {
        let rows = &mut state[element.initial_start..element.initial_start + element.rows];
        for (row, dof) in rows.iter_mut().zip(role.springs.iter()) {
            *row = start[dof.index()];
        }
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

/// `K = Σ Dᵀ k D` (Eqs. 41–42) over the inner IDCs.
fn assemble(plan: &Plan, workspace: &mut Workspace) {
    let Workspace {
        operators,
        stiffnesses,
        values,
        scratch,
        ..
    } = workspace;
    values.fill(0.0);
    for element in &plan.elements {
        let (rows, count) = (element.rows, element.inner);
        let d = &operators[element.operator_start..element.operator_start + rows * count];
        let k = &stiffnesses[element.stiffness_start..element.stiffness_start + rows * rows];
        let kd = &mut scratch[..rows * count];
        multiply(k, d, rows, kd);
        let mut places = plan.places[element.places_start..].iter();
        for (b, kd_b) in kd.chunks_exact(rows).enumerate() {
            for (d_a, place) in d.chunks_exact(rows).take(b + 1).zip(&mut places) {
                values[*place] += dot(d_a, kd_b);
            }
        }
    }
}

/// `out = k d` for a square `k` of `rows`, column by column.
pub(crate) fn multiply(k: &[f64], d: &[f64], rows: usize, out: &mut [f64]) {
    for (column, result) in d.chunks_exact(rows).zip(out.chunks_exact_mut(rows)) {
        result.fill(0.0);
        for (weight, k_column) in column.iter().zip(k.chunks_exact(rows)) {
            for (r, entry) in result.iter_mut().zip(k_column) {
                *r += weight * entry;
            }
        }
    }
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Loads on the IDCs: what acts in each state (`Σ Hᵀ F` over all nodes) in a column of its own, unit
/// forces on the output in the columns before where its coordinates are not independent.
fn load(plan: &Plan, geometry: &Geometry, acting: &[Acting], workspace: &mut Workspace) {
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
fn add_load(
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

/// Displacement of a node (outside an absorbed joint) in a column of the solutions.
pub(crate) fn node_displacement(
    plan: &Plan,
    geometry: &Geometry,
    workspace: &Workspace,
    column: usize,
    node: NodeId,
) -> Vector6<f64> {
    let carrier = plan.topology.carrier_of[node.0];
    let block = plan.block(workspace, carrier);
    let mut at_reference = Vector6::zeros();
    for (k, &idc) in plan.columns[carrier].iter().enumerate() {
        at_reference += read(block, 6 * k) * workspace.solutions[column * plan.unknowns + idc];
    }
    if column >= LOADS && !workspace.offsets.is_empty() {
        at_reference += workspace.offsets[carrier];
    }
    shift(geometry, plan.topology.carriers[carrier].reference, node) * at_reference
}
