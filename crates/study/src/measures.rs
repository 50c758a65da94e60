//! Measures of the output's stiffness and displacement, each name with its one definition: those that
//! summaries count, and those that figures find from a table.

use std::cell::OnceCell;

use hyperstat_assembly::Probe;
use hyperstat_assembly::measures::principal;
use nalgebra::{Cholesky, Matrix3, Matrix6, Vector6};

/// A measure of one pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measure {
    /// Its name.
    pub name: &'static str,
    /// What it is.
    pub words: &'static str,
    /// The same in a table.
    pub(crate) short: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    pub(crate) rule: Rule,
}

impl Measure {
    /// All measures there are.
    pub fn all() -> &'static [Self] {
        &MEASURES
    }

    /// The measure of this name, such as `deflection` or `softest_force`.
    pub fn named(name: &str) -> Option<&'static Self> {
        named(name)
    }

    /// Its value of an output with this stiffness \[N/m, N/rad; N, N·m/rad\], by rows, and displacement
    /// \[m, rad\]; `None` where it has none.
    pub fn at(&self, stiffness: &[f64; 36], displacement: &[f64; 6]) -> Option<f64> {
        let pose = Pose::new(&Matrix6::from_row_slice(stiffness));
        pose.measure(self.rule, &Vector6::from_row_slice(displacement))
    }
}

/// How a measure is found. A block is that of translations, 0, or of rotations, 3.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Rule {
    /// Length of the displacement's block.
    Length(usize),
    /// An entry of the compliance's diagonal.
    Compliance(usize),
    /// Its inverse.
    InverseCompliance(usize),
    /// The largest eigenvalue of a block of the compliance.
    Softest(usize),
    /// What is not loaded goes where it likes: a force, or a moment, acts alone. Inverse of the largest
    /// (least stiffness) or least eigenvalue of a block of the compliance.
    Free { block: usize, least: bool },
    /// What is not moved stays: a translation, or a rotation, is made alone. Least or largest
    /// eigenvalue of a block of the stiffness.
    Held { block: usize, least: bool },
    /// Work of a unit force, mean over its directions: a third of the trace of the compliance's block.
    Work,
}

impl Rule {
    /// Whether it is of the displacement, which every case has its own of.
    pub(crate) fn is_of_loads(self) -> bool {
        matches!(self, Self::Length(_))
    }

    /// The measure, where it needs nothing but the displacement.
    pub(crate) fn of_displacement(self, displacement: &Vector6<f64>) -> Option<f64> {
        match self {
            Self::Length(block) => Some(displacement.fixed_rows::<3>(block).norm()),
            _ => None,
        }
    }
}

/// What measures are found from; what several of them share is worked out once.
#[derive(Debug)]
pub(crate) struct Pose {
    stiffness: Matrix6<f64>,
    /// None of a stiffness that is not positive definite.
    compliance: OnceCell<Option<Matrix6<f64>>>,
    /// Of the blocks of the compliance, then of the stiffness: translations, rotations.
    eigenvalues: [OnceCell<[f64; 3]>; 4],
}

impl Pose {
    /// Of a stiffness.
    pub(crate) fn new(stiffness: &Matrix6<f64>) -> Self {
        Self {
            stiffness: *stiffness,
            compliance: OnceCell::new(),
            eigenvalues: Default::default(),
        }
    }

    pub(crate) fn stiffness(&self) -> &Matrix6<f64> {
        &self.stiffness
    }

    /// What its derivative is of a measure; `None` where it has none.
    pub(crate) fn probe(&self, rule: Rule, displacement: &Vector6<f64>) -> Option<Probe> {
        let unit = |place: usize| Vector6::ith(place, 1.0);
        let softest = |matrix: &Matrix6<f64>, block: usize, place: usize| {
            let part: Matrix3<f64> = matrix.fixed_view::<3, 3>(block, block).into();
            let found = principal(&part);
            let mut wrench = Vector6::zeros();
            wrench
                .fixed_rows_mut::<3>(block)
                .copy_from(&found.directions[place]);
            (found.values[place], wrench)
        };
        let mut probe = Probe::default();
        match rule {
            Rule::Length(block) => {
                let own = displacement.fixed_rows::<3>(block);
                let mut along = Vector6::zeros();
                along
                    .fixed_rows_mut::<3>(block)
                    .copy_from(&(own / own.norm()));
                probe.along = Some(along);
            }
            Rule::Compliance(place) => probe.wrenches.push((1.0, unit(place))),
            Rule::InverseCompliance(place) => {
                let own = self.compliance()?[(place, place)];
                probe.wrenches.push((-1.0 / (own * own), unit(place)));
            }
            Rule::Softest(block) => {
                let (_, wrench) = softest(self.compliance()?, block, 2);
                probe.wrenches.push((1.0, wrench));
            }
            Rule::Free { block, least } => {
                let place = if least { 2 } else { 0 };
                let (value, wrench) = softest(self.compliance()?, block, place);
                probe.wrenches.push((-1.0 / (value * value), wrench));
            }
            Rule::Held { block, least } => {
                let place = if least { 0 } else { 2 };
                let (_, moved) = softest(&self.stiffness, block, place);
                // ∂K = −K (∂C) K.
                probe.wrenches.push((-1.0, self.stiffness * moved));
            }
            Rule::Work => {
                let third = |place| (1.0 / 3.0, unit(place));
                probe.wrenches.extend([0, 1, 2].map(third));
            }
        }
        let numbers = probe.wrenches.iter();
        let numbers = numbers.flat_map(|(weight, own)| own.iter().chain([weight]));
        let along = probe.along.iter().flatten();
        let finite = numbers.chain(along).all(|number| number.is_finite());
        finite.then_some(probe)
    }

    /// The inverse of the stiffness.
    pub(crate) fn compliance(&self) -> Option<&Matrix6<f64>> {
        let invert = || {
            let stiffness = &self.stiffness;
            let scale = stiffness.diagonal().map(f64::sqrt);
            let unit = Matrix6::from_fn(|r, c| stiffness[(r, c)] / (scale[r] * scale[c]));
            let inverse = Cholesky::new(unit)?.inverse();
            Some(Matrix6::from_fn(|r, c| {
                inverse[(r, c)] / (scale[r] * scale[c])
            }))
        };
        self.compliance.get_or_init(invert).as_ref()
    }

    /// Ascending, of a block of the compliance (`first` 0) or of the stiffness (2).
    fn eigenvalues(&self, matrix: &Matrix6<f64>, block: usize, first: usize) -> [f64; 3] {
        *self.eigenvalues[first + block / 3].get_or_init(|| {
            let block: Matrix3<f64> = matrix.fixed_view::<3, 3>(block, block).into();
            principal(&block).values
        })
    }

    /// A measure of it, under a displacement; `None` where it has none.
    pub(crate) fn measure(&self, rule: Rule, displacement: &Vector6<f64>) -> Option<f64> {
        let found = match rule {
            Rule::Length(_) => rule.of_displacement(displacement)?,
            Rule::Compliance(place) => self.compliance()?[(place, place)],
            Rule::InverseCompliance(place) => 1.0 / self.compliance()?[(place, place)],
            Rule::Softest(block) => self.eigenvalues(self.compliance()?, block, 0)[2],
            Rule::Free { block, least } => {
                let values = self.eigenvalues(self.compliance()?, block, 0);
                1.0 / values[if least { 2 } else { 0 }]
            }
            Rule::Held { block, least } => {
                let values = self.eigenvalues(&self.stiffness, block, 2);
                values[if least { 0 } else { 2 }]
            }
            Rule::Work => self.compliance()?.fixed_view::<3, 3>(0, 0).trace() / 3.0,
        };
        Some(found).filter(|value| value.is_finite())
    }
}

/// The measure of this name.
pub(crate) fn named(name: &str) -> Option<&'static Measure> {
    MEASURES.iter().find(|measure| measure.name == name)
}

const fn measure(
    name: &'static str,
    words: &'static str,
    short: &'static str,
    unit: &'static str,
    rule: Rule,
) -> Measure {
    Measure {
        name,
        words,
        short,
        unit,
        rule,
    }
}

/// All of them.
#[rustfmt::skip]
pub(crate) const MEASURES: [Measure; 22] = [
    measure("deflection", "length of the output's displacement", "deflection under the loads", "m",
        Rule::Length(0)),
    measure("rotation", "angle of the output's rotation", "rotation under the loads", "rad",
        Rule::Length(3)),
    measure("compliance_x", "displacement along x per force along x alone", "compliance along x", "m/N",
        Rule::Compliance(0)),
    measure("compliance_y", "displacement along y per force along y alone", "compliance along y", "m/N",
        Rule::Compliance(1)),
    measure("compliance_z", "displacement along z per force along z alone", "compliance along z", "m/N",
        Rule::Compliance(2)),
    measure("softest_force", "greatest principal compliance against a pure force, rotations free",
        "compliance, softest direction", "m/N", Rule::Softest(0)),
    measure("softest_moment", "greatest principal compliance against a pure moment, translations free",
        "compliance, softest moment", "rad/(N·m)", Rule::Softest(3)),
    measure("pure_force_stiffness_min", "least principal stiffness against a pure force, rotations free",
        "stiffness, pure force, least", "N/m", Rule::Free { block: 0, least: true }),
    measure("pure_force_stiffness_max", "greatest principal stiffness against a pure force, rotations free",
        "stiffness, pure force, greatest", "N/m", Rule::Free { block: 0, least: false }),
    measure("pure_force_stiffness_x", "force along x alone per displacement along x",
        "stiffness, pure force along x", "N/m", Rule::InverseCompliance(0)),
    measure("pure_force_stiffness_y", "force along y alone per displacement along y",
        "stiffness, pure force along y", "N/m", Rule::InverseCompliance(1)),
    measure("pure_force_stiffness_z", "force along z alone per displacement along z",
        "stiffness, pure force along z", "N/m", Rule::InverseCompliance(2)),
    measure("pure_moment_stiffness_min",
        "least principal stiffness against a pure moment, translations free",
        "stiffness, pure moment, least", "N·m/rad", Rule::Free { block: 3, least: true }),
    measure("pure_moment_stiffness_max",
        "greatest principal stiffness against a pure moment, translations free",
        "stiffness, pure moment, greatest", "N·m/rad", Rule::Free { block: 3, least: false }),
    measure("pure_moment_stiffness_x", "moment along x alone per rotation along x",
        "stiffness, pure moment about x", "N·m/rad", Rule::InverseCompliance(3)),
    measure("pure_moment_stiffness_y", "moment along y alone per rotation along y",
        "stiffness, pure moment about y", "N·m/rad", Rule::InverseCompliance(4)),
    measure("pure_moment_stiffness_z", "moment along z alone per rotation along z",
        "stiffness, pure moment about z", "N·m/rad", Rule::InverseCompliance(5)),
    measure("pure_translation_stiffness_min",
        "least principal stiffness against a pure translation, rotations held",
        "stiffness, pure translation, least", "N/m", Rule::Held { block: 0, least: true }),
    measure("pure_translation_stiffness_max",
        "greatest principal stiffness against a pure translation, rotations held",
        "stiffness, pure translation, greatest", "N/m", Rule::Held { block: 0, least: false }),
    measure("pure_rotation_stiffness_min",
        "least principal stiffness against a pure rotation, translations held",
        "stiffness, pure rotation, least", "N·m/rad", Rule::Held { block: 3, least: true }),
    measure("pure_rotation_stiffness_max",
        "greatest principal stiffness against a pure rotation, translations held",
        "stiffness, pure rotation, greatest", "N·m/rad", Rule::Held { block: 3, least: false }),
    measure("virtual_work_index", "work of a unit force, mean over its directions",
        "virtual-work index of forces", "J", Rule::Work),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// A stiffness from some entries of its upper triangle.
    fn of(entries: &[(usize, usize, f64)]) -> Matrix6<f64> {
        let mut stiffness = Matrix6::zeros();
        for (row, column, value) in entries {
            stiffness[(*row, *column)] = *value;
            stiffness[(*column, *row)] = *value;
        }
        stiffness
    }

    fn find(name: &str, stiffness: &Matrix6<f64>) -> f64 {
        let pose = Pose::new(stiffness);
        let found = pose.measure(named(name).unwrap().rule, &Vector6::zeros());
        found.unwrap()
    }

    #[test]
    fn principal_stiffness_of_springs_at_an_angle() {
        // 1e6 N/m along (1, 1)/√2 in x-y, 4e6 across it, 2e6 along z, rotations apart.
        let mut stiffness = of(&[
            (0, 0, 2.5e6),
            (0, 1, -1.5e6),
            (1, 1, 2.5e6),
            (2, 2, 2e6),
            (3, 3, 10.0),
            (4, 4, 20.0),
            (5, 5, 30.0),
        ]);
        for (name, expected) in [
            ("pure_force_stiffness_min", 1e6),
            ("pure_force_stiffness_max", 4e6),
            ("pure_moment_stiffness_min", 10.0),
            ("pure_moment_stiffness_max", 30.0),
            ("pure_translation_stiffness_min", 1e6),
            ("pure_rotation_stiffness_max", 30.0),
            // 1 / (1/2 (1/1e6 + 1/4e6)).
            ("pure_force_stiffness_x", 1.6e6),
            ("pure_force_stiffness_z", 2e6),
            ("compliance_x", 1.0 / 1.6e6),
            ("softest_force", 1e-6),
            ("softest_moment", 0.1),
            ("virtual_work_index", (1e-6 + 0.25e-6 + 0.5e-6) / 3.0),
        ] {
            let found = find(name, &stiffness);
            assert!(
                (found / expected - 1.0).abs() < 1e-12,
                "{name}: {found} {expected}"
            );
        }
        stiffness[(0, 0)] = -1.0;
        let pose = Pose::new(&stiffness);
        let of = |rule| pose.measure(rule, &Vector6::zeros());
        assert_eq!(of(Rule::InverseCompliance(2)), None);
        let block = 3;
        assert!(of(Rule::Held { block, least: true }).is_some());
    }

    /// A spring k along x at the height h above the output, held in rotation by a spring c: a force
    /// alone turns the output, 1/K = 1/k + h²/c; a translation alone meets k.
    #[test]
    fn rotations_free_and_held_are_two_stiffnesses() {
        let (k, h, c) = (2e6, 0.3, 5e4);
        // The spring's, and stiff ones in all other directions.
        let stiffness = of(&[
            (0, 0, k),
            (0, 4, k * h),
            (1, 1, 1e9),
            (2, 2, 1e9),
            (3, 3, 1e9),
            (4, 4, c + k * h * h),
            (5, 5, 1e9),
        ]);
        for (name, expected) in [
            ("pure_force_stiffness_min", 1.0 / (1.0 / k + h * h / c)),
            ("pure_force_stiffness_x", 1.0 / (1.0 / k + h * h / c)),
            ("pure_translation_stiffness_min", k),
            ("pure_moment_stiffness_min", c),
            ("pure_rotation_stiffness_min", c + k * h * h),
        ] {
            let found = find(name, &stiffness);
            assert!((found / expected - 1.0).abs() < 1e-12, "{name}");
        }
    }

    #[test]
    fn a_name_has_one_definition() {
        for (place, measure) in MEASURES.iter().enumerate() {
            let same = |other: &Measure| {
                other.name == measure.name
                    || other.words == measure.words
                    || other.short == measure.short
                    || other.rule == measure.rule
            };
            assert!(!MEASURES[place + 1..].iter().any(same), "{}", measure.name);
        }
    }
}
