//! What `solve --verify`, `solve --allow-free` and `check` say beyond the numbers.

use serde_json::Value;

use crate::support::{Bench, CANTILEVER, delta_batch, hinged};

/// The paper's delta, one drive forgotten, without loads: written out by `export`.
fn delta_without_a_drive(bench: &Bench) -> String {
    let batch = delta_batch("delta", "List([(0.0, 0.0, 0.45)])", "");
    let load = batch.lines().find(|line| line.contains("loads:")).unwrap();
    bench.file("delta.ron", &batch.replace(load, "            loads: [],"));
    let exported = bench.hyperstat(&["export", "delta.ron"]).ends_with(0);
    exported.out().replacen(", locked: true", "", 1)
}

#[test]
fn verify_reports_the_largest_differences() {
    let bench = Bench::new("verify");
    let batch = delta_batch("delta", "List([(0.03, 0.02, 0.45)])", "");
    bench.file("delta.ron", &batch);
    let outcome = bench.hyperstat(&["solve", "delta.ron", "--verify", "--format", "json"]);
    let report = outcome.ends_with(0).json();
    let verification = &report["verification"];
    for what in ["stiffness", "compliance", "displacements", "joint_wrenches"] {
        let difference = verification[what].as_f64().unwrap();
        assert!((0.0..1e-12).contains(&difference), "{what}: {difference:e}");
    }
    assert_eq!(verification["disagreements"], Value::Array(vec![]));
    assert_eq!(report["warnings"], Value::Array(vec![]));

    let outcome = bench.hyperstat(&["solve", "delta.ron", "--verify"]);
    let text = outcome.ends_with(0);
    for part in [
        "Verification by the independent solver",
        "output stiffness",
        "joint wrenches",
    ] {
        assert!(text.out().contains(part), "{}", text.out());
    }
    let outcome = bench.hyperstat(&["solve", "delta.ron", "--format", "json"]);
    assert_eq!(outcome.ends_with(0).json().get("verification"), None);
}

#[test]
fn verify_leaves_idle_bodies_and_undetermined_wrenches_out() {
    let bench = Bench::new("verify-idle");
    let batch = delta_batch("delta", "List([(0.03, 0.02, 0.45)])", "").replace(
        "rod_spacing: 0.12,",
        "rod_spacing: 0.12, rod_ends: Spherical,",
    );
    bench.file("delta.ron", &batch);
    let outcome = bench.hyperstat(&["solve", "delta.ron", "--verify", "--format", "json"]);
    let report = outcome.ends_with(0).json();
    assert_eq!(report["idle_modes"], 12);
    assert_eq!(report["warnings"], Value::Array(vec![]));
    assert!(report["verification"]["displacements"].as_f64().unwrap() < 1e-12);
}

#[test]
fn a_model_too_large_to_verify_is_told() {
    let bench = Bench::new("verify-large");
    let text = CANTILEVER.replace(
        "material: \"steel\")",
        "material: \"steel\", elements: 100000)",
    );
    assert_ne!(text, CANTILEVER);
    bench.file("long.ron", &text);
    let outcome = bench
        .hyperstat(&["solve", "long.ron", "--verify"])
        .ends_with(2);
    outcome.says(&["independent solver", "at most", "leave `--verify` out"]);
}

#[test]
fn a_forgotten_drive_is_named() {
    let bench = Bench::new("free-drive");
    let text = delta_without_a_drive(&bench);
    bench.file("free.ron", &text);
    let outcome = bench.hyperstat(&["solve", "free.ron"]).ends_with(2);
    outcome.says(&[
        "the output `platform.P` moves freely",
        "`platform` moves along (",
        "hold the drive that is missing (`locked: true`, or `stiffness`): one of `A1.v`, `B1.v`",
        "--allow-free",
    ]);
    // What the message proposes is true.
    let held = text.replacen(
        "Revolute(axis: (1.0, 0.0, 0.0))",
        "Fixed(axis: (1.0, 0.0, 0.0))",
        1,
    );
    assert_ne!(held, text);
    bench.file("held.ron", &held);
    bench.hyperstat(&["solve", "held.ron"]).ends_with(0);
}

#[test]
fn allow_free_takes_a_free_output_as_a_result() {
    let bench = Bench::new("allow-free");
    bench.file("free.ron", &delta_without_a_drive(&bench));
    let arguments = [
        "solve",
        "free.ron",
        "--allow-free",
        "--verify",
        "--format",
        "json",
    ];
    let outcome = bench.hyperstat(&arguments).ends_with(0);
    assert_eq!(outcome.err(), "");
    let report = outcome.json();
    assert_eq!(report["output"]["compliance"], Value::Null);
    assert_eq!(
        report["output"]["free_motions"].as_array().unwrap().len(),
        1
    );
    assert!(report["verification"]["stiffness"].as_f64().unwrap() < 1e-12);
    assert_eq!(report["warnings"], Value::Array(vec![]));

    // A load on the free motion has no equilibrium, allowed or not.
    bench.file("hinged.ron", &hinged());
    let outcome = bench.hyperstat(&["solve", "hinged.ron", "--allow-free"]);
    outcome
        .ends_with(2)
        .says(&["hinged.ron:8:", "nothing resists"]);
}

#[test]
fn redundant_constraints_are_named_by_joint_and_direction() {
    let bench = Bench::new("redundant");
    let batch = delta_batch("delta", "List([(0.0, 0.0, 0.45)])", "");
    bench.file("delta.ron", &batch);
    for command in ["check", "solve"] {
        let outcome = bench.hyperstat(&[command, "delta.ron", "--format", "json"]);
        let report = outcome.ends_with(0).json();
        let groups = report["redundant_constraints"].as_array().unwrap();
        assert_eq!(groups.len(), 12, "{command}");
        assert!(
            groups
                .iter()
                .all(|group| group.as_array().unwrap().len() > 1)
        );
        // A parallelogram's four hinges cannot tilt about one line without each other.
        let tilt = serde_json::json!(["Ba1.u", "Ca1.u", "Bb1.u", "Cb1.u"]);
        assert!(groups.contains(&tilt), "{command}: {groups:?}");
    }
    let text = bench.hyperstat(&["check", "delta.ron"]).ends_with(0);
    assert!(
        text.out().contains("  - Ba1.u Ca1.u Bb1.u Cb1.u\n"),
        "{}",
        text.out()
    );
}

#[test]
fn check_names_what_the_locked_drives_leave_free() {
    let bench = Bench::new("check-free");
    bench.file("free.ron", &delta_without_a_drive(&bench));
    let outcome = bench.hyperstat(&["check", "free.ron", "--format", "json"]);
    let report = outcome.ends_with(2).json();
    assert_eq!(report["idle_modes"], 0);
    let motions = report["free_motions"].as_array().unwrap();
    assert_eq!(motions.len(), 1);
    assert!(
        motions[0]
            .as_str()
            .unwrap()
            .starts_with("`arm1` turns about (1, 0, 0) through A1")
    );
    let text = bench.hyperstat(&["check", "free.ron"]).ends_with(2);
    assert!(
        text.out().contains("Motions that nothing resists"),
        "{}",
        text.out()
    );

    bench.file("cantilever.ron", CANTILEVER);
    let outcome = bench.hyperstat(&["check", "cantilever.ron", "--format", "json"]);
    let report = outcome.ends_with(0).json();
    assert_eq!(report["free_motions"], Value::Array(vec![]));
    assert_eq!(report["redundant_constraints"], Value::Array(vec![]));
}
