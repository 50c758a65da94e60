//! The states of unit loads on the output, and the work that a state's forces do on another's
//! deformations: what budgets and sensitivities are made of.

use std::sync::Arc;

use hyperstat_elements::{BeamLoad, rotate_vector6};
use hyperstat_joints::DofSet;
use hyperstat_model::{Directions, Geometry, JointId, LoadSet, Model, NodeId, SegmentId};
use nalgebra::{DVector, Matrix6, Vector6};

use crate::answer::solution::{SegmentForces, Solution, State as Displaced};
use crate::error::SolveError;
use crate::posture::{PlacedBeam, Posture};
use crate::state::preload::along;

/// The states of a model under a unit of each component of a wrench on its output (N, N·m, global
/// axes, at the output), without its loads.
///
/// By the principle of virtual work they say where a displacement of the output comes from
/// ([`budget`](Influence::budget)) and what changes it ([`sensitivities`](Influence::sensitivities)).
#[derive(Debug)]
pub struct Influence<'m> {
    pub(crate) model: &'m Model,
    pub(crate) geometry: &'m Geometry,
    /// The mechanism's size (m).
    pub(crate) size: f64,
    pub(crate) units: [UnitState; 6],
    /// Displacement of every node in each of them, global axes.
    pub(crate) displacements: [Vec<Vector6<f64>>; 6],
    pub(crate) beams: Arc<[PlacedBeam]>,
    pub(crate) joints: Vec<ElasticDirections>,
}

/// The forces in a model's elastic parts; linear in the loads, where none acts between nodes.
#[derive(Debug, Clone)]
pub(crate) struct UnitState {
    /// Wrench on every segment at its second node, element frame.
    pub ends: Vec<Vector6<f64>>,
    /// Load along every segment, element frame; empty where none has any.
    pub loads: Vec<BeamLoad>,
    /// Force and deflection along every joint's directions, zero along those that are not elastic.
    pub joints: Vec<[Vector6<f64>; 2]>,
    /// Force on the second body along every joint's directions; `None` where it is not determined.
    pub reactions: Vec<Option<Vector6<f64>>>,
    /// Forces on the nodes after the first of every flexible body, its own axes, and their
    /// displacements relative to it.
    pub flexibles: Vec<[DVector<f64>; 2]>,
}

/// What is elastic in a joint.
#[derive(Debug)]
pub(crate) struct ElasticDirections {
    directions: Directions,
    basis: Matrix6<f64>,
    /// From a relative twist in global axes to the directions.
    to_directions: Matrix6<f64>,
}

impl<'m> Influence<'m> {
    /// The loads whose states it is made of: a unit of each component of a wrench on the output.
    pub(crate) fn units(output: NodeId) -> [LoadSet; 6] {
        [0, 1, 2, 3, 4, 5].map(|k| LoadSet::on(output, Vector6::ith(k, 1.0)))
    }

    /// From the states under [those loads](Self::units).
    pub(crate) fn new(
        model: &'m Model,
        geometry: &'m Geometry,
        at: &Posture<'_>,
        states: Vec<Displaced>,
    ) -> Result<Self, SolveError> {
        let joints = model.joints().iter().enumerate();
        let joints = joints.map(|(k, joint)| ElasticDirections {
            directions: Directions::of(joint),
            basis: joint.joint.basis(),
            to_directions: at.direction_map(JointId(k)),
        });
        let mut influence = Self {
            model,
            geometry,
            size: at.size,
            units: std::array::from_fn(|_| UnitState::empty()),
            displacements: std::array::from_fn(|_| Vec::new()),
            beams: at.beams()?,
            joints: joints.collect(),
        };
        for (k, state) in states.into_iter().enumerate() {
            influence.units[k] =
                influence.state_of(&state.displacements, &state.joint_wrenches, &state.segments);
            influence.displacements[k] = state.displacements;
        }
        Ok(influence)
    }

    /// The state of a solution of this model, under any loads: what the springs of its joints
    /// themselves take and give, apart from preloads and misfits.
    pub(crate) fn state(&self, solution: &Solution) -> UnitState {
        let wrenches = &solution.joint_wrenches;
        let mut state = self.state_of(&solution.displacements, wrenches, &solution.segments);
        for entry in self.model.misfits() {
            let JointId(k) = entry.joint;
            let directions = &self.joints[k].directions;
            let elastic = directions.elastic;
            let [force, deflection] = &mut state.joints[k];
            match (&state.reactions[k], &directions.compliance) {
                (Some(_), Some(compliance)) => {
                    *force -= along(&entry.preload, elastic);
                    *deflection = compliance * *force;
                }
                (known, _) => {
                    *deflection += along(&entry.misfit, elastic);
                    *force = match known {
                        Some(_) => *force - along(&entry.preload, elastic),
                        None => directions.stiffness * *deflection,
                    };
                }
            }
        }
        state
    }

    fn state_of(
        &self,
        displacements: &[Vector6<f64>],
        wrenches: &[Option<Vector6<f64>>],
        segments: &[SegmentForces],
    ) -> UnitState {
        let model = self.model;
        let ends = segments.iter().map(|s| s.ends[1]).collect();
        let loads = segments.iter().map(|s| s.load).collect();
        let joints = (0..model.joints().len())
            .map(|k| self.joint_state(JointId(k), displacements, wrenches))
            .collect();
        let displacement = |node: NodeId| displacements[node.0];
        let flexibles = (model.flexibles().iter().enumerate())
            .map(|(k, flexible)| {
                let geometry = self.geometry;
                let nodes = &model.bodies()[flexible.body.0].nodes;
                let to_body = geometry.rotations[k].inverse();
                let first = displacement(nodes[0]);
                let mut relative = DVector::zeros(6 * (nodes.len() - 1));
                for (r, node) in nodes[1..].iter().enumerate() {
                    let moved = crate::plan::blocks::shift(geometry, nodes[0], *node) * first;
                    let own = rotate_vector6(&(displacement(*node) - moved), &to_body);
                    relative.fixed_rows_mut::<6>(6 * r).copy_from(&own);
                }
                [flexible.element.held_stiffness() * &relative, relative]
            })
            .collect();
        let reactions = wrenches.iter().zip(&self.joints);
        let reactions = reactions
            .map(|(wrench, own)| wrench.map(|wrench| own.basis.transpose() * wrench))
            .collect();
        UnitState {
            ends,
            loads,
            joints,
            reactions,
            flexibles,
        }
    }

    /// Force and deflection along a joint's elastic directions: from its wrench, else from the
    /// displacements on both sides of it.
    fn joint_state(
        &self,
        joint: JointId,
        displacements: &[Vector6<f64>],
        wrenches: &[Option<Vector6<f64>>],
    ) -> [Vector6<f64>; 2] {
        let own = &self.joints[joint.0];
        let elastic = own.directions.elastic;
        if elastic.is_empty() {
            return [Vector6::zeros(); 2];
        }
        let only = |v: Vector6<f64>| along(&v, elastic);
        let deflection = || {
            let [first, second] = self.model.joints()[joint.0]
                .between
                .map(|node| node.map_or(Vector6::zeros(), |node| displacements[node.0]));
            only(own.to_directions * (first - second))
        };
        let wrench = wrenches[joint.0].as_ref();
        match (wrench, &own.directions.compliance) {
            (Some(wrench), Some(compliance)) => {
                let force = only(own.basis.transpose() * wrench);
                [force, compliance * force]
            }
            (Some(wrench), None) => [only(own.basis.transpose() * wrench), deflection()],
            (None, _) => {
                let deflection = deflection();
                [own.directions.stiffness * deflection, deflection]
            }
        }
    }

    /// Work of a unit state's section wrenches on the elastic strains of a segment in `state`:
    /// tension, shear along y and z, torsion, bending about y and z, each with a weight.
    pub(crate) fn segment_work(
        &self,
        segment: SegmentId,
        state: &UnitState,
        unit: &UnitState,
        weight: &dyn Fn(f64) -> Vector6<f64>,
    ) -> Vector6<f64> {
        let load = state.load(segment);
        let (end, virtual_end) = (&state.ends[segment.0], &unit.ends[segment.0]);
        let beam = self.beams[segment.0].beam.straight();
        beam.elastic_work(end, &load, virtual_end, weight)
    }

    /// The same work on all strains, those apart that no force makes: the elastic ones, the others.
    pub(crate) fn segment_parts(
        &self,
        segment: SegmentId,
        state: &UnitState,
        unit: &UnitState,
    ) -> (Vector6<f64>, f64) {
        let elastic = self.segment_work(segment, state, unit, &|_| Vector6::repeat(1.0));
        let beam = self.beams[segment.0].beam.straight();
        let free = beam.free_work(&state.load(segment), &unit.ends[segment.0]);
        (elastic, free.sum())
    }
}

impl ElasticDirections {
    /// The rigid and elastic directions.
    pub fn held(&self) -> DofSet {
        self.directions.free.complement()
    }

    /// The elastic directions.
    pub fn elastic(&self) -> DofSet {
        self.directions.elastic
    }
}

impl UnitState {
    fn empty() -> Self {
        Self {
            ends: Vec::new(),
            loads: Vec::new(),
            joints: Vec::new(),
            reactions: Vec::new(),
            flexibles: Vec::new(),
        }
    }

    pub(crate) fn load(&self, segment: SegmentId) -> BeamLoad {
        let load = self.loads.get(segment.0).copied();
        load.unwrap_or_else(BeamLoad::none)
    }

    /// The state under a wrench on the output, from those under its components.
    pub fn combined(units: &[Self; 6], wrench: &Vector6<f64>) -> Self {
        let sum = |of: &dyn Fn(&Self) -> Vector6<f64>| {
            units
                .iter()
                .zip(wrench.iter())
                .map(|(unit, w)| of(unit) * *w)
                .sum()
        };
        let ends = (0..units[0].ends.len())
            .map(|k| sum(&|unit| unit.ends[k]))
            .collect();
        let joints = (0..units[0].joints.len())
            .map(|k| [0, 1].map(|part| sum(&|unit| unit.joints[k][part])))
            .collect();
        let reactions = (0..units[0].reactions.len())
            .map(|k| {
                let parts = units.iter().zip(wrench.iter());
                parts.map(|(unit, w)| Some(unit.reactions[k]? * *w)).sum()
            })
            .collect();
        let flexibles = (0..units[0].flexibles.len())
            .map(|k| {
                [0, 1].map(|part| {
                    let mut sum = &units[0].flexibles[k][part] * wrench[0];
                    for (unit, w) in units.iter().zip(wrench.iter()).skip(1) {
                        sum += &unit.flexibles[k][part] * *w;
                    }
                    sum
                })
            })
            .collect();
        Self {
            ends,
            loads: Vec::new(),
            joints,
            reactions,
            flexibles,
        }
    }
}
