//! Comparisons of mechanisms whose differences are known.

use std::path::Path;

use hyperstat_mechanisms::{Disk, Registry, mechanism_from_str};
use serde_json::json;

use super::{Comparison, Pair};
use crate::ask::Focus;
use crate::study::Study;

/// A round bar held at one end.
const BAR: &str = r#"(
    name: "bar",
    parameters: { "d": 0.02, "length": 0.5 },
    materials: { "steel": (young: 2.1e11, poisson: 0.3, density: 7850.0) },
    sections: { "rod": Circle(diameter: "= d") },
    points: { "A": (0.0, 0.0, 0.0), "B": ("= length", 0.0, 0.0) },
    bodies: { "bar": Beam(through: ["A", "B"], section: "rod", material: "steel") },
    joints: { "wall": (at: "A", between: ("ground", "bar"), kind: Fixed) },
    loads: [(on: ("bar", "B"), force: (0.0, 0.0, -100.0))],
    output: ("bar", "B"),
)"#;

fn study(changes: &[(&str, &str)]) -> Study {
    let mut text = BAR.to_string();
    for (from, to) in changes {
        assert!(text.contains(from), "no `{from}`");
        text = text.replace(from, to);
    }
    let mechanism = mechanism_from_str(&text, Path::new("bar.ron"), &Disk, &Registry::builtin());
    Study::of_mechanism(mechanism.unwrap_or_else(|error| panic!("{error}")))
}

fn compared(changes: &[(&str, &str)]) -> Comparison {
    Comparison::new([&study(&[]), &study(changes)], &Focus::default()).unwrap()
}

#[track_caller]
fn ratio(pairs: &[Pair], name: &str, expected: f64) {
    let pair = pairs.iter().find(|pair| pair.name == name).unwrap();
    let found = pair.ratio.unwrap();
    assert!(
        (found / expected - 1.0).abs() < 1e-10,
        "{name}: {found} {expected}"
    );
}

/// Euler and Bernoulli: bending as d⁴, tension as d², frequencies of bending as d, mass as d².
#[test]
fn a_thicker_bar_differs_by_powers_of_its_diameter() {
    let found = compared(&[("\"d\": 0.02", "\"d\": 0.022")]);
    let [parameter] = &found.parameters[..] else {
        panic!("{:?}", found.parameters)
    };
    assert_eq!(parameter.path, "parameters.d");
    assert_eq!(parameter.values, [Some(json!(0.02)), Some(json!(0.022))]);
    let parts = found.parts.as_ref().unwrap();
    let [part] = &parts[..] else {
        panic!("{parts:?}")
    };
    assert_eq!(
        (&*part.of, &*part.names, &*part.field),
        ("bodies", &["bar".to_string()][..], "section.diameter")
    );
    let q: f64 = 1.1;
    let results = &found.results;
    ratio(&results.stiffness, "k11", q.powi(2));
    ratio(&results.stiffness, "k33", q.powi(4));
    ratio(&results.displacement, "dz", q.powi(-4));
    ratio(&results.measures, "deflection", q.powi(-4));
    ratio(&results.measures, "pure_force_stiffness_min", q.powi(4));
    ratio(&results.frequencies, "mass", q.powi(2));
    ratio(&results.frequencies, "f1", q);
    ratio(&results.counts, "unknowns", 1.0);
    let budget = results.budget.as_ref().unwrap();
    assert_eq!(budget.of, "displacement");
    ratio(
        std::slice::from_ref(&budget.total),
        "deflection",
        q.powi(-4),
    );
    ratio(&budget.by_part, "bar", q.powi(-4));
}

#[test]
fn names_and_rounding_are_no_difference() {
    let same = compared(&[
        ("\"rod\"", "\"tube of another name\""),
        ("\"steel\"", "\"S355\""),
        ("(0.0, 0.0, 0.0), \"B\"", "(1e-17, 0.0, -1e-17), \"B\""),
        ("name: \"bar\"", "name: \"the same\""),
    ]);
    assert_eq!(same.parts, Some(Vec::new()));
    assert!(same.parameters.is_empty());
    let stiffness = &same.results.stiffness;
    assert!(
        stiffness
            .iter()
            .all(|pair| (pair.ratio.unwrap() - 1.0).abs() < 1e-12)
    );
}

#[test]
fn a_part_that_one_has_is_told_once() {
    let found = compared(&[
        (
            "kind: Fixed",
            "kind: Fixed, stiffness: (x: 1e8, y: 1e8, z: 1e8)",
        ),
        (
            "name: \"bar\",",
            "name: \"bar\", gravity: (0.0, 0.0, -9.81),",
        ),
        ("force: (0.0, 0.0, -100.0)", "force: (0.0, 0.0, -200.0)"),
        (
            "joints: {",
            "masses: [(on: (\"bar\", \"B\"), mass: 2.0)], joints: {",
        ),
    ]);
    let parts = found.parts.unwrap();
    let told = |of: &str, field: &str| {
        let mut alike = parts
            .iter()
            .filter(|part| part.of == of && part.field == field);
        let one = alike
            .next()
            .unwrap_or_else(|| panic!("{of} {field}: {parts:#?}"));
        assert!(alike.next().is_none(), "{parts:#?}");
        one.values.clone()
    };
    assert_eq!(told("joints", "stiffness.x"), [None, Some(json!(1e8))]);
    assert_eq!(told("gravity", ""), [None, Some(json!([0.0, 0.0, -9.81]))]);
    assert_eq!(
        told("loads", "force"),
        [
            Some(json!([0.0, 0.0, -100.0])),
            Some(json!([0.0, 0.0, -200.0]))
        ]
    );
    assert_eq!(told("masses", ""), [None, Some(json!(true))]);
    // Nothing of a mass that only one has but that it is there.
    assert!(
        !parts
            .iter()
            .any(|part| part.of == "masses" && part.field == "mass")
    );
}

#[test]
fn equal_changes_are_told_together() {
    let two = [(
        "bodies: { \"bar\": Beam(through: [\"A\", \"B\"], section: \"rod\", material: \"steel\") }",
        "bodies: { \"bar\": Beam(through: [\"A\", \"B\"], section: \"rod\", material: \"steel\", elements: 3) }",
    )];
    let found = compared(&two);
    let parts = found.parts.unwrap();
    assert_eq!(parts.len(), 1, "{parts:?}");
    assert_eq!(parts[0].field, "elements");
    // The exact beam has the same stiffness in any number of elements.
    let stiffness = &found.results.stiffness;
    assert!(
        stiffness
            .iter()
            .all(|pair| (pair.ratio.unwrap() - 1.0).abs() < 1e-9)
    );
}
