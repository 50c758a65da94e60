//! Derivatives of quantities of the output at the poses of a sweep.
//!
//! Any quantity of the output's compliance and displacement has a derivative of the form
//! `Σ g wᵀ (∂C) w + eᵀ (∂u)`, with a few wrenches w and e on the output. What a parameter does to it is the
//! work of the forces under these on the change that it makes of what gives
//! ([`sensitivity`](super::sensitivity)): so a few states answer for any number of parameters. Weight that changes
//! with a parameter is a load case beside the others.

use hyperstat_elements::StraightBeam;
use hyperstat_joints::Dof;
use hyperstat_model::{
    Axes, Geometry, JointId, LineLoad, LoadCase, LoadSet, Model, SegmentId, segment_beam,
};
use nalgebra::{Matrix6, Vector6};

use super::gives::{JointGive, SegmentGive};
use super::parameters::{Parameter, SegmentChange, Varied, parameters};
use crate::answer::forces::Forces;
use crate::answer::pose_result::PoseResult;
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
    /// By parameters: the case of the weight that changes with it, and that of what acts in every state.
    weights: Vec<Option<[usize; 2]>>,
}

/// Name of the case of what acts in every state alone.
const ALWAYS: &str = "\u{2202}";

/// Two states of a pose, the first of them under a wrench on the output alone, and the weight of their work.
struct Pair<'a> {
    weight: f64,
    unit: &'a Forces,
    loaded: &'a Forces,
    /// Whether the second is one of the model's own, with its preloads.
    is_own: bool,
}

impl Slopes {
    /// Adds to a model the cases that derivatives of its displacements by these parameters are found from.
    ///
    /// # Errors
    /// As [`Slopes::new`].
    pub fn add_cases(model: &mut Model, wanted: &[Parameter]) -> Result<(), SolveError> {
        let known = parameters(model)?;
        let mut cases = vec![(ALWAYS.to_owned(), LoadSet::default())];
        for (number, wanted) in wanted.iter().enumerate() {
            let own = known.iter().find(|own| own.parameter == *wanted);
            if let Some(Some(loads)) = own.and_then(|own| weight_change(model, own)) {
                cases.push((format!("{ALWAYS}{number}"), loads));
            }
        }
        if cases.len() > 1 {
            for (name, loads) in cases {
                model.add_case(LoadCase { name, loads })?;
            }
        }
        Ok(())
    }

    /// Those of the model's that these are; `None` where one of them is none of the model's, or changes what
    /// acts otherwise than as a case. `of_loads`: whether a displacement is differentiated, in a model with
    /// [those cases](Slopes::add_cases).
    ///
    /// # Errors
    /// A section that cannot be formed, which no segment of a model has.
    pub fn new(
        model: &Model,
        wanted: &[Parameter],
        of_loads: bool,
    ) -> Result<Option<Self>, SolveError> {
        let mut known: Vec<_> = parameters(model)?.into_iter().map(Some).collect();
        let mut found = Vec::with_capacity(wanted.len());
        let mut weights = Vec::with_capacity(wanted.len());
        let case = |name: &str| model.cases().iter().position(|own| own.name == name);
        for (number, wanted) in wanted.iter().enumerate() {
            let own = known
                .iter_mut()
                .find(|own| own.as_ref().is_some_and(|own| own.parameter == *wanted));
            let Some(own) = own.and_then(Option::take) else {
                return Ok(None);
            };
            weights.push(match weight_change(model, &own) {
                Some(Some(_)) if of_loads => {
                    let own = case(&format!("{ALWAYS}{number}"));
                    let Some(own) = own.zip(case(ALWAYS)) else {
                        return Ok(None);
                    };
                    Some(own.into())
                }
                None if of_loads => return Ok(None),
                _ => None,
            });
            found.push(own);
        }
        let mut own = Self {
            segments: Vec::new(),
            joints: Vec::new(),
            parameters: found,
            weights,
        };
        let changes = |id: &SegmentId| {
            let elastic = own
                .parameters
                .iter()
                .filter(|own| own.parameter.is_elastic());
            let mut all = elastic.flat_map(|own| &own.segments);
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
        (result, loaded): (&PoseResult, Option<&Forces>),
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
        for (slope, cases) in slopes.iter_mut().zip(&self.weights) {
            let (Some([own, always]), Some(along)) = (cases, probe.along) else {
                continue;
            };
            let [own, always] = [own, always].map(|case| result.cases.get(*case));
            *slope += match own.zip(always) {
                Some((own, always)) => along.dot(&(own - always)),
                None => f64::NAN,
            };
        }
        Ok(slopes)
    }
}

/// How the weight changes with a parameter, `Some(None)` where it does not; `None` where what acts changes in a
/// way that is no case.
fn weight_change(model: &Model, varied: &Varied) -> Option<Option<LoadSet>> {
    let gravity = model.gravity();
    let per_mass = Vector6::new(gravity.x, gravity.y, gravity.z, 0.0, 0.0, 0.0);
    let mut loads = LoadSet::default();
    if let Parameter::Mass {
        mass,
        inertia: false,
    } = varied.parameter
    {
        loads = LoadSet::on(model.masses()[mass].node, per_mass);
    }
    for (id, change) in &varied.segments {
        let segment = &model.segments()[id.0];
        if let SegmentChange::Expansion = change {
            if model.bodies()[segment.body.0].temperature != 0.0 {
                return None;
            }
            continue;
        }
        if matches!(change, SegmentChange::Elastic(_)) || per_mass == Vector6::zeros() {
            continue;
        }
        if segment.taper.is_some() {
            return None;
        }
        let area = segment.section.area();
        let per_length = match change {
            SegmentChange::Density => area,
            _ => segment.material.density().unwrap_or(0.0) * area * change.sections(0.0)[0],
        };
        let weight = per_mass * per_length;
        if weight != Vector6::zeros() {
            loads.lines.push(LineLoad {
                segment: *id,
                ends: [weight; 2],
                axes: Axes::Global,
            });
        }
    }
    loads.nodes.retain(|load| load.wrench != Vector6::zeros());
    let changes = !loads.nodes.is_empty() || !loads.lines.is_empty();
    Some(changes.then_some(loads))
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
