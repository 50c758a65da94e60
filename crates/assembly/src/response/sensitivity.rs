//! Derivatives of the output's compliance, stiffness and displacement by every dimension of a
//! section, constant of a material, stiffness of a joint and mass.
//!
//! With W_a the section wrenches under a unit of component a on the output, and c the section's
//! compliances, `∂C_o[a, b]/∂p = Σ ∫ W_aᵀ (∂c/∂p) W_b dx`; `f_aᵀ (∂C_j/∂p) f_b` for a joint:
//! what the change of the internal forces does, does no work on a deformation that fits together.
//! Then `∂K_o = −K_o ∂C_o K_o`. The displacement has W under the loads for W_b, and the part of
//! weight and temperature that change with the parameter ([`crate::load_change`]).

use nalgebra::{Matrix6, Vector6};

use super::influence::{Influence, State};
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
        for varied in parameters(self.model)? {
            let loads = self.load_change(&varied)?;
            let elastic = match &varied.parameter {
                Parameter::Mass { .. } => false,
                Parameter::Material { constant, .. } => {
                    !matches!(*constant, "density" | "expansion")
                }
                _ => true,
            };
            if !elastic && loads.is_none() {
                continue;
            }
            let mut sum = Derivative::default();
            if elastic {
                self.add_stiffness(&mut sum, &varied, &loaded);
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

    /// Adds what a parameter does by the stiffness of its segments and joints.
    fn add_stiffness(&self, sum: &mut Derivative, varied: &Varied, loaded: &State) {
        for (segment, change) in &varied.segments {
            let weight = |xi| -change.rigidities(xi);
            sum.add(&self.units, loaded, |unit, state| {
                self.segment_work(*segment, state, unit, &weight).sum()
            });
        }
        let Parameter::Joint { direction, joints } = &varied.parameter else {
            return;
        };
        for joint in joints {
            // q = f/k along every direction: ∂(f_aᵀ C f_b)/∂k = −f_a q_b / k.
            sum.add(&self.units, loaded, |unit, state| {
                let work = unit.joints[joint.0][0].component_mul(&state.joints[joint.0][1]);
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
    /// Adds a part, given the work of a first state's forces on a second's change of deformation.
    fn add(&mut self, units: &[State; 6], loaded: &State, work: impl Fn(&State, &State) -> f64) {
        for (a, unit) in units.iter().enumerate() {
            self.displacement[a] += work(unit, loaded);
            for (b, other) in units.iter().enumerate().take(a + 1) {
                let entry = work(unit, other);
                self.compliance[(a, b)] += entry;
                if a != b {
                    self.compliance[(b, a)] += entry;
                }
            }
        }
    }
}
