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

pub(crate) mod acts;
pub(crate) mod chain;
pub(crate) mod columns;
pub(crate) mod element;
pub(crate) mod fronts;
pub(crate) mod hang;
pub(crate) mod idle;
pub(crate) mod inputs;
pub(crate) mod loops;
pub(crate) mod parts;
pub(crate) mod recovery;
pub(crate) mod scatter;
pub(crate) mod series;

use hyperstat_model::{Geometry, JointId, Model, characteristic_length};

use super::beside::Beside;
use super::program::acts::Acts;
use super::program::columns::{Brought, Columns};
use super::program::element::{Element, NodeLoad, NodeMotion, Screw, Spring};
use super::program::fronts::{Fronts, Group, Scatter};
use super::program::hang::{hang, last_roots};
use super::program::idle::idle_coordinates;
use super::program::inputs::{Inputs, Point};
use super::program::loops::Loops;
use super::program::parts::{Parts, Placed, screws};
use super::program::recovery::Recovery;
use super::program::series::Series;
use crate::plan::Plan;
use crate::plan::topology::Topology;
use crate::plan::trees::Component;

/// Most coordinates that a mechanism may have: beyond, a factorization is worth more than lanes.
const MOST_COORDINATES: usize = 600;
/// Most columns of what acts that may have a row: a front has room for all of them.
const MOST_ROWS: usize = 100;
/// Nodes of a joint farther apart than this share of the mechanism's size are no one point.
const APART: f64 = 1e-9;

/// The work of a pose.
#[derive(Debug)]
pub(crate) struct Program {
    pub inputs: Inputs,
    /// All points, which the mechanism's size follows from.
    pub points: Vec<Point>,
    pub screws: Vec<Screw>,
    /// Loops of rigid bodies.
    pub loops: Loops,
    pub elements: Vec<Element>,
    /// Constant stiffnesses between two coordinates.
    pub springs: Vec<Spring>,
    /// What acts, as it is formed at every pose.
    pub acts: Acts,
    /// Loads on nodes.
    pub loads: Vec<NodeLoad>,
    /// Columns of what acts: each one's row in the fronts; `None` where it acts on the output alone.
    pub rows: Vec<Option<usize>>,
    /// Columns that make up a state.
    pub states: Vec<Vec<usize>>,
    pub fronts: Fronts,
    /// All coordinates, without the rows.
    pub coordinates: usize,
    /// By coordinates: whether it tells an idle motion.
    pub idle: Vec<bool>,
    /// Blocks that the largest element needs, 36 entries each.
    pub most_blocks: usize,
    /// Coordinates of the chain that has most.
    pub most_ends: usize,
    /// Links of the loaded chain that has most.
    pub most_links: usize,
    /// First of the output's six coordinates.
    pub output: usize,
    /// What is needed for forces, where they are asked for and can be found.
    pub recovery: Option<Recovery>,
}

impl Program {
    /// The program of a plan; `None` where the lanes do not take it: loops of rigid bodies whose
    /// elimination is not clear, or with misfits; motions of the output without energy; too many
    /// coordinates, or load cases that act within the mechanism. With what is needed for what is asked
    /// for beside the output.
    pub fn new(plan: &Plan, model: &Model, geometry: &Geometry, beside: Beside) -> Option<Self> {
        let topology = Topology::new(model, geometry, plan.output, false);
        let is_misfit = |joint: &JointId| model.misfit(*joint).is_some();
        let closed = topology
            .components
            .iter()
            .filter(|c| !c.closings.is_empty());
        // Misfits in loops of rigid bodies may not fit.
        let misfit = closed.into_iter().any(|c| {
            let ties = c.ties.iter().map(|t| t.joint);
            ties.chain(c.closings.iter().copied())
                .any(|joint| is_misfit(&joint))
        });
        let network = topology.components.iter().any(Component::is_network);
        if misfit || network || topology.coordinates > MOST_COORDINATES {
            return None;
        }
        let mut inputs = Inputs::new(model, geometry, APART)?;
        let placed = Placed::all(&topology);
        let size = characteristic_length(geometry);
        let screws = screws(model, &topology, &placed, &mut inputs)?;
        let seen = (&placed[..], &screws[..]);
        let loops = Loops::new(model, geometry, &topology, seen, size, &mut inputs)?;
        let mut parts = Parts {
            model,
            geometry,
            topology: &topology,
            placed: &placed,
            loops: &loops,
            size,
            standing: Vec::new(),
            brought: Brought::default(),
            elements: Vec::new(),
            springs: Vec::new(),
        };
        let columns = Columns::of(model)?;
        let mut acts = Acts::default();
        let (loads, mut brought) = columns.bring(&parts, &mut acts, &mut inputs)?;
        let wrenches = std::mem::take(&mut brought.wrenches);
        parts.take(brought, &mut inputs);
        for subassembly in &topology.subassemblies {
            parts.add_subassembly(subassembly, &mut inputs)?;
        }
        for joint in 0..model.joints().len() {
            parts.add_joint(JointId(joint), &mut inputs)?;
        }
        let idle = if plan.has_idle {
            let seen = (&parts.elements[..], &loops.dependent[..]);
            idle_coordinates(plan, &topology, model, geometry, &placed, seen)?
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
            gone: (0..topology.coordinates)
                .map(|c| loops.dependent.contains(&c))
                .collect(),
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
            .filter(|screw| screw.in_loop || !gone[screw.coordinate])
            .collect();
        for element in &mut elements {
            element.settle();
        }
        let of_output =
            |l: &NodeLoad| l.node.root == Some(output.start) && l.node.screws.is_empty();
        let unknowns = topology.coordinates;
        let (mut rows, mut count) = (Vec::new(), 0);
        for column in 0..columns.len() {
            let mut own = loads.iter().filter(|l| l.column == column);
            let within = elements.iter().any(|e| e.columns.contains(&column));
            let has_row = within || !own.all(of_output);
            rows.push(has_row.then_some(count));
            count += usize::from(has_row);
        }
        if count > MOST_ROWS {
            return None;
        }
        let variable = |column: &usize| Some(unknowns + rows[*column]?);

        let mut groups: Vec<Group> = Vec::new();
        for (k, element) in elements.iter().enumerate() {
            let own = element.nodes.iter().flat_map(NodeMotion::coordinates);
            let own_rows = element.columns.iter().filter_map(variable);
            groups.push(Group::element(k, own.chain(own_rows).collect()));
        }
        for (k, spring) in springs.iter().enumerate() {
            groups.push(Group::spring(k, spring.coordinates.to_vec()));
        }
        for (k, load) in loads.iter().enumerate() {
            let own = load.node.coordinates();
            groups.push(Group::load(k, own.chain(variable(&load.column)).collect()));
        }
        let weights: Vec<f64> = elements.iter().map(Element::weight).collect();
        let references = placed
            .iter()
            .flatten()
            .filter_map(|p| Some((p.root?, p.reference)));
        let references = references.filter(|(root, _)| !gone[*root]).collect();
        let late = last_roots(&elements, &weights, &references);
        let late = |c: usize| late.iter().any(|root| (*root..*root + 6).contains(&c));
        let eliminated = (0..unknowns).filter(|c| !gone[*c]).collect();
        let own_rows = unknowns..unknowns + count;
        let first = output.start;
        let mut fronts = Fronts::new(eliminated, groups, &idle, output, own_rows, late)?;
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
        let seen = (&elements[..], &screws[..], &fronts);
        let recovery = match beside {
            Beside::Nothing => None,
            _ => Recovery::new(model, geometry, &topology, seen, wrenches, &mut inputs),
        };
        let blocks = elements.iter().map(Element::blocks);
        let ends = elements.iter().map(Element::ends);
        let links = elements.iter().map(Element::loaded_links);
        Some(Self {
            points: inputs.all_points(),
            most_blocks: blocks.max().unwrap_or(0),
            most_ends: ends.max().unwrap_or(0),
            most_links: links.max().unwrap_or(0),
            output: first,
            recovery,
            idle: (0..unknowns).map(|c| idle.contains(&c)).collect(),
            inputs,
            screws,
            loops,
            elements,
            springs,
            acts,
            loads,
            rows,
            states: columns.states,
            fronts,
            coordinates: unknowns,
        })
    }
}
