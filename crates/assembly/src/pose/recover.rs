//! Recovery of everything else: displacements of all nodes, end forces, joint wrenches.

use std::collections::HashMap;

use hyperstat_elements::{BeamLoad, rotate_vector6};
use hyperstat_joints::{Dof, DofSet};
use hyperstat_model::{JointId, Model, NodeId, rotation6};
use nalgebra::{DMatrix, DVector, Matrix6, Point3, Vector6};

use super::joining::join;
use super::subassembly::{absorbed_joint, misfit_inside, subassembly_frame};
use crate::answer::solution::{SegmentForces, State};
use crate::error::SolveError;
use crate::plan::Plan;
use crate::plan::blocks::{multiply, shift};
use crate::plan::elements::Source;
use crate::plan::workspace::{LOADS, Workspace};
use crate::pose::{node_displacement, node_motion};
use crate::posture::Posture;
use crate::rank::dense::{Elimination, RANK_TOLERANCE};
use crate::rank::dissection::{Graph, levels};
use crate::rank::sparse::{SparseElimination, SparseVector};
use crate::sets::Sets;
use crate::state::acting::Acting;
use crate::state::floor::Floor;
use crate::state::preload::loose_wrench;

/// Most carriers whose equilibrium is found with complete pivoting.
const MOST_DENSE: usize = 40;

/// Most joints after one at a carrier that are taken for its neighbours.
const MOST_NEIGHBOURS: usize = 16;

/// What is recovered from the IDCs.
pub(crate) struct Recovered {
    pub state: State,
    /// A pivot of the joints' equilibrium between zero and not zero.
    pub doubtful: Option<f64>,
    /// What wrenches inside absorbed joints are off by \[N\], moments over the size.
    pub off: f64,
}

/// Recovers displacements and forces under a set of loads, from its column of the solutions; the
/// displacement of the output is known. What is rounding beside what acts is zero.
pub(crate) fn recover(
    plan: &Plan,
    at: &Posture<'_>,
    workspace: &Workspace,
    set: usize,
    (acting, floor): (&Acting, &Floor),
    mut output: Vector6<f64>,
) -> Result<Recovered, SolveError> {
    let Posture {
        model, geometry, ..
    } = *at;
    let column = LOADS + set;
    let mut displacements: Vec<Vector6<f64>> = (0..model.nodes().len())
        .map(|n| node_displacement(plan, geometry, workspace, column, NodeId(n)))
        .collect();
    let remainder = &workspace.remainders[set * plan.unknowns..][..plan.unknowns];
    for (n, displacement) in displacements.iter_mut().enumerate() {
        *displacement += node_motion(plan, geometry, workspace, remainder, NodeId(n));
    }
    output += node_motion(plan, geometry, workspace, remainder, plan.output);
    let loads = node_loads(model, acting);
    let all_forces = element_forces(plan, workspace, set);
    // What the elements take at their nodes: the sum of all other wrenches on the node.
    let mut demand = vec![Vector6::zeros(); model.nodes().len()];
    let mut segments: Vec<Option<SegmentForces>> = vec![None; model.segments().len()];
    for (element, forces) in plan.elements.iter().zip(&all_forces) {
        let Source::Subassembly(k) = element.source else {
            continue;
        };
        let subassembly = &plan.topology.subassemblies[k];
        let frame = subassembly_frame(subassembly, geometry)?;
        // Wrenches at the nodes after the first, in global axes; what goes through every
        // segment's end, or for a flexible body their sum at the first node.
        let mut through = Vector6::zeros();
        for r in (1..subassembly.nodes.len()).rev() {
            let node = subassembly.nodes[r];
            let at_node = rotate_vector6(
                &Vector6::from_column_slice(&forces[6 * (r - 1)..6 * r]),
                &frame,
            );
            demand[node.0] += at_node;
            if subassembly.flexible.is_some() {
                let first = subassembly.nodes[0];
                through += shift(geometry, first, node).transpose() * at_node;
                continue;
            }
            through += at_node;
            let before = subassembly.nodes[r - 1];
            let (id, reversed) = subassembly.segments[r - 1];
            let placed = at.beam(id)?;
            let (own, length) = (placed.frame, placed.span.norm());
            let at_before = shift(geometry, before, node).transpose() * through;
            let to_own = own.inverse();
            let (far, near) = (
                rotate_vector6(&through, &to_own),
                -rotate_vector6(&at_before, &to_own),
            );
            let mut ends = if reversed { [far, near] } else { [near, far] };
            let load = acting.on_segment(id).copied();
            if let Some(load) = &load {
                ends[0] -= load.resultant(length);
            }
            segments[id.0] = Some(SegmentForces {
                frame: own,
                length,
                ends,
                load: load.unwrap_or_else(BeamLoad::none),
            });
            through = at_before;
        }
        demand[subassembly.nodes[0].0] -= through;
    }
    for subassembly in &plan.topology.subassemblies {
        for (node, joint) in subassembly.nodes.iter().zip(&subassembly.joints) {
            if let Some(joint) = joint {
                let wrench = demand[node.0] - loads[node.0];
                let elastic = absorbed_joint(plan, at, *joint);
                displacements[node.0] -= elastic.turned_compliance() * wrench;
                if acting.misfits {
                    displacements[node.0] += misfit_inside(plan, at, *joint, *node);
                }
            }
        }
    }
    let off = join(
        plan,
        at,
        workspace,
        &segments,
        &mut displacements,
        floor.size,
    )?;
    for (wrench, load) in demand.iter_mut().zip(&loads) {
        *wrench -= load;
    }
    let (mut joint_wrenches, doubtful) = joint_wrenches(plan, at, &all_forces, &demand);
    if acting.misfits {
        for entry in model.misfits() {
            if let Some(wrench) = &mut joint_wrenches[entry.joint.0] {
                *wrench += loose_wrench(model, entry);
            }
        }
    }
    let mut state = State {
        output,
        displacements,
        joint_wrenches,
        segments: segments.into_iter().flatten().collect(),
        floor: *floor,
    };
    state.clear_rounding();
    Ok(Recovered {
        state,
        doubtful,
        off,
    })
}

impl State {
    /// Sets to zero what is rounding beside what acts.
    fn clear_rounding(&mut self) {
        let floor = self.floor;
        let displacements = self.displacements.iter_mut();
        displacements
            .chain([&mut self.output])
            .for_each(|u| floor.clear_displacement(u));
        let ends = self.segments.iter_mut().flat_map(|s| &mut s.ends);
        let wrenches = self.joint_wrenches.iter_mut().flatten();
        wrenches.chain(ends).for_each(|w| floor.clear_wrench(w));
    }
}

/// Forces `k (D U + δ₀)` of all elements, the solution's remainder included.
pub(crate) fn element_forces(plan: &Plan, workspace: &Workspace, set: usize) -> Vec<Vec<f64>> {
    let n = plan.unknowns;
    let solution = &workspace.solutions[(LOADS + set) * n..][..n];
    let remainder = &workspace.remainders[set * n..][..n];
    let mut all = Vec::with_capacity(plan.elements.len());
    for element in &plan.elements {
        let (rows, count) = (element.rows, element.columns.len());
        let start = element.operator_start;
        let d = &workspace.operators[start..start + rows * count];
        let start = element.stiffness_start;
        let k = &workspace.stiffnesses[start..start + rows * rows];
        let start = set * plan.deformations + element.initial_start;
        let initial = &workspace.initial[start..start + rows];
        let mut deformations = [initial.to_vec(), vec![0.0; rows]].concat();
        let (whole, small) = deformations.split_at_mut(rows);
        for (&idc, column) in element.columns.iter().zip(d.chunks_exact(rows)) {
            for (row, entry) in column.iter().enumerate() {
                whole[row] += solution[idc] * entry;
                small[row] += remainder[idc] * entry;
            }
        }
        let mut forces = vec![0.0; 2 * rows];
        multiply(k, &deformations, rows, &mut forces);
        all.push(
            (0..rows)
                .map(|row| forces[row] + forces[rows + row])
                .collect(),
        );
    }
    all
}

/// A joint as equilibrium sees it.
struct JointForces {
    /// Wrench on the second body, global axes, for a unit along each direction.
    basis: Matrix6<f64>,
    /// Directions whose force equilibrium must find.
    unknown: DofSet,
    /// Forces of the springs that keep coordinates of their own.
    known: Vector6<f64>,
}

/// Sums of the loads on all nodes.
fn node_loads(model: &Model, acting: &Acting) -> Vec<Vector6<f64>> {
    let mut loads = vec![Vector6::zeros(); model.nodes().len()];
    for (node, wrench) in &acting.nodes {
        loads[node.0] += wrench;
    }
    loads
}

/// Wrenches of all joints from the equilibrium of their carriers, group by group; `None` where
/// redundant rigid constraints leave one undetermined. `demand` is what joints must give each
/// node.
fn joint_wrenches(
    plan: &Plan,
    at: &Posture<'_>,
    element_forces: &[Vec<f64>],
    demand: &[Vector6<f64>],
) -> (Vec<Option<Vector6<f64>>>, Option<f64>) {
    let Posture {
        model, geometry, ..
    } = *at;
    let count = model.joints().len();
    let mut springs = vec![Vector6::zeros(); count];
    for (element, forces) in plan.elements.iter().zip(element_forces) {
        if let Source::Spring(joint) = element.source {
            let elastic = plan.topology.joints[joint.0].springs;
            for (dof, force) in elastic.iter().zip(forces) {
                springs[joint.0][dof.index()] = *force;
            }
        }
    }
    let joints: Vec<JointForces> = (0..count)
        .map(|k| {
            let local = at.direction_map(JointId(k));
            let role = &plan.topology.joints[k];
            JointForces {
                basis: local.transpose(),
                unknown: role.moving.complement(),
                known: springs[k],
            }
        })
        .collect();

    // Wrench that the joints of a carrier must give it, at its reference.
    let carriers = &plan.topology.carriers;
    let mut needed = vec![Vector6::zeros(); carriers.len()];
    for (n, wrench) in demand.iter().enumerate() {
        let carrier = plan.topology.carrier_of[n];
        let arm = shift(geometry, carriers[carrier].reference, NodeId(n));
        needed[carrier] += arm.transpose() * wrench;
    }
    let ends: Vec<Vec<(usize, f64, Matrix6<f64>)>> = model
        .joints()
        .iter()
        .map(|joint| {
            let sides = joint.between.iter().zip([-1.0, 1.0]);
            sides
                .filter_map(|(node, sign)| {
                    let node = (*node)?;
                    let carrier = plan.topology.carrier_of[node.0];
                    let arm = shift(geometry, carriers[carrier].reference, node);
                    Some((carrier, sign, arm.transpose()))
                })
                .collect()
        })
        .collect();
    for (joint, ends) in joints.iter().zip(&ends) {
        for (carrier, sign, arm) in ends {
            needed[*carrier] -= arm * joint.basis * joint.known * *sign;
        }
    }

    let mut forces: Vec<Option<Vector6<f64>>> = joints.iter().map(|j| Some(j.known)).collect();
    let mut doubtful = None;
    // Only forces that equilibrium must find tie carriers together.
    let unknown: Vec<usize> = (0..count)
        .filter(|k| !joints[*k].unknown.is_empty())
        .collect();
    let end_carriers = |joint: usize| between(plan, model, joint);
    for group in groups(carriers.len(), &unknown, end_carriers) {
        let found = equilibrium(&group, &joints, &ends, &needed, at, &mut forces);
        doubtful = doubtful.or(found);
    }
    let wrenches = (0..count)
        .map(|k| {
            let wrench = joints[k].basis * forces[k]?;
            Some(rotation6(&geometry.frames[k]).transpose() * wrench)
        })
        .collect();
    (wrenches, doubtful)
}

/// Carriers and joints that are connected, the ground apart.
struct Group {
    carriers: Vec<usize>,
    joints: Vec<usize>,
}

/// The carriers that a joint lies between, the ground apart.
fn between(plan: &Plan, model: &Model, joint: usize) -> [Option<usize>; 2] {
    let nodes = model.joints()[joint].between;
    nodes.map(|node| node.map(|node| plan.topology.carrier_of[node.0]))
}

/// Groups of carriers that `joints` connect, each between `ends`.
fn groups(
    carriers: usize,
    joints: &[usize],
    ends: impl Fn(usize) -> [Option<usize>; 2],
) -> Vec<Group> {
    let mut group_of = Sets::new(carriers);
    for &joint in joints {
        if let [Some(a), Some(b)] = ends(joint) {
            group_of.join(a, b);
        }
    }
    let mut groups: Vec<Group> = Vec::new();
    let mut place = vec![usize::MAX; carriers];
    for &joint in joints {
        let Some(carrier) = ends(joint).into_iter().flatten().next() else {
            continue;
        };
        let root = group_of.root(carrier);
        if place[root] == usize::MAX {
            place[root] = groups.len();
            groups.push(Group {
                carriers: Vec::new(),
                joints: Vec::new(),
            });
        }
        groups[place[root]].joints.push(joint);
    }
    for carrier in 0..carriers {
        let root = group_of.root(carrier);
        if place[root] != usize::MAX {
            groups[place[root]].carriers.push(carrier);
        }
    }
    groups
}

/// Solves a group's equilibrium for the unknown joint forces, moments over a length; returns a
/// doubtful pivot.
fn equilibrium(
    group: &Group,
    joints: &[JointForces],
    ends: &[Vec<(usize, f64, Matrix6<f64>)>],
    needed: &[Vector6<f64>],
    at: &Posture<'_>,
    forces: &mut [Option<Vector6<f64>>],
) -> Option<f64> {
    let unknowns: Vec<(usize, Dof)> = group
        .joints
        .iter()
        .flat_map(|&j| joints[j].unknown.iter().map(move |dof| (j, dof)))
        .collect();
    if unknowns.is_empty() {
        return None;
    }
    let is_large = group.carriers.len() > MOST_DENSE;
    let length = if is_large { at.arm_length() } else { at.size };
    let mut matrix = Vec::with_capacity(unknowns.len());
    let over_length = |mut w: Vector6<f64>| {
        for k in 3..6 {
            w[k] /= length;
        }
        w
    };
    let mut scales = Vec::with_capacity(unknowns.len());
    for (joint, dof) in &unknowns {
        let unit = joints[*joint].basis.column(dof.index()).into_owned();
        let scale = over_length(unit).norm();
        scales.push(scale);
        let mut column = Vec::with_capacity(2);
        for (carrier, sign, arm) in &ends[*joint] {
            if let Ok(row) = group.carriers.binary_search(carrier) {
                column.push((row, over_length(arm * unit) * (sign / scale)));
            }
        }
        matrix.push(column);
    }
    let mut right_side = DVector::zeros(6 * group.carriers.len());
    for (row, carrier) in group.carriers.iter().enumerate() {
        right_side
            .fixed_rows_mut::<6>(6 * row)
            .copy_from(&over_length(needed[*carrier]));
    }
    let (solution, open, doubtful) = if is_large {
        let of_joints = joint_levels(group, ends, at);
        let levels = unknowns.iter().map(|(joint, _)| of_joints[joint]).collect();
        sparsely_balanced(&matrix, &right_side, levels)
    } else {
        densely_balanced(&matrix, &right_side)
    };
    for (k, (joint, dof)) in unknowns.iter().enumerate() {
        if open[k] {
            forces[*joint] = None;
        } else if let Some(force) = &mut forces[*joint] {
            force[dof.index()] = solution[k] / scales[k];
        }
    }
    doubtful
}

/// Of some forces, the shares that each gives to carriers, by the carriers' places in their group.
type Shares = [Vec<(usize, Vector6<f64>)>];

/// Forces that balance a right side, which of them are undetermined, and a doubtful pivot.
type Balanced = (DVector<f64>, Vec<bool>, Option<f64>);

fn densely_balanced(shares: &Shares, right_side: &DVector<f64>) -> Balanced {
    let mut matrix = DMatrix::zeros(right_side.len(), shares.len());
    for (column, shares) in shares.iter().enumerate() {
        for (carrier, share) in shares {
            let mut view = matrix.fixed_view_mut::<6, 1>(6 * carrier, column);
            view += share;
        }
    }
    let first = Elimination::with_right_side(matrix.clone(), right_side.clone(), 0);
    let rest = right_side - &matrix * &first.particular;
    let correction = Elimination::with_right_side(matrix, rest, 0).particular;
    let undetermined = |k: usize| first.map.row(k).amax() > RANK_TOLERANCE;
    let open = (0..shares.len()).map(undetermined).collect();
    (first.particular + correction, open, first.doubtful)
}

/// Levels of a group's joints in a dissection; those at one carrier are neighbours.
fn joint_levels(
    group: &Group,
    ends: &[Vec<(usize, f64, Matrix6<f64>)>],
    at: &Posture<'_>,
) -> HashMap<usize, usize> {
    let mut joints_at: HashMap<usize, Vec<usize>> = HashMap::new();
    let mut places = Vec::with_capacity(group.joints.len());
    for (k, joint) in group.joints.iter().enumerate() {
        for (carrier, ..) in &ends[*joint] {
            joints_at.entry(*carrier).or_default().push(k);
        }
        let nodes = at.model.joints()[*joint].between;
        let node = nodes.into_iter().flatten().next();
        places.push(node.map_or(Point3::origin(), |node| at.geometry.positions[node.0]));
    }
    let mut graph: Graph = vec![Vec::new(); places.len()];
    for joints in joints_at.values() {
        // Where very many meet, those next to one another in the file.
        for (k, &a) in joints.iter().enumerate() {
            for &b in joints[k + 1..].iter().take(MOST_NEIGHBOURS) {
                if a != b && !graph[a].contains(&b) {
                    graph[a].push(b);
                    graph[b].push(a);
                }
            }
        }
    }
    let levels = levels(&graph, &places);
    group.joints.iter().copied().zip(levels).collect()
}

fn sparsely_balanced(shares: &Shares, right_side: &DVector<f64>, levels: Vec<usize>) -> Balanced {
    let mut rows: Vec<SparseVector> = vec![Vec::new(); right_side.len()];
    for (column, shares) in shares.iter().enumerate() {
        for (carrier, share) in shares {
            for (k, value) in share.iter().enumerate().filter(|(_, v)| **v != 0.0) {
                let row = &mut rows[6 * carrier + k];
                match row.last_mut() {
                    Some((last, sum)) if *last == column => *sum += value,
                    _ => row.push((column, *value)),
                }
            }
        }
    }
    let solved = SparseElimination::by_levels(rows.clone(), levels);
    let mut solution = solved.particular(right_side.as_slice());
    let rest = rows.iter().zip(right_side.iter()).map(|(row, asked)| {
        let met: f64 = row.iter().map(|(c, v)| v * solution[*c]).sum();
        asked - met
    });
    let correction = solved.particular(&rest.collect::<Vec<f64>>());
    for (value, correction) in solution.iter_mut().zip(correction) {
        *value += correction;
    }
    (DVector::from_vec(solution), solved.open(), solved.doubtful)
}
