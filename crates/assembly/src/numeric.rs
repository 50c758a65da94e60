//! The numeric pass of one pose: carriers' blocks, elements, assembled stiffness (Eqs. 40–42).

use hyperstat_elements::subassembly::{
    ElasticJoint, JointFactor, StiffSegment, absorb_joints, chain_stiffness,
};
use hyperstat_elements::{Beam, element_frame, rotate_matrix6};
use hyperstat_joints::rigid_motion;
use nalgebra::{Matrix6, Rotation3, Vector3, Vector6};

use crate::coordinates::{read, shift, write};
use crate::directions::to_directions;
use crate::error::SolveError;
use crate::kinematics::characteristic_length;
use crate::model::{Geometry, JointId, Model, NodeId, SegmentId};
use crate::plan::{COLUMNS, ElementPlan, Plan, Source, Workspace};
use crate::topology::{Cluster, LONGEST_CLUSTER};

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

/// Brings blocks, elements, stiffness and loads of `workspace` to a configuration.
pub(crate) fn evaluate(
    plan: &Plan,
    model: &Model,
    geometry: &Geometry,
    workspace: &mut Workspace,
) -> Result<(), Fault> {
    workspace.tree.evaluate(&plan.topology, model, geometry)?;
    for (coordinate, idc) in plan.idc_of.iter().enumerate() {
        if let Some(idc) = idc {
            workspace.identities[*idc] = workspace.tree.identities[coordinate];
        }
    }
    close_loops(plan, model, geometry, workspace)?;
    workspace.initial.fill(0.0);
    for element in &plan.elements {
        match element.source {
            Source::Cluster(k) => {
                let cluster = &plan.topology.clusters[k];
                cluster_element(plan, element, cluster, model, geometry, workspace)?;
            }
            Source::Spring(joint) => {
                spring_element(plan, element, joint, model, geometry, workspace)
            }
        }
    }
    assemble(plan, workspace);
    load(plan, model, geometry, workspace);
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

/// Beam of a segment, its frame and span in a configuration.
pub(crate) fn segment_beam(
    model: &Model,
    geometry: &Geometry,
    id: SegmentId,
) -> Result<(Beam, Rotation3<f64>, Vector3<f64>), SolveError> {
    let segment = &model.segments()[id.0];
    let [a, b] = segment.ends.map(|n| geometry.positions[n.0]);
    let span = b - a;
    let frame = element_frame(&span, geometry.y_axes[id.0].as_ref())?;
    let beam = Beam::new(&segment.material, &segment.section, span.norm())?;
    Ok((beam, frame, span))
}

/// Axes of a cluster: those of its first segment.
pub(crate) fn cluster_frame(
    cluster: &Cluster,
    geometry: &Geometry,
) -> Result<Rotation3<f64>, SolveError> {
    let (id, _) = cluster.segments[0];
    let span = geometry.positions[cluster.nodes[1].0] - geometry.positions[cluster.nodes[0].0];
    Ok(element_frame(&span, geometry.y_axes[id.0].as_ref())?)
}

/// An absorbed joint: its compliance in its own frame, and that frame in global axes.
pub(crate) fn absorbed_joint(
    plan: &Plan,
    model: &Model,
    geometry: &Geometry,
    joint: JointId,
) -> ElasticJoint {
    let own = plan.topology.joints[joint.0].directions.compliance;
    let basis = model.joints()[joint.0].joint.basis();
    ElasticJoint {
        compliance: basis * own.unwrap_or(Matrix6::zeros()) * basis.transpose(),
        frame: geometry.frames[joint.0],
    }
}

fn cluster_element(
    plan: &Plan,
    element: &ElementPlan,
    cluster: &Cluster,
    model: &Model,
    geometry: &Geometry,
    workspace: &mut Workspace,
) -> Result<(), SolveError> {
    let frame = cluster_frame(cluster, geometry)?;
    let to_local = frame.inverse();
    let rows = element.rows;
    let base = geometry.positions[cluster.nodes[0].0];

    // D: displacements of the nodes after the first relative to it, in the cluster's axes.
    let operator_start = element.operator_start;
    workspace.operators[operator_start..operator_start + rows * element.columns.len()].fill(0.0);
    for (r, (node, places)) in element.nodes.iter().enumerate() {
        let carrier = plan.topology.carrier_of[node.0];
        for (k, place) in places.iter().enumerate() {
            let u = read(plan.block(workspace, carrier), 6 * k);
            let column = operator_start + rows * place;
            if r == 0 {
                for (b, other) in cluster.nodes.iter().enumerate().skip(1) {
                    let arm = geometry.positions[other.0] - base;
                    let moved = rigid_motion(&arm) * u;
                    add_turned(
                        &mut workspace.operators,
                        column + 6 * (b - 1),
                        &to_local,
                        &moved,
                        -1.0,
                    );
                }
            } else {
                add_turned(
                    &mut workspace.operators,
                    column + 6 * (r - 1),
                    &to_local,
                    &u,
                    1.0,
                );
            }
        }
    }

    // Stiffness of those deformations.
    let stiffness =
        &mut workspace.stiffnesses[element.stiffness_start..element.stiffness_start + rows * rows];
    if cluster.segments.len() == 1 && cluster.joints.iter().all(Option::is_none) {
        let (beam, _, _) = segment_beam(model, geometry, cluster.segments[0].0)?;
        stiffness.copy_from_slice(beam.cantilever_stiffness().as_slice());
        return Ok(());
    }
    let mut segments = [StiffSegment {
        stiffness: Matrix6::zeros(),
        span: Vector3::zeros(),
    }; LONGEST_CLUSTER];
    let mut arms = [Vector3::zeros(); LONGEST_CLUSTER];
    for (k, (id, reversed)) in cluster.segments.iter().enumerate() {
        let (beam, own, span) = segment_beam(model, geometry, *id)?;
        // Run through backwards, the segment is the same beam turned by π about its z axis.
        let turned = if *reversed { own * half_turn() } else { own };
        segments[k] = StiffSegment {
            stiffness: rotate_matrix6(&beam.cantilever_stiffness(), &(to_local * turned)),
            span: to_local * if *reversed { -span } else { span },
        };
        arms[k] = to_local * (geometry.positions[cluster.nodes[k + 1].0] - base);
    }
    let count = cluster.segments.len();
    chain_stiffness(&segments[..count], stiffness);
    let mut factors = [JointFactor {
        node: 0,
        factor: Matrix6::zeros(),
    }; LONGEST_CLUSTER + 1];
    let mut absorbed = 0;
    for (r, joint) in cluster.joints.iter().enumerate() {
        let Some(joint) = joint else { continue };
        let elastic = absorbed_joint(plan, model, geometry, *joint);
        let local = ElasticJoint {
            frame: to_local * elastic.frame,
            ..elastic.clone()
        };
        factors[absorbed] = JointFactor {
            node: r,
            factor: local.factor(),
        };
        absorbed += 1;
        let load = node_load(model, cluster.nodes[r]);
        if load != Vector6::zeros() {
            let initial =
                &mut workspace.initial[element.initial_start..element.initial_start + rows];
            let give = elastic.turned_compliance() * load;
            if r == 0 {
                for (b, other) in cluster.nodes.iter().enumerate().skip(1) {
                    let arm = geometry.positions[other.0] - base;
                    let moved = rigid_motion(&arm) * give;
                    add_turned(initial, 6 * (b - 1), &to_local, &moved, -1.0);
                }
            } else {
                add_turned(initial, 6 * (r - 1), &to_local, &give, 1.0);
            }
        }
    }
    absorb_joints(
        &factors[..absorbed],
        &arms[..count],
        stiffness,
        &mut workspace.absorption,
    )?;
    Ok(())
}

/// `π` about z.
pub(crate) fn half_turn() -> Rotation3<f64> {
    Rotation3::from_matrix_unchecked(nalgebra::Matrix3::from_diagonal(&Vector3::new(
        -1.0, -1.0, 1.0,
    )))
}

/// Sum of the loads on a node.
pub(crate) fn node_load(model: &Model, node: NodeId) -> Vector6<f64> {
    let on_node = model.loads().iter().filter(|l| l.node == node);
    on_node.map(|l| l.wrench).sum()
}

fn add_turned(
    values: &mut [f64],
    start: usize,
    rotation: &Rotation3<f64>,
    u: &Vector6<f64>,
    sign: f64,
) {
    let linear = rotation * Vector3::new(u[0], u[1], u[2]);
    let angular = rotation * Vector3::new(u[3], u[4], u[5]);
    for k in 0..3 {
        values[start + k] += sign * linear[k];
        values[start + 3 + k] += sign * angular[k];
    }
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
    let directions = &plan.topology.joints[joint.0].directions;
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
            for (row, dof) in directions.elastic.iter().enumerate() {
                workspace.operators[start + rows * place + row] += sign * relative[dof.index()];
            }
        }
    }
    for (c, column) in directions.elastic.iter().enumerate() {
        for (r, row) in directions.elastic.iter().enumerate() {
            workspace.stiffnesses[element.stiffness_start + rows * c + r] =
                directions.stiffness[(row.index(), column.index())];
        }
    }
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

/// The model's loads on the IDCs: `Σ Hᵀ F` over all nodes.
fn load(plan: &Plan, model: &Model, geometry: &Geometry, workspace: &mut Workspace) {
    workspace.loads.fill(0.0);
    for load in model.loads() {
        add_load(
            plan,
            geometry,
            workspace,
            COLUMNS - 1,
            load.node,
            &load.wrench,
        );
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
    shift(geometry, plan.topology.carriers[carrier].reference, node) * at_reference
}
