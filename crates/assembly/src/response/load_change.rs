//! How weight and free strains change with a parameter, and what that does to the output.
//!
//! By Betti's theorem a load moves the output along a unit wrench by its work on the displacements
//! under that wrench: for a load along a segment, its resultant at the first node and the
//! displacement δ of the free end, `Rᵀ u₁ + f₂ᵀ δ`, with u₁ and f₂ those of the unit wrench.

use hyperstat_elements::rotate_vector6;
use hyperstat_model::{NodeId, SegmentId};
use nalgebra::Vector6;

use super::influence::Influence;
use super::parameters::{Parameter, Varied};
use crate::error::SolveError;
use crate::kinematics::motion::Motion;
use crate::pose::restraint::working;

/// Derivative by a parameter of what acts in every state.
pub(crate) struct LoadChange {
    /// On nodes, global axes.
    wrenches: Vec<(NodeId, Vector6<f64>)>,
    /// Displacement of the free end of segments held at their first node, element frame.
    free_ends: Vec<(SegmentId, Vector6<f64>)>,
}

impl Influence<'_> {
    /// What a parameter changes of weight and free strains; `None`: nothing.
    pub(crate) fn load_change(&self, varied: &Varied) -> Result<Option<LoadChange>, SolveError> {
        let model = self.model;
        let gravity = model.gravity();
        let mut change = LoadChange {
            wrenches: Vec::new(),
            free_ends: Vec::new(),
        };
        if let Parameter::Mass {
            mass,
            inertia: false,
        } = varied.parameter
        {
            let force = Vector6::new(gravity.x, gravity.y, gravity.z, 0.0, 0.0, 0.0);
            change.wrenches.push((model.masses()[mass].node, force));
        }
        for (id, own) in &varied.segments {
            let placed = &self.beams[id.0];
            let (segment, frame) = (&model.segments()[id.0], &placed.frame);
            let temperature = model.bodies()[segment.body.0].temperature;
            let load = own.load(segment, &(frame.inverse() * gravity), temperature)?;
            let Some(load) = load else { continue };
            let beam = placed.beam.straight();
            let resultant = rotate_vector6(&load.resultant(beam.length()), frame);
            change.wrenches.push((segment.ends[0], resultant));
            change.free_ends.push((*id, beam.free_end(&load)));
        }
        let zero = |wrench: &Vector6<f64>| *wrench == Vector6::zeros();
        let nothing = change.wrenches.iter().all(|(_, wrench)| zero(wrench))
            && change.free_ends.iter().all(|(_, end)| zero(end));
        Ok((!nothing).then_some(change))
    }

    /// Derivative of the output's displacement that it makes.
    pub(crate) fn moved_by(&self, change: &LoadChange) -> Vector6<f64> {
        Vector6::from_fn(|a, _| {
            let (ends, displacements) = (&self.units[a].ends, &self.displacements[a]);
            let nodes = change.wrenches.iter();
            let nodes = nodes.map(|(node, wrench)| wrench.dot(&displacements[node.0]));
            let segments = change.free_ends.iter();
            let segments = segments.map(|(segment, end)| end.dot(&ends[segment.0]));
            nodes.chain(segments).sum()
        })
    }

    /// Whether it works on one of these motions, which nothing resists: with any more of the
    /// parameter the mechanism is in balance no longer.
    pub(crate) fn unbalances(&self, change: &LoadChange, motions: &[Motion]) -> bool {
        let (geometry, size) = (self.geometry, self.size);
        let wrenches = || change.wrenches.iter().enumerate();
        (motions.iter())
            .any(|motion| working(motion, self.model, geometry, size, wrenches()).is_some())
    }
}
