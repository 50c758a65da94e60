//! What depends on the topology alone: carriers of displacement, absorbed joints, the spanning
//! trees along which joints hand on displacements, and the clusters of segments.
//!
//! A *carrier* is what has six displacement coordinates: a node of an elastic body, or a whole
//! rigid body. Joints tie carriers into trees; a joint that would close a loop gives conditions
//! instead (the book, "Overall model").

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashSet};
use std::ops::Range;

use hyperstat_joints::DofSet;
use nalgebra::{Matrix6, Vector6};

use crate::cluster::segment_beam;
use crate::directions::Directions;
use crate::error::SolveError;
use crate::model::{BodyKind, FlexibleId, Geometry, JointId, Model, NodeId, SegmentId};
use crate::room::{self, MOST_NUMBERS};

/// A joint softer than this share of the beam's own stiffness keeps coordinates of its own: across the
/// beam's axes a matrix of doubles holds its stiffness to 1e-16 over this share, whatever formed
/// it, which no refinement brings back.
const SOFTEST_ABSORBED: f64 = 1e-4;
/// What asks for too much room where trees are deep.
const CHAINS: &str = "its chains of rigid bodies and joints, one after another,";
/// Most segments that absorbed joints join into one run.
pub(crate) const LONGEST_CLUSTER: usize = 8;

/// A carrier of six displacement coordinates, kept at `reference`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Carrier {
    pub reference: NodeId,
    /// Tree coordinates its displacement depends on, in the order of its block's columns.
    pub coordinates: Vec<usize>,
}

/// What the model makes of a joint.
#[derive(Debug, Clone)]
pub(crate) struct JointRole {
    pub directions: Directions,
    /// Node inside whose subassembly elastic directions are absorbed.
    pub absorbed: Option<NodeId>,
    /// Compliance of the absorbed directions, zero elsewhere.
    pub compliance: Matrix6<f64>,
    /// Elastic directions with coordinates of their own.
    pub springs: DofSet,
    /// All directions with coordinates of their own: these springs and the free ones.
    pub moving: DofSet,
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

/// What forms one subassembly element: a run of segments, or a flexible body.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Cluster {
    /// Nodes along the run, or of the flexible body.
    pub nodes: Vec<NodeId>,
    /// Segments along the run; `true` where it is run through from its second node.
    pub segments: Vec<(SegmentId, bool)>,
    /// The flexible body, which has no segments.
    pub flexible: Option<FlexibleId>,
    /// Absorbed joint at each node.
    pub joints: Vec<Option<JointId>>,
}

/// Topology of a model.
#[derive(Debug, Clone)]
pub(crate) struct Topology {
    pub carriers: Vec<Carrier>,
    /// Carrier of every node.
    pub carrier_of: Vec<usize>,
    pub joints: Vec<JointRole>,
    pub components: Vec<Component>,
    pub clusters: Vec<Cluster>,
    /// Number of tree coordinates.
    pub coordinates: usize,
    /// First of the output carrier's six tree coordinates.
    pub output_start: usize,
}

impl Topology {
    /// The topology of a model; `absorbs`: elastic joints go into the subassemblies where they
    /// can, else each keeps coordinates of its own.
    ///
    /// # Errors
    /// Chains of joints too long.
    pub fn new(
        model: &Model,
        geometry: &Geometry,
        output: NodeId,
        absorbs: bool,
    ) -> Result<Self, SolveError> {
        let (mut carriers, carrier_of) = carriers(model, output);
        let joints = roles(model, geometry, output, absorbs);
        let clusters = clusters(model, &joints);
        let mut coordinates = 0;
        let (components, output_start) = components(
            model,
            &joints,
            &mut carriers,
            &carrier_of,
            carrier_of[output.0],
            &mut coordinates,
        )?;
        Ok(Self {
            carriers,
            carrier_of,
            joints,
            components,
            clusters,
            coordinates,
            output_start,
        })
    }

    /// Whether another topology is the same but for the joints' stiffness.
    pub fn is_like(&self, other: &Self) -> bool {
        self.carriers == other.carriers
            && self.carrier_of == other.carrier_of
            && self.components == other.components
            && self.clusters == other.clusters
            && self.joints.len() == other.joints.len()
            && (self.joints.iter().zip(&other.joints)).all(|(own, other)| own.is_like(other))
    }
}

impl JointRole {
    /// Whether every direction has the same role in both.
    fn is_like(&self, other: &Self) -> bool {
        let sets = |role: &Self| {
            let own = &role.directions;
            let sets = [own.rigid, own.elastic, own.free, role.springs, role.moving];
            (role.absorbed, sets)
        };
        sets(self) == sets(other)
    }
}

/// One carrier a node of an elastic body, one a rigid body; the output is its carrier's reference.
fn carriers(model: &Model, output: NodeId) -> (Vec<Carrier>, Vec<usize>) {
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

/// Roles of all joints: which are absorbed, and which directions keep coordinates.
fn roles(model: &Model, geometry: &Geometry, output: NodeId, absorbs: bool) -> Vec<JointRole> {
    let mut joints_at = vec![0usize; model.nodes().len()];
    for joint in model.joints() {
        for node in joint.between.iter().flatten() {
            joints_at[node.0] += 1;
        }
    }
    let mut segments_at: Vec<Vec<SegmentId>> = vec![Vec::new(); model.nodes().len()];
    for (k, segment) in model.segments().iter().enumerate() {
        for end in segment.ends {
            segments_at[end.0].push(SegmentId(k));
        }
    }
    let mut flexible_nodes: Vec<Option<Matrix6<f64>>> = vec![None; model.nodes().len()];
    for flexible in model.flexibles() {
        for (k, node) in model.bodies()[flexible.body.0].nodes.iter().enumerate() {
            flexible_nodes[node.0] = Some(flexible.element.node_stiffness(k));
        }
    }
    let mut run = Runs::new(model.segments().len());
    let mut roles = Vec::with_capacity(model.joints().len());
    for joint in model.joints() {
        let directions = Directions::of(joint);
        let absorbable = |node: NodeId| {
            if !absorbs || node == output || joints_at[node.0] != 1 {
                return DofSet::EMPTY;
            }
            match &flexible_nodes[node.0] {
                Some(own) => stiff_directions(&directions, &own.diagonal()),
                None => {
                    let segments = &segments_at[node.0];
                    if !(1..=2).contains(&segments.len()) {
                        return DofSet::EMPTY;
                    }
                    stiff_directions(&directions, &stiffest(segments, model, geometry))
                }
            }
        };
        let nodes = joint.between.iter().rev().flatten();
        let mut sides: Vec<(NodeId, DofSet)> = nodes
            .map(|n| (*n, absorbable(*n)))
            .filter(|(_, set)| !set.is_empty())
            .collect();
        let nodes_on_body = |n: NodeId| model.bodies()[model.nodes()[n.0].body.0].nodes.len();
        sides.sort_by_key(|(n, _)| (segments_at[n.0].len(), nodes_on_body(*n)));
        let absorbed = sides
            .into_iter()
            .find(|(n, _)| match segments_at[n.0].as_slice() {
                [a, b] => run.join(a.0, b.0),
                _ => true,
            });
        let inside = absorbed.map_or(DofSet::EMPTY, |(_, set)| set);
        let springs = directions.elastic.difference(inside);
        roles.push(JointRole {
            absorbed: absorbed.map(|(node, _)| node),
            compliance: directions.compliance_of(inside),
            springs,
            moving: directions.free.union(springs),
            directions,
        });
    }
    roles
}

/// Largest stiffness of the beams at a node by direction, element frame.
fn stiffest(segments: &[SegmentId], model: &Model, geometry: &Geometry) -> Vector6<f64> {
    let mut stiffest = Vector6::zeros();
    for id in segments {
        if let Ok((beam, _, _)) = segment_beam(model, geometry, *id) {
            stiffest = stiffest.sup(&beam.cantilever_stiffness().diagonal());
        }
    }
    stiffest
}

/// Elastic directions stiff enough beside the `own` stiffness of the body at a joint's node, by
/// direction in any axes, to be absorbed; coupled directions all or none.
fn stiff_directions(directions: &Directions, own: &Vector6<f64>) -> DofSet {
    let Some(compliance) = &directions.compliance else {
        return DofSet::EMPTY;
    };
    let stiffest = [own.fixed_rows::<3>(0).max(), own.fixed_rows::<3>(3).max()];
    let stiff: DofSet = directions
        .elastic
        .iter()
        .filter(|dof| {
            let d = dof.index();
            compliance[(d, d)] * stiffest[d / 3] * SOFTEST_ABSORBED <= 1.0
        })
        .collect();
    if stiff == directions.elastic || !directions.is_coupled() {
        stiff
    } else {
        DofSet::EMPTY
    }
}

/// Sets of segments joined at absorbed joints, kept short.
struct Runs {
    parent: Vec<usize>,
    length: Vec<usize>,
}

impl Runs {
    fn new(count: usize) -> Self {
        Self {
            parent: (0..count).collect(),
            length: vec![1; count],
        }
    }

    fn find(&mut self, mut k: usize) -> usize {
        while self.parent[k] != k {
            self.parent[k] = self.parent[self.parent[k]];
            k = self.parent[k];
        }
        k
    }

    /// Joins two runs unless they are one already (a ring) or would grow too long.
    fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        let length = self.length[a] + self.length[b];
        if a == b || length > LONGEST_CLUSTER {
            return false;
        }
        self.parent[b] = a;
        self.length[a] = length;
        true
    }
}

/// Runs of segments through absorbed middle joints; every other segment is a run of its own, as
/// is every flexible body.
fn clusters(model: &Model, roles: &[JointRole]) -> Vec<Cluster> {
    let mut absorbed_at = vec![None; model.nodes().len()];
    for (k, role) in roles.iter().enumerate() {
        if let Some(node) = role.absorbed {
            absorbed_at[node.0] = Some(JointId(k));
        }
    }
    let mut segments_at: Vec<Vec<usize>> = vec![Vec::new(); model.nodes().len()];
    for (k, segment) in model.segments().iter().enumerate() {
        for end in segment.ends {
            segments_at[end.0].push(k);
        }
    }
    let inner = |node: NodeId| absorbed_at[node.0].is_some() && segments_at[node.0].len() == 2;
    let mut seen = vec![false; model.segments().len()];
    let mut clusters = Vec::new();
    for start in 0..model.segments().len() {
        if seen[start] {
            continue;
        }
        // Walk back to the run's beginning, then forward along it.
        let (mut segment, mut first) = (start, model.segments()[start].ends[0]);
        while inner(first) {
            let Some(&before) = segments_at[first.0].iter().find(|s| **s != segment) else {
                break;
            };
            segment = before;
            first = other_end(model, segment, first);
        }
        let mut nodes = vec![first];
        let mut segments = Vec::new();
        loop {
            seen[segment] = true;
            let last = nodes[nodes.len() - 1];
            segments.push((
                SegmentId(segment),
                model.segments()[segment].ends[0] != last,
            ));
            let next = other_end(model, segment, last);
            nodes.push(next);
            match segments_at[next.0].iter().find(|s| **s != segment) {
                Some(&after) if inner(next) => segment = after,
                _ => break,
            }
        }
        let joints = nodes.iter().map(|n| absorbed_at[n.0]).collect();
        // An end node shared by two runs carries no absorbed joint (it would be inside a run).
        clusters.push(Cluster {
            nodes,
            segments,
            flexible: None,
            joints,
        });
    }
    clusters.extend(model.bodies().iter().filter_map(|body| {
        let id = body.flexible?;
        Some(Cluster {
            nodes: body.nodes.clone(),
            segments: Vec::new(),
            flexible: Some(id),
            joints: body.nodes.iter().map(|n| absorbed_at[n.0]).collect(),
        })
    }));
    clusters
}

fn other_end(model: &Model, segment: usize, node: NodeId) -> NodeId {
    let [a, b] = model.segments()[segment].ends;
    if a == node { b } else { a }
}

/// Spanning trees: from the output's carrier, from the ground, or from the carrier with the most
/// joints; joints with the fewest moving directions first.
fn components(
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
fn connected(
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
