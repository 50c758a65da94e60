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
use crate::plan::closing::Conditions;
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
    carry(plan, at, workspace)?;
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

/// Brings the blocks of all carriers to a configuration.
pub(crate) fn carry(plan: &Plan, at: &Posture<'_>, workspace: &mut Workspace) -> Result<(), Fault> {
    workspace.doubtful = None;
    workspace.tree.evaluate(&plan.topology, at)?;
    for (coordinate, idc) in plan.idc_of.iter().enumerate() {
        if let Some(idc) = idc {
            workspace.identities[*idc] = workspace.tree.identities[coordinate];
        }
    }
    close_loops(plan, at, workspace)
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
        let conditions = Conditions::new(component, &workspace.tree, topology, at);
        let solved = conditions.solved(&closed.order)?;
        workspace.doubtful = workspace.doubtful.or(solved.doubtful());
        let independent = solved.independent();
        let spared = independent
            .iter()
            .take_while(|c| **c < closed.order.spared)
            .count();
        let full = closed.order.spared > 0 && spared == closed.order.spared;
        let expected = closed.order.spared > 0 && plan.output_is_independent();
        let others = (closed.independent.as_ref()).is_some_and(|own| own != independent);
        if independent.len() != closed.idcs.len() || full != expected || others {
            return Err(Fault::Changed);
        }
        for (place, coordinate) in independent.iter().enumerate() {
            workspace.identities[closed.idc(place)] = workspace.tree.identities[first + coordinate];
        }
        for carrier in component.members() {
            let Some(start) = plan.reduced_starts[carrier] else {
                continue;
            };
            let columns = &plan.columns[carrier];
            workspace.reduced[start..start + 6 * columns.len()].fill(0.0);
            let coordinates = topology.carriers[carrier].coordinates.iter();
            for (k, &coordinate) in coordinates.enumerate() {
                let own = workspace.tree.starts[carrier] + 6 * k;
                let own = read(&workspace.tree.values, own);
                for (place, weight) in solved.weights(coordinate - first) {
                    let Ok(column) = columns.binary_search(&closed.idc(place)) else {
                        return Err(Fault::Changed);
                    };
                    let block = start + 6 * column;
                    let column = read(&workspace.reduced, block) + own * weight;
                    write(&mut workspace.reduced, block, &column);
                }
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
