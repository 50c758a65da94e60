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

use nalgebra::{Matrix6, Vector6};

use crate::kinematics::characteristic_length;
use crate::model::{Geometry, JointId, Model};
use crate::plan::Plan;
use crate::topology::Topology;

use super::chain::{Chain, InnerLoad, Release};
use super::fronts::{Fronts, Group};
use super::hang::{hang, late_roots};
use super::idle::idle_coordinates;
use super::inputs::{Inputs, Point};
use super::parts::{Parts, Placed, screws};
use super::scatter::Scatter;
use super::series::Series;

/// Most coordinates that a mechanism may have: beyond, a factorization is worth more than lanes.
const MOST_COORDINATES: usize = 600;
/// Nodes of a joint farther apart than this share of the mechanism's size are no one point.
const APART: f64 = 1e-9;

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
        let topology = Topology::new(model, geometry, plan.output, false).ok()?;
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
        // Loads on an idle motion of what only the ground holds show in nothing that is found here.
        if !elements.iter().all(Element::moves) {
            return None;
        }
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

    /// Whether anything moves it, or loads within could work on an idle motion of its own.
    pub fn counts(&self) -> bool {
        let has_idle = matches!(&self.kind, Kind::Chain(chain) if !chain.idle.is_empty());
        self.moves() || (has_idle && self.is_loaded())
    }

    /// Whether anything moves it.
    pub fn moves(&self) -> bool {
        self.nodes.iter().any(NodeMotion::moves)
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
