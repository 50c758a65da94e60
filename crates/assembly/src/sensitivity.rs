//! Derivatives of the output's compliance, stiffness and displacement by every dimension of a
//! section, constant of a material and stiffness of a joint.
//!
//! With W_a the section wrenches under a unit of component a on the output, and c the section's
//! compliances, `∂C_o[a, b]/∂p = Σ ∫ W_aᵀ (∂c/∂p) W_b dx`; `f_aᵀ (∂C_j/∂p) f_b` for a joint:
//! what the change of the internal forces does, does no work on a deformation that fits together.
//! Then `∂K_o = −K_o ∂C_o K_o`.

use hyperstat_elements::{Material, Section};
use hyperstat_joints::Dof;
use nalgebra::{Matrix6, Vector6};

use crate::error::SolveError;
use crate::influence::{Influence, State};
use crate::measures::compliance_along;
use crate::model::{BodyId, JointId, JointStiffness, SegmentId};
use crate::solution::Solution;

/// How the output answers to one parameter of the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// The parameter p.
    pub parameter: Parameter,
    /// Its value; 1 for the factor of a whole stiffness matrix.
    pub value: f64,
    /// ∂C_o/∂p, the output's compliance.
    pub compliance: Matrix6<f64>,
    /// ∂K_o/∂p, the output's stiffness; `None` where it has none.
    pub stiffness: Option<Matrix6<f64>>,
    /// ∂u/∂p, the output's displacement under loads that stay as they are (weights too).
    pub displacement: Vector6<f64>,
}

/// A parameter. Equal sections, materials and elastic joints count as one: it changes all of them.
#[derive(Debug, Clone, PartialEq)]
pub enum Parameter {
    /// A dimension of a section.
    Section {
        /// The section.
        section: Section,
        /// Whether it is the one at the second end of segments that taper.
        second: bool,
        /// Name of the dimension, as in files.
        dimension: &'static str,
        /// Bodies that have the section.
        bodies: Vec<BodyId>,
    },
    /// A constant of a material.
    Material {
        /// The material.
        material: Material,
        /// Name of the constant, as in files; the other one stays as it is.
        constant: &'static str,
        /// Bodies that are of the material.
        bodies: Vec<BodyId>,
    },
    /// A stiffness of joints.
    Joint {
        /// The direction; `None`: a factor on the whole of a stiffness matrix.
        direction: Option<Dof>,
        /// Joints of one kind with the same stiffness.
        joints: Vec<JointId>,
    },
}

impl Sensitivity {
    /// The relative change of the displacement along a unit wrench per relative change of the
    /// parameter, p/u ∂u/∂p: −4 says that 1 % more of it makes the displacement 4 % smaller.
    /// `None` where there is no displacement.
    pub fn relative(&self, displacement: &Vector6<f64>, along: &Vector6<f64>) -> Option<f64> {
        let own = displacement.dot(along);
        (own != 0.0).then(|| self.displacement.dot(along) * self.value / own)
    }
}

impl Sensitivity {
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
    /// Sensitivities of a solution of this model, to every parameter that its stiffness depends on,
    /// in the order of bodies and joints.
    ///
    /// # Errors
    /// A section so near the limits of its kind that its dimension cannot be varied.
    pub fn sensitivities(&self, solution: &Solution) -> Result<Vec<Sensitivity>, SolveError> {
        let loaded = self.state(solution);
        let mut found = Vec::new();
        self.of_sections(&loaded, &mut found)?;
        self.of_materials(&loaded, &mut found);
        self.of_joints(&loaded, &mut found);
        for sensitivity in &mut found {
            let stiffness = solution.output.stiffness;
            sensitivity.stiffness = stiffness.map(|k| -(k * sensitivity.compliance * k));
        }
        Ok(found)
    }

    fn of_sections(&self, loaded: &State, found: &mut Vec<Sensitivity>) -> Result<(), SolveError> {
        let segments = self.model.segments();
        for second in [false, true] {
            let section = |k: usize| {
                if second {
                    segments[k].taper.as_ref()
                } else {
                    Some(&segments[k].section)
                }
            };
            // A section of a segment that tapers is another parameter than the same one all along.
            let key = |k: usize| section(k).map(|s| (s, segments[k].taper.is_some()));
            for group in groups(segments.len(), |a, b| key(a) == key(b)) {
                let Some(own) = section(group[0]) else {
                    continue;
                };
                for (dimension, value) in own.dimensions() {
                    let mut sum = Derivative::default();
                    for &k in &group {
                        let taper = segments[k].change_of_section()?;
                        if let Some(taper) = &taper {
                            // Any change that a place refuses, the ends refuse.
                            taper.logarithmic_derivative(second, dimension, 0.5)?;
                        }
                        let constant = own.logarithmic_derivative(dimension);
                        self.add_segment(&mut sum, SegmentId(k), loaded, &|xi| match &taper {
                            None => -constant,
                            Some(taper) => -(taper.logarithmic_derivative(second, dimension, xi))
                                .unwrap_or_default(),
                        });
                    }
                    let parameter = Parameter::Section {
                        section: own.clone(),
                        second,
                        dimension,
                        bodies: self.bodies(&group),
                    };
                    found.push(sum.of(parameter, value));
                }
            }
        }
        Ok(())
    }

    fn of_materials(&self, loaded: &State, found: &mut Vec<Sensitivity>) {
        let segments = self.model.segments();
        let same = |a: usize, b: usize| {
            let [a, b] = [a, b].map(|k| &segments[k].material);
            a.constants() == b.constants()
        };
        for group in groups(segments.len(), same) {
            let material = &segments[group[0]].material;
            for (constant, value) in material.constants() {
                let mut sum = Derivative::default();
                let weight = -material.logarithmic_derivative(constant);
                for &k in &group {
                    self.add_segment(&mut sum, SegmentId(k), loaded, &|_| weight);
                }
                let parameter = Parameter::Material {
                    material: material.clone(),
                    constant,
                    bodies: self.bodies(&group),
                };
                found.push(sum.of(parameter, value));
            }
        }
    }

    fn of_joints(&self, loaded: &State, found: &mut Vec<Sensitivity>) {
        let joints = self.model.joints();
        let same = |a: usize, b: usize| {
            let elastic = |k: usize| self.joints[k].elastic();
            joints[a].stiffness == joints[b].stiffness
                && joints[a].joint.kind() == joints[b].joint.kind()
                && joints[a].joint.basis() == joints[b].joint.basis()
                && joints[a].joint.compliance() == joints[b].joint.compliance()
                && elastic(a) == elastic(b)
        };
        for group in groups(joints.len(), same) {
            let joint = &joints[group[0]];
            let given = match &joint.stiffness {
                JointStiffness::Directions(values) => *values,
                JointStiffness::Matrix(_) => [None; 6],
            };
            let by_direction = given.iter().any(Option::is_some);
            let ids: Vec<JointId> = group.iter().map(|k| JointId(*k)).collect();
            let elastic = self.joints[group[0]].elastic();
            if elastic.is_empty() {
                continue;
            }
            let parameters = match by_direction {
                true => elastic
                    .iter()
                    .map(|dof| (Some(dof), given[dof.index()]))
                    .collect(),
                false => vec![(None, Some(1.0))],
            };
            for (direction, value) in parameters {
                let Some(value) = value else { continue };
                let mut sum = Derivative::default();
                for &k in &group {
                    // q = f/k along every direction: ∂(f_aᵀ C f_b)/∂k = −f_a q_b / k.
                    let work = |a: &State, b: &State| {
                        let work = a.joints[k][0].component_mul(&b.joints[k][1]);
                        -direction.map_or(work.sum(), |dof| work[dof.index()]) / value
                    };
                    sum.add(&self.units, loaded, work);
                }
                let parameter = Parameter::Joint {
                    direction,
                    joints: ids.clone(),
                };
                found.push(sum.of(parameter, value));
            }
        }
    }

    fn add_segment(
        &self,
        sum: &mut Derivative,
        segment: SegmentId,
        loaded: &State,
        weight: &dyn Fn(f64) -> Vector6<f64>,
    ) {
        sum.add(&self.units, loaded, |unit, state| {
            self.segment_work(segment, state, unit, weight).sum()
        });
    }

    /// Bodies that these segments are of.
    fn bodies(&self, segments: &[usize]) -> Vec<BodyId> {
        let mut bodies: Vec<_> = (segments.iter())
            .map(|k| self.model.segments()[*k].body)
            .collect();
        bodies.dedup();
        bodies
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

    fn of(self, parameter: Parameter, value: f64) -> Sensitivity {
        Sensitivity {
            parameter,
            value,
            compliance: self.compliance,
            stiffness: None,
            displacement: self.displacement,
        }
    }
}

/// The numbers below `count` in groups of those that are the same, in the order of their firsts.
fn groups(count: usize, same: impl Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for k in 0..count {
        match groups.iter_mut().find(|group| same(group[0], k)) {
            Some(group) => group.push(k),
            None => groups.push(vec![k]),
        }
    }
    groups
}
