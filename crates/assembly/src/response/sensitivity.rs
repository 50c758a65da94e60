//! Derivatives of the output's compliance, stiffness and displacement by every dimension of a
//! section, constant of a material, stiffness of a joint and mass.
//!
//! With W_a the section wrenches under a unit of component a on the output, and c the section's
//! compliances, `∂C_o[a, b]/∂p = Σ ∫ W_aᵀ (∂c/∂p) W_b dx`; `f_aᵀ (∂C_j/∂p) f_b` for a joint:
//! what the change of the internal forces does, does no work on a deformation that fits together.
//! Then `∂K_o = −K_o ∂C_o K_o`. The displacement has W under the loads for W_b, and the part of
//! weight and temperature that change with the parameter ([`crate::load_change`]).

use hyperstat_elements::SampledStates;
use hyperstat_model::SegmentId;
use nalgebra::{Matrix6, Vector6};

use super::influence::{Influence, UnitState};
use super::parameters::{Parameter, Varied, parameters};
use crate::answer::measures::compliance_along;
use crate::answer::solution::Solution;
use crate::error::SolveError;
use crate::state::floor::ROUNDING;

/// How the output answers to one parameter of the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// The parameter p.
    pub parameter: Parameter,
    /// Its name, where its values have one ([`Model::name_value`](crate::Model::name_value)).
    pub name: Option<String>,
    /// Its value; 1 for a factor.
    pub value: f64,
    /// ∂C_o/∂p, the output's compliance.
    pub compliance: Matrix6<f64>,
    /// ∂K_o/∂p, the output's stiffness; `None` where it has none.
    pub stiffness: Option<Matrix6<f64>>,
    /// ∂u/∂p, the output's displacement: weight and free strains change with the parameter, other
    /// loads stay as they are. `None` where the change of weight would work on an idle motion:
    /// with any more of the parameter the mechanism is in balance no longer.
    pub displacement: Option<Vector6<f64>>,
}

impl Sensitivity {
    /// The relative change of the displacement along a unit wrench per relative change of the
    /// parameter, p/u ∂u/∂p: −4 says that 1 % more of it makes the displacement 4 % smaller.
    /// `None` where there is no displacement, or no derivative of it.
    pub fn relative(&self, displacement: &Vector6<f64>, along: &Vector6<f64>) -> Option<f64> {
        let own = displacement.dot(along);
        let change = self.displacement?.dot(along);
        let rounding = ROUNDING * displacement.component_mul(along).abs().sum();
        (own.abs() > rounding).then(|| change * self.value / own)
    }

    /// The relative change of the compliance along a unit wrench per relative change of the
    /// parameter. `None` where there is no compliance.
    pub fn relative_compliance(
        &self,
        compliance: &Matrix6<f64>,
        along: &Vector6<f64>,
    ) -> Option<f64> {
        let own = compliance_along(compliance, along);
        let change = compliance_along(&self.compliance, along);
        (own != 0.0).then(|| change * self.value / own)
    }
}

impl Influence<'_> {
    /// Sensitivities of a solution of this model to every parameter that its stiffness or what acts
    /// on it depends on: those of bodies first, then of joints, then of masses.
    ///
    /// # Errors
    /// A segment that cannot be formed, which none of a solved model is.
    pub fn sensitivities(&self, solution: &Solution) -> Result<Vec<Sensitivity>, SolveError> {
        let loaded = self.state(solution);
        let mut found = Vec::new();
        let parameters = parameters(self.model)?;
        let sums = self.by_stiffness(&parameters, &loaded);
        for (varied, sum) in parameters.into_iter().zip(sums) {
            let loads = self.load_change(&varied)?;
            if !varied.parameter.is_elastic() && loads.is_none() {
                continue;
            }
            let displacement = match loads {
                Some(loads) if self.unbalances(&loads, &solution.idle) => None,
                Some(loads) => Some(sum.displacement + self.moved_by(&loads)),
                None => Some(sum.displacement),
            };
            let stiffness = solution.output.stiffness;
            found.push(Sensitivity {
                parameter: varied.parameter,
                name: varied.name,
                value: varied.value,
                compliance: sum.compliance,
                stiffness: stiffness.map(|k| -(k * sum.compliance * k)),
                displacement,
            });
        }
        Ok(found)
    }

    /// What each of the parameters does by the stiffness of its segments and joints.
    fn by_stiffness(&self, parameters: &[Varied], loaded: &UnitState) -> Vec<Derivative> {
        let mut sums: Vec<Derivative> = Vec::new();
        sums.resize_with(parameters.len(), Derivative::default);
        // A segment's states serve all the parameters that change it: their segments are ascending.
        let mut left: Vec<_> = parameters.iter().map(|own| &own.segments[..]).collect();
        let mut sampled = SampledStates::default();
        for (k, beam) in self.beams.iter().enumerate() {
            let id = SegmentId(k);
            sampled.forget();
            for (k, varied) in parameters.iter().enumerate() {
                let Some(((own, change), rest)) = left[k].split_first() else {
                    continue;
                };
                if *own != id {
                    continue;
                }
                left[k] = rest;
                if !varied.parameter.is_elastic() {
                    continue;
                }
                if sampled.is_empty() {
                    let states = self.units.iter().chain([loaded]);
                    let states = states.map(|state| (&state.ends[id.0], state.load(id)));
                    sampled.sample(beam.beam.straight(), states);
                }
                sampled.weigh(|xi| -change.rigidities(xi));
                sums[k].add(|unit, state| sampled.work(unit, state).sum());
            }
        }
        for (varied, sum) in parameters.iter().zip(&mut sums) {
            self.add_joints(sum, varied, loaded);
        }
        sums
    }

    /// Adds what a parameter does by the stiffness of its joints.
    fn add_joints(&self, sum: &mut Derivative, varied: &Varied, loaded: &UnitState) {
        let Parameter::Joint { direction, joints } = &varied.parameter else {
            return;
        };
        let state = |k: usize| self.units.get(k).unwrap_or(loaded);
        for joint in joints {
            // q = f/k along every direction: ∂(f_aᵀ C f_b)/∂k = −f_a q_b / k.
            sum.add(|a, b| {
                let [force, _] = &state(a).joints[joint.0];
                let [_, deflection] = &state(b).joints[joint.0];
                let work = force.component_mul(deflection);
                -direction.map_or(work.sum(), |dof| work[dof.index()]) / varied.value
            });
        }
    }
}

/// Sums of work over the parts that a parameter is of.
#[derive(Default)]
struct Derivative {
    compliance: Matrix6<f64>,
    displacement: Vector6<f64>,
}

impl Derivative {
    /// Adds a part, given the work of the forces in a state on the change of deformation in another,
    /// by number: those of unit wrenches, then the loaded one.
    fn add(&mut self, work: impl Fn(usize, usize) -> f64) {
        for a in 0..6 {
            self.displacement[a] += work(a, 6);
            for b in 0..=a {
                let entry = work(a, b);
                self.compliance[(a, b)] += entry;
                if a != b {
                    self.compliance[(b, a)] += entry;
                }
            }
        }
    }
}
