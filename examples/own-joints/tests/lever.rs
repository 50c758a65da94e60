//! The binary with joints of its own: its numbers, and its messages.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

const LEVER: &str = include_str!("../lever.ron");

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_own-joints"))
        .args(arguments)
        .output()
        .unwrap()
}

/// Solves a changed lever; `name` is that of the test.
fn solve(name: &str, text: &str) -> Output {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let file = folder.join(format!("{name}.ron"));
    fs::write(&file, text).unwrap();
    let file = file.to_str().unwrap();
    run(&["solve", file, "--verify", "--format", "json"])
}

#[track_caller]
fn report(output: &Output) -> Value {
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{error}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn the_lever_is_solved_as_by_the_independent_solver() {
    let report = report(&solve("lever", LEVER));
    assert_eq!(report["mobility"], 0);
    assert_eq!(report["idle_modes"], 0);
    assert_eq!(report["warnings"], Value::Array(vec![]));
    let verification = &report["verification"];
    assert_eq!(verification["disagreements"], Value::Array(vec![]));
    for what in ["stiffness", "compliance", "displacements", "joint_wrenches"] {
        let difference = number(&verification[what]);
        assert!(difference < 1e-10, "{what}: {difference:e}");
    }
}

/// Without the rod's lower joint the lever hangs on its pivot, which turns by `F l / (2 E I / L)`;
/// the lever's own bending comes on top.
#[test]
fn without_its_rod_the_lever_hangs_on_the_blades() {
    let text = LEVER.replace(
        r#""bottom": (at: "D", between: ("rod", "ground"), kind: Spherical),"#,
        "",
    );
    let text = text.replace(
        "kind: OffsetUniversal",
        "locked: true, kind: OffsetUniversal",
    );
    let report = report(&solve("hanging", &text));
    assert_eq!(report["mobility"], 3);
    let second_moment = 0.01 * 0.0005_f64.powi(3) / 12.0;
    let pivot = 2.0 * 2.1e11 * second_moment / 0.05;
    let lever = 50.0 * 0.3_f64.powi(2) / (2.0 * 2.1e11 * 0.02 * 0.03_f64.powi(3) / 12.0);
    let expected = 50.0 * 0.3 / pivot + lever;
    let found = number(&report["output"]["displacement"][4]);
    assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
}

/// The offset is not for show: with it the lever's side stiffness is another.
#[test]
fn the_offset_changes_the_stiffness() {
    let stiffness = |report: &Value| number(&report["output"]["stiffness"][1][1]);
    let skew = stiffness(&report(&solve("skew", LEVER)));
    let crossing = LEVER.replace("offset: 0.015", "offset: 0.0");
    let built_in = crossing
        .replace("OffsetUniversal", "Universal")
        .replace(", offset: 0.0)", ")");
    let crossing = stiffness(&report(&solve("crossing", &crossing)));
    let built_in = stiffness(&report(&solve("built-in", &built_in)));
    assert!((crossing / built_in - 1.0).abs() < 1e-12);
    assert!((skew / crossing - 1.0).abs() > 1e-6);
}

#[test]
fn a_mistake_is_told_at_its_place() {
    let cases = [
        ("angle: 0.7853981633974483", "angle: 45.0", "`angle` is 45"),
        ("thickness: 0.0005", "thickness: 0.0", "`thickness` is 0"),
        (
            ", poisson: 0.3,\n            )",
            ",\n            )",
            "poisson",
        ),
        ("offset: 0.015", "offset: \"15 mn\"", "`mn` is no unit"),
        ("offset: 0.015", "ofset: 0.015", "`offset`"),
        (
            "(1.0, 0.0, 0.0)), offset",
            "(0.0, 2.0, 0.0)), offset",
            "parallel",
        ),
    ];
    for (k, (right, wrong, message)) in cases.into_iter().enumerate() {
        assert!(LEVER.contains(right), "{right}");
        let output = solve(&format!("mistake-{k}"), &LEVER.replace(right, wrong));
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(message), "no `{message}` in\n{error}");
        assert!(error.contains(&format!("mistake-{k}.ron:")), "{error}");
    }
}

#[test]
fn export_says_that_a_kind_has_no_writer() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/lever.ron");
    let output = run(&["export", file]);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains("how a `CrossSpring` is written"), "{error}");
}
