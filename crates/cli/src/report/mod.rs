//! What `solve` and `check` print: plain data that JSON and the tables are both made from.

mod answer;
mod cases;
mod check;
mod forces;
mod inner;
mod joints;
mod loads;
mod misfits;
mod modes;
mod parameters;
mod sensitivities;
mod solve;
mod table;
mod why;

use std::fmt::Write as _;

use hyperstat_assembly::{Configuration, Model};
use nalgebra::{Matrix6, Vector6};
use serde::{Serialize, Serializer};

use crate::error::CliError;
use crate::terminal::plain_json;
pub(crate) use check::{CheckReport, Problem};
use inner::inner_displacements;
use inner::inner_displacements_of;
pub(crate) use modes::ModesReport;
pub(crate) use sensitivities::FrequencyReport;
pub(crate) use solve::SolveReport;
pub(crate) use table::{Table, number};
pub(crate) use why::{Asked, BudgetReport, Sum, Why, budget};

/// The name of a mechanism and, where it is from a batch, of which job, design and pose.
fn title(name: &str, job: Option<&str>, design: Option<usize>, pose: Option<usize>) -> String {
    let design = design.map_or_else(String::new, |design| format!(", design {design}"));
    match (job, pose) {
        (Some(job), Some(pose)) => format!("{name} (job {job}{design}, pose {pose})"),
        _ => name.into(),
    }
}

/// Components of a displacement, as table heads.
const DISPLACEMENT: [&str; 6] = ["Δx", "Δy", "Δz", "φx", "φy", "φz"];
/// Components of a wrench, as table heads.
const WRENCH: [&str; 6] = ["Fx", "Fy", "Fz", "Mx", "My", "Mz"];

/// A map whose entries keep their order (that of the file) in JSON.
#[derive(Debug)]
pub(crate) struct Entries<T>(Vec<(String, T)>);

impl<T> FromIterator<(String, T)> for Entries<T> {
    fn from_iter<I: IntoIterator<Item = (String, T)>>(entries: I) -> Self {
        Self(entries.into_iter().collect())
    }
}

impl<T> Entries<T> {
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Names and values in their order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&str, &T)> {
        self.0.iter().map(|(name, value)| (&**name, value))
    }
}

impl<T: Serialize> Serialize for Entries<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

/// Report `value` as JSON. Numbers read back to the same double.
pub(crate) fn json(value: &impl Serialize) -> Result<String, CliError> {
    match serde_json::to_string_pretty(value) {
        Ok(text) => Ok(plain_json(&text).into_owned() + "\n"),
        Err(error) => Err(CliError::Print(error.into())),
    }
}

/// A 6×6 matrix by rows.
type Rows = [[f64; 6]; 6];

/// The rows of a matrix.
pub(crate) fn rows(matrix: &Matrix6<f64>) -> Rows {
    std::array::from_fn(|r| std::array::from_fn(|c| matrix[(r, c)]))
}

fn numbers(vector: &Vector6<f64>) -> [f64; 6] {
    (*vector).into()
}

/// Table heads: `names`, then the six components.
fn heads<'a>(names: &[&'a str], components: [&'a str; 6]) -> Vec<&'a str> {
    names.iter().copied().chain(components).collect()
}

/// A 6×6 matrix as a table. What is rounding beside its diagonal entries is shown as 0.
fn matrix_table(row_names: [&str; 6], column_names: [&str; 6], matrix: &Rows) -> Table {
    let mut table = Table::new(1, &heads(&[""], column_names));
    for (r, name) in row_names.iter().enumerate() {
        let shown = |c: usize| {
            let scale = (matrix[r][r] * matrix[c][c]).abs().sqrt();
            let entry = matrix[r][c];
            if entry.abs() < ROUNDING * scale {
                0.0
            } else {
                entry
            }
        };
        table.row(&[name], (0..6).map(shown));
    }
    table
}

/// What is rounding beside the largest number of its kind, shown as 0: of six components, the first
/// three are of one kind and the last three of another.
struct Rounding([f64; 2]);

impl Rounding {
    /// Of all rows of a table.
    fn of<'a>(rows: impl IntoIterator<Item = &'a [f64; 6]>) -> Self {
        let mut largest = [0.0_f64; 2];
        for row in rows {
            for (k, number) in row.iter().enumerate() {
                largest[k / 3] = largest[k / 3].max(number.abs());
            }
        }
        Self(largest.map(|largest| ROUNDING * largest))
    }

    /// A row as it is shown.
    fn shown(&self, row: &[f64; 6]) -> [f64; 6] {
        std::array::from_fn(|k| {
            if row[k].abs() < self.0[k / 3] {
                0.0
            } else {
                row[k]
            }
        })
    }
}

/// The displacement of the output as a table; what is rounding beside those of the `nodes` is 0.
fn output_table(displacement: &[f64; 6], nodes: &Entries<[f64; 6]>) -> Table {
    let rounding = Rounding::of(nodes.0.iter().map(|(_, row)| row));
    let mut table = Table::new(0, &DISPLACEMENT);
    table.row(&[], rounding.shown(displacement));
    table
}

/// A table of names and displacements.
fn displacement_table(displacements: &Entries<[f64; 6]>) -> Table {
    let rounding = Rounding::of(displacements.0.iter().map(|(_, row)| row));
    let mut table = Table::new(1, &heads(&["node"], DISPLACEMENT));
    for (name, displacement) in &displacements.0 {
        table.row(&[name], rounding.shown(displacement));
    }
    table
}

/// Entries of a matrix below this share of √(K_ii K_jj) are rounding, and numbers of a list below
/// this share of the largest.
const ROUNDING: f64 = 1e-14;

/// A stiffness matrix as a table: each column the wrench of a unit displacement.
pub(crate) fn stiffness_table(stiffness: &Rows) -> Table {
    matrix_table(WRENCH, DISPLACEMENT, stiffness)
}

/// The redundant constraints of a mechanism: joint directions such as `A1.x`, in groups.
fn redundancies(here: &Configuration<'_>) -> Vec<Vec<String>> {
    let redundant = here.redundant_constraints().into_iter();
    redundant.map(|group| group.names(here.model())).collect()
}

/// What a model says that can hardly be meant, in words.
fn doubts(model: &Model) -> impl Iterator<Item = String> {
    model.doubts().into_iter().map(|doubt| doubt.to_string())
}

/// A heading and what stands under it, with an empty line before.
fn section(text: &mut String, heading: &str, body: impl std::fmt::Display) {
    // Writing to a String cannot fail.
    let _ = write!(text, "\n{heading}\n{body}");
}

/// A heading and a list under it; nothing where the list is empty.
fn list(text: &mut String, heading: &str, items: &[String]) {
    if !items.is_empty() {
        let body: String = items.iter().map(|item| format!("  - {item}\n")).collect();
        section(text, heading, body);
    }
}
