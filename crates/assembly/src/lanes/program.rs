//! What the lanes do at every pose, worked out once a topology.
//!
//! The lanes take other coordinates than the one-by-one path: the root of every component keeps
//! its six global components, and a joint's own coordinates are its relative motions q along the
//! moving directions, `u_i = u_j + S q`. They are as independent as the IDCs of Eqs. 17–36 and
//! span the same motions, so the condensed output is the same; and no choice of axes that could
//! differ from lane to lane is left (the book, "Lanes").
//!
//! Every carrier moves as a rigid body by `root + Σ screw · q`, with the twists of root and screws
//! taken at one reference point a component. Beams and elastic joints in series are one element
//! ([`series`](super::series)); what lies between them has no coordinates.

use hyperstat_joints::Dof;
use nalgebra::{DVector, Matrix6, Vector6};

use crate::directions::Directions;
use crate::kinematics::{characteristic_length, node_twist};
use crate::model::{Geometry, JointId, Model, NodeId};
use crate::plan::Plan;
use crate::restraint::{Restraint, largest_minor, scaled};
use crate::topology::{Cluster, Topology};

use super::chain::{Chain, InnerLoad, Link, Release};
use super::fronts::{Fronts, Group};
use super::hang::{hang, late_roots};
use super::inputs::{Inputs, Point};
use super::scatter::Scatter;
use super::series::Series;

/// Most coordinates that a mechanism may have: beyond, a factorization is worth more than lanes.
const MOST_COORDINATES: usize = 600;
/// Nodes of a joint farther apart than this share of the mechanism's size are no one point.
const APART: f64 = 1e-9;
/// Entries of idle motions below this are none.
const STILL: f64 = 1e-9;
/// How much coordinates count that stay, and those that may go, to tell idle motions by.
const STAYS: f64 = 4.0;
const GOES: f64 = 0.25;

/// The work of a pose.
#[derive(Debug)]
pub(super) struct Program {
    pub inputs: Inputs,
    pub screws: Vec<Screw>,
    pub elements: Vec<Element>,
    /// Constant stiffnesses between two coordinates.
    pub springs: Vec<Spring>,
    /// Loads on nodes.
    pub loads: Vec<NodeLoad>,
    pub fronts: Fronts,
    /// All coordinates, the loads' row included.
    pub coordinates: usize,
    /// By coordinates: whether it tells an idle motion.
    pub idle: Vec<bool>,
    /// Blocks that the largest element needs, 36 entries each.
    pub most_blocks: usize,
    /// Coordinates of the chain that has most.
    pub most_ends: usize,
}

/// The relative motion that a joint's coordinate stands for: a twist at the joint, carried to the
/// component's reference point.
#[derive(Debug, Clone)]
pub(super) struct Screw {
    pub coordinate: usize,
    pub motion: Release,
    /// From the joint to the reference point, where they differ.
    pub arm: Option<[Point; 2]>,
}

/// How a node of an element moves.
#[derive(Debug, Clone, Default)]
pub(super) struct NodeMotion {
    /// First of the six coordinates of its component's root.
    pub root: Option<usize>,
    /// Coordinates of the joints between root and node.
    pub screws: Vec<usize>,
    /// From the component's reference point to the node, where they differ.
    pub arm: Option<[Point; 2]>,
}

impl NodeMotion {
    /// Whether it moves at all.
    pub fn moves(&self) -> bool {
        self.root.is_some() || !self.screws.is_empty()
    }

    pub fn coordinates(&self) -> impl Iterator<Item = usize> {
        let root = self.root.into_iter().flat_map(|start| start..start + 6);
        root.chain(self.screws.iter().copied())
    }
}

/// An element: what it is, and how its nodes move.
#[derive(Debug, Clone)]
pub(super) struct Element {
    pub kind: Kind,
    pub nodes: Vec<NodeMotion>,
}

/// Where an element's stiffness comes from.
#[derive(Debug, Clone)]
pub(super) enum Kind {
    /// Beams and elastic joints in series between two nodes.
    Chain(Chain),
    /// A flexible body.
    Flexible(FlexibleElement),
    /// A stiffness between two nodes at one point, in a joint's frame (its columns' places).
    Bushing {
        columns: [usize; 3],
        stiffness: Box<Matrix6<f64>>,
    },
}

/// A flexible body: a stiffness over nodes 1..=m with node 0 held, in axes that turn with it.
#[derive(Debug, Clone)]
pub(super) struct FlexibleElement {
    pub points: Vec<Point>,
    /// Columns of its rotation (places in the inputs).
    pub axes: [usize; 3],
    /// Column-major.
    pub stiffness: Vec<f64>,
}

/// A constant entry of the stiffness.
#[derive(Debug, Clone)]
pub(super) struct Spring {
    pub coordinates: [usize; 2],
    pub stiffness: f64,
}

/// A load on a node.
#[derive(Debug, Clone)]
pub(super) struct NodeLoad {
    pub node: NodeMotion,
    pub point: Point,
    pub wrench: Vector6<f64>,
}

impl NodeLoad {
    /// The same within a chain.
    pub fn inner(self) -> InnerLoad {
        InnerLoad {
            point: self.point,
            wrench: self.wrench,
        }
    }
}

impl Program {
    /// The program of a plan; `None` where the lanes do not take it: closed loops of rigid bodies
    /// whose elimination depends on the pose, motions of the output without energy, too many
    /// coordinates.
    pub fn new(plan: &Plan, model: &Model, geometry: &Geometry) -> Option<Self> {
        let topology = Topology::new(model, geometry, plan.output, false);
        let closed = |component: &crate::topology::Component| !component.closings.is_empty();
        if topology.components.iter().any(closed) || topology.coordinates > MOST_COORDINATES {
            return None;
        }
        let mut inputs = Inputs::new(model, geometry, APART)?;
        let placed = Placed::all(&topology);
        let screws = screws(model, &topology, &placed, &mut inputs)?;
        let mut parts = Parts {
            model,
            geometry,
            topology: &topology,
            placed: &placed,
            size: characteristic_length(geometry),
            elements: Vec::new(),
            springs: Vec::new(),
        };
        for cluster in &topology.clusters {
            parts.add_cluster(cluster, &mut inputs)?;
        }
        for joint in 0..model.joints().len() {
            parts.add_joint(JointId(joint), &mut inputs)?;
        }
        let mut loads = Vec::new();
        for load in model.loads() {
            let wrench = load.wrench;
            let node = parts.motion(load.node, &mut inputs)?;
            if node.moves() && wrench != Vector6::zeros() {
                let point = inputs.point(load.node);
                loads.push(NodeLoad {
                    node,
                    point,
                    wrench,
                });
            }
        }
        let idle = if plan.has_idle {
            idle_coordinates(plan, &topology, model, geometry, &placed, &parts.elements)?
        } else {
            Vec::new()
        };
        let output = topology.output_start..topology.output_start + 6;
        let with_root = topology.components.iter().filter(|c| c.root.is_some());
        let components: Vec<_> = with_root
            .map(|c| c.coordinates.clone())
            .filter(|c| !c.contains(&output.start))
            .collect();
        let parts = Series {
            elements: parts.elements,
            springs: parts.springs,
            loads,
            private: idle.clone(),
            idle,
            gone: vec![false; topology.coordinates],
        };
        let Series {
            mut elements,
            springs,
            loads,
            idle,
            gone,
            ..
        } = parts.joined(&screws, &components, |place| inputs.at(geometry, place));
        let screws: Vec<Screw> = screws
            .into_iter()
            .filter(|screw| !gone[screw.coordinate])
            .collect();
        let of_output =
            |l: &NodeLoad| l.node.root == Some(output.start) && l.node.screws.is_empty();
        let at_output = loads.iter().all(of_output) && elements.iter().all(|e| !e.is_loaded());

        let unknowns = topology.coordinates;
        let loads_row = (!at_output).then_some(unknowns);
        let mut groups: Vec<Group> = Vec::new();
        for (k, element) in elements.iter().enumerate() {
            let own = element.nodes.iter().flat_map(NodeMotion::coordinates);
            let row = loads_row.filter(|_| element.is_loaded());
            groups.push(Group::element(k, own.chain(row).collect()));
        }
        for (k, spring) in springs.iter().enumerate() {
            groups.push(Group::spring(k, spring.coordinates.to_vec()));
        }
        for (k, load) in loads.iter().enumerate() {
            let own = load.node.coordinates();
            groups.push(Group::load(k, own.chain(loads_row).collect()));
        }
        let weights: Vec<f64> = elements.iter().map(Element::weight).collect();
        let references = placed
            .iter()
            .flatten()
            .filter_map(|p| Some((p.root?, p.reference)));
        let references = references.filter(|(root, _)| !gone[*root]).collect();
        let late = late_roots(&elements, &weights, &references);
        let late = |c: usize| late.iter().any(|root| (*root..*root + 6).contains(&c));
        let eliminated = (0..unknowns).filter(|c| !gone[*c]).collect();
        let mut fronts = Fronts::new(eliminated, groups, &idle, output, loads_row, late)?;
        hang(
            &mut fronts,
            &mut elements,
            &weights,
            &references,
            &mut inputs,
        );
        for front in &mut fronts.list {
            front.scatter = Scatter::new(front, &elements);
        }
        let blocks = elements.iter().map(Element::blocks);
        let ends = elements.iter().map(Element::ends);
        Some(Self {
            most_blocks: blocks.max().unwrap_or(0),
            most_ends: ends.max().unwrap_or(0),
            idle: (0..unknowns).map(|c| idle.contains(&c)).collect(),
            inputs,
            screws,
            elements,
            springs,
            loads,
            fronts,
            coordinates: unknowns + usize::from(loads_row.is_some()),
        })
    }
}

impl Element {
    /// Stiffness against translations in the plan's configuration, as a measure \[N/m\].
    fn weight(&self) -> f64 {
        match &self.kind {
            Kind::Chain(chain) => chain.weight(),
            Kind::Flexible(flexible) => {
                let rows = 6 * (flexible.points.len() - 1);
                (0..3).map(|k| flexible.stiffness[k * (rows + 1)]).sum()
            }
            Kind::Bushing { stiffness, .. } => (0..3).map(|k| stiffness[(k, k)]).sum(),
        }
    }

    /// Blocks that it needs, 36 entries each.
    fn blocks(&self) -> usize {
        match self.kind {
            Kind::Chain(_) => 0,
            _ => self.nodes.len() * (self.nodes.len() + 1) / 2,
        }
    }

    /// Free motions within a chain.
    pub fn releases(&self) -> usize {
        match &self.kind {
            Kind::Chain(chain) => chain.releases.len(),
            _ => 0,
        }
    }

    /// Whether loads act on what lies within it.
    pub fn is_loaded(&self) -> bool {
        matches!(&self.kind, Kind::Chain(chain) if !chain.loads.is_empty())
    }

    /// Coordinates of a chain.
    pub fn ends(&self) -> usize {
        match self.kind {
            Kind::Chain(_) => self.nodes.iter().flat_map(NodeMotion::coordinates).count(),
            _ => 0,
        }
    }
}

/// Where a carrier stands.
struct Placed {
    /// First coordinate of its component's root.
    root: Option<usize>,
    /// The component's reference point.
    reference: NodeId,
}

impl Placed {
    /// By carriers.
    fn all(topology: &Topology) -> Vec<Option<Self>> {
        let mut placed: Vec<Option<Self>> = topology.carriers.iter().map(|_| None).collect();
        for component in &topology.components {
            let reference = match (component.root, component.ties.first()) {
                (Some(root), _) => topology.carriers[root].reference,
                (None, Some(tie)) => tie.child_node,
                (None, None) => continue,
            };
            let root = component.root.map(|c| topology.carriers[c].coordinates[0]);
            let children = component.ties.iter().map(|t| t.child);
            for carrier in component.root.into_iter().chain(children) {
                placed[carrier] = Some(Self { root, reference });
            }
        }
        placed
    }
}

/// The screws of all joints that have coordinates of their own.
fn screws(
    model: &Model,
    topology: &Topology,
    placed: &[Option<Placed>],
    inputs: &mut Inputs,
) -> Option<Vec<Screw>> {
    let mut screws = Vec::new();
    for tie in topology.components.iter().flat_map(|c| &c.ties) {
        let reference = placed[tie.child].as_ref()?.reference;
        let moving = topology.joints[tie.joint.0].moving;
        for (coordinate, dof) in tie.coordinates.clone().zip(moving.iter()) {
            screws.push(Screw {
                coordinate,
                motion: release(model, tie.joint, dof, tie.child_node, inputs),
                arm: inputs.arm(tie.child_node, reference),
            });
        }
    }
    Some(screws)
}

/// One of a joint's directions, at one of its nodes.
fn release(model: &Model, joint: JointId, dof: Dof, node: NodeId, inputs: &mut Inputs) -> Release {
    let basis = model.joints()[joint.0].joint.basis();
    let direction = basis.column(dof.index());
    let parts = (0..3).map(|c| (c, direction[c], direction[3 + c]));
    let axes = parts
        .filter(|(_, linear, angular)| *linear != 0.0 || *angular != 0.0)
        .map(|(c, linear, angular)| (inputs.frame_column(joint, c), linear, angular))
        .collect();
    Release {
        point: inputs.point(node),
        axes,
    }
}

/// The parts of a mechanism, each by itself.
struct Parts<'a> {
    model: &'a Model,
    geometry: &'a Geometry,
    topology: &'a Topology,
    placed: &'a [Option<Placed>],
    /// Of the mechanism.
    size: f64,
    elements: Vec<Element>,
    springs: Vec<Spring>,
}

impl Parts<'_> {
    fn motion(&self, node: NodeId, inputs: &mut Inputs) -> Option<NodeMotion> {
        let carrier = self.topology.carrier_of[node.0];
        let placed = self.placed[carrier].as_ref()?;
        let own = &self.topology.carriers[carrier].coordinates;
        let skipped = if placed.root.is_some() { 6 } else { 0 };
        let moves = !own.is_empty();
        Some(NodeMotion {
            root: placed.root,
            screws: own[skipped..].to_vec(),
            arm: inputs.arm(placed.reference, node).filter(|_| moves),
        })
    }

    fn origin(&self, node: NodeId, inputs: &mut Inputs) -> Option<Point> {
        let placed = self.placed[self.topology.carrier_of[node.0]].as_ref()?;
        Some(inputs.point(placed.reference))
    }

    /// Adds an element whose nodes move as the model's nodes say, unless it is rigidly held.
    fn add(&mut self, kind: Kind, mut nodes: Vec<NodeMotion>) {
        drop_shared(&mut nodes);
        if nodes.iter().any(NodeMotion::moves) {
            self.elements.push(Element { kind, nodes });
        }
    }

    fn add_cluster(&mut self, cluster: &Cluster, inputs: &mut Inputs) -> Option<()> {
        let mut nodes = Vec::new();
        for node in &cluster.nodes {
            nodes.push(self.motion(*node, inputs)?);
        }
        let kind = match cluster.flexible {
            Some(id) => {
                let stiffness = self.model.flexibles()[id.0].element.held_stiffness();
                Kind::Flexible(FlexibleElement {
                    points: cluster.nodes.iter().map(|n| inputs.point(*n)).collect(),
                    axes: [0, 1, 2].map(|c| inputs.rotation(id, c)),
                    stiffness: stiffness.as_slice().to_vec(),
                })
            }
            None => {
                // Without absorbed joints, a run is one segment.
                let [(id, _)] = cluster.segments.as_slice() else {
                    return None;
                };
                let ends = self.model.segments()[id.0].ends;
                nodes.clear();
                for node in ends {
                    nodes.push(self.motion(node, inputs)?);
                }
                let link = Link::beam(self.model, self.geometry, *id, inputs)?;
                let [a, b] = ends.map(|n| self.origin(n, inputs));
                Kind::Chain(Chain::new(link, Vec::new(), [a?, b?]))
            }
        };
        self.add(kind, nodes);
        Some(())
    }

    /// What an elastic joint adds.
    fn add_joint(&mut self, joint: JointId, inputs: &mut Inputs) -> Option<()> {
        let role = &self.topology.joints[joint.0];
        if role.springs.is_empty() {
            return Some(());
        }
        let ties = self.topology.components.iter().flat_map(|c| &c.ties);
        if let Some(tie) = ties.into_iter().find(|t| t.joint == joint) {
            if !role.directions.has_stiffness {
                return None;
            }
            let places = tie.coordinates.clone().zip(role.moving.iter());
            let places: Vec<(usize, Dof)> =
                places.filter(|(_, d)| role.springs.contains(*d)).collect();
            for (k, (a, d)) in places.iter().enumerate() {
                for (b, e) in &places[k..] {
                    let stiffness = role.directions.stiffness[(d.index(), e.index())];
                    if a == b || stiffness != 0.0 {
                        self.springs.push(Spring {
                            coordinates: [*a, *b],
                            stiffness,
                        });
                    }
                }
            }
            return Some(());
        }
        let entry = &self.model.joints()[joint.0];
        let columns = [0, 1, 2].map(|c| inputs.frame_column(joint, c));
        let basis = entry.joint.basis();
        let Directions {
            stiffness,
            has_stiffness,
            compliance,
            ..
        } = &role.directions;
        let mut nodes = Vec::new();
        for node in entry.between.iter().flatten() {
            nodes.push(self.motion(*node, inputs)?);
        }
        let kind = match compliance {
            Some(compliance) => {
                let at = entry.between.iter().flatten().next()?;
                let own = basis * compliance * basis.transpose();
                let link = Link::joint(&own, *at, columns, self.size, inputs);
                let free = role.directions.free.iter();
                let releases = free.map(|dof| release(self.model, joint, dof, *at, inputs));
                let releases = releases.collect();
                let mut origins = [inputs.point(*at); 2];
                for (origin, node) in origins.iter_mut().zip(entry.between.iter().flatten()) {
                    *origin = self.origin(*node, inputs)?;
                }
                Kind::Chain(Chain::new(link, releases, origins))
            }
            None if *has_stiffness => {
                let inverse = basis.try_inverse()?;
                let stiffness = Box::new(inverse.transpose() * stiffness * inverse);
                Kind::Bushing { columns, stiffness }
            }
            None => return None,
        };
        if matches!(kind, Kind::Chain(_)) && nodes.len() == 1 {
            nodes.push(NodeMotion::default());
        }
        self.add(kind, nodes);
        Some(())
    }
}

/// Takes out what all nodes of an element share: with it they move as one rigid body.
pub(super) fn drop_shared(nodes: &mut [NodeMotion]) {
    let first = nodes[0].clone();
    if first.root.is_some() && nodes.iter().all(|n| n.root == first.root) {
        for node in nodes.iter_mut() {
            node.root = None;
        }
    }
    for screw in first.screws {
        if nodes.iter().all(|n| n.screws.contains(&screw)) {
            for node in nodes.iter_mut() {
                node.screws.retain(|s| *s != screw);
            }
        }
    }
}

/// One coordinate an idle motion: those with the largest minor, where coordinates count more that
/// stay, since several chains meet at them, and roots' less that could go. `None` where the output
/// moves without energy.
fn idle_coordinates(
    plan: &Plan,
    topology: &Topology,
    model: &Model,
    geometry: &Geometry,
    placed: &[Option<Placed>],
    elements: &[Element],
) -> Option<Vec<usize>> {
    let restraint = Restraint::new(model, geometry, plan.output);
    if !restraint.moving.is_empty() {
        return None;
    }
    let mut columns: Vec<DVector<f64>> = Vec::new();
    for motion in &restraint.idle {
        let twist = |node: NodeId| node_twist(motion, model, geometry, node.0);
        let mut column = DVector::zeros(topology.coordinates);
        let nodes = || elements.iter().flat_map(|e| &e.nodes);
        for placed in placed.iter().flatten() {
            if let Some(root) = placed.root {
                let meeting = nodes().filter(|n| n.root == Some(root)).count();
                let rank = if meeting > 2 { STAYS } else { GOES };
                let at = scaled(&twist(placed.reference), restraint.size) * rank;
                column.fixed_rows_mut::<6>(root).copy_from(&at);
            }
        }
        for tie in topology.components.iter().flat_map(|c| &c.ties) {
            let joint = &model.joints()[tie.joint.0];
            let at = |node: Option<NodeId>| node.map_or(Vector6::zeros(), twist);
            let relative = at(joint.between[0]) - at(joint.between[1]);
            let frame = &geometry.frames[tie.joint.0];
            let along = crate::directions::to_directions(&joint.joint.basis(), frame) * relative;
            let moving = topology.joints[tie.joint.0].moving;
            for (coordinate, dof) in tie.coordinates.clone().zip(moving.iter()) {
                let unit = if dof.index() < 3 { restraint.size } else { 1.0 };
                let meeting = nodes().filter(|n| n.screws.contains(&coordinate)).count();
                let rank = if meeting > 1 { STAYS } else { 1.0 };
                column[coordinate] = along[dof.index()] / unit * rank;
            }
        }
        columns.push(column);
    }
    Some(largest_minor(columns, STILL))
}
