//! The numeric pass of one pose: carriers' blocks, elements, assembled stiffness (Eqs. 40–42).

pub(crate) mod condense;
pub(crate) mod joining;
pub(crate) mod loads;
pub(crate) mod precision;
pub(crate) mod recover;
pub(crate) mod restraint;
pub(crate) mod spread;
pub(crate) mod spring;
pub(crate) mod subassembly;

use hyperstat_model::{Geometry, NodeId};
use nalgebra::Vector6;

use crate::plan::Plan;
use crate::plan::blocks::{dot, multiply, read, shift, write};
use crate::plan::elements::Source;
use crate::plan::fault::Fault;
use crate::plan::workspace::{LOADS, Workspace};
use crate::pose::loads::load;
use crate::pose::spring::{spring_element, spring_initial};
use crate::pose::subassembly::{subassembly_element, subassembly_initial};
use crate::posture::Posture;
use crate::state::acting::Acting;
use crate::state::offsets::offsets;

/// Brings blocks, elements, stiffness and loads of `workspace` to a configuration, with what acts
/// in each state.
pub(crate) fn evaluate(
    plan: &Plan,
    at: &Posture<'_>,
    acting: &[Acting],
    workspace: &mut Workspace,
) -> Result<(), Fault> {
    plan.check_sets(at.model, acting.len())?;
    form(plan, at, workspace)?;
    act(plan, at, acting, workspace)
}

/// Brings blocks, elements and stiffness of `workspace` to a configuration.
pub(crate) fn form(plan: &Plan, at: &Posture<'_>, workspace: &mut Workspace) -> Result<(), Fault> {
    workspace.doubtful = None;
    workspace.tree.evaluate(&plan.topology, at)?;
    for (coordinate, idc) in plan.idc_of.iter().enumerate() {
        if let Some(idc) = idc {
            workspace.identities[*idc] = workspace.tree.identities[coordinate];
        }
    }
    close_loops(plan, at, workspace)?;
    for element in &plan.elements {
        match element.source {
            Source::Subassembly(k) => {
                let subassembly = &plan.topology.subassemblies[k];
                subassembly_element(plan, element, subassembly, at, workspace)?;
            }
            Source::Spring(joint) => spring_element(plan, element, joint, at, workspace),
        }
    }
    assemble(plan, workspace);
    Ok(())
}

/// Brings the loads of a `workspace` that is [formed](form), and what its elements start from, to what
/// acts in each state.
pub(crate) fn act(
    plan: &Plan,
    at: &Posture<'_>,
    acting: &[Acting],
    workspace: &mut Workspace,
) -> Result<(), Fault> {
    plan.make_room(workspace, acting.len());
    workspace.offsets = if acting.iter().any(|a| a.misfits) {
        offsets(plan, at, &workspace.tree)?
    } else {
        Vec::new()
    };
    workspace.initial.fill(0.0);
    for element in &plan.elements {
        match element.source {
            Source::Subassembly(k) => {
                let subassembly = &plan.topology.subassemblies[k];
                subassembly_initial(plan, element, subassembly, at, acting, workspace)?;
            }
            Source::Spring(joint) => {
                if !workspace.offsets.is_empty() {
                    spring_initial(plan, element, joint, at, workspace);
                }
            }
        }
    }
    load(plan, at.geometry, acting, workspace);
    Ok(())
}

/// Blocks of the components whose loops are closed by elimination.
fn close_loops(plan: &Plan, at: &Posture<'_>, workspace: &mut Workspace) -> Result<(), Fault> {
    for closed in &plan.closed {
        let component = &plan.topology.components[closed.component];
        let first = component.coordinates.start;
        let topology = &plan.topology;
        let solved = workspace.tree.close(component, topology, at, closed.spared);
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

/// Displacement of a node (outside an absorbed joint) in a column of the solutions.
pub(crate) fn node_displacement(
    plan: &Plan,
    geometry: &Geometry,
    workspace: &Workspace,
    column: usize,
    node: NodeId,
) -> Vector6<f64> {
    let solution = &workspace.solutions[column * plan.unknowns..][..plan.unknowns];
    let mut displacement = node_motion(plan, geometry, workspace, solution, node);
    if column >= LOADS && !workspace.offsets.is_empty() {
        let carrier = plan.topology.carrier_of[node.0];
        let reference = plan.topology.carriers[carrier].reference;
        displacement += shift(geometry, reference, node) * workspace.offsets[carrier];
    }
    displacement
}

/// What displacements of the IDCs move a node by.
pub(crate) fn node_motion(
    plan: &Plan,
    geometry: &Geometry,
    workspace: &Workspace,
    solution: &[f64],
    node: NodeId,
) -> Vector6<f64> {
    let carrier = plan.topology.carrier_of[node.0];
    let block = plan.block(workspace, carrier);
    let mut at_reference = Vector6::zeros();
    for (k, &idc) in plan.columns[carrier].iter().enumerate() {
        at_reference += read(block, 6 * k) * solution[idc];
    }
    shift(geometry, plan.topology.carriers[carrier].reference, node) * at_reference
}
