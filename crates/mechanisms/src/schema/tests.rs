//! The book's tables say what the table of terms says.

use std::collections::BTreeSet;
use std::path::Path;

use super::*;
use crate::terms::acting::{ALONG, LOAD};
use crate::terms::bodies::{BODY, MEMBER};
use crate::terms::figures::FIGURE;
use crate::terms::job::{JOB, MODES, POSES};
use crate::terms::joints::JOINT;
use crate::terms::mechanism::COPIED;
use crate::terms::names;
use crate::terms::parts::{MATERIAL, PROFILE};
use crate::text::csv;
use crate::text::tree::MAPS;

/// A table of the book: the heading above it, the first cell of its head, and its rows.
struct Table {
    heading: String,
    first: String,
    rows: Vec<Vec<String>>,
}

fn tables(page: &str) -> Vec<Table> {
    let book = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src");
    let text = std::fs::read_to_string(book.join(page)).unwrap();
    let (mut heading, mut tables, mut inside) = (String::new(), Vec::<Table>::new(), false);
    for line in text.lines() {
        if let Some(row) = line.strip_prefix('|') {
            let cells: Vec<String> = row.split('|').map(|cell| cell.trim().into()).collect();
            match tables.last_mut().filter(|_| inside) {
                Some(_) if row.starts_with("---") => {}
                Some(table) => table.rows.push(cells),
                None => tables.push(Table {
                    heading: heading.clone(),
                    first: cells[0].clone(),
                    rows: Vec::new(),
                }),
            }
            inside = true;
            continue;
        }
        inside = false;
        if line.starts_with('#') {
            heading = line.trim_start_matches('#').trim().into();
        }
    }
    tables
}

/// The names in backquotes of a cell, each up to what follows a word.
fn quoted(cell: &str) -> Vec<String> {
    let parts = cell.split('`').skip(1).step_by(2);
    let word = |part: &str| {
        let word = part.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        word.into_iter().next().unwrap_or_default().to_owned()
    };
    parts.map(word).filter(|word| !word.is_empty()).collect()
}

fn of_rows(table: &Table) -> BTreeSet<String> {
    table.rows.iter().flat_map(|row| quoted(&row[0])).collect()
}

fn set(names: impl IntoIterator<Item = impl Into<String>>) -> BTreeSet<String> {
    names.into_iter().map(Into::into).collect()
}

/// The names of fields, without some.
fn without(names: Vec<&str>, left_out: &[&str]) -> BTreeSet<String> {
    set(names.into_iter().filter(|name| !left_out.contains(name)))
}

fn find<'t>(tables: &'t [Table], heading: &str, first: &str) -> &'t Table {
    let found = |table: &&Table| table.heading == heading && table.first == first;
    tables
        .iter()
        .find(found)
        .unwrap_or_else(|| panic!("no table of {heading}, {first}"))
}

#[test]
fn the_page_of_mechanism_files_has_these_fields() {
    let tables = tables("file-format.md");
    let whole = find(&tables, "Mechanism files", "field");
    assert_eq!(of_rows(whole), set(MECHANISM.names()));
    for row in &whole.rows {
        let field = MECHANISM
            .fields
            .iter()
            .find(|own| own.name == quoted(&row[0])[0]);
        assert_eq!(row[1] == "yes", field.unwrap().required, "{}", row[0]);
    }
    let fields = |heading, first| of_rows(find(&tables, heading, first));
    assert_eq!(fields("Materials", "field"), set(MATERIAL.names()));
    assert_eq!(fields("Joints", "field"), set(JOINT.names()));
    assert_eq!(fields("Loads", "field"), {
        let mut along = set(ALONG);
        along.insert("frame".into());
        assert!(along.is_subset(&set(LOAD.names())));
        along
    });
    for kind in ["Beam", "Frame"] {
        let known = BODY.fields(kind).unwrap();
        assert_eq!(fields(kind, "field"), without(known, &["temperature"]));
    }
    let sections = find(&tables, "Sections", "kind");
    assert_eq!(of_rows(sections), set(PROFILE.names()));
    for row in &sections.rows {
        let known = PROFILE.fields(&quoted(&row[0])[0]).unwrap();
        let known = without(known, &["shear_y", "shear_z"]);
        assert_eq!(set(quoted(&row[1])), known, "{}", row[0]);
    }
    let joints = find(&tables, "Joints", "kind");
    assert_eq!(
        of_rows(joints),
        set(joints::KINDS.iter().map(|kind| kind.name))
    );
    for row in &joints.rows {
        let known = joints::of_kind(&quoted(&row[0])[0]);
        assert_eq!(set(quoted(&row[1])), set(names(known)), "{}", row[0]);
    }
}

#[test]
fn the_page_of_batch_files_has_these_fields() {
    let tables = tables("batch-files.md");
    let first = |first: &str| {
        let table = tables.iter().find(|table| table.first == first);
        of_rows(table.unwrap_or_else(|| panic!("no table of {first}")))
    };
    assert_eq!(first("field of a job"), set(JOB.names()));
    assert_eq!(first("field of `Map`"), set(FIGURE.fields("Map").unwrap()));
    assert_eq!(first("`figures:`"), set(FIGURE.names()));
    assert_eq!(first("field"), set(MODES.names()));
    let mut poses: BTreeSet<String> = set(POSES.names());
    poses.remove("Drives");
    assert_eq!(first("`poses:`"), poses);
}

#[test]
fn the_page_of_prebuilt_mechanisms_has_these_fields() {
    let tables = tables("prebuilt.md");
    let registry = Registry::builtin();
    for (kind, known) in registry.known_prebuilts() {
        assert!(matches!(known, Known::Fields(_)), "{kind}");
        let table = find(&tables, kind, "field");
        assert_eq!(of_rows(table), set(known.names()), "{kind}");
    }
}

#[test]
fn every_field_is_told_in_one_line() {
    let text = schema(&Registry::builtin());
    let schema: Value = serde_json::from_str(&text).unwrap();
    let mut count = 0;
    for definition in schema["$defs"].as_object().unwrap().values() {
        let properties = definition["properties"].as_object();
        for (name, property) in properties.into_iter().flatten() {
            let about = property["description"].as_str();
            assert!(about.is_some_and(|about| !about.is_empty()), "{name}");
            count += 1;
        }
    }
    assert!(count > 60, "{count}");
}

/// What the reader of JSON takes for names follows from the table, and so do the axes of a grid.
#[test]
fn fields_that_hold_names_are_known_to_the_reader() {
    let of_map = FIGURE.kinds.iter().find(|kind| kind.name == "Map");
    let of_map = match of_map.map(|kind| &kind.arguments) {
        Some(Arguments::Fields(fields)) => *fields,
        _ => &[],
    };
    let maps = [
        MECHANISM.fields,
        JOB.fields,
        COPIED.fields,
        MEMBER.fields,
        of_map,
    ]
    .concat();
    let maps = maps.iter().filter(|field| matches!(field.of, Type::Map(_)));
    assert_eq!(set(maps.map(|field| field.name)), set(MAPS));
    assert_eq!(POSES.fields("Grid").unwrap(), csv::COLUMNS);
}
