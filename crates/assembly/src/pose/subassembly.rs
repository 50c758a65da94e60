//! The element of an elastic body: a run of segments or a flexible body, with the elastic joints
//! at its nodes absorbed (paper §2.1).

use hyperstat_elements::subassembly::{ElasticJoint, StiffSegment, absorb_joints, chain_stiffness};
use hyperstat_elements::{element_frame, rotate_matrix6, rotate_vector6};
use hyperstat_joints::rigid_motion;
use hyperstat_model::{Geometry, JointId, NodeId};
use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3, Vector6};

use crate::error::SolveError;
use crate::plan::Plan;
use crate::plan::blocks::{read, shift};
use crate::plan::elements::ElementPlan;
use crate::plan::subassemblies::{LONGEST_CLUSTER, Subassembly};
use crate::plan::workspace::Workspace;
use crate::posture::{PlacedBeam, Posture};
use crate::state::acting::Acting;
use crate::state::offsets::offset;
use crate::state::preload::{along, displacement_by_misfit, spring_misfit};

/// Axes of a subassembly: those of its first segment, or of the flexible body.
pub(crate) fn subassembly_frame(
    subassembly: &Subassembly,
    geometry: &Geometry,
) -> Result<Rotation3<f64>, SolveError> {
    if let Some(id) = subassembly.flexible {
        return Ok(geometry.rotations[id.0]);
    }
    let (id, _) = subassembly.segments[0];
    let span =
        geometry.positions[subassembly.nodes[1].0] - geometry.positions[subassembly.nodes[0].0];
    Ok(element_frame(&span, geometry.y_axes[id.0].as_ref())?)
}

/// An absorbed joint: its compliance in its own frame, and that frame in global axes.
pub(crate) fn absorbed_joint(plan: &Plan, at: &Posture<'_>, joint: JointId) -> ElasticJoint {
    let Posture {
        model, geometry, ..
    } = *at;
    let own = plan.topology.joints[joint.0].compliance;
    let basis = model.joints()[joint.0].joint.basis();
    ElasticJoint {
        compliance: basis * own * basis.transpose(),
        frame: geometry.frames[joint.0],
    }
}

/// A joint in the axes that `to_local` turns into.
fn seen_from(to_local: &Rotation3<f64>, joint: &ElasticJoint) -> ElasticJoint {
    ElasticJoint {
        frame: to_local * joint.frame,
        ..joint.clone()
    }
}

/// Writes the arms of a subassembly; returns the turn to its axes.
fn place_subassembly(
    subassembly: &Subassembly,
    geometry: &Geometry,
    workspace: &mut Workspace,
) -> Result<Rotation3<f64>, SolveError> {
    let to_local = subassembly_frame(subassembly, geometry)?.inverse();
    let base = geometry.positions[subassembly.nodes[0].0];
    for (arm, node) in workspace.arms.iter_mut().zip(&subassembly.nodes[1..]) {
        *arm = geometry.positions[node.0] - base;
    }
    Ok(to_local)
}

/// Forms the deformations that a subassembly's element starts from in each state: those that loads
/// inside absorbed joints make, the free ends of loaded segments, and misfits.
pub(crate) fn subassembly_initial(
    plan: &Plan,
    element: &ElementPlan,
    subassembly: &Subassembly,
    at: &Posture<'_>,
    acting: &[Acting],
    workspace: &mut Workspace,
) -> Result<(), SolveError> {
    let Posture { geometry, .. } = *at;
    let to_local = place_subassembly(subassembly, geometry, workspace)?;
    if !workspace.offsets.is_empty() {
        add_misfits(plan, element, subassembly, at, &to_local, workspace);
    }
    for (set, acting) in acting.iter().enumerate() {
        let start = set * plan.deformations + element.initial_start;
        let initial = &mut workspace.initial[start..start + element.rows];
        for (r, joint) in subassembly.joints.iter().enumerate() {
            let Some(joint) = joint else { continue };
            let load = acting.on_node(subassembly.nodes[r]);
            if load != Vector6::zeros() {
                let elastic = absorbed_joint(plan, at, *joint);
                let give = elastic.turned_compliance() * load;
                add_deformation(initial, r, &give, &workspace.arms, &to_local);
            }
        }
        for (r, (id, reversed)) in subassembly.segments.iter().enumerate() {
            let Some(load) = acting.on_segment(*id) else {
                continue;
            };
            let placed = at.beam(*id)?;
            let free_end = placed.beam.straight().free_end(load);
            let mut free = -rotate_vector6(&free_end, &placed.frame);
            if *reversed {
                // With the second node held instead: δ seen from there, carried to the first.
                free = -(rigid_motion(&-placed.span) * free);
            }
            for (k, node) in subassembly.nodes[1..].iter().enumerate().skip(r) {
                let carried = shift(geometry, subassembly.nodes[r + 1], *node) * free;
                add_turned(&mut initial[6 * k..], &to_local, &carried, 1.0);
            }
        }
    }
    Ok(())
}

/// Adds the deformations that misfits make with all IDCs zero, in every state.
fn add_misfits(
    plan: &Plan,
    element: &ElementPlan,
    subassembly: &Subassembly,
    at: &Posture<'_>,
    to_local: &Rotation3<f64>,
    workspace: &mut Workspace,
) {
    let Posture { geometry, .. } = *at;
    for (r, (node, joint)) in subassembly
        .nodes
        .iter()
        .zip(&subassembly.joints)
        .enumerate()
    {
        let mut moved = offset(plan, geometry, workspace, *node);
        if let Some(joint) = joint {
            moved += misfit_inside(plan, at, *joint, *node);
        }
        for state in workspace.initial.chunks_exact_mut(plan.deformations) {
            let start = &mut state[element.initial_start..element.initial_start + element.rows];
            add_deformation(start, r, &moved, &workspace.arms, to_local);
        }
    }
}

/// What the misfit of an absorbed joint displaces the body's own node by, global axes.
pub(crate) fn misfit_inside(
    plan: &Plan,
    at: &Posture<'_>,
    joint: JointId,
    node: NodeId,
) -> Vector6<f64> {
    let Posture { model, .. } = *at;
    let Some(entry) = model.misfit(joint) else {
        return Vector6::zeros();
    };
    let role = &plan.topology.joints[joint.0];
    let inside = role.directions.elastic.difference(role.springs);
    let misfit = along(&spring_misfit(&role.directions, entry), inside);
    let apart = displacement_by_misfit(at, joint, &misfit);
    if model.joints()[joint.0].between[1] == Some(node) {
        apart
    } else {
        -apart
    }
}

/// Forms the operator and the stiffness of a subassembly's element.
pub(crate) fn subassembly_element(
    plan: &Plan,
    element: &ElementPlan,
    subassembly: &Subassembly,
    at: &Posture<'_>,
    workspace: &mut Workspace,
) -> Result<(), SolveError> {
    let Posture { geometry, .. } = *at;
    let to_local = place_subassembly(subassembly, geometry, workspace)?;
    operator(plan, element, &to_local, workspace);
    stiffness(plan, element, subassembly, &to_local, at, workspace)
}

/// The stiffness of a subassembly's element; the workspace has the arms.
fn stiffness(
    plan: &Plan,
    element: &ElementPlan,
    subassembly: &Subassembly,
    to_local: &Rotation3<f64>,
    at: &Posture<'_>,
    workspace: &mut Workspace,
) -> Result<(), SolveError> {
    let Posture { model, .. } = *at;
    let rows = element.rows;
    let start = element.stiffness_start;
    let stiffness = &mut workspace.stiffnesses[start..start + rows * rows];
    match subassembly.flexible {
        Some(id) => {
            let held = model.flexibles()[id.0].element.held_stiffness();
            stiffness.copy_from_slice(held.as_slice());
        }
        None => run_stiffness(subassembly, to_local, at, stiffness)?,
    }
    if subassembly.joints.iter().all(Option::is_none) {
        return Ok(());
    }
    absorb(plan, element, subassembly, to_local, at, workspace)
}

/// D: displacements of the nodes after the first relative to it, in the subassembly's axes.
fn operator(
    plan: &Plan,
    element: &ElementPlan,
    to_local: &Rotation3<f64>,
    workspace: &mut Workspace,
) {
    let rows = element.rows;
    let start = element.operator_start;
    workspace.operators[start..start + rows * element.columns.len()].fill(0.0);
    for (r, (node, places)) in element.nodes.iter().enumerate() {
        let carrier = plan.topology.carrier_of[node.0];
        for (k, place) in places.iter().enumerate() {
            let u = read(plan.block(workspace, carrier), 6 * k);
            let column = &mut workspace.operators[start + rows * place..][..rows];
            add_deformation(column, r, &u, &workspace.arms, to_local);
        }
    }
}

/// Adds the deformations, in the subassembly's axes, that a displacement of node `r` gives: its own,
/// or for node 0 the opposite of what would carry the other nodes along.
fn add_deformation(
    deformations: &mut [f64],
    r: usize,
    u: &Vector6<f64>,
    arms: &[Vector3<f64>],
    to_local: &Rotation3<f64>,
) {
    if r > 0 {
        add_turned(&mut deformations[6 * (r - 1)..], to_local, u, 1.0);
        return;
    }
    for (part, arm) in deformations.chunks_exact_mut(6).zip(arms) {
        add_turned(part, to_local, &(rigid_motion(arm) * u), -1.0);
    }
}

/// Stiffness of a run of segments with its first node held.
fn run_stiffness(
    subassembly: &Subassembly,
    to_local: &Rotation3<f64>,
    at: &Posture<'_>,
    stiffness: &mut [f64],
) -> Result<(), SolveError> {
    if let ([(id, _)], true) = (
        subassembly.segments.as_slice(),
        subassembly.joints.iter().all(Option::is_none),
    ) {
        let held = at.beam(*id)?.beam.cantilever_stiffness();
        stiffness.copy_from_slice(held.as_slice());
        return Ok(());
    }
    let mut segments = [StiffSegment {
        stiffness: Matrix6::zeros(),
        span: Vector3::zeros(),
    }; LONGEST_CLUSTER];
    for (k, (id, reversed)) in subassembly.segments.iter().enumerate() {
        let placed = at.beam(*id)?;
        let PlacedBeam { beam, frame, span } = &*placed;
        let (held, turned, span) = if *reversed {
            (beam.reversed_stiffness(), frame * half_turn(), -span)
        } else {
            (beam.cantilever_stiffness(), *frame, *span)
        };
        segments[k] = StiffSegment {
            stiffness: rotate_matrix6(&held, &(to_local * turned)),
            span: to_local * span,
        };
    }
    chain_stiffness(&segments[..subassembly.segments.len()], stiffness);
    Ok(())
}

/// `π` about z.
fn half_turn() -> Rotation3<f64> {
    Rotation3::from_matrix_unchecked(Matrix3::from_diagonal(&Vector3::new(-1.0, -1.0, 1.0)))
}

/// Absorbs the subassembly's joints into its stiffness.
fn absorb(
    plan: &Plan,
    element: &ElementPlan,
    subassembly: &Subassembly,
    to_local: &Rotation3<f64>,
    at: &Posture<'_>,
    workspace: &mut Workspace,
) -> Result<(), SolveError> {
    let rows = element.rows;
    let mut absorbed = 0;
    for (r, joint) in subassembly.joints.iter().enumerate() {
        let Some(joint) = joint else { continue };
        let elastic = absorbed_joint(plan, at, *joint);
        let local = seen_from(to_local, &elastic);
        workspace.factors[absorbed].node = r;
        workspace.factors[absorbed].factor = local.factor();
        absorbed += 1;
    }
    let arms = &mut workspace.arms[..rows / 6];
    for arm in arms.iter_mut() {
        *arm = to_local * *arm;
    }
    let stiffness = &mut workspace.stiffnesses[element.stiffness_start..][..rows * rows];
    absorb_joints(
        &workspace.factors[..absorbed],
        arms,
        stiffness,
        &mut workspace.absorption,
    )?;
    Ok(())
}

fn add_turned(values: &mut [f64], rotation: &Rotation3<f64>, u: &Vector6<f64>, sign: f64) {
    let linear = rotation * Vector3::new(u[0], u[1], u[2]);
    let angular = rotation * Vector3::new(u[3], u[4], u[5]);
    for k in 0..3 {
        values[k] += sign * linear[k];
        values[3 + k] += sign * angular[k];
    }
}
