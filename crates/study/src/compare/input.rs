//! What differs in what is written: parameters, and the parts of both mechanisms as files state them.

use std::collections::BTreeMap;

use hyperstat_mechanisms::{Registry, Value};
use serde::Serialize;
use serde_json::{Map, Value as Json};

use crate::study::Study;

/// Numbers differ where they do by more than this part of the largest of their kind: less is rounding of
/// computed coordinates.
const ROUNDING: f64 = 1e-12;

/// A value that is another in the second mechanism.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InputDifference {
    /// Its path, as `vary` takes it.
    pub path: String,
    /// It in each of the two, as a file states it (SI); `None` where there is none.
    pub values: [Option<Json>; 2],
}

/// The same difference of one part or of several.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PartDifference {
    /// What they are: `points`, `bodies`, `joints` …
    pub of: String,
    /// Which of them: their names, or numbers, from 0, of what has no name.
    pub names: Vec<String>,
    /// What of them, such as `section.diameter`; empty where it is the whole.
    pub field: String,
    /// It in each of the two, as a file states it (SI); `None` where there is none.
    pub values: [Option<Json>; 2],
}

/// Parameters of the mechanisms, and what jobs vary, that differ.
pub(super) fn parameters(studies: [&Study; 2]) -> Vec<InputDifference> {
    let of = studies.map(|study| {
        let parameters = study.dependences().into_iter();
        let mut values: BTreeMap<_, _> = parameters.map(|of| (of.path, number(of.value))).collect();
        for (path, value) in study.varied_values() {
            // A parameter may be named without its map.
            if !values.contains_key(&format!("parameters.{path}")) {
                values.insert(
                    path,
                    match value {
                        Value::Number(value) => number(value),
                        other => Json::String(other.to_string()),
                    },
                );
            }
        }
        values
    });
    let [first, second] = &of;
    let paths = first
        .keys()
        .chain(second.keys().filter(|path| !first.contains_key(*path)));
    let differences = paths.map(|path| InputDifference {
        path: path.clone(),
        values: of.each_ref().map(|values| values.get(path).cloned()),
    });
    differences
        .filter(|found| found.values[0] != found.values[1])
        .collect()
}

/// What of the mechanisms differs; `None` where one has parts that no file can state.
pub(super) fn parts(studies: [&Study; 2]) -> Option<Vec<PartDifference>> {
    let [first, second] = studies.map(leaves);
    let [first, second] = [first?, second?];
    let size = lengths(&first).max(lengths(&second));
    let differ = |[a, b]: [Option<&Json>; 2], of: &str| match (a, b) {
        (Some(a), Some(b)) => !same(a, b, if of == "points" { size } else { 0.0 }),
        _ => true,
    };
    let mut found: Vec<PartDifference> = Vec::new();
    let places = first
        .keys()
        .chain(second.keys().filter(|key| !first.contains_key(*key)));
    for place @ Place { of, name, field } in places {
        let values = [first.get(place), second.get(place)];
        // Of a part that only one has, this is all that is told.
        let whole = |k: usize| {
            let place = Place {
                field: String::new(),
                ..place.clone()
            };
            [&first, &second][k].contains_key(&place)
        };
        let told = field.is_empty() || whole(0) == whole(1);
        if !told || !differ(values, of) {
            continue;
        }
        let values = values.map(|value| value.cloned());
        let alike = |other: &&mut PartDifference| {
            other.of == *of && other.field == *field && other.values == values
        };
        match found.iter_mut().find(alike) {
            Some(alike) => alike.names.push(name.clone()),
            None => found.push(PartDifference {
                of: of.clone(),
                names: vec![name.clone()],
                field: field.clone(),
                values,
            }),
        }
    }
    Some(found)
}

/// Where a value stands: of what kind of part, of which, and what of it.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    of: String,
    name: String,
    field: String,
}

type Leaves = BTreeMap<Place, Json>;

/// All values of a mechanism, sections and materials as those of the bodies that have them.
fn leaves(study: &Study) -> Option<Leaves> {
    // Kinds of joints of others are written by their names, which are all that is compared of them.
    let text = study.mechanism_file_json(&Registry::builtin()).ok()?;
    let Ok(Json::Object(mut file)) = serde_json::from_str(&text) else {
        return None;
    };
    let shared = ["sections", "materials"].map(|kind| match file.remove(kind) {
        Some(Json::Object(shared)) => shared,
        _ => Map::new(),
    });
    file.remove("name");
    let mut leaves = Leaves::new();
    for (of, parts) in file {
        let named: Vec<(String, Json)> = match parts {
            Json::Object(parts) => parts.into_iter().collect(),
            Json::Array(parts) if parts.iter().all(Json::is_object) => {
                let numbered = parts.into_iter().enumerate();
                numbered.map(|(k, part)| (k.to_string(), part)).collect()
            }
            other => vec![(String::new(), other)],
        };
        for (name, part) in named {
            let mut add = |field: &str, value: Json| {
                let (of, name, field) = (of.clone(), name.clone(), field.to_string());
                leaves.insert(Place { of, name, field }, value);
            };
            flatten(part, "", &shared, &mut add);
        }
    }
    Some(leaves)
}

/// Calls `add` with every value below a node and its path; a kind such as `Circle(…)` is a value of its
/// own and no step of the path.
fn flatten(
    node: Json,
    path: &str,
    shared: &[Map<String, Json>; 2],
    add: &mut impl FnMut(&str, Json),
) {
    let below = |field: &str| match path {
        "" => field.to_string(),
        path => format!("{path}.{field}"),
    };
    match node {
        Json::Object(fields) => {
            let fields = match kind(&fields) {
                Some(kind) => {
                    add(path, Json::String(kind.clone()));
                    match fields.into_iter().next() {
                        Some((_, Json::Object(inner))) => inner,
                        Some((_, inner)) => Map::from_iter([("of".to_string(), inner)]),
                        None => return,
                    }
                }
                None if path.is_empty() => {
                    add("", Json::Bool(true));
                    fields
                }
                None => fields,
            };
            for (field, inner) in fields {
                let inner = resolved(&field, inner, shared);
                flatten(inner, &below(&field), shared, add);
            }
        }
        Json::Array(items) if items.iter().any(Json::is_object) => {
            for (k, item) in items.into_iter().enumerate() {
                flatten(item, &below(&k.to_string()), shared, add);
            }
        }
        value => add(path, value),
    }
}

/// The kind of a node that is one, such as `Circle` of `{"Circle": {…}}`.
fn kind(fields: &Map<String, Json>) -> Option<&String> {
    let (name, _) = fields.iter().next().filter(|_| fields.len() == 1)?;
    name.starts_with(char::is_uppercase).then_some(name)
}

/// A section or a material in the place of its name.
fn resolved(field: &str, value: Json, shared: &[Map<String, Json>; 2]) -> Json {
    let shared = match field {
        "section" | "sections" => &shared[0],
        "material" => &shared[1],
        _ => return value,
    };
    let of = |value: Json| match value {
        Json::String(name) => shared.get(&name).cloned().unwrap_or(Json::String(name)),
        other => other,
    };
    match value {
        Json::Array(items) => Json::Array(items.into_iter().map(of).collect()),
        value => of(value),
    }
}

/// Whether two values are the same but for rounding, beside numbers of a size.
fn same(a: &Json, b: &Json, size: f64) -> bool {
    if let (Json::Array(first), Json::Array(second)) = (a, b)
        && first.iter().chain(second).any(Json::is_array)
    {
        let mut pairs = first.iter().zip(second);
        return first.len() == second.len() && pairs.all(|(a, b)| same(a, b, size));
    }
    let numbers = |value: &Json| match value {
        Json::Array(items) => items.iter().map(Json::as_f64).collect(),
        value => value.as_f64().map(|number| vec![number]),
    };
    let (Some(first), Some(second)) = (numbers(a), numbers(b)) else {
        return a == b;
    };
    let all = || first.iter().chain(&second);
    let scale = all().fold(size, |largest, number| largest.max(number.abs()));
    let mut pairs = first.iter().zip(&second);
    first.len() == second.len() && pairs.all(|(a, b)| (a - b).abs() <= ROUNDING * scale)
}

/// The largest coordinate.
fn lengths(leaves: &Leaves) -> f64 {
    let points = leaves.iter().filter(|(place, _)| place.of == "points");
    let numbers = points.flat_map(|(_, point)| point.as_array().into_iter().flatten());
    numbers
        .filter_map(Json::as_f64)
        .fold(0.0, |size, c| size.max(c.abs()))
}

fn number(value: f64) -> Json {
    serde_json::Number::from_f64(value).map_or(Json::Null, Json::Number)
}
