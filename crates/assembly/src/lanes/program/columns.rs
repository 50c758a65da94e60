//! What acts, by the columns that the lanes find it in.
//!
//! A mechanism without load cases has one column: its loads with all that acts always. With cases,
//! what acts always has a column of its own, and so have the model's own loads and each case's: a
//! state is the sum of two.

use hyperstat_model::{JointId, Model, SegmentId};
use nalgebra::Vector6;

use super::acts::{Act, Acts};
use super::element::{NodeLoad, Shift};
use super::inputs::{Inputs, Point, Turned};
use super::parts::Parts;
use super::recovery::NodeWrench;
use crate::state::preload::{along as along_directions, spring_misfit};
use crate::state::sources::{Along, Sources};

/// Columns, and the states that are made of them.
#[derive(Debug)]
pub(crate) struct Columns<'m> {
    sources: Vec<Vec<Sources<'m>>>,
    /// By states: the model's own loads, then its cases.
    pub states: Vec<Vec<usize>>,
}

/// What acts on segments and joints, brought into the program.
#[derive(Debug, Default)]
pub(crate) struct Brought {
    /// Displacements of the second nodes of segments.
    pub segments: Vec<(SegmentId, usize, Act)>,
    /// Displacements of the second bodies of joints.
    pub misfits: Vec<(JointId, usize, Act)>,
    /// Wrenches on nodes, whether these move or not.
    pub wrenches: Vec<NodeWrench>,
}

impl<'m> Columns<'m> {
    /// Those of a model. `None` where a weight has no density.
    pub fn of(model: &'m Model) -> Option<Self> {
        let always = Sources::always(model).ok()?;
        let own = Sources::of_set(model.load_set());
        if model.cases().is_empty() {
            let acts = !own.is_empty() || !always.is_empty();
            return Some(Self {
                sources: if acts {
                    vec![vec![own, always]]
                } else {
                    Vec::new()
                },
                states: vec![if acts { vec![0] } else { Vec::new() }],
            });
        }
        let mut columns = Self {
            sources: Vec::new(),
            states: Vec::new(),
        };
        let mut add = |sources: Sources<'m>| {
            let acts = !sources.is_empty();
            acts.then(|| {
                columns.sources.push(vec![sources]);
                columns.sources.len() - 1
            })
        };
        let always = add(always);
        let cases = model
            .cases()
            .iter()
            .map(|case| Sources::of_set(&case.loads));
        let sets: Vec<_> = std::iter::once(own).chain(cases).collect();
        let sets: Vec<_> = sets.into_iter().map(&mut add).collect();
        columns.states = sets
            .into_iter()
            .map(|set| always.into_iter().chain(set).collect())
            .collect();
        Some(columns)
    }

    /// Number of columns.
    pub fn len(&self) -> usize {
        self.sources.len()
    }

    /// The loads on nodes, and what acts along segments and in joints. `None` where a segment is no
    /// beam.
    pub fn bring(
        &self,
        parts: &Parts<'_>,
        acts: &mut Acts,
        inputs: &mut Inputs,
    ) -> Option<(Vec<NodeLoad>, Brought)> {
        let model = parts.model;
        let (mut loads, mut brought) = (Vec::new(), Brought::default());
        for (column, sources) in self.sources.iter().enumerate() {
            let wrenches = &mut brought.wrenches;
            let mut add_load = |node, act, inputs: &mut Inputs| {
                let point = inputs.point(node);
                wrenches.push(NodeWrench {
                    node,
                    point,
                    act,
                    column,
                });
                let motion = parts.motion(node, inputs)?;
                if motion.moves() {
                    loads.push(NodeLoad {
                        node: motion,
                        point,
                        act,
                        column,
                    });
                }
                Some(())
            };
            let wrenches = sources.iter().flat_map(|s| &s.wrenches);
            for source in wrenches.filter(|w| w.wrench != Vector6::zeros()) {
                let act = acts.wrench(model, source, inputs);
                add_load(source.node, act, inputs)?;
            }
            let along = sources.iter().flat_map(|s| &s.along);
            let mut along: Vec<&(SegmentId, Along<'_>)> = along.collect();
            along.sort_by_key(|(id, _)| *id);
            for own in along.chunk_by(|a, b| a.0 == b.0) {
                let &(id, _) = own[0];
                let sources: Vec<&Along<'_>> = own.iter().map(|(_, along)| along).collect();
                let (resultant, free_end) = acts.along(model, id, &sources, inputs)?;
                brought.segments.push((id, column, free_end));
                if let Some(act) = resultant {
                    add_load(model.segments()[id.0].ends[0], act, inputs)?;
                }
            }
            if !sources.iter().any(|s| s.misfits) {
                continue;
            }
            for entry in model.misfits() {
                let directions = &parts.topology.joints[entry.joint.0].directions;
                let misfit = along_directions(&entry.misfit, directions.rigid)
                    + spring_misfit(directions, entry);
                let six = model.joints()[entry.joint.0].joint.basis() * misfit;
                if six != Vector6::zeros() {
                    let act = acts.turned(Turned::Joint(entry.joint), &six, inputs);
                    brought.misfits.push((entry.joint, column, act));
                }
            }
        }
        Some((loads, brought))
    }
}

impl Brought {
    /// What a node of an element stands off by, by what acts along a segment.
    pub fn by_segment(&self, id: SegmentId, node: usize, point: Point) -> Vec<Shift> {
        let own = self.segments.iter().filter(|(own, ..)| *own == id);
        let shift =
            |(_, column, act): &(SegmentId, usize, Act)| shift(node, *act, point, 1.0, *column);
        own.map(shift).collect()
    }

    /// The same by the misfit of a joint; `sign`: that of what the node's side stands off by.
    pub fn by_joint(&self, id: JointId, node: usize, point: Point, sign: f64) -> Vec<Shift> {
        let own = self.misfits.iter().filter(|(own, ..)| *own == id);
        let shift =
            |(_, column, act): &(JointId, usize, Act)| shift(node, *act, point, sign, *column);
        own.map(shift).collect()
    }
}

fn shift(node: usize, act: Act, point: Point, sign: f64, column: usize) -> Shift {
    Shift {
        node,
        act,
        point,
        sign,
        column,
    }
}
