//! What pages are put together from: tables, matrices, lists, figures.

use maud::{Markup, PreEscaped, html};

use crate::answer::Rows;
use crate::figure::Drawing;
use crate::number::number;

/// Components of a displacement, as heads.
pub(super) const DISPLACEMENT: [&str; 6] = [
    "Δx [m]",
    "Δy [m]",
    "Δz [m]",
    "φx [rad]",
    "φy [rad]",
    "φz [rad]",
];

/// Components of a wrench, as heads.
pub(super) const WRENCH: [&str; 6] = [
    "Fx [N]",
    "Fy [N]",
    "Fz [N]",
    "Mx [N·m]",
    "My [N·m]",
    "Mz [N·m]",
];

/// Entries of a matrix below this share of √(K_ii K_jj) are rounding, shown as 0, and numbers of a table
/// below this share of the largest of their kind.
const ROUNDING: f64 = 1e-14;

/// A row: words to the left, numbers to the right; a dash stands for one that there is not. Counts are last.
#[derive(Default)]
pub(super) struct Row {
    pub words: Vec<String>,
    pub numbers: Vec<Option<f64>>,
    pub counts: Vec<usize>,
}

impl Row {
    /// A name and its numbers.
    pub fn new(name: impl Into<String>, numbers: impl IntoIterator<Item = f64>) -> Self {
        Self {
            words: vec![name.into()],
            numbers: numbers.into_iter().map(Some).collect(),
            counts: Vec::new(),
        }
    }
}

/// A table with these heads: over words first, then over numbers.
pub(super) fn table(heads: &[&str], rows: &[Row]) -> Markup {
    let words = rows.first().map_or(0, |row| row.words.len());
    html! {
        div.wide { table {
            thead { tr {
                @for (k, head) in heads.iter().enumerate() {
                    @if k < words { th.word { (head) } } @else { th { (head) } }
                }
            } }
            tbody {
                @for row in rows {
                    tr {
                        @for word in &row.words { td.word { (word) } }
                        @for number in &row.numbers { td { (shown(*number)) } }
                        @for count in &row.counts { td { (count) } }
                    }
                }
            }
        } }
    }
}

/// A number of six digits.
fn shown(value: Option<f64>) -> String {
    value.map_or_else(|| "–".into(), number)
}

/// Rows of six components; what is rounding beside the largest of its kind is 0.
pub(super) fn sixes<'a>(
    first: &str,
    heads: [&str; 6],
    rows: impl Iterator<Item = (String, Option<&'a [f64; 6]>)>,
) -> Markup {
    let rows: Vec<_> = rows.collect();
    let largest = |k: usize| {
        let numbers = rows.iter().filter_map(|(_, row)| *row);
        numbers
            .flat_map(|row| &row[k..k + 3])
            .fold(0.0_f64, |most, c| most.max(c.abs()))
    };
    let floors = [largest(0), largest(3)].map(|largest| ROUNDING * largest);
    let clean = |k: usize, value: f64| {
        if value.abs() < floors[k / 3] {
            0.0
        } else {
            value
        }
    };
    let rows: Vec<Row> = rows
        .iter()
        .map(|(name, row)| Row {
            words: vec![name.clone()],
            numbers: (0..6).map(|k| row.map(|row| clean(k, row[k]))).collect(),
            counts: Vec::new(),
        })
        .collect();
    let heads: Vec<&str> = std::iter::once(first).chain(heads).collect();
    table(&heads, &rows)
}

/// A 6×6 matrix; what is rounding beside its diagonal is 0.
pub(super) fn matrix(rows: [&str; 6], columns: [&str; 6], matrix: &Rows) -> Markup {
    let entry = |r: usize, c: usize| {
        let scale = (matrix[r][r] * matrix[c][c]).abs().sqrt();
        match matrix[r][c] {
            entry if entry.abs() < ROUNDING * scale => 0.0,
            entry => entry,
        }
    };
    let named = rows.iter().enumerate();
    let rows: Vec<Row> = named
        .map(|(r, name)| Row::new(*name, (0..6).map(|c| entry(r, c))))
        .collect();
    let heads: Vec<&str> = std::iter::once("").chain(columns).collect();
    table(&heads, &rows)
}

/// A heading and a list; nothing of an empty one.
pub(super) fn list(heading: &str, items: &[String]) -> Markup {
    html! {
        @if !items.is_empty() {
            h3 { (heading) }
            ul { @for item in items { li { (item) } } }
        }
    }
}

/// A drawing and its caption; what kept it from being drawn, where something did.
pub(super) fn figure(drawing: &Drawing) -> Markup {
    match (drawing.svg(), drawing.caption()) {
        (Ok(svg), Ok(caption)) => html! {
            figure { (PreEscaped(svg)) figcaption { (caption) } }
        },
        (Err(why), _) | (_, Err(why)) => html! { p { "A figure is left out: " (why) "." } },
    }
}
