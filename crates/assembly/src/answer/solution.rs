//! What a solve gives.

use std::fmt;

use hyperstat_elements::BeamLoad;
use hyperstat_model::{JointId, Model, SegmentId};
use nalgebra::{Matrix6, Rotation3, Vector6};

use super::curve::inner_displacements;
use crate::error::SolveError;
use crate::kinematics::motion::Motion;
use crate::state::floor::Floor;

/// Everything about one configuration under the model's loads.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Solution {
    /// Number of independent displacement coordinates, after loop elimination, idle motions included.
    pub unknowns: usize,
    /// Instantaneous mobility: every body rigid, every direction that is free by its joint's kind released.
    pub mobility: usize,
    /// Constraints less their rank, every body rigid.
    pub overconstraint: usize,
    /// Motions without energy that leave the output where it is, drives locked.
    pub idle: Vec<Motion>,
    /// The output's stiffness, compliance and displacement.
    pub output: Output,
    /// Displacement of every node, the body's own (inside an absorbed joint), by `NodeId`, global axes.
    pub displacements: Vec<Vector6<f64>>,
    /// Wrench on the second body of every joint, at the joint, in the joint frame, by `JointId`;
    /// `None` where redundant rigid constraints leave it undetermined.
    pub joint_wrenches: Vec<Option<Vector6<f64>>>,
    /// End forces of every segment, by `SegmentId`.
    pub segments: Vec<SegmentForces>,
    /// What acts: the floor that the displacements and forces are measured by. What is rounding
    /// beside it is zero.
    pub floor: Floor,
    /// The model's cases, in their order.
    pub cases: Vec<CaseSolution>,
    /// What the user should know about the numbers.
    pub warnings: Vec<Warning>,
}

/// A case of a model and what it does.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct CaseSolution {
    /// Name of the case.
    pub name: String,
    /// What it does.
    pub state: State,
}

/// What loads that act together do.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct State {
    /// Displacement of the output, global axes; up to its free motions where it has any.
    pub output: Vector6<f64>,
    /// As [`Solution::displacements`].
    pub displacements: Vec<Vector6<f64>>,
    /// As [`Solution::joint_wrenches`].
    pub joint_wrenches: Vec<Option<Vector6<f64>>>,
    /// As [`Solution::segments`].
    pub segments: Vec<SegmentForces>,
    /// As [`Solution::floor`].
    pub floor: Floor,
}

impl State {
    pub(crate) fn is_finite(&self) -> bool {
        let ends = self.segments.iter().flat_map(|segment| &segment.ends);
        let vectors = self.displacements.iter().chain([&self.output]).chain(ends);
        let vectors = vectors.chain(self.joint_wrenches.iter().flatten());
        vectors.flatten().all(|number| number.is_finite())
    }

    /// As [`Solution::inner_displacements`].
    ///
    /// # Errors
    /// As there.
    pub fn inner_displacements(
        &self,
        model: &Model,
        segment: SegmentId,
    ) -> Result<Vec<Vector6<f64>>, SolveError> {
        let forces = self.segments.get(segment.0);
        let load = &forces.ok_or(SolveError::ForeignModel)?.load;
        inner_displacements(model, model.geometry(), &self.displacements, segment, load)
    }
}

impl Output {
    pub(crate) fn is_finite(&self) -> bool {
        let matrices = self.stiffness.iter().chain(&self.compliance).flatten();
        let vectors = self.rigid_directions.iter().chain(&self.free_motions);
        let vectors = vectors.chain([&self.displacement]).flatten();
        matrices.chain(vectors).all(|number| number.is_finite())
    }
}

impl Solution {
    /// Joints whose wrench redundant rigid constraints leave undetermined.
    pub fn undetermined(&self) -> Vec<JointId> {
        let none = |(k, w): (usize, &Option<_>)| w.is_none().then_some(JointId(k));
        self.joint_wrenches
            .iter()
            .enumerate()
            .filter_map(none)
            .collect()
    }

    /// The solution under the loads of a case in place of the model's own: the same in all that no
    /// load changes. `None` where there is no case of this name.
    pub fn of_case(&self, name: &str) -> Option<Self> {
        let case = self.cases.iter().find(|case| case.name == name)?;
        let State {
            output,
            displacements,
            joint_wrenches,
            segments,
            floor,
        } = case.state.clone();
        let mut solution = Self {
            displacements,
            joint_wrenches,
            segments,
            floor,
            ..self.clone()
        };
        solution.output.displacement = output;
        Some(solution)
    }

    /// Displacements of the inner nodes of a segment divided into n elements: node k of 1 to
    /// n − 1 lies at k/n of the way from its first node to its second. Six components each, global
    /// axes (m, rad). They are exact, loads along the segment included; time grows with n alone.
    ///
    /// `model` is the one that was solved.
    ///
    /// # Errors
    /// A segment that cannot be formed, which no segment of a solved model is.
    pub fn inner_displacements(
        &self,
        model: &Model,
        segment: SegmentId,
    ) -> Result<Vec<Vector6<f64>>, SolveError> {
        let forces = self.segments.get(segment.0);
        let load = &forces.ok_or(SolveError::ForeignModel)?.load;
        inner_displacements(model, model.geometry(), &self.displacements, segment, load)
    }
}

/// The output node: 6×6 matrices and vectors in global axes, at the node, linear part first.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Output {
    /// Stiffness K_o (Eq. 45); `None` where the output is held rigidly in some direction.
    pub stiffness: Option<Matrix6<f64>>,
    /// Compliance K_o⁻¹; `None` where the output has a free motion.
    pub compliance: Option<Matrix6<f64>>,
    /// Displacement under the loads.
    pub displacement: Vector6<f64>,
    /// Twists of the output that rigid constraints forbid (an orthonormal basis of them).
    pub rigid_directions: Vec<Vector6<f64>>,
    /// Twists of the output that need no energy, drives locked.
    pub free_motions: Vec<Vector6<f64>>,
}

/// Forces at the ends of a segment.
#[derive(Debug, Clone, PartialEq)]
pub struct SegmentForces {
    /// Element frame: columns are local x, y, z in global axes.
    pub frame: Rotation3<f64>,
    /// Length (m).
    pub length: f64,
    /// Wrench on the segment at its first and second node, in the element frame.
    pub ends: [Vector6<f64>; 2],
    /// What acts between them, in the element frame: distributed loads, weight, temperature.
    pub load: BeamLoad,
}

/// A remark on the numbers of a solution.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// Mobility and over-constraint may be those of a neighbouring geometry.
    NearSingular {
        /// The pivot of the rigid mechanism's conditions that lies between zero (below 1e-12)
        /// and not zero (above 1e-4).
        value: f64,
        /// The motion that this condition only nearly prevents, in words, where it is one of the
        /// held mechanism's.
        motion: Option<String>,
    },
    /// Digits are lost.
    LostDigits {
        /// How far results may be off: stiffness and compliance by √(K_ii K_jj), displacements by
        /// the largest of their kind. An estimate on the safe side.
        error: f64,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NearSingular { value, motion } => {
                write!(
                    f,
                    "the mechanism is nearly singular or its coordinates are rounded: a condition \
                     of relative size {value:.1e} lies between zero (below 1e-12) and not zero \
                     (above 1e-4), so mobility and over-constraint may be those of a neighbouring \
                     geometry"
                )?;
                match motion {
                    Some(motion) => write!(f, "; what it nearly leaves free: {motion}"),
                    None => Ok(()),
                }
            }
            Self::LostDigits { error } if error.is_nan() || *error >= 1.0 => f.write_str(
                "parts of very different stiffness: no digit of the results is right, by an estimate",
            ),
            Self::LostDigits { error } => write!(
                f,
                "parts of very different stiffness: results are good to {} only, by an estimate",
                one_digit_up(*error)
            ),
        }
    }
}

/// A number to one digit, rounded up: what is stated is on the safe side.
fn one_digit_up(value: f64) -> String {
    let down = format!("{value:.0e}");
    match down.parse::<f64>() {
        Ok(rounded) if rounded < value => {
            let unit = 10.0_f64.powf(value.log10().floor());
            format!("{:.0e}", rounded + unit)
        }
        _ => down,
    }
}

#[cfg(test)]
mod tests {
    use super::{Warning, one_digit_up};

    #[test]
    fn without_a_digit_no_size_is_stated() {
        for error in [1.0, 35.0, f64::INFINITY, f64::NAN] {
            let told = Warning::LostDigits { error }.to_string();
            assert!(told.contains("no digit of the results is right"), "{told}");
        }
        let told = Warning::LostDigits { error: 0.3 }.to_string();
        assert!(told.contains("good to 3e-1 only"), "{told}");
    }

    #[test]
    fn what_is_stated_is_never_less() {
        for (value, text) in [
            (4.0e-9, "4e-9"),
            (4.1e-9, "5e-9"),
            (3.9e-9, "4e-9"),
            (9.6e-7, "1e-6"),
            (9.4e-7, "1e-6"),
            (1.0e-10, "1e-10"),
        ] {
            assert_eq!(one_digit_up(value), text);
        }
    }
}
