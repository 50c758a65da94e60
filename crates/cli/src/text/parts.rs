//! What the reports are put together from: headings, lists, and tables of six components.

use std::fmt::Write as _;

pub(crate) use hyperstat_study::Rounding;
use hyperstat_study::{Entries, Rows, without_rounding};

use super::table::Table;

/// The name of a mechanism and, where it is from a batch, of which job, design and pose.
pub(crate) fn title(
    name: &str,
    job: Option<&str>,
    design: Option<usize>,
    pose: Option<usize>,
) -> String {
    let design = design.map_or_else(String::new, |design| format!(", design {design}"));
    match (job, pose) {
        (Some(job), Some(pose)) => format!("{name} (job {job}{design}, pose {pose})"),
        _ => name.into(),
    }
}

/// Components of a displacement, as table heads.
pub(crate) const DISPLACEMENT: [&str; 6] = ["Δx", "Δy", "Δz", "φx", "φy", "φz"];

/// Components of a wrench, as table heads.
pub(crate) const WRENCH: [&str; 6] = ["Fx", "Fy", "Fz", "Mx", "My", "Mz"];

/// Table heads: `names`, then the six components.
pub(crate) fn heads<'a>(names: &[&'a str], components: [&'a str; 6]) -> Vec<&'a str> {
    names.iter().copied().chain(components).collect()
}

/// A 6×6 matrix as a table. What is rounding beside its diagonal entries is shown as 0.
pub(crate) fn matrix_table(row_names: [&str; 6], column_names: [&str; 6], matrix: &Rows) -> Table {
    let mut table = Table::new(1, &heads(&[""], column_names));
    for (name, row) in row_names.iter().zip(without_rounding(matrix)) {
        table.row(&[name], row);
    }
    table
}

/// The displacement of the output as a table; what is rounding beside those of the `nodes` is 0.
pub(crate) fn output_table(displacement: &[f64; 6], nodes: &Entries<[f64; 6]>) -> Table {
    let rounding = Rounding::of(nodes.iter().map(|(_, row)| row));
    let mut table = Table::new(0, &DISPLACEMENT);
    table.row(&[], rounding.shown(displacement));
    table
}

/// A table of names and displacements.
pub(crate) fn displacement_table(displacements: &Entries<[f64; 6]>) -> Table {
    let rounding = Rounding::of(displacements.iter().map(|(_, row)| row));
    let mut table = Table::new(1, &heads(&["node"], DISPLACEMENT));
    for (name, displacement) in displacements.iter() {
        table.row(&[name], rounding.shown(displacement));
    }
    table
}

/// A stiffness matrix as a table: each column the wrench of a unit displacement.
pub(crate) fn stiffness_table(stiffness: &Rows) -> Table {
    matrix_table(WRENCH, DISPLACEMENT, stiffness)
}

/// A heading and what stands under it, with an empty line before.
pub(crate) fn section(text: &mut String, heading: &str, body: impl std::fmt::Display) {
    // Writing to a String cannot fail.
    let _ = write!(text, "\n{heading}\n{body}");
}

/// A heading and a list under it; nothing where the list is empty.
pub(crate) fn list(text: &mut String, heading: &str, items: &[String]) {
    if !items.is_empty() {
        let body: String = items.iter().map(|item| format!("  - {item}\n")).collect();
        section(text, heading, body);
    }
}
