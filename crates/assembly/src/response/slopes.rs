//! Derivatives of quantities of the output at the poses of a sweep, by parameters that change no load.
//!
//! Any quantity of the output's compliance and displacement has a derivative of the form
//! `Σ g wᵀ (∂C) w + eᵀ (∂u)`, with a few wrenches w and e on the output. What a parameter does to it is the
//! work of the forces under these on the change that it makes of what gives
//! ([`sensitivity`](super::sensitivity)): so a few states answer for any number of parameters.

use hyperstat_elements::StraightBeam;
use hyperstat_joints::Dof;
use hyperstat_model::{Geometry, JointId, Model, SegmentId, segment_beam};
use nalgebra::{Matrix6, Vector6};

use super::gives::{JointGive, SegmentGive};
use super::parameters::{Parameter, SegmentChange, Varied, parameters};
use crate::answer::forces::Forces;
use crate::error::SolveError;

/// The derivative of a quantity of the output: `Σ weight · wᵀ (∂C) w + eᵀ (∂u)`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Probe {
    /// Weights and wrenches w: force, moment, global axes, at the output.
    pub wrenches: Vec<(f64, Vector6<f64>)>,
    /// The wrench e, where the quantity is one of the displacement.
    pub along: Option<Vector6<f64>>,
}

impl Probe {
    /// The derivative along a change of compliance and displacement.
    pub fn along(&self, compliance: &Matrix6<f64>, displacement: &Vector6<f64>) -> f64 {
        let own = self.wrenches.iter();
        let own: f64 = own
            .map(|(weight, w)| weight * w.dot(&(compliance * w)))
            .sum();
        own + self.along.map_or(0.0, |along| along.dot(displacement))
    }

    /// The wrenches whose states it is made of, in order.
    pub(crate) fn states(&self) -> Vec<Vector6<f64>> {
        let own = self.wrenches.iter().map(|(_, wrench)| *wrench);
        own.chain(self.along).collect()
    }
}

/// Parameters of a model, and the parts that each of them changes.
#[derive(Debug)]
pub struct Slopes {
    parameters: Vec<Varied>,
    /// The segments that any of them changes, in order.
    segments: Vec<(SegmentId, SegmentGive)>,
    /// The joints, likewise.
    joints: Vec<(JointId, JointGive)>,
}

/// Two states of a pose, the first of them under a wrench on the output alone, and the weight of their work.
struct Pair<'a> {
    weight: f64,
    unit: &'a Forces,
    loaded: &'a Forces,
    /// Whether the second is one of the model's own, with its preloads.
    is_own: bool,
}

impl Slopes {
    /// Those of the model's that these are; `None` where one of them is none of the model's, changes what acts
    /// or nothing that gives.
    ///
    /// # Errors
    /// As [`Influence::sensitivities`](crate::Influence::sensitivities).
    pub fn new(model: &Model, wanted: &[Parameter]) -> Result<Option<Self>, SolveError> {
        let mut known: Vec<_> = parameters(model)?.into_iter().map(Some).collect();
        let mut found = Vec::with_capacity(wanted.len());
        for wanted in wanted {
            let own = known
                .iter_mut()
                .find(|own| own.as_ref().is_some_and(|own| own.parameter == *wanted));
            match own.and_then(Option::take) {
                Some(own) if wanted.is_elastic() && !changes_loads(model, &own) => found.push(own),
                _ => return Ok(None),
            }
        }
        let mut own = Self {
            segments: Vec::new(),
            joints: Vec::new(),
            parameters: found,
        };
        let changes = |id: &SegmentId| {
            let mut all = own.parameters.iter().flat_map(|own| &own.segments);
            all.any(|(changed, _)| changed == id)
        };
        let segments = (0..model.segments().len()).map(SegmentId).filter(changes);
        for id in segments.collect::<Vec<_>>() {
            own.segments.push((id, SegmentGive::of(model, id)?));
        }
        let mut joints: Vec<JointId> = Vec::new();
        for varied in &own.parameters {
            if let Parameter::Joint { joints: all, .. } = &varied.parameter {
                joints.extend(all);
            }
        }
        joints.sort_unstable();
        joints.dedup();
        for id in joints {
            let give = JointGive::of(model, id);
            if give.directions.compliance.is_none() {
                return Ok(None);
            }
            own.joints.push((id, give));
        }
        Ok(Some(own))
    }

    /// The derivatives of what a probe is of, by the parameters in order, from what joints and segments carry
    /// under its wrenches, and in the state that its displacement is of.
    pub(crate) fn of(
        &self,
        model: &Model,
        geometry: &Geometry,
        probe: &Probe,
        units: &[&Forces],
        loaded: Option<&Forces>,
    ) -> Result<Vec<f64>, SolveError> {
        let (weights, along) = units.split_at(probe.wrenches.len().min(units.len()));
        let own = probe.wrenches.iter().zip(weights);
        let own = own.map(|((weight, _), unit)| Pair {
            weight: *weight,
            unit,
            loaded: unit,
            is_own: false,
        });
        let of_state = along.first().zip(loaded).map(|(unit, loaded)| Pair {
            weight: 1.0,
            unit,
            loaded,
            is_own: true,
        });
        let pairs: Vec<Pair<'_>> = own.chain(of_state).collect();
        let mut slopes = vec![0.0; self.parameters.len()];
        // A parameter's segments are ascending, as these are.
        let mut left: Vec<&[_]> = self
            .parameters
            .iter()
            .map(|own| &own.segments[..])
            .collect();
        for (id, give) in &self.segments {
            let works = pairs.iter();
            let works = works.map(|own| Some(give.work(own.unit, own.loaded)? * own.weight));
            let alike: Option<Vector6<f64>> = works.sum();
            let beam = match alike {
                Some(_) => None,
                None => Some(segment_beam(model, geometry, *id)?.0),
            };
            for (slope, left) in slopes.iter_mut().zip(&mut left) {
                let Some(((own, change), rest)) = left.split_first() else {
                    continue;
                };
                if own != id {
                    continue;
                }
                *left = rest;
                *slope -= match (&alike, &beam) {
                    (Some(work), _) => change.rigidities(0.0).dot(work),
                    (None, Some(beam)) => work_of(beam.straight(), *id, change, &pairs),
                    (None, None) => 0.0,
                };
            }
        }
        let works: Vec<Vector6<f64>> = (self.joints.iter())
            .map(|(_, give)| {
                let own = pairs.iter();
                own.map(|own| give.work(own.unit, own.loaded, own.is_own) * own.weight)
                    .sum()
            })
            .collect();
        for (slope, varied) in slopes.iter_mut().zip(&self.parameters) {
            let Parameter::Joint { direction, joints } = &varied.parameter else {
                continue;
            };
            for joint in joints {
                let place = self.joints.binary_search_by_key(joint, |(id, _)| *id);
                let Ok(place) = place else { continue };
                let part = |dof: Dof| works[place][dof.index()];
                *slope -= direction.map_or(works[place].sum(), part) / varied.value;
            }
        }
        Ok(slopes)
    }
}

/// Whether weight or free strains change with a parameter.
fn changes_loads(model: &Model, varied: &Varied) -> bool {
    let weighs = model.gravity().norm_squared() > 0.0;
    let loads = |(id, change): &(SegmentId, SegmentChange)| match change {
        SegmentChange::Elastic(_) => false,
        SegmentChange::Expansion => {
            let segment = &model.segments()[id.0];
            model.bodies()[segment.body.0].temperature != 0.0
        }
        _ => weighs,
    };
    varied.segments.iter().any(loads)
}

/// Work of the pairs on what a segment gives, where its rigidities change so along it: all parts together.
fn work_of(
    beam: &dyn StraightBeam,
    id: SegmentId,
    change: &SegmentChange,
    pairs: &[Pair<'_>],
) -> f64 {
    let work = |pair: &Pair<'_>| {
        let [unit, loaded] = [pair.unit, pair.loaded].map(|own| &own.segments[id.0]);
        let weight = |xi: f64| change.rigidities(xi);
        let work = beam.elastic_work(&loaded.ends[1], &loaded.load, &unit.ends[1], &weight);
        pair.weight * work.sum()
    };
    pairs.iter().map(work).sum()
}
