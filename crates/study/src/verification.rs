//! A solution beside that of the independent solver (`solve --verify`).

use hyperstat_assembly::{BodyId, Configuration, Floor, Model, Solution};
use hyperstat_reference::ReferenceSolution;
use nalgebra::{Matrix6, Vector6};
use serde::Serialize;

use crate::entries::Entries;

/// Two solutions that agree this well are equal for every use of them.
const AGREEMENT: f64 = 1e-8;

/// The largest differences between a solution and the independent solver's. Field names are those
/// of the JSON output.
#[derive(Debug, Serialize)]
pub struct Verification {
    /// Largest |ΔK_ij| / √(K_ii K_jj) of the output's stiffness; `None` where it has none.
    pub stiffness: Option<f64>,
    /// The same of its compliance; `None` where it has none.
    pub compliance: Option<f64>,
    /// Under the model's own loads.
    #[serde(flatten)]
    pub state: StateDifferences,
    /// In its cases.
    #[serde(skip_serializing_if = "Entries::is_empty")]
    pub cases: Entries<StateDifferences>,
    /// What only one of the two solvers finds, or both find differently.
    pub disagreements: Vec<String>,
}

/// The largest differences between two solutions in one state.
#[derive(Debug, Serialize)]
pub struct StateDifferences {
    /// Of the displacements of all nodes, without those of bodies that move freely: over the
    /// largest, rotations times the mechanism's size.
    pub displacements: f64,
    /// Of the joint wrenches that are determined: over the largest, forces times the size.
    pub joint_wrenches: f64,
}

impl Verification {
    /// Compares `solution` with `reference`, both of this configuration.
    pub fn new(
        here: &Configuration<'_>,
        solution: &Solution,
        reference: &ReferenceSolution,
    ) -> Self {
        let model = here.model();
        let moving = bodies_that_move(here);
        let nodes = model.nodes().iter();
        let held: Vec<bool> = nodes.map(|node| !moving.contains(&node.body)).collect();
        let floor = &solution.floor;
        let output = &solution.output;
        let stiffness = output.stiffness.zip(reference.stiffness);
        let compliance = output.compliance.zip(reference.compliance);
        let cases = solution.cases.iter().zip(&reference.cases);
        Self {
            stiffness: stiffness.map(|(found, expected)| {
                matrix_difference(&found, &expected, floor.stiffness_scales(&expected))
            }),
            compliance: compliance.map(|(found, expected)| {
                matrix_difference(&found, &expected, floor.compliance_scales(&expected))
            }),
            state: StateDifferences::new(
                floor,
                &held,
                [&solution.displacements, &reference.displacements],
                [&solution.joint_wrenches, &reference.joint_wrenches],
            ),
            cases: cases
                .map(|(case, reference)| {
                    let differences = StateDifferences::new(
                        &case.state.floor,
                        &held,
                        [&case.state.displacements, &reference.displacements],
                        [&case.state.joint_wrenches, &reference.joint_wrenches],
                    );
                    (case.name.clone(), differences)
                })
                .collect(),
            disagreements: disagreements(model, solution, reference),
        }
    }

    /// Each difference with what it is of.
    pub fn differences(&self) -> Vec<(String, f64)> {
        let output = [
            ("output stiffness", self.stiffness),
            ("output compliance", self.compliance),
        ];
        let output = output.into_iter();
        let mut all: Vec<_> = output
            .filter_map(|(name, difference)| Some((name.into(), difference?)))
            .collect();
        let cases = self.cases.iter();
        let cases = cases.map(|(name, state)| (format!(" in case `{name}`"), state));
        for (of, state) in std::iter::once((String::new(), &self.state)).chain(cases) {
            all.push((format!("displacements{of}"), state.displacements));
            all.push((format!("joint wrenches{of}"), state.joint_wrenches));
        }
        all
    }

    /// What the two solvers do not agree on, in words.
    pub fn warnings(&self) -> Vec<String> {
        let far = self.differences().into_iter();
        far.filter(|(_, d)| *d > AGREEMENT || d.is_nan())
            .map(|(name, difference)| {
                format!("the independent solver's {name} differ by {difference:.1e}")
            })
            .chain(self.disagreements.iter().cloned())
            .collect()
    }
}

impl StateDifferences {
    /// Of displacements and wrenches, found and expected, by what acts where all are smaller;
    /// displacements of the nodes that are `held`.
    fn new(
        floor: &Floor,
        held: &[bool],
        [found, expected]: [&[Vector6<f64>]; 2],
        [wrenches, expected_wrenches]: [&[Option<Vector6<f64>>]; 2],
    ) -> Self {
        let pairs = found.iter().zip(expected).zip(held);
        let held = pairs.filter(|(_, held)| **held).map(|(pair, _)| pair);
        let wrenches = wrenches.iter().zip(expected_wrenches);
        let determined =
            wrenches.filter_map(|(found, expected)| found.as_ref().zip(expected.as_ref()));
        let displacement = |u: &Vector6<f64>| floor.as_displacement(u);
        let force = |wrench: &Vector6<f64>| floor.as_force(wrench);
        Self {
            displacements: vector_difference(held, displacement, floor.least_displacement()),
            joint_wrenches: vector_difference(determined, force, floor.least_force()),
        }
    }
}

fn disagreements(model: &Model, solution: &Solution, reference: &ReferenceSolution) -> Vec<String> {
    let counts = [
        ("mobility", solution.mobility, reference.mobility),
        (
            "over-constraint",
            solution.overconstraint,
            reference.overconstraint,
        ),
        ("idle motions", solution.idle.len(), reference.idle_modes),
    ];
    let counts = counts
        .into_iter()
        .filter(|(_, found, expected)| found != expected)
        .map(|(name, found, expected)| {
            format!("{name}: {found} here, {expected} by the independent solver")
        });
    let output = [
        (
            "output stiffness",
            solution.output.stiffness.is_some(),
            reference.stiffness.is_some(),
        ),
        (
            "output compliance",
            solution.output.compliance.is_some(),
            reference.compliance.is_some(),
        ),
    ];
    let output = output.map(|(name, found, expected)| (name.to_string(), found, expected));
    let wrenches = model
        .joints()
        .iter()
        .zip(&solution.joint_wrenches)
        .zip(&reference.joint_wrenches)
        .map(|((joint, found), expected)| {
            let name = format!("wrench of joint `{}`", joint.name);
            (name, found.is_some(), expected.is_some())
        });
    let presence = output
        .into_iter()
        .chain(wrenches)
        .filter(|(_, found, expected)| found != expected)
        .map(|(name, found, _)| match found {
            true => format!("{name}: found here, not by the independent solver"),
            false => format!("{name}: not found here, but by the independent solver"),
        });
    counts.chain(presence).collect()
}

/// Bodies that move without energy, drives locked: their displacements are not defined.
fn bodies_that_move(here: &Configuration<'_>) -> Vec<BodyId> {
    let motions = here.kinematics().map_or(&[][..], |k| &k.motions);
    let twists = motions.iter().flat_map(|motion| &motion.twists);
    twists.map(|(body, _)| *body).collect()
}

/// Largest |Δ_ij| / √(s_i s_j).
fn matrix_difference(found: &Matrix6<f64>, expected: &Matrix6<f64>, scales: [f64; 6]) -> f64 {
    let differences = (0..36).map(|entry| {
        let (r, c) = (entry / 6, entry % 6);
        ratio(
            (found[(r, c)] - expected[(r, c)]).abs(),
            (scales[r] * scales[c]).sqrt(),
        )
    });
    largest(differences)
}

/// Largest difference over the largest expected vector, by `size`; over `least` where all of these
/// are smaller.
fn vector_difference<'a>(
    pairs: impl Iterator<Item = (&'a Vector6<f64>, &'a Vector6<f64>)> + Clone,
    size: impl Fn(&Vector6<f64>) -> f64,
    least: f64,
) -> f64 {
    let apart = pairs.clone().map(|(found, expected)| found - expected);
    let difference = largest(apart.map(|apart| size_of(&apart, &size)));
    let expected = pairs.map(|(_, expected)| size_of(expected, &size));
    ratio(difference, largest(expected.chain([least])))
}

/// The size of a vector; NaN where a component is.
fn size_of(vector: &Vector6<f64>, size: impl Fn(&Vector6<f64>) -> f64) -> f64 {
    if vector.iter().any(|component| component.is_nan()) {
        f64::NAN
    } else {
        size(vector)
    }
}

/// `difference / scale`, and 0 for no difference from nothing.
fn ratio(difference: f64, scale: f64) -> f64 {
    if difference == 0.0 {
        0.0
    } else {
        difference / scale
    }
}

/// The largest of numbers of which none is negative; NaN where one of them is.
fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(0.0, |largest, number| {
        if number > largest || number.is_nan() {
            number
        } else {
            largest
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Forces count as they are, moments over a length.
    fn by(length: f64) -> impl Fn(&Vector6<f64>) -> f64 {
        move |v| {
            (0..6).fold(0.0, |m: f64, k| {
                m.max(v[k].abs() / if k < 3 { 1.0 } else { length })
            })
        }
    }

    #[test]
    fn a_difference_is_taken_on_the_scale_of_its_row_and_column() {
        let scales = [1e8, 1e8, 1e4, 1e5, 1e5, 10.0];
        let stiff = Matrix6::from_diagonal(&Vector6::from(scales));
        let mut found = stiff;
        found[(2, 5)] += 1.0;
        let expected = 1.0 / (1e4_f64 * 10.0).sqrt();
        assert_eq!(matrix_difference(&found, &stiff, scales), expected);
        assert_eq!(matrix_difference(&stiff, &stiff, scales), 0.0);
    }

    #[test]
    fn a_number_that_is_none_is_seen() {
        let zero = Vector6::zeros();
        let nan = Vector6::repeat(f64::NAN);
        let one = Vector6::repeat(1.0);
        let none = vector_difference([(&zero, &zero)].into_iter(), by(1.0), 0.0);
        assert_eq!(none, 0.0);
        let pairs = [(&nan, &one), (&one, &one)];
        assert!(vector_difference(pairs.into_iter(), by(1.0), 1.0).is_nan());
        let verification = Verification {
            stiffness: Some(f64::NAN),
            compliance: None,
            state: StateDifferences {
                displacements: 1e-9,
                joint_wrenches: 2e-8,
            },
            cases: Entries::from_iter([(
                "push".to_string(),
                StateDifferences {
                    displacements: 1e-7,
                    joint_wrenches: 1e-9,
                },
            )]),
            disagreements: vec!["mobility".into()],
        };
        let warnings = verification.warnings();
        assert_eq!(warnings.len(), 4);
        assert_eq!(
            warnings[2],
            "the independent solver's displacements in case `push` differ by 1.0e-7"
        );
    }

    #[test]
    fn what_acts_is_the_floor() {
        let expected = Vector6::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        let found = Vector6::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.01);
        let pair = [(&found, &expected)];
        assert_eq!(vector_difference(pair.into_iter(), by(0.5), 0.5), 0.02);
        assert_eq!(vector_difference(pair.into_iter(), by(0.5), 4.0), 0.005);
    }
}
