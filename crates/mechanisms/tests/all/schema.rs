//! The JSON Schema takes what the reader takes, and finds what is misspelt.

use std::path::Path;

use hyperstat_mechanisms::{Disk, Registry, begin, beginnings, load_str, schema, to_json};
use serde_json::Value;

use crate::fuzzing::seeds;

fn validator() -> jsonschema::Validator {
    let schema: Value = serde_json::from_str(&schema(&Registry::builtin())).unwrap();
    jsonschema::draft202012::meta::validate(&schema).unwrap_or_else(|error| panic!("{error}"));
    jsonschema::draft202012::new(&schema).unwrap()
}

fn json(text: &str, path: &Path) -> Option<Value> {
    let text = to_json(text, path).ok()?;
    Some(serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}\n{text}")))
}

#[test]
fn what_the_reader_takes_is_valid() {
    let validator = validator();
    let registry = Registry::builtin();
    let mut count = 0;
    let begun = beginnings().into_iter().map(|kind| {
        let text = begin(&kind).unwrap();
        (kind.into(), text)
    });
    // A kind of their own is theirs alone.
    let own = |path: &Path| path.to_string_lossy().contains("own-joints");
    for (path, text) in seeds(Path::new("../.."), "ron").into_iter().chain(begun) {
        if own(&path) || load_str(&text, &path, &Disk, &registry).is_err() {
            continue;
        }
        let json = json(&text, &path).unwrap();
        if let Err(error) = validator.validate(&json) {
            panic!("{}: {} at {}", path.display(), error, error.instance_path());
        }
        count += 1;
    }
    assert!(count > 50, "{count}");
}

/// How messages begin about what is misspelt, missing or of another kind.
const SLIPS: [&str; 9] = [
    "unknown field",
    "unknown kind",
    "unknown joint kind",
    "unknown mechanism",
    "unknown figure",
    "unknown `",
    "expected ",
    "neither `poisson` nor `shear`",
    "both `poisson` and `shear`",
];

/// Files whose mistake is one of what the values mean together, or of RON alone; what begins with
/// `batch_vary` is about paths, `expression` about expressions.
const ELSEWHERE: [&str; 12] = [
    "batch_figure_scale_negative",
    "batch_grid_missing_axis",
    "elements_of_an_expression",     // a value
    "mechanism_elements_with_point", // 2.0 is whole in JSON Schema
    "mechanism_frame_without_section",
    "mechanism_gravity_without_density",
    "mechanism_load_from_without_to",
    "mechanism_point_as_list",
    "mechanism_temperature_without_expansion",
    "slip_no_quotes",
    "slip_pose_decimal_commas",
    "slip_single_quotes_of_one_letter",
];

#[test]
fn what_is_misspelt_is_found() {
    let validator = validator();
    let registry = Registry::builtin();
    let (mut found, mut missed) = (0, Vec::new());
    for (path, text) in seeds(Path::new("../.."), "ron") {
        let (Some(json), Err(error)) =
            (json(&text, &path), load_str(&text, &path, &Disk, &registry))
        else {
            continue;
        };
        let message = error.message();
        let here = error.location().is_some_and(|at| at.path == path);
        let missing = message.contains(" has no `") && message.ends_with('`');
        let slip = missing || SLIPS.iter().any(|slip| message.contains(slip));
        let stem = path.file_stem().unwrap().to_str().unwrap();
        // What an expression says is not for a schema.
        let begins = |start: &&str| stem.starts_with(start);
        let begins = ["batch_vary", "batch_expression", "expression"]
            .iter()
            .any(begins);
        let elsewhere = ELSEWHERE.contains(&stem) || begins;
        if !here || !slip || elsewhere {
            continue;
        }
        match validator.is_valid(&json) {
            false => found += 1,
            true => missed.push(format!("{}: {message}", path.display())),
        }
    }
    assert!(
        missed.is_empty() && found > 60,
        "{found} found, missed:\n{}",
        missed.join("\n")
    );
}

#[test]
fn kinds_of_ones_own_are_in_it() {
    let mut registry = Registry::builtin();
    registry.register("Slotted", &["slot"], |_| unreachable!());
    registry.register_prebuilt("Own", &["reach"], |_| unreachable!());
    let schema: Value = serde_json::from_str(&schema(&registry)).unwrap();
    let kinds = &schema["$defs"]["joint_kind"]["anyOf"];
    assert!(
        kinds[0]["enum"]
            .as_array()
            .unwrap()
            .contains(&"Slotted".into())
    );
    let slot = &kinds[1]["properties"]["Slotted"]["properties"]["slot"];
    assert!(slot.is_object());
    let own = &schema["$defs"]["job_mechanism"]["anyOf"][1]["properties"]["Own"];
    assert!(own["properties"]["reach"].is_object());
}
