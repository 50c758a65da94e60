//! `hyperstat check`: counts, idle motions, and 2 exactly when `solve` ends with 2.

use serde_json::Value;

use crate::support::{Bench, CANTILEVER, delta_batch, hinged};

#[test]
fn a_sound_file_is_counted() {
    let bench = Bench::new("check-sound");
    let batch = delta_batch("delta", "List([(0.0, 0.0, 0.45)])", "");
    bench.file("delta.ron", &batch);
    let text = bench.hyperstat(&["check", "delta.ron"]).ends_with(0);
    for line in [
        "mobility         3",
        "over-constraint  12",
        "idle motions     0",
        "can be solved",
    ] {
        assert!(text.out().contains(line), "no `{line}` in\n{}", text.out());
    }
    let outcome = bench.hyperstat(&["check", "delta.ron", "--format", "json"]);
    let report = outcome.ends_with(0).json();
    assert_eq!(report["solvable"], true);
    assert_eq!(report["mobility"], 3);
    assert_eq!(report["overconstraint"], 12);
    assert_eq!(report["unknowns"], 114);
    assert_eq!(report["problem"], Value::Null);
}

#[test]
fn idle_motions_are_named() {
    let bench = Bench::new("check-idle");
    let batch = delta_batch("delta", "List([(0.0, 0.0, 0.45)])", "").replace(
        "rod_spacing: 0.12,",
        "rod_spacing: 0.12, rod_ends: Spherical,",
    );
    bench.file("delta.ron", &batch);
    let outcome = bench.hyperstat(&["check", "delta.ron"]).ends_with(0);
    // Six rods, and six cross links whose joints all lie on one line.
    assert!(
        outcome.out().contains("idle motions     12"),
        "{}",
        outcome.out()
    );
    assert!(
        outcome.out().contains("`roda1` spins about its own axis"),
        "{}",
        outcome.out()
    );
}

#[test]
fn it_ends_with_2_exactly_when_solve_does() {
    let bench = Bench::new("check-agrees");
    let unheld = CANTILEVER.replace("joints: {", "joints: {}, unknown_field: {");
    let idle_load = hinged().replace(r#"on: ("bar", "B")"#, r#"on: ("bar", "A")"#);
    let files = [
        ("sound.ron", CANTILEVER.to_string(), 0),
        ("free-output.ron", idle_load, 2),
        ("load-on-free.ron", hinged(), 2),
        ("unknown-field.ron", unheld, 2),
        ("no-syntax.ron", "(name: ".into(), 2),
        (
            "nothing-holds.ron",
            CANTILEVER.replace(
                r#"joints: { "wall": (at: "A", between: ("ground", "bar"), kind: Fixed) },"#,
                "joints: {},",
            ),
            2,
        ),
    ];
    for (name, text, status) in files {
        bench.file(name, &text);
        let solved = bench.hyperstat(&["solve", name]).ends_with(status);
        let checked = bench.hyperstat(&["check", name]).ends_with(status);
        assert_eq!(solved.err(), checked.err());
        let report = bench
            .hyperstat(&["check", name, "--format", "json"])
            .ends_with(status)
            .json();
        assert_eq!(report["solvable"], status == 0, "{name}");
        assert_eq!(report["problem"].is_null(), status == 0, "{name}");
        if status == 2 {
            assert_eq!(report["problem"]["path"], name);
            assert!(report["problem"]["line"].as_u64().unwrap() >= 1);
        }
    }
}

#[test]
fn what_nothing_resists_is_listed_where_there_is_no_solution() {
    let bench = Bench::new("check-free-motions");
    bench.file("hinged.ron", &hinged());
    let outcome = bench.hyperstat(&["check", "hinged.ron", "--format", "json"]);
    let report = outcome.ends_with(2).json();
    assert_eq!(report["mobility"], 1);
    assert_eq!(report["unknowns"], Value::Null);
    let motions = report["free_motions"].as_array().unwrap();
    assert_eq!(motions.len(), 1);
    assert!(
        motions[0]
            .as_str()
            .unwrap()
            .starts_with("`bar` turns about")
    );
    assert_eq!(report["problem"]["line"], 8);
}

/// A load on an idle rod leaves no solution; the rod is idle all the same.
#[test]
fn idle_motions_are_counted_where_there_is_no_solution() {
    let bench = Bench::new("check-idle-loaded");
    let batch = delta_batch("delta", "List([(0.0, 0.0, 0.45)])", "")
        .replace(
            "rod_spacing: 0.12,",
            "rod_spacing: 0.12, rod_ends: Spherical,",
        )
        .replace(r#"("platform", "P")"#, r#"("roda1", "Ba1")"#);
    bench.file("delta.ron", &batch);
    let outcome = bench.hyperstat(&["check", "delta.ron", "--format", "json"]);
    let report = outcome.ends_with(2).json();
    assert_eq!(report["solvable"], false);
    assert_eq!(report["unknowns"], Value::Null);
    assert_eq!(report["idle_modes"], 12);
    assert_eq!(report["idle_motions"].as_array().unwrap().len(), 12);
}
