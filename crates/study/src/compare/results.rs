//! What differs in what is found: stiffness, displacement, measures, budget, frequencies.

use hyperstat_assembly::{Modes, Solution};
use hyperstat_mechanisms::Along;
use nalgebra::{Matrix6, Vector6};
use serde::Serialize;

use super::Pair;
use crate::answer::{Asked, BudgetReport, Sum};
use crate::ask::Focus;
use crate::error::StudyError;
use crate::measures::{MEASURES, Pose};
use crate::schema::{DISPLACEMENT, stiffness, unit};
use crate::study::Study;

/// Entries of a stiffness below this part of √(K_ii K_jj), and components of a displacement below this part
/// of the largest of their kind, are rounding: zero.
const ROUNDING: f64 = 1e-12;

/// What is found of two mechanisms.
#[derive(Debug, Serialize)]
pub struct Results {
    /// Mobility, over-constraint, unknowns, idle motions.
    pub counts: Vec<Pair>,
    /// Displacement of the output, global axes.
    pub displacement: Vec<Pair>,
    /// Upper triangle of the output's stiffness, global axes; without entries that both have as zero.
    pub stiffness: Vec<Pair>,
    /// Measures of stiffness and displacement, by the names that maps have.
    pub measures: Vec<Pair>,
    /// Mass of all that has one \[kg\], and natural frequencies \[Hz\].
    pub frequencies: Vec<Pair>,
    /// Where the deflections come from; `None` where the two are not budgets of the same quantity.
    pub budget: Option<BudgetComparison>,
}

/// Two budgets along one direction.
#[derive(Debug, Serialize)]
pub struct BudgetComparison {
    /// `displacement` under the loads, or `compliance` where there is none.
    pub of: String,
    /// The unit wrench along which: of both the direction of the first.
    pub along: [f64; 6],
    /// The wholes.
    pub total: Pair,
    /// By kinds of deformation, those that differ most first.
    pub by_deformation: Vec<Pair>,
    /// By bodies and joints, those that differ most first.
    pub by_part: Vec<Pair>,
}

/// What is found of one.
struct Found {
    solution: Solution,
    displacement: Vector6<f64>,
    stiffness: Option<Matrix6<f64>>,
    modes: Option<Modes>,
}

impl Found {
    fn new(study: &Study, focus: &Focus) -> Result<Self, StudyError> {
        let solution = study.solve_held()?;
        let loaded = study.under(&solution, focus.asked.case.as_deref())?;
        let displacement = loaded.output.displacement;
        let options = study.modes_in(focus);
        let modes = options.map(|options| study.modes(&options)).transpose()?;
        Ok(Self {
            displacement: cleaned(&displacement),
            stiffness: solution.output.stiffness,
            modes,
            solution,
        })
    }

    fn measures(&self) -> [Option<f64>; MEASURES.len()] {
        let pose = self.stiffness.as_ref().map(Pose::new);
        MEASURES.map(|measure| pose.as_ref()?.measure(measure.rule, &self.displacement))
    }
}

/// A displacement without what is rounding.
fn cleaned(displacement: &Vector6<f64>) -> Vector6<f64> {
    let largest = [0, 3].map(|first| displacement.fixed_rows::<3>(first).amax());
    Vector6::from_fn(|row, _| match displacement[row] {
        component if component.abs() < ROUNDING * largest[row / 3] => 0.0,
        component => component,
    })
}

impl Results {
    pub(super) fn new(studies: [&Study; 2], focus: &Focus) -> Result<Self, StudyError> {
        let [a, b] = studies;
        let found = [Found::new(a, focus)?, Found::new(b, focus)?];
        let both = |of: &dyn Fn(&Found) -> Option<f64>| found.each_ref().map(of);
        let count = |name: &str, of: fn(&Solution) -> usize| {
            Pair::new(name, "", both(&|found| Some(of(&found.solution) as f64)))
        };
        let entry = |(name, (row, column)): (String, (usize, usize))| {
            let values = both(&|found| {
                let k = found.stiffness?;
                let scale = (k[(row, row)] * k[(column, column)]).abs().sqrt();
                Some(k[(row, column)]).map(|entry| {
                    if entry.abs() < ROUNDING * scale {
                        0.0
                    } else {
                        entry
                    }
                })
            });
            Pair::new(name.clone(), unit(&name), values)
        };
        let upper = (0..6).flat_map(|row| (row..6).map(move |column| (row, column)));
        let measured = found.each_ref().map(Found::measures);
        let of_modes = |of: &dyn Fn(&Modes) -> Option<f64>| {
            both(&|found: &Found| found.modes.as_ref().and_then(of))
        };
        let counted = found
            .iter()
            .filter_map(|found| Some(found.modes.as_ref()?.modes.len()));
        let frequencies = (0..counted.max().unwrap_or(0)).map(|k| {
            let values = of_modes(&|modes| modes.modes.get(k).map(|mode| mode.frequency));
            Pair::new(format!("f{}", k + 1), "Hz", values)
        });
        let mass = Pair::new("mass", "kg", of_modes(&|modes| Some(modes.mass)));
        let has_mass = mass.values.iter().any(Option::is_some);
        let displacement = DISPLACEMENT.iter().enumerate().map(|(k, name)| {
            Pair::new(
                *name,
                unit(name),
                both(&|found| Some(found.displacement[k])),
            )
        });
        Ok(Self {
            counts: vec![
                count("mobility", |solution| solution.mobility),
                count("over-constraint", |solution| solution.overconstraint),
                count("unknowns", |solution| solution.unknowns),
                count("idle motions", |solution| solution.idle.len()),
            ],
            displacement: displacement.collect(),
            stiffness: (stiffness().zip(upper).map(entry))
                .filter(|pair| pair.values.iter().flatten().any(|value| *value != 0.0))
                .collect(),
            measures: (MEASURES.iter().enumerate())
                .map(|(k, m)| Pair::new(m.name, m.unit, [measured[0][k], measured[1][k]]))
                .collect(),
            frequencies: (has_mass.then_some(mass).into_iter())
                .chain(frequencies)
                .collect(),
            budget: budgets(studies, &found, &focus.asked)?,
        })
    }

    /// All numbers that are compared, but the budget's.
    pub fn pairs(&self) -> impl Iterator<Item = &Pair> {
        let first = self.counts.iter().chain(&self.displacement);
        first
            .chain(&self.stiffness)
            .chain(&self.measures)
            .chain(&self.frequencies)
    }
}

/// Both budgets along the direction of the first.
fn budgets(
    studies: [&Study; 2],
    found: &[Found; 2],
    asked: &Asked,
) -> Result<Option<BudgetComparison>, StudyError> {
    let budget = |k: usize, asked: &Asked| {
        let loaded = studies[k].under(&found[k].solution, asked.case.as_deref())?;
        studies[k].budget(&loaded, asked)
    };
    let Some(first) = budget(0, asked)? else {
        return Ok(None);
    };
    let same = Asked {
        along: Along::Wrench(first.along),
        ..asked.clone()
    };
    let second = budget(1, &same)?.filter(|second| second.of == first.of);
    Ok(second.map(|second| BudgetComparison::new(&first, &second)))
}

impl BudgetComparison {
    fn new(first: &BudgetReport, second: &BudgetReport) -> Self {
        let (name, unit) = first.quantity();
        let sums = |of: fn(&BudgetReport) -> &Vec<Sum>| pairs(of(first), of(second), unit);
        Self {
            of: first.of.clone(),
            along: first.along,
            total: Pair::new(name, unit, [Some(first.total), Some(second.total)]),
            by_deformation: sums(|budget| &budget.by_deformation),
            by_part: sums(|budget| &budget.by_part),
        }
    }
}

/// Sums of both by their names, those that differ most first.
fn pairs(first: &[Sum], second: &[Sum], unit: &str) -> Vec<Pair> {
    let of = |sums: &[Sum], name: &str| {
        let found = sums.iter().find(|sum| sum.name == name);
        found.map(|sum| sum.displacement)
    };
    let is_new = |sum: &&Sum| of(first, &sum.name).is_none();
    let names = first.iter().chain(second.iter().filter(is_new));
    let pair = |sum: &Sum| {
        Pair::new(
            &*sum.name,
            unit,
            [of(first, &sum.name), of(second, &sum.name)],
        )
    };
    let mut pairs: Vec<Pair> = names.map(pair).collect();
    let change = |pair: &Pair| {
        let [first, second] = pair.values.map(|value| value.unwrap_or(0.0));
        (second - first).abs()
    };
    pairs.sort_by(|a, b| change(b).total_cmp(&change(a)));
    pairs
}
