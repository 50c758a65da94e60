//! Trees of carriers that joints tie together.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashSet};
use std::ops::Range;

use hyperstat_joints::DofSet;
use hyperstat_model::{BodyKind, JointId, Model, NodeId};

use super::roles::JointRole;
use crate::error::SolveError;
use crate::room;
use crate::room::MOST_NUMBERS;

/// What asks for too much room where trees are deep.
pub(crate) const CHAINS: &str = "its chains of rigid bodies and joints, one after another,";

/// A carrier of six displacement coordinates, kept at `reference`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Carrier {
    pub reference: NodeId,
    /// Tree coordinates its displacement depends on, in the order of its block's columns.
    pub coordinates: Vec<usize>,
}

/// A joint along which displacement is handed from `parent` to `child`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Tie {
    pub joint: JointId,
    /// `None` is the ground.
    pub parent: Option<usize>,
    pub parent_node: Option<NodeId>,
    pub child: usize,
    pub child_node: NodeId,
    /// Tree coordinates of the moving directions.
    pub coordinates: Range<usize>,
}

/// Carriers tied together by joints, ground apart.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Component {
    /// Carrier with six coordinates of its own, unless the tree hangs from the ground.
    pub root: Option<usize>,
    pub ties: Vec<Tie>,
    /// Joints whose rigid directions are conditions on the tree's coordinates.
    pub closings: Vec<JointId>,
    pub coordinates: Range<usize>,
}

/// One carrier a node of an elastic body, one a rigid body; the output is its carrier's reference.
pub(crate) fn carriers(model: &Model, output: NodeId) -> (Vec<Carrier>, Vec<usize>) {
    let mut carriers = Vec::new();
    let mut carrier_of = vec![0; model.nodes().len()];
    let mut add = |reference| {
        carriers.push(Carrier {
            reference,
            coordinates: Vec::new(),
        });
        carriers.len() - 1
    };
    for body in model.bodies() {
        match body.kind {
            BodyKind::Rigid => {
                let holds_output = body.nodes.contains(&output);
                let carrier = add(if holds_output { output } else { body.nodes[0] });
                for node in &body.nodes {
                    carrier_of[node.0] = carrier;
                }
            }
            BodyKind::Elastic | BodyKind::Flexible => {
                for node in &body.nodes {
                    carrier_of[node.0] = add(*node);
                }
            }
        }
    }
    (carriers, carrier_of)
}

/// Spanning trees: from the output's carrier, from the ground, or from the carrier with the most
/// joints; joints with the fewest moving directions first.
pub(crate) fn components(
    model: &Model,
    roles: &[JointRole],
    carriers: &mut [Carrier],
    carrier_of: &[usize],
    output: usize,
    coordinates: &mut usize,
) -> Result<(Vec<Component>, usize), SolveError> {
    struct Edge {
        joint: usize,
        ends: [Option<usize>; 2],
    }
    let edges: Vec<Edge> = (0..model.joints().len())
        .filter(|&k| roles[k].moving != DofSet::ALL)
        .map(|joint| Edge {
            joint,
            ends: model.joints()[joint]
                .between
                .map(|n| n.map(|n| carrier_of[n.0])),
        })
        .collect();
    let mut edges_at: Vec<Vec<usize>> = vec![Vec::new(); carriers.len()];
    for (k, edge) in edges.iter().enumerate() {
        for end in edge.ends.iter().flatten() {
            edges_at[*end].push(k);
        }
    }
    let members = connected(carriers.len(), &edges_at, |k| edges[k].ends);
    let mut components = Vec::with_capacity(members.len());
    let mut reached = vec![false; carriers.len()];
    let mut output_start = 0;
    // Every carrier depends on all coordinates between it and its root.
    let mut handed_on = 0;
    for group in members {
        let start = *coordinates;
        let grounded = group
            .iter()
            .flat_map(|c| &edges_at[*c])
            .any(|&e| edges[e].ends.contains(&None));
        let root = if group.contains(&output) {
            Some(output)
        } else if grounded {
            None
        } else {
            group
                .iter()
                .copied()
                .max_by_key(|c| (edges_at[*c].len(), usize::MAX - c))
        };
        if let Some(root) = root {
            if root == output {
                output_start = *coordinates;
            }
            carriers[root].coordinates = (*coordinates..*coordinates + 6).collect();
            *coordinates += 6;
            reached[root] = true;
        }
        // Ties in the order of the fewest moving directions, then of the joints, among those that
        // lead on from what is reached.
        let inside = |end: &Option<usize>, reached: &[bool]| match end {
            Some(c) => reached[*c],
            None => root.is_none(),
        };
        let key = |e: usize| Reverse((roles[edges[e].joint].moving.len(), edges[e].joint, e));
        let mut own: Vec<usize> = group.iter().flat_map(|c| edges_at[*c].clone()).collect();
        own.sort_unstable_by_key(|&e| Reverse(key(e)));
        own.dedup();
        let mut leading: BinaryHeap<_> = match root {
            Some(root) => edges_at[root].iter().map(|&e| key(e)).collect(),
            None => {
                let grounded = own.iter().filter(|e| edges[**e].ends.contains(&None));
                grounded.map(|&e| key(e)).collect()
            }
        };
        let mut ties = Vec::new();
        let mut used = HashSet::new();
        while let Some(Reverse((_, _, e))) = leading.pop() {
            let edge = &edges[e];
            let [a, b] = &edge.ends;
            let leads_on = inside(a, &reached) != inside(b, &reached)
                && (a.is_some() || root.is_none())
                && (b.is_some() || root.is_none());
            if !leads_on {
                continue;
            }
            let between = model.joints()[edge.joint].between;
            let child_side = usize::from(inside(&edge.ends[0], &reached));
            let (Some(child), Some(child_node)) = (edge.ends[child_side], between[child_side])
            else {
                continue;
            };
            used.insert(e);
            let parent = edge.ends[1 - child_side];
            let count = roles[edge.joint].moving.len();
            let range = *coordinates..*coordinates + count;
            *coordinates += count;
            let mut columns = parent.map_or(Vec::new(), |p| carriers[p].coordinates.clone());
            columns.extend(range.clone());
            handed_on += 6 * columns.len();
            room::check(CHAINS, handed_on, MOST_NUMBERS)?;
            carriers[child].coordinates = columns;
            carriers[child].reference = child_node;
            reached[child] = true;
            leading.extend(edges_at[child].iter().map(|&e| key(e)));
            ties.push(Tie {
                joint: JointId(edge.joint),
                parent,
                parent_node: between[1 - child_side],
                child,
                child_node,
                coordinates: range,
            });
        }
        let closings = own.iter().filter(|e| !used.contains(*e));
        let closings = closings.map(|&e| JointId(edges[e].joint)).collect();
        components.push(Component {
            root,
            ties,
            closings,
            coordinates: start..*coordinates,
        });
    }
    Ok((components, output_start))
}

/// Groups of carriers connected by edges, ground apart, in order of their first carrier.
pub(crate) fn connected(
    count: usize,
    edges_at: &[Vec<usize>],
    ends: impl Fn(usize) -> [Option<usize>; 2],
) -> Vec<Vec<usize>> {
    let mut group_of = vec![usize::MAX; count];
    let mut groups = Vec::new();
    for start in 0..count {
        if group_of[start] != usize::MAX {
            continue;
        }
        let mut group = vec![start];
        group_of[start] = groups.len();
        let mut next = 0;
        while next < group.len() {
            for &edge in &edges_at[group[next]] {
                for end in ends(edge).into_iter().flatten() {
                    if group_of[end] == usize::MAX {
                        group_of[end] = groups.len();
                        group.push(end);
                    }
                }
            }
            next += 1;
        }
        groups.push(group);
    }
    groups
}
