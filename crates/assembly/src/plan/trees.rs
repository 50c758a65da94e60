//! Trees of carriers that joints tie together.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashSet};
use std::ops::Range;

use hyperstat_joints::DofSet;
use hyperstat_model::{BodyKind, JointId, Model, NodeId};

use super::roles::JointRole;
/// Most coordinates that a tree hands to one carrier, or eliminates where it closes loops: rigid
/// bodies tied together by more are a network.
const MOST_HANDED: usize = 64;

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

/// Carriers tied together by joints, ground apart: a tree, or a network.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Component {
    /// Carrier of a tree with six coordinates of its own, unless the tree hangs from the ground.
    pub root: Option<usize>,
    pub ties: Vec<Tie>,
    /// Joints whose rigid directions are conditions on the coordinates.
    pub closings: Vec<JointId>,
    /// Carriers of a network, each with six coordinates of its own, an output's first; nothing is
    /// handed on, all joints are closings. Empty in a tree.
    pub network: Vec<usize>,
    pub coordinates: Range<usize>,
}

impl Component {
    /// Its carriers.
    pub fn members(&self) -> impl Iterator<Item = usize> {
        let children = self.ties.iter().map(|tie| tie.child);
        let tree = self.root.into_iter().chain(children);
        tree.chain(self.network.iter().copied())
    }

    /// Whether it is a network.
    pub fn is_network(&self) -> bool {
        !self.network.is_empty()
    }
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
/// joints; joints with the fewest moving directions first. Networks where these would be large.
pub(crate) fn components(
    model: &Model,
    roles: &[JointRole],
    carriers: &mut [Carrier],
    carrier_of: &[usize],
    output: usize,
    coordinates: &mut usize,
) -> (Vec<Component>, usize) {
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
    // Numbers of coordinates between a carrier and its root.
    let mut handed = vec![0; carriers.len()];
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
            *coordinates += 6;
            handed[root] = 6;
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
            handed[child] = parent.map_or(0, |p| handed[p]) + count;
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
        let closes = used.len() < own.len();
        let most = group.iter().map(|c| handed[*c]).max().unwrap_or(0);
        let is_network = most > MOST_HANDED || (closes && *coordinates - start > MOST_HANDED);
        if is_network {
            let mut network = group;
            network.sort_unstable_by_key(|c| (*c != output, *c));
            for (k, &carrier) in network.iter().enumerate() {
                let first = start + 6 * k;
                carriers[carrier].coordinates = (first..first + 6).collect();
            }
            *coordinates = start + 6 * network.len();
            components.push(Component {
                root: None,
                ties: Vec::new(),
                closings: own.iter().map(|&e| JointId(edges[e].joint)).collect(),
                network,
                coordinates: start..*coordinates,
            });
            continue;
        }
        if let Some(root) = root {
            carriers[root].coordinates = (start..start + 6).collect();
        }
        for tie in &ties {
            let mut columns =
                (tie.parent).map_or(Vec::new(), |parent| carriers[parent].coordinates.clone());
            columns.extend(tie.coordinates.clone());
            carriers[tie.child].coordinates = columns;
            carriers[tie.child].reference = tie.child_node;
        }
        let closings = own.iter().filter(|e| !used.contains(*e));
        components.push(Component {
            root,
            ties,
            closings: closings.map(|&e| JointId(edges[e].joint)).collect(),
            network: Vec::new(),
            coordinates: start..*coordinates,
        });
    }
    (components, output_start)
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
