//! Elements and their places in the matrix.

use hyperstat_model::{JointId, Model, NodeId, to_directions};
use nalgebra::Rotation3;

use super::sparse::Pattern;
use super::topology::Topology;

/// What an element is made from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Source {
    /// A run of segments with its absorbed joints.
    Subassembly(usize),
    /// The elastic directions of a joint that keep coordinates of their own.
    Spring(JointId),
}

/// An element: deformations `δ = D U + δ₀` over its IDCs, and their stiffness.
#[derive(Debug, Clone)]
pub(crate) struct ElementPlan {
    pub source: Source,
    /// Number of deformations.
    pub rows: usize,
    /// IDCs, ascending: `inner` inner ones, then the output's.
    pub columns: Vec<usize>,
    pub inner: usize,
    /// Nodes it depends on, each with the places in `columns` of its carrier's columns; past their
    /// end for one that the element's deformations do not depend on.
    pub nodes: Vec<(NodeId, Vec<usize>)>,
    pub operator_start: usize,
    pub stiffness_start: usize,
    pub initial_start: usize,
    pub places_start: usize,
}

/// The columns of all carriers' blocks.
pub(crate) struct BlockColumns<'a> {
    /// IDCs of the columns.
    pub all: &'a [Vec<usize>],
    /// Of carriers whose rotation depends on some of them only, these.
    pub turning: &'a [Option<Vec<usize>>],
}

/// One element a subassembly, and one a joint whose elastic directions keep their coordinates.
pub(crate) fn elements(
    model: &Model,
    topology: &Topology,
    columns: &BlockColumns<'_>,
) -> Vec<ElementPlan> {
    let subassemblies = topology
        .subassemblies
        .iter()
        .enumerate()
        .map(|(k, subassembly)| {
            let rows = 6 * (subassembly.nodes.len() - 1);
            (Source::Subassembly(k), rows, subassembly.nodes.clone())
        });
    let springs = topology.joints.iter().enumerate().filter_map(|(k, role)| {
        if role.springs.is_empty() {
            return None;
        }
        let nodes: Vec<NodeId> = model.joints()[k]
            .between
            .iter()
            .flatten()
            .copied()
            .collect();
        Some((Source::Spring(JointId(k)), role.springs.len(), nodes))
    });
    let mut elements: Vec<ElementPlan> = Vec::new();
    let (mut operator_start, mut stiffness_start, mut initial_start) = (0, 0, 0);
    for (source, rows, nodes) in subassemblies.chain(springs) {
        let turns = match source {
            Source::Spring(joint) => only_turns(model, topology, joint),
            Source::Subassembly(_) => false,
        };
        let needed = |node: &NodeId| {
            let carrier = topology.carrier_of[node.0];
            let turning = columns.turning[carrier].as_ref().filter(|_| turns);
            turning.unwrap_or(&columns.all[carrier])
        };
        let mut all: Vec<usize> = nodes.iter().flat_map(needed).copied().collect();
        all.sort_unstable();
        all.dedup();
        let nodes = nodes
            .into_iter()
            .map(|n| {
                let own = &columns.all[topology.carrier_of[n.0]];
                let place = |c: &usize| all.binary_search(c).unwrap_or(all.len());
                (n, own.iter().map(place).collect())
            })
            .collect();
        let count = all.len();
        elements.push(ElementPlan {
            source,
            rows,
            columns: all,
            inner: 0,
            nodes,
            operator_start,
            stiffness_start,
            initial_start,
            places_start: 0,
        });
        operator_start += rows * count;
        stiffness_start += rows * rows;
        initial_start += rows;
    }
    elements
}

/// Whether all springs of a joint that keep coordinates are about its axes.
fn only_turns(model: &Model, topology: &Topology, joint: JointId) -> bool {
    let basis = model.joints()[joint.0].joint.basis();
    let map = to_directions(&basis, &Rotation3::identity());
    let mut springs = topology.joints[joint.0].springs.iter();
    springs.all(|dof| (0..3).all(|k| map[(dof.index(), k)] == 0.0))
}

/// Where every pair (a ≤ b) of an element's inner columns goes in the assembled values.
pub(crate) fn places(elements: &mut [ElementPlan], pattern: &Pattern) -> Vec<usize> {
    let mut places = Vec::new();
    for element in elements {
        element.places_start = places.len();
        element.inner = element.columns.partition_point(|c| *c < pattern.size());
        for (b, &row) in element.columns[..element.inner].iter().enumerate() {
            let columns = &element.columns[..=b];
            places.extend(columns.iter().map(|column| pattern.place(row, *column)));
        }
    }
    places
}
