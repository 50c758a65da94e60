//! What 1 % more of every parameter would change: of the deflection, and of natural frequencies.

use std::fmt::Write as _;

use hyperstat_study::{FrequencyReport, SensitivityReport};

use super::parts::section;
use super::table::{left, number};

/// Parameters that the text tells; JSON has all.
const TOLD: usize = 15;

/// Paths that are longer are left to JSON.
const LONGEST: usize = 100;

/// Changes below this are 0.000 %: they are left out of the text.
const LEAST: f64 = 0.0005;

/// Writes what they change of `what`.
pub(super) fn write_sensitivities(found: &[SensitivityReport], what: &str, text: &mut String) {
    let changes = found.iter().map(|s| Change {
        parameter: &s.parameter,
        path: s.path.as_deref(),
        by_differences: s.by_differences,
        value: s.value,
        relative: s.relative.iter().copied().collect(),
    });
    section(
        text,
        "What 1 % more of each value changes",
        table(changes, what),
    );
}

/// Writes what changes them.
pub(crate) fn write_frequencies(found: &FrequencyReport, text: &mut String) {
    let numbers: Vec<String> = found.modes.iter().map(ToString::to_string).collect();
    let which = match numbers.as_slice() {
        [one] => format!("frequency {one}"),
        [first, .., last] if numbers.len() > 2 => format!("frequencies {first} to {last}"),
        some => format!("frequencies {}", some.join(" and ")),
    };
    let changes = found.sensitivities.iter().map(|s| Change {
        parameter: &s.parameter,
        path: s.path.as_deref(),
        by_differences: s.by_differences,
        value: s.value,
        relative: s.relative.clone().unwrap_or_default(),
    });
    let heading = format!(
        "What 1 % more of each value changes in {which} ({} Hz)",
        number(found.frequency)
    );
    section(text, &heading, table(changes, "frequency"));
}

/// A row of the text.
struct Change<'a> {
    parameter: &'a str,
    /// Of what is told in words.
    path: Option<&'a str>,
    by_differences: bool,
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
            "  {}  {:>12}   {} {what}{}",
            left(change.parameter, width),
            number(change.value),
            shown.join(","),
            if change.by_differences {
                ", by differences"
            } else {
                ""
            }
        );
        if let Some(path) = change.path.filter(|path| path.len() <= LONGEST) {
            let _ = writeln!(body, "    {path}");
        }
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
