//! What differs between two mechanisms, or between two tables.

use std::fmt::Write as _;

use hyperstat_study::{
    ColumnDifference, Comparison, InputDifference, Pair, PartDifference, TableComparison,
};
use serde_json::Value as Json;

use hyperstat_study::figure::in_words;

use super::parts::section;
use super::table::{Table, left, number};

/// Lines of a list that the text tells; JSON has all.
const TOLD: usize = 15;
/// Numbers of one kind that the text tells, enough for all measures.
const MOST: usize = 22;
/// Names that are told of parts that differ alike.
const NAMES: usize = 4;
/// Ratios this near to 1 are told as no difference.
const SAME: f64 = 1e-9;

/// The comparison of two mechanisms as text.
pub(crate) fn compared(found: &Comparison) -> String {
    let [a, b] = &found.names;
    let mut text = format!("A  {a}\nB  {b}\n");
    if !found.parameters.is_empty() {
        let lines = found.parameters.iter().map(parameter);
        section(
            &mut text,
            "Parameters and what the job varies: A → B",
            lines_of(lines),
        );
    }
    match &found.parts {
        None => section(
            &mut text,
            "What differs in the mechanisms",
            "  One has parts that no file can state: they are not compared.\n",
        ),
        Some(parts) if parts.is_empty() => {
            section(&mut text, "What differs in the mechanisms", "  Nothing.\n");
        }
        Some(parts) => {
            let lines = parts.iter().map(part);
            section(
                &mut text,
                "What differs in the mechanisms: A → B",
                lines_of(lines),
            );
        }
    }
    let results = &found.results;
    let all: Vec<&Pair> = results.pairs().collect();
    if all.iter().all(|pair| is_same(pair)) {
        section(&mut text, "What is found", "  The same of both.\n");
        return text;
    }
    let groups = [
        ("Displacement of the output", &results.displacement),
        ("Stiffness of the output", &results.stiffness),
        ("Measures", &results.measures),
        ("Mass and natural frequencies", &results.frequencies),
    ];
    let counts = results.counts.iter().filter(|pair| !pair.is_same());
    let counts: Vec<_> = counts.map(count).collect();
    if !counts.is_empty() {
        section(&mut text, "Counts: A → B", lines_of(counts.into_iter()));
    }
    for (heading, pairs) in groups {
        pairs_section(&mut text, heading, pairs);
    }
    if let Some(budget) = &results.budget {
        let whole = std::slice::from_ref(&budget.total);
        let heading = format!(
            "Where the {} comes from, {}",
            budget.total.name,
            in_words(&budget.along)
        );
        pairs_section(&mut text, &heading, whole);
        pairs_section(&mut text, "By deformation", &budget.by_deformation);
        pairs_section(&mut text, "By bodies and joints", &budget.by_part);
    }
    text
}

/// Those of some numbers that differ, as a table under a heading; nothing where none does.
fn pairs_section(text: &mut String, heading: &str, pairs: &[Pair]) {
    let differ: Vec<&Pair> = pairs.iter().filter(|pair| !is_same(pair)).collect();
    if differ.is_empty() {
        return;
    }
    let mut table = Table::new(1, &["", "A", "B", "B/A"]);
    for pair in differ.iter().take(MOST) {
        let name = match &*pair.unit {
            "" => pair.name.clone(),
            unit => format!("{} [{unit}]", pair.name),
        };
        let [a, b] = pair.values;
        table.row(&[&name], [a, b, pair.ratio]);
    }
    let mut more = match differ.len().saturating_sub(MOST) {
        0 => String::new(),
        left => format!("  … and {left} more\n"),
    };
    more += &match pairs.len() - differ.len() {
        0 => String::new(),
        1 => "  and 1 that is the same\n".into(),
        same => format!("  and {same} that are the same\n"),
    };
    section(text, heading, format!("{table}{more}"));
}

/// A count of each.
fn count(pair: &Pair) -> [String; 2] {
    let [a, b] = pair.values.map(|value| value.unwrap_or(0.0).to_string());
    [pair.name.clone(), format!("{a} → {b}")]
}

fn is_same(pair: &Pair) -> bool {
    pair.is_same() || pair.ratio.is_some_and(|ratio| (ratio - 1.0).abs() < SAME)
}

fn parameter(found: &InputDifference) -> [String; 2] {
    [found.path.clone(), change(&found.values)]
}

fn part(found: &PartDifference) -> [String; 2] {
    let names = match &*found.names {
        [name] => name.clone(),
        names => {
            let told = names
                .iter()
                .take(NAMES)
                .cloned()
                .collect::<Vec<_>>()
                .join(", ");
            let more = if names.len() > NAMES { ", …" } else { "" };
            format!("{told}{more} ({})", names.len())
        }
    };
    let parts = [&*found.of, &*names, &*found.field];
    let parts: Vec<_> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    [parts.join(" "), change(&found.values)]
}

/// Lines of two columns, the first as wide as it has to be.
fn lines_of(lines: impl Iterator<Item = [String; 2]>) -> String {
    let lines: Vec<_> = lines.collect();
    let told = &lines[..lines.len().min(TOLD)];
    let width = told
        .iter()
        .map(|[name, _]| name.chars().count())
        .max()
        .unwrap_or(0);
    let mut text = String::new();
    for [name, change] in told {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "  {}  {change}", left(name, width));
    }
    if lines.len() > told.len() {
        let _ = writeln!(text, "  … and {} more", lines.len() - told.len());
    }
    text
}

fn change(values: &[Option<Json>; 2]) -> String {
    let [a, b] = values.each_ref().map(|value| match value {
        None => "none".to_string(),
        Some(Json::String(text)) => text.clone(),
        Some(Json::Bool(true)) => "there".into(),
        Some(value) => shown(value),
    });
    format!("{a} → {b}")
}

/// A value as an engineer reads it.
fn shown(value: &Json) -> String {
    match value {
        Json::Number(given) => given.as_f64().map_or_else(|| given.to_string(), number),
        Json::Array(items) => {
            let items: Vec<_> = items.iter().map(shown).collect();
            format!("({})", items.join(", "))
        }
        Json::String(text) => text.clone(),
        other => other.to_string(),
    }
}

/// The comparison of two tables as text.
pub(crate) fn compared_tables(found: &TableComparison) -> String {
    let [a, b] = &found.names;
    let mut text = format!(
        "A  {}, {} rows\nB  {}, {} rows\n",
        a.display(),
        found.rows[0],
        b.display(),
        found.rows[1]
    );
    let by = match (found.matched.by, found.matched.off) {
        ("pose", _) => "of the same pose".to_string(),
        (_, Some(off)) => format!(
            "of the same number, though their poses differ by up to {}",
            number(off)
        ),
        (_, None) => "of the same number".into(),
    };
    let _ = writeln!(text, "{} rows {by} are compared.", found.matched.rows);
    for (k, name) in ["A", "B"].iter().enumerate() {
        if !found.only_in[k].is_empty() {
            let _ = writeln!(
                text,
                "Only {name} has the columns {}.",
                found.only_in[k].join(", ")
            );
        }
    }
    let changed = found
        .statuses
        .iter()
        .filter(|count| count.statuses[0] != count.statuses[1]);
    let lines: Vec<_> = changed
        .map(|count| {
            let [a, b] = &count.statuses;
            let rows = format!(
                "{} rows, the first is row {} of A",
                count.rows, count.first_row
            );
            [format!("{a} → {b}"), rows]
        })
        .collect();
    if !lines.is_empty() {
        section(
            &mut text,
            "Statuses that differ: A → B",
            lines_of(lines.into_iter()),
        );
    }
    if found.columns.is_empty() {
        section(&mut text, "Numbers", "  The same in all rows.\n");
        return text;
    }
    let heads = ["", "row", "A", "B", "least B/A", "median", "greatest"];
    let mut table = Table::new(2, &heads);
    for column in &found.columns {
        row(&mut table, column);
    }
    section(
        &mut text,
        "Where the two are furthest apart, and the ratios of all rows",
        table,
    );
    if !found.same.is_empty() {
        let _ = writeln!(text, "  the same in all rows: {}", found.same.join(", "));
    }
    text
}

fn row(table: &mut Table, column: &ColumnDifference) {
    let name = match &*column.unit {
        "" => column.column.clone(),
        unit => format!("{} [{unit}]", column.column),
    };
    let at = column
        .furthest
        .map_or_else(String::new, |found| found.row.to_string());
    let values = column.furthest.map(|found| found.values);
    let ratios = column
        .ratio
        .map(|ratio| [ratio.least, ratio.median, ratio.most]);
    let numbers = [values.map(|v| v[0]), values.map(|v| v[1])];
    let ratios = [0, 1, 2].map(|k| ratios.map(|ratios| ratios[k]));
    table.row(&[&name, &at], numbers.into_iter().chain(ratios));
}
