//! What pages are put together from: tables, matrices, lists, figures.

use maud::{Markup, PreEscaped, html};

use crate::answer::Rows;
use crate::figure::Drawing;
use crate::number::{Rounding, number, without_rounding};

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
    let rounding = Rounding::of(rows.iter().filter_map(|(_, row)| *row));
    let shown = |(name, row): &(String, Option<&[f64; 6]>)| Row {
        words: vec![name.clone()],
        numbers: match row {
            Some(row) => rounding.shown(row).map(Some).into(),
            None => vec![None; 6],
        },
        ..Row::default()
    };
    let rows: Vec<Row> = rows.iter().map(shown).collect();
    let heads: Vec<&str> = std::iter::once(first).chain(heads).collect();
    table(&heads, &rows)
}

/// A 6×6 matrix; what is rounding beside its diagonal is 0.
pub(super) fn matrix(rows: [&str; 6], columns: [&str; 6], matrix: &Rows) -> Markup {
    let named = rows.iter().zip(without_rounding(matrix));
    let rows: Vec<Row> = named.map(|(name, row)| Row::new(*name, row)).collect();
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
