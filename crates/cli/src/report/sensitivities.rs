//! What 1 % more of every parameter would change: of the deflection, and of natural frequencies.

use std::fmt::Write as _;

use hyperstat_assembly::{
    FrequencySensitivity, Influence, ModalSensitivities, Sensitivity, Solution, SolveError,
    larger_first,
};
use serde::Serialize;

use super::table::left;
use super::{Rows, number, numbers, parameters, rows, section};
use crate::case::Case;

/// Parameters that the text tells; JSON has all.
const TOLD: usize = 15;
/// Changes below this are 0.000 %: they are left out of the text.
const LEAST: f64 = 0.0005;

/// Field names are those of the JSON output.
#[derive(Debug, Serialize)]
pub(super) struct SensitivityReport {
    parameter: String,
    value: f64,
    /// Relative change of the budget's total per relative change of the parameter.
    relative: Option<f64>,
    displacement: Option<[f64; 6]>,
    compliance: Rows,
    stiffness: Option<Rows>,
}

/// How frequencies that are equal, mostly one, answer to the parameters.
#[derive(Debug, Serialize)]
pub(crate) struct FrequencyReport {
    /// Their numbers, from 1.
    modes: Vec<usize>,
    /// [Hz]
    frequency: f64,
    sensitivities: Vec<FrequencySensitivityReport>,
}

/// Of each of the frequencies, ascending.
#[derive(Debug, Serialize)]
struct FrequencySensitivityReport {
    parameter: String,
    value: f64,
    /// Relative change of each frequency per relative change of the parameter.
    relative: Option<Vec<f64>>,
    /// [Hz over the parameter's unit]
    derivative: Vec<f64>,
}

impl SensitivityReport {
    /// Sensitivities of a solution, largest first by `relative`.
    pub(super) fn all(
        case: &Case,
        influence: &Influence<'_>,
        solution: &Solution,
        relative: impl Fn(&Sensitivity) -> Option<f64>,
    ) -> Result<Vec<Self>, SolveError> {
        let found = influence.sensitivities(solution)?;
        let named = found.iter().map(|s| (s.name.as_deref(), &s.parameter));
        let names = parameters::names(case.model(), named);
        let mut all: Vec<Self> = (found.iter().zip(names))
            .map(|(s, parameter)| Self {
                parameter,
                value: s.value,
                relative: relative(s),
                displacement: s.displacement.as_ref().map(numbers),
                compliance: rows(&s.compliance),
                stiffness: s.stiffness.as_ref().map(rows),
            })
            .collect();
        let size = |s: &Self| s.relative.unwrap_or(0.0).abs();
        all.sort_by(|a, b| larger_first(size(a), size(b)));
        Ok(all)
    }

    /// What the user should know about a parameter that has no derivative.
    pub(super) fn remark(&self) -> Option<String> {
        self.displacement.is_none().then(|| {
            format!(
                "sensitivities: with more of `{}` the weight would not be in balance on an idle \
                 motion, so that it has no derivative",
                self.parameter
            )
        })
    }

    /// Writes what they change of `what`.
    pub(super) fn write(found: &[Self], what: &str, text: &mut String) {
        let changes = found.iter().map(|s| Change {
            parameter: &s.parameter,
            value: s.value,
            relative: s.relative.iter().copied().collect(),
        });
        section(
            text,
            "What 1 % more of each value changes",
            table(changes, what),
        );
    }
}

impl FrequencyReport {
    /// Those of a model, one a group of equal frequencies.
    pub(crate) fn all(case: &Case, found: &ModalSensitivities) -> Vec<Self> {
        let named = found.parameters.iter();
        let named = named.map(|s| (s.name.as_deref(), &s.parameter));
        let names = parameters::names(case.model(), named);
        let group = |group: &std::ops::Range<usize>| {
            let own = |(s, name): (&FrequencySensitivity, &String)| FrequencySensitivityReport {
                parameter: name.clone(),
                value: s.value,
                relative: (group.clone())
                    .map(|place| s.relative(&found.frequencies, place))
                    .collect(),
                derivative: s.derivatives[group.clone()].to_vec(),
            };
            let all = found.parameters.iter().zip(&names);
            let mut sensitivities: Vec<_> = all.map(own).collect();
            sensitivities.sort_by(|a, b| larger_first(a.size(), b.size()));
            Self {
                modes: group.clone().map(|place| place + 1).collect(),
                frequency: found.frequencies[group.start],
                sensitivities,
            }
        };
        found.groups.iter().map(group).collect()
    }

    /// Writes what changes them.
    pub(crate) fn write(&self, text: &mut String) {
        let numbers: Vec<String> = self.modes.iter().map(ToString::to_string).collect();
        let which = match numbers.as_slice() {
            [one] => format!("frequency {one}"),
            [first, .., last] if numbers.len() > 2 => format!("frequencies {first} to {last}"),
            some => format!("frequencies {}", some.join(" and ")),
        };
        let changes = self.sensitivities.iter().map(|s| Change {
            parameter: &s.parameter,
            value: s.value,
            relative: s.relative.clone().unwrap_or_default(),
        });
        let heading = format!(
            "What 1 % more of each value changes in {which} ({} Hz)",
            number(self.frequency)
        );
        section(text, &heading, table(changes, "frequency"));
    }
}

impl FrequencySensitivityReport {
    fn size(&self) -> f64 {
        largest(self.relative.as_deref().unwrap_or_default())
    }
}

/// A row of the text.
struct Change<'a> {
    parameter: &'a str,
    value: f64,
    /// More than one of equal frequencies; none where there is no derivative.
    relative: Vec<f64>,
}

/// The first rows, those that change nothing left out.
fn table<'a>(changes: impl Iterator<Item = Change<'a>>, what: &str) -> String {
    let told: Vec<_> = changes
        .filter(|change| largest(&change.relative) >= LEAST)
        .take(TOLD)
        .collect();
    let width = told.iter().map(|c| c.parameter.chars().count()).max();
    let width = width.unwrap_or(0);
    let mut body = String::new();
    for change in &told {
        let mut shown: Vec<String> = (change.relative.iter())
            .map(|relative| format!("{relative:>+8.3} %"))
            .collect();
        shown.dedup();
        // Writing to a String cannot fail.
        let _ = writeln!(
            body,
            "  {}  {:>12}   {} {what}",
            left(change.parameter, width),
            number(change.value),
            shown.join(",")
        );
    }
    if told.is_empty() {
        body += "  None of them changes it.\n";
    }
    body
}

/// Largest size of some numbers.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size, value| value.abs().max(size))
}
