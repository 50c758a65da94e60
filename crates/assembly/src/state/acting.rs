//! What acts in one state, brought to one configuration: wrenches on nodes and loads along
//! segments.
//!
//! A load along a segment becomes a wrench at the segment's first node, its resultant, and a
//! deformation that the segment starts from, less the free end's displacement δ: the wrench on its
//! second node is k (u₂ − M u₁ − δ), that on its first follows from equilibrium.

use std::ops::Range;

use hyperstat_elements::{BeamLoad, rotate_vector6};
use hyperstat_model::{JointId, LoadSet, NodeId, SegmentId};
use nalgebra::Vector6;

use super::sources::{Along, Sources, WrenchAxes};
use crate::error::SolveError;
use crate::posture::Posture;

/// What acts in one state.
#[derive(Debug, Clone)]
pub(crate) struct Acting {
    /// Wrenches on nodes, global axes, the resultants of segments among them.
    pub nodes: Vec<(NodeId, Vector6<f64>)>,
    /// The joints whose preloads are some of these wrenches, and the number of the first of them.
    preloaded: (usize, Vec<JointId>),
    /// Loads along segments that have any, element frames, in the segments' order.
    segments: Vec<(SegmentId, BeamLoad)>,
    /// Whether the misfits of the model's joints act. The states that are solved together have
    /// them all or none.
    pub misfits: bool,
}

impl Acting {
    /// The states of a model: its own loads, then its cases, each with what acts in all of them.
    pub fn of_model(at: &Posture<'_>) -> Result<Vec<Self>, SolveError> {
        Self::of_states(at, 0..1 + at.model.cases().len())
    }

    /// Some of these states, by their numbers.
    pub fn of_states(at: &Posture<'_>, states: Range<usize>) -> Result<Vec<Self>, SolveError> {
        let Posture { model, .. } = *at;
        let always = Self::always(at)?;
        let cases = model.cases().iter().map(|case| &case.loads);
        std::iter::once(model.load_set())
            .chain(cases)
            .skip(states.start)
            .take(states.len())
            .map(|set| Ok(Self::new(at, set)?.with(&always)))
            .collect()
    }

    /// No load, no misfit.
    pub fn nothing() -> Self {
        Self {
            nodes: Vec::new(),
            preloaded: (0, Vec::new()),
            segments: Vec::new(),
            misfits: false,
        }
    }

    /// A set of loads alone.
    pub fn new(at: &Posture<'_>, set: &LoadSet) -> Result<Self, SolveError> {
        Self::brought(at, &Sources::of_set(set))
    }

    /// What acts in every state: misfits and preloads, weight and temperatures.
    fn always(at: &Posture<'_>) -> Result<Self, SolveError> {
        Self::brought(at, &Sources::always(at.model)?)
    }

    /// Sources, brought to a configuration.
    fn brought(at: &Posture<'_>, sources: &Sources<'_>) -> Result<Self, SolveError> {
        let mut acting = Self {
            nodes: Vec::with_capacity(sources.wrenches.len()),
            misfits: sources.misfits,
            ..Self::nothing()
        };
        for source in &sources.wrenches {
            let wrench = match source.axes {
                WrenchAxes::Load(axes) => {
                    rotate_vector6(&source.wrench, &axes.rotation(at.model, at.geometry)?)
                }
                WrenchAxes::Preload(joint) => {
                    acting.preloaded.1.push(joint);
                    at.direction_map(joint).transpose() * source.wrench
                }
            };
            acting.nodes.push((source.node, wrench));
        }
        let mut along = Vec::with_capacity(sources.along.len());
        for (id, source) in &sources.along {
            let load = match source {
                Along::Heat(load) => *load,
                Along::Weight(mass) => {
                    let frame = at.segment_frame(*id)?;
                    mass.weight(&(frame.inverse() * at.model.gravity()))
                }
                Along::Line(load) => {
                    let frame = at.segment_frame(*id)?;
                    let turn = frame.inverse() * load.axes.rotation(at.model, at.geometry)?;
                    let [first, second] = load.ends.map(|end| rotate_vector6(&end, &turn));
                    BeamLoad::linear(first, second)
                }
            };
            along.push((*id, load));
        }
        acting.add_along(at, along)?;
        Ok(acting)
    }

    /// Adds loads along segments, element frames, and their resultants at first nodes.
    fn add_along(
        &mut self,
        at: &Posture<'_>,
        mut along: Vec<(SegmentId, BeamLoad)>,
    ) -> Result<(), SolveError> {
        let Posture {
            model, geometry, ..
        } = *at;
        along.sort_by_key(|(segment, _)| *segment);
        for (segment, load) in &along {
            let [a, b] = model.segments()[segment.0].ends;
            let length = (geometry.positions[b.0] - geometry.positions[a.0]).norm();
            let frame = at.segment_frame(*segment)?;
            let resultant = load.resultant(length);
            if resultant != Vector6::zeros() {
                self.nodes.push((a, rotate_vector6(&resultant, &frame)));
            }
        }
        self.join(along);
        Ok(())
    }

    /// Takes in loads along segments in the segments' order, those of a segment added.
    fn join(&mut self, along: Vec<(SegmentId, BeamLoad)>) {
        for (segment, load) in along {
            match self.segments.last_mut() {
                Some((last, sum)) if *last == segment => *sum = *sum + load,
                _ => self.segments.push((segment, load)),
            }
        }
    }

    /// Both together; `other` is what acts always, and has the preloads.
    fn with(mut self, other: &Self) -> Self {
        self.preloaded = (self.nodes.len(), other.preloaded.1.clone());
        self.nodes.extend(&other.nodes);
        self.misfits |= other.misfits;
        let mut own = std::mem::take(&mut self.segments);
        own.extend(&other.segments);
        own.sort_by_key(|(segment, _)| *segment);
        self.join(own);
        self
    }

    /// The joint whose preload a wrench of [`Acting::nodes`] is, by its number.
    pub fn preloaded(&self, wrench: usize) -> Option<JointId> {
        let (first, joints) = &self.preloaded;
        joints.get(wrench.checked_sub(*first)?).copied()
    }

    /// Loads along segments that have any, element frames.
    pub fn segments(&self) -> &[(SegmentId, BeamLoad)] {
        &self.segments
    }

    /// Load along a segment, element frame.
    pub fn on_segment(&self, segment: SegmentId) -> Option<&BeamLoad> {
        let place = self.segments.binary_search_by_key(&segment, |s| s.0).ok()?;
        Some(&self.segments[place].1)
    }

    /// Sum of the wrenches on a node, global axes.
    pub fn on_node(&self, node: NodeId) -> Vector6<f64> {
        let on_node = self.nodes.iter().filter(|(n, _)| *n == node);
        on_node.map(|(_, wrench)| wrench).sum()
    }
}
