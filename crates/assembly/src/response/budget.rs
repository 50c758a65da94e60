//! The compliance budget: which part gives how much of a displacement of the output.

use std::cmp::Ordering;

use hyperstat_joints::{Dof, DofSet};
use nalgebra::{Matrix6, Vector6};

use super::gives::Gives;
use super::influence::{Influence, UnitState};
use crate::answer::forces::Forces;
use crate::answer::measures::{compliance_along, direction_of};
use crate::answer::solution::Solution;
use crate::error::SolveError;
use hyperstat_model::{BodyId, Geometry, JointId, Model};

/// Order by size, the largest first. What is equal to nine digits, as equal parts of a symmetric
/// mechanism are but for rounding, is equal here, so that a stable sort keeps the order of the file.
pub fn larger_first(a: f64, b: f64) -> Ordering {
    let coarse = |number: f64| {
        let bits = number.abs().to_bits().saturating_add(1 << 22);
        f64::from_bits(bits >> 23 << 23)
    };
    coarse(b).total_cmp(&coarse(a))
}

/// Where the displacement of the output along a direction comes from.
///
/// By the principle of virtual work the displacement along a unit wrench e is the work of the
/// forces that e alone would cause on the deformations under the loads,
/// `eᵀu = Σ_segments ∫ W_eᵀ C W dx + Σ_joints f_eᵀ (C f − m) + Σ_flexible bodies f_eᵀ δ`, with the
/// misfits m of joints; each part has its share, and the shares add to 1. A negative share is that of a part whose give moves the
/// output the other way.
#[derive(Debug, Clone, PartialEq)]
pub struct Budget {
    /// The unit wrench: force, moment, global axes, at the output.
    pub along: Vector6<f64>,
    /// Displacement of the output along it, under the loads \[m, or rad for a moment\].
    pub total: f64,
    /// The parts, largest size first; parts that are rigid or carry nothing are left out.
    pub parts: Vec<Part>,
    /// What is left of `total` \[m or rad\]: the misfits of rigid directions
    /// whose forces are not determined, and rounding.
    pub rest: f64,
}

/// One part of a budget.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// Whose it is.
    pub source: PartSource,
    /// How it deforms.
    pub deformation: Deformation,
    /// Its part of the displacement \[m or rad\].
    pub displacement: f64,
    /// That over the whole; `None` where the whole is zero.
    pub share: Option<f64>,
}

/// What a part of a budget belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PartSource {
    /// An elastic body.
    Body(BodyId),
    /// A joint.
    Joint(JointId),
}

/// A way to deform.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Deformation {
    /// Bending of a body's beams, both planes.
    Bending,
    /// Shear deformation of a body's beams.
    Shear,
    /// Torsion of a body's beams.
    Torsion,
    /// Tension and compression of a body's beams.
    Tension,
    /// Strains of a body's beams that no force makes, such as those of temperature.
    FreeStrain,
    /// Any deformation of a flexible body.
    Flexible,
    /// The give of a joint along directions that its kind constrains.
    Bearing,
    /// The give of a joint along directions that are free by its kind: a drive, or a spring.
    Drive,
    /// The misfit of a joint, along all its directions.
    Misfit,
}

/// What joints and segments carry at a pose of a sweep in every state, and where the output's displacement
/// comes from.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Carried {
    /// By states: the model's own loads, then its cases.
    pub forces: Vec<Forces>,
    /// Budgets of the same states; none where they are not asked for.
    pub budgets: Vec<Budget>,
}

impl From<Vec<Forces>> for Carried {
    fn from(forces: Vec<Forces>) -> Self {
        Self {
            forces,
            budgets: Vec::new(),
        }
    }
}

impl Influence<'_> {
    /// The budget of a solution of this model along the unit wrench `along` (global axes, at the
    /// output). `along` is taken as it is: with length 1, `total` is a displacement.
    pub fn budget(&self, solution: &Solution, along: &Vector6<f64>) -> Budget {
        let total = solution.output.displacement.dot(along);
        let unit = UnitState::combined(&self.units, along);
        let misfits = self.misfit_parts(&unit);
        let rounding = solution
            .floor
            .rounding_along(&solution.output.displacement, along);
        let states = (&self.state(solution), &unit);
        self.budget_of(states, total, along, misfits, rounding)
    }

    /// The budget of the compliance along a unit wrench: of the displacement along it that it
    /// causes itself \[m/N, or rad/(N·m) for a moment\].
    pub fn compliance_budget(&self, compliance: &Matrix6<f64>, along: &Vector6<f64>) -> Budget {
        let total = compliance_along(compliance, along);
        let unit = UnitState::combined(&self.units, along);
        self.budget_of((&unit, &unit), total, along, Vec::new(), 0.0)
    }

    /// The budget of `total` from the state that it is of and the one under a unit of the wrench.
    fn budget_of(
        &self,
        (loaded, unit): (&UnitState, &UnitState),
        total: f64,
        along: &Vector6<f64>,
        mut found: Vec<Found>,
        rounding: f64,
    ) -> Budget {
        let model = self.model;
        for (k, body) in model.bodies().iter().enumerate() {
            let parts = body.segments.iter();
            let parts = parts.map(|segment| self.segment_parts(*segment, loaded, unit));
            add_body(&mut found, BodyId(k), parts);
            if let Some(flexible) = body.flexible {
                let [force, _] = &unit.flexibles[flexible.0];
                let [_, deflection] = &loaded.flexibles[flexible.0];
                let source = PartSource::Body(BodyId(k));
                found.push((source, Deformation::Flexible, force.dot(deflection)));
            }
        }
        for (k, joint) in model.joints().iter().enumerate() {
            let work = unit.joints[k][0].component_mul(&loaded.joints[k][1]);
            add_joint(&mut found, JointId(k), &work, joint.joint.free());
        }
        settled(found, total, along, rounding)
    }
}

/// A part, how it deforms and its displacement.
type Found = (PartSource, Deformation, f64);

/// Adds a body's beams, by the work on what each of them gives, elastic and not.
fn add_body(found: &mut Vec<Found>, id: BodyId, parts: impl Iterator<Item = (Vector6<f64>, f64)>) {
    let (mut work, mut free) = (Vector6::zeros(), 0.0);
    for (elastic, other) in parts {
        work += elastic;
        free += other;
    }
    let source = PartSource::Body(id);
    found.extend([
        (source, Deformation::Bending, work[4] + work[5]),
        (source, Deformation::Shear, work[1] + work[2]),
        (source, Deformation::Torsion, work[3]),
        (source, Deformation::Tension, work[0]),
        (source, Deformation::FreeStrain, free),
    ]);
}

/// Adds a joint, by the work on what it gives along its directions, of which these are free by its kind.
fn add_joint(found: &mut Vec<Found>, id: JointId, work: &Vector6<f64>, free: DofSet) {
    let source = PartSource::Joint(id);
    let mut parts = [0.0; 2];
    for dof in Dof::ALL {
        parts[usize::from(free.contains(dof))] += work[dof.index()];
    }
    found.extend([
        (source, Deformation::Bearing, parts[0]),
        (source, Deformation::Drive, parts[1]),
    ]);
}

/// The budget of `total`; what is below `rounding`, it and its parts, is zero.
fn settled(mut found: Vec<Found>, total: f64, along: &Vector6<f64>, rounding: f64) -> Budget {
    let clean = |value: f64| if value.abs() <= rounding { 0.0 } else { value };
    let total = clean(total);
    let accounted: f64 = found.iter().map(|(_, _, work)| work).sum();
    found.retain(|(_, _, work)| clean(*work) != 0.0);
    found.sort_by(|a, b| larger_first(a.2, b.2));
    let parts = found
        .into_iter()
        .map(|(source, deformation, displacement)| Part {
            source,
            deformation,
            displacement,
            share: (total != 0.0).then(|| displacement / total),
        });
    Budget {
        along: *along,
        total,
        parts: parts.collect(),
        rest: clean(total - accounted),
    }
}

impl Gives {
    /// The budget of the displacement of the output in a state of a pose along a unit wrench, from what joints
    /// and segments carry in the state and under the wrench; of a mechanism of beams, rigid bodies and joints
    /// whose wrenches are all determined.
    ///
    /// # Errors
    /// As [`Influence::sensitivities`].
    pub fn budget(
        &self,
        at: (&Model, &Geometry),
        (displacement, forces): (&Vector6<f64>, &Forces),
        (along, unit): (&Vector6<f64>, &Forces),
    ) -> Result<Budget, SolveError> {
        let displacement = forces.floor.cleared(displacement);
        let rounding = forces.floor.rounding_along(&displacement, along);
        let mut found = Vec::with_capacity(5 * at.0.bodies().len() + 2 * self.joints.len());
        self.add_misfits(&mut found, at.0, unit);
        self.add_parts(&mut found, at, (unit, forces), true)?;
        Ok(settled(found, displacement.dot(along), along, rounding))
    }

    /// The same of the displacement that the wrench causes itself.
    ///
    /// # Errors
    /// As [`Influence::sensitivities`].
    pub fn compliance_budget(
        &self,
        at: (&Model, &Geometry),
        displacement: &Vector6<f64>,
        (along, unit): (&Vector6<f64>, &Forces),
    ) -> Result<Budget, SolveError> {
        let mut found = Vec::new();
        self.add_parts(&mut found, at, (unit, unit), false)?;
        Ok(settled(found, displacement.dot(along), along, 0.0))
    }

    fn add_parts(
        &self,
        found: &mut Vec<Found>,
        at: (&Model, &Geometry),
        (unit, loaded): (&Forces, &Forces),
        preloaded: bool,
    ) -> Result<(), SolveError> {
        for (k, body) in at.0.bodies().iter().enumerate() {
            let works = body.segments.iter();
            let works = works.map(|id| self.segments[id.0].works(at, unit, loaded));
            let works: Vec<_> = works.collect::<Result<_, _>>()?;
            add_body(found, BodyId(k), works.into_iter());
        }
        for (k, joint) in self.joints.iter().enumerate() {
            let work = joint.work(unit, loaded, preloaded);
            add_joint(found, JointId(k), &work, joint.free);
        }
        Ok(())
    }

    /// Adds what the model's misfits give along a wrench, by what joints carry under it.
    fn add_misfits(&self, found: &mut Vec<Found>, model: &Model, unit: &Forces) {
        for entry in model.misfits() {
            let joint = &self.joints[entry.joint.0];
            let Some(force) = joint.force(unit) else {
                continue;
            };
            let mut sum = None;
            for direction in joint.directions.free.complement().iter() {
                let per_unit = -force[direction.index()];
                *sum.get_or_insert(0.0) += entry.misfit[direction.index()] * per_unit;
            }
            let source = PartSource::Joint(entry.joint);
            found.extend(sum.map(|sum| (source, Deformation::Misfit, sum)));
        }
    }
}

impl Influence<'_> {
    /// What the model's misfits give along a wrench, by the state under it.
    fn misfit_parts(&self, unit: &UnitState) -> Vec<(PartSource, Deformation, f64)> {
        if self.model.misfits().is_empty() {
            return Vec::new();
        }
        let mut parts: Vec<(PartSource, Deformation, f64)> = Vec::new();
        for effect in self.effects_of_misfits(unit) {
            let source = PartSource::Joint(effect.joint);
            let misfit = self.model.misfit(effect.joint).map(|entry| entry.misfit);
            if let (Some(misfit), Some(per_unit)) = (misfit, effect.per_unit) {
                let given = misfit[effect.direction.index()] * per_unit;
                match parts.last_mut() {
                    Some((last, _, sum)) if *last == source => *sum += given,
                    _ => parts.push((source, Deformation::Misfit, given)),
                }
            }
        }
        parts
    }

    /// What a unit misfit of each direction of each joint would do to the output along a unit
    /// wrench, in the joints' order; free directions are left out, they have no misfit.
    ///
    /// By reciprocity it is the force along that direction that the unit wrench on the output
    /// causes, reversed: `−f_e` on the second body. So it says which tolerance of a joint, of a
    /// bearing's place or a link's length, matters.
    pub fn misfit_effects(&self, along: &Vector6<f64>) -> Vec<MisfitEffect> {
        self.effects_of_misfits(&UnitState::combined(&self.units, along))
    }

    fn effects_of_misfits(&self, state: &UnitState) -> Vec<MisfitEffect> {
        let mut effects = Vec::new();
        for (k, joint) in self.joints.iter().enumerate() {
            let reaction = &state.reactions[k];
            let [elastic_force, _] = &state.joints[k];
            let elastic = joint.elastic();
            for direction in joint.held().iter() {
                let force = match reaction {
                    Some(reaction) => Some(reaction[direction.index()]),
                    None if elastic.contains(direction) => Some(elastic_force[direction.index()]),
                    None => None,
                };
                effects.push(MisfitEffect {
                    joint: JointId(k),
                    direction,
                    per_unit: force.map(|force| if force == 0.0 { 0.0 } else { -force }),
                });
            }
        }
        effects
    }
}

/// What a misfit along a direction of a joint does to the output.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MisfitEffect {
    /// The joint.
    pub joint: JointId,
    /// A rigid, locked or elastic direction of it.
    pub direction: Dof,
    /// Displacement of the output along the wrench asked for, per unit of the misfit (m or rad per
    /// m or rad); `None` where redundant rigid constraints leave it undetermined.
    pub per_unit: Option<f64>,
}

impl Budget {
    /// The unit force along the translation of a displacement, or the unit moment along its
    /// rotation where it does not translate; `None` for no displacement.
    pub fn direction_of(displacement: &Vector6<f64>) -> Option<Vector6<f64>> {
        direction_of(displacement)
    }

    /// The share of each way to deform, largest size first.
    pub fn by_deformation(&self) -> Vec<(Deformation, f64)> {
        self.summed(|part| part.deformation)
    }

    /// The share of each body and joint, largest size first.
    pub fn by_source(&self) -> Vec<(PartSource, f64)> {
        self.summed(|part| part.source)
    }

    /// Displacements by a property of the parts.
    fn summed<T: PartialEq + Copy>(&self, of: impl Fn(&Part) -> T) -> Vec<(T, f64)> {
        let mut sums: Vec<(T, f64)> = Vec::new();
        for part in &self.parts {
            let key = of(part);
            match sums.iter_mut().find(|(known, _)| *known == key) {
                Some((_, sum)) => *sum += part.displacement,
                None => sums.push((key, part.displacement)),
            }
        }
        sums.sort_by(|a, b| larger_first(a.1, b.1));
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::larger_first;

    #[test]
    fn what_differs_by_rounding_keeps_its_order() {
        let mut shares = [
            ("a", 1.0),
            ("b", -3.0),
            ("c", 1.0 + 1e-14),
            ("d", 1.001),
            ("e", 0.0),
        ];
        shares.sort_by(|x, y| larger_first(x.1, y.1));
        assert_eq!(shares.map(|share| share.0), ["b", "d", "a", "c", "e"]);
    }
}
