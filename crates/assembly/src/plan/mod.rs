//! What is worked out once a topology: coordinates and their order, elements, sparsity pattern,
//! symbolic factorization; and the buffers that one thread needs for a pose.

pub(crate) mod blocks;
pub(crate) mod closing;
pub(crate) mod coordinates;
pub(crate) mod elements;
pub(crate) mod fault;
pub(crate) mod roles;
pub(crate) mod sparse;
pub(crate) mod subassemblies;
pub(crate) mod topology;
pub(crate) mod trees;
pub(crate) mod workspace;

use std::sync::Arc;

use hyperstat_joints::DofSet;
use hyperstat_model::{BodyId, Directions, Model, NodeId, fresh_revision};

use crate::error::SolveError;
use crate::kinematics::diagnosis::Diagnosis;
use crate::plan::closing::{Closing, Conditions, NETWORK, Order};
use crate::plan::coordinates::TreeBlocks;
use crate::plan::elements::{BlockColumns, ElementPlan, elements, places};
use crate::plan::sparse::Pattern;
use crate::plan::topology::Topology;
use crate::posture::Posture;
use crate::room;
use crate::room::MOST_NUMBERS;

/// A topology made ready: one plan serves every pose of a mechanism.
#[derive(Debug)]
pub(crate) struct Plan {
    /// A number that no other plan has.
    pub(crate) id: u64,
    /// How far apart (m) two nodes of a joint may lie.
    pub(crate) one_point: f64,
    pub(crate) topology: Topology,
    pub(crate) output: NodeId,
    /// IDC of every tree coordinate, where its component has no closing joint.
    pub(crate) idc_of: Vec<Option<usize>>,
    /// Components with closing joints.
    pub(crate) closed: Vec<Closed>,
    /// IDCs of the columns of every carrier's block.
    pub(crate) columns: Vec<Vec<usize>>,
    /// Start of every carrier's reduced block; `None`: its tree block serves.
    pub(crate) reduced_starts: Vec<Option<usize>>,
    reduced_len: usize,
    /// Whether motions without energy are to be looked for at every pose.
    pub(crate) has_idle: bool,
    /// Number of IDCs.
    pub(crate) unknowns: usize,
    /// Number of IDCs that are factored: all but the output's, where those are independent.
    pub(crate) inner: usize,
    pub(crate) elements: Vec<ElementPlan>,
    /// Deformations of all elements.
    pub(crate) deformations: usize,
    pub(crate) pattern: Arc<Pattern>,
    /// Places of every element's upper triangle in the assembled values.
    pub(crate) places: Arc<[usize]>,
}

/// A component whose closing joints are eliminated.
#[derive(Debug)]
pub(crate) struct Closed {
    pub component: usize,
    /// Which of its coordinates are to stay independent if possible.
    pub order: Order,
    /// How many of the spared ones are independent if all are, else none: their IDCs are the last.
    pub last: usize,
    /// The independent coordinates of a network, by their places in it: its pattern is theirs.
    pub independent: Option<Vec<usize>>,
    /// IDC of every independent coordinate, in ascending order of the coordinates with the
    /// spared ones last.
    pub idcs: Vec<usize>,
}

impl Closed {
    /// The IDC of an independent coordinate by its place in their ascending order: an output's come
    /// first there, and last here.
    pub fn idc(&self, place: usize) -> usize {
        let count = self.idcs.len();
        self.idcs[(place + count - self.last) % count]
    }
}

impl Plan {
    /// Plan of a model in its own configuration, of which nothing else is asked.
    ///
    /// # Errors
    /// As [`Plan::absorbing`].
    pub(crate) fn new(model: &Model) -> Result<Self, SolveError> {
        let at = Posture::new(model, model.geometry());
        Self::absorbing(&at, true, &Diagnosis::default())
    }

    /// Plan of a model in some configuration, with (`absorbs`) or without elastic joints inside
    /// subassemblies.
    ///
    /// # Errors
    /// No output, a model that is not one whole ([`Model::check`]), bodies that no chain of joints
    /// connects to the ground or the output, a segment or joint that cannot be formed, a model too
    /// large for memory.
    pub(crate) fn absorbing(
        at: &Posture<'_>,
        absorbs: bool,
        diagnosis: &Diagnosis,
    ) -> Result<Self, SolveError> {
        let Posture {
            model, geometry, ..
        } = *at;
        let output = model.output().ok_or(SolveError::NoOutput)?;
        model.check()?;
        let one_point = model.one_point();
        model.check_geometry(geometry, one_point)?;
        check_held(model, output)?;
        let topology = Topology::new(model, geometry, output, absorbs);
        check_stiffness(model, &topology)?;
        let mut tree = TreeBlocks::new(&topology);
        tree.evaluate(&topology, at)?;

        let output_carrier = topology.carrier_of[output.0];
        let mut eliminations: Vec<Option<(Order, Closing)>> = Vec::new();
        let mut output_component = 0;
        for (k, component) in topology.components.iter().enumerate() {
            let holds_output = component.members().next() == Some(output_carrier);
            if holds_output {
                output_component = k;
            }
            eliminations.push(if component.closings.is_empty() {
                None
            } else {
                let order = Order::new(component, &topology, at, holds_output);
                let conditions = Conditions::new(component, &tree, &topology, at);
                let solved = conditions.solved(&order)?;
                Some((order, solved))
            });
        }
        let output_free = match &eliminations[output_component] {
            Some((_, solved)) => {
                let independent = solved.independent().iter();
                independent.take_while(|c| **c < 6).count() == 6
            }
            None => true,
        };

        // Number the IDCs: components in order, the output's six last where they are independent.
        let mut next = 0;
        let mut idc_of = vec![None; topology.coordinates];
        let mut closed: Vec<Closed> = Vec::new();
        let mut closings = Vec::new();
        let mut nodes = Vec::new();
        let node_of = |coordinate: usize| tree.identities[coordinate].0.0;
        for (k, (component, elimination)) in
            topology.components.iter().zip(eliminations).enumerate()
        {
            let holds_output = k == output_component;
            match elimination {
                None => {
                    for coordinate in component.coordinates.clone() {
                        let of_output = holds_output && output_free && {
                            (topology.output_start..topology.output_start + 6).contains(&coordinate)
                        };
                        if !of_output {
                            idc_of[coordinate] = Some(next);
                            nodes.push(node_of(coordinate));
                            next += 1;
                        }
                    }
                }
                Some((order, solved)) => {
                    let last = if holds_output && output_free { 6 } else { 0 };
                    let own = solved.independent().len() - last;
                    let first = component.coordinates.start;
                    let independent = solved.independent()[last..].iter();
                    nodes.extend(independent.map(|c| node_of(first + c)));
                    closed.push(Closed {
                        component: k,
                        order,
                        last,
                        independent: (component.is_network())
                            .then(|| solved.independent().to_vec()),
                        idcs: (next..next + own).collect(),
                    });
                    closings.push(solved);
                    next += own;
                }
            }
        }
        let inner = next;
        let unknowns = if output_free { inner + 6 } else { inner };
        if output_free {
            match closed.iter_mut().find(|c| c.component == output_component) {
                Some(closed) => closed.idcs.extend(inner..unknowns),
                None => {
                    for k in 0..6 {
                        idc_of[topology.output_start + k] = Some(inner + k);
                    }
                }
            }
        }

        let mut columns: Vec<Vec<usize>> = topology
            .carriers
            .iter()
            .map(|c| c.coordinates.iter().filter_map(|t| idc_of[*t]).collect())
            .collect();
        let mut turning = vec![None; topology.carriers.len()];
        let mut reduced_starts = vec![None; topology.carriers.len()];
        let mut reduced_len = 0;
        for (closed, solved) in closed.iter().zip(&closings) {
            let component = &topology.components[closed.component];
            for carrier in component.members() {
                columns[carrier] = if component.is_network() {
                    let own = &topology.carriers[carrier].coordinates;
                    let of = |coordinates: &[usize]| {
                        let weights = coordinates
                            .iter()
                            .flat_map(|c| solved.weights(c - component.coordinates.start));
                        let idcs = weights.map(|(place, _)| closed.idc(place));
                        let mut idcs: Vec<usize> = idcs.collect();
                        idcs.sort_unstable();
                        idcs.dedup();
                        idcs
                    };
                    turning[carrier] = Some(of(&own[3..]));
                    of(own)
                } else {
                    closed.idcs.clone()
                };
                reduced_starts[carrier] = Some(reduced_len);
                reduced_len += 6 * columns[carrier].len();
                room::check(NETWORK, reduced_len, MOST_NUMBERS)?;
            }
        }

        let block_columns = BlockColumns {
            all: &columns,
            turning: &turning,
        };
        let mut elements = elements(model, &topology, &block_columns);
        let couplings = elements.iter().map(|e| e.columns.len() * e.columns.len());
        let couplings = room::sum(couplings);
        room::check(COUPLINGS, couplings, MOST_NUMBERS)?;
        let mut inner_groups: Vec<Vec<usize>> = Vec::with_capacity(elements.len());
        for element in &elements {
            let inner_columns = element.columns.iter().copied().filter(|c| *c < inner);
            inner_groups.push(inner_columns.collect());
        }
        let groups = inner_groups.iter().map(Vec::as_slice);
        let pattern = Pattern::new(inner, groups, Some((&nodes, &geometry.positions)))?;
        let places = places(&mut elements, &pattern);
        let deformations = elements.iter().map(|e| e.rows).sum();
        Ok(Self {
            id: fresh_revision(),
            one_point,
            topology,
            output,
            idc_of,
            closed,
            columns,
            reduced_starts,
            reduced_len,
            has_idle: diagnosis.is_loose(at),
            unknowns,
            inner,
            elements,
            deformations,
            pattern: Arc::new(pattern),
            places: places.into(),
        })
    }

    /// Plan of another design of the model that this plan was made for: other dimensions,
    /// sections, materials, stiffnesses and loads. Where the topology is the same, and so is every
    /// joint's part in it, all that depends on it alone is shared with this plan; elsewhere, and
    /// where loops of rigid bodies are eliminated, it is what [`Plan::new`] makes. Either way the
    /// results are those of [`Plan::new`].
    ///
    /// # Errors
    /// As [`Plan::new`].
    pub(crate) fn for_design(&self, model: &Model) -> Result<Self, SolveError> {
        if model.output() != Some(self.output) || !self.closed.is_empty() {
            return Self::new(model);
        }
        model.check()?;
        let geometry = model.geometry();
        let topology = Topology::new(model, geometry, self.output, true);
        if !topology.is_like(&self.topology) {
            return Self::new(model);
        }
        check_stiffness(model, &topology)?;
        let at = Posture::new(model, geometry);
        TreeBlocks::new(&topology).evaluate(&topology, &at)?;
        Ok(Self {
            id: fresh_revision(),
            one_point: model.one_point(),
            topology,
            output: self.output,
            idc_of: self.idc_of.clone(),
            closed: Vec::new(),
            columns: self.columns.clone(),
            reduced_starts: self.reduced_starts.clone(),
            reduced_len: self.reduced_len,
            has_idle: self.has_idle,
            unknowns: self.unknowns,
            inner: self.inner,
            elements: self.elements.clone(),
            deformations: self.deformations,
            pattern: self.pattern.clone(),
            places: self.places.clone(),
        })
    }

    /// Number of independent displacement coordinates, after loop elimination.
    pub(crate) fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// Whether the output's six coordinates are independent.
    pub(crate) fn output_is_independent(&self) -> bool {
        self.inner < self.unknowns
    }
}

/// What asks for too much room where elements depend on many coordinates.
const COUPLINGS: &str = "its elastic parts at the ends of chains of rigid bodies";

/// Refuses springs with coordinates of their own that are rigid in some combination of them.
fn check_stiffness(model: &Model, topology: &Topology) -> Result<(), SolveError> {
    for (joint, role) in model.joints().iter().zip(&topology.joints) {
        if !role.springs.is_empty() && !role.directions.has_stiffness {
            return Err(SolveError::SingularCompliance {
                joint: joint.name.clone(),
            });
        }
    }
    Ok(())
}

/// Refuses bodies that joints connect neither to the ground nor to the output.
fn check_held(model: &Model, output: NodeId) -> Result<(), SolveError> {
    let body_of = |n: NodeId| model.nodes()[n.0].body.0;
    let count = model.bodies().len();
    let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); count];
    let mut reached = vec![body_of(output)];
    for joint in model.joints() {
        if Directions::of(joint).free == DofSet::ALL {
            continue;
        }
        match joint.between.map(|n| n.map(body_of)) {
            [Some(a), Some(b)] => {
                neighbours[a].push(b);
                neighbours[b].push(a);
            }
            [a, b] => reached.extend(a.or(b)),
        }
    }
    let mut held = vec![false; count];
    while let Some(body) = reached.pop() {
        if !std::mem::replace(&mut held[body], true) {
            reached.extend(&neighbours[body]);
        }
    }
    let loose = (0..count).filter(|b| !held[*b]).map(BodyId);
    let bodies: Vec<String> = loose.map(|b| model.bodies()[b.0].name.clone()).collect();
    if bodies.is_empty() {
        Ok(())
    } else {
        Err(SolveError::Unheld { bodies })
    }
}
