//! `hyperstat export`: a mechanism written out solves to the same numbers.

use serde_json::Value;

use crate::support::{Bench, CANTILEVER, assert_near, delta_batch, numbers};

/// What the last digits of the joints' axes may change.
const LAST_DIGITS: f64 = 1e-12;

#[test]
fn a_pose_of_a_batch_is_written_as_a_mechanism_file() {
    let bench = Bench::new("export-pose");
    let poses = "List([(0.0, 0.0, 0.45), (0.05, -0.03, 0.5)])";
    bench.file("delta.ron", &delta_batch("delta", poses, ""));
    let chosen = ["delta.ron", "--job", "delta", "--pose", "1"];
    let exported = bench.hyperstat(&[&["export"], &chosen[..]].concat());
    let exported = exported.ends_with(0);
    assert_eq!(exported.err(), "");
    for part in [
        "\"arm1\": Beam(through: [\"A1\", \"B1\"], section: \"arm1\", material: \"arm1\", y_axis: (",
        "\"arm1\": (young: 210000000000.0, poisson: 0.3, density: 7850.0)",
        "\"arm1\": Circle(diameter: 0.03)",
        "kind: Revolute(axis: (",
        "locked: true",
        "\"P\": (0.05, -0.03, 0.5)",
        "output: (\"platform\", \"P\")",
    ] {
        assert!(
            exported.out().contains(part),
            "no `{part}` in\n{}",
            exported.out()
        );
    }

    bench.file("written.ron", exported.out());
    let solve = |arguments: &[&str]| {
        let outcome = bench.hyperstat(&[&["solve", "--format", "json"], arguments].concat());
        outcome.ends_with(0).json()
    };
    let (found, expected) = (solve(&["written.ron"]), solve(&chosen));
    for count in [
        "name",
        "unknowns",
        "mobility",
        "overconstraint",
        "idle_modes",
    ] {
        assert_eq!(found[count], expected[count], "{count}");
    }
    let rows = |report: &Value| -> Vec<Vec<f64>> {
        let rows = report["output"]["stiffness"].as_array().unwrap();
        rows.iter().map(numbers).collect()
    };
    let (k, wanted) = (rows(&found), rows(&expected));
    for (r, c) in (0..36).map(|entry| (entry / 6, entry % 6)) {
        let scale = (wanted[r][r] * wanted[c][c]).sqrt();
        assert_near(k[r][c], wanted[r][c], LAST_DIGITS, scale);
    }
    let displacement = |report: &Value| numbers(&report["output"]["displacement"]);
    for (u, wanted) in displacement(&found)
        .into_iter()
        .zip(displacement(&expected))
    {
        assert_near(u, wanted, LAST_DIGITS, 1e-3);
    }
}

#[test]
fn a_file_is_written_with_out() {
    let bench = Bench::new("export-out");
    bench.file("cantilever.ron", CANTILEVER);
    let shown = bench.hyperstat(&["export", "cantilever.ron"]).ends_with(0);
    let outcome = bench.hyperstat(&["export", "cantilever.ron", "--out", "again.ron"]);
    assert_eq!(outcome.ends_with(0).out(), "");
    assert_eq!(bench.read("again.ron"), shown.out());
    assert_eq!(bench.names("."), ["again.ron", "cantilever.ron"]);
    let nowhere = bench.hyperstat(&["export", "cantilever.ron", "--out", "no/folder.ron"]);
    nowhere.ends_with(3).says(&["cannot write no/folder.ron"]);
}

#[test]
fn a_pose_that_cannot_be_reached_is_refused() {
    let bench = Bench::new("export-unreachable");
    let poses = "List([(0.0, 0.0, 0.45), (9.0, 0.0, 0.5)])";
    bench.file("delta.ron", &delta_batch("delta", poses, ""));
    let outcome = bench.hyperstat(&["export", "delta.ron", "--pose", "1"]);
    outcome.ends_with(2).says(&["delta.ron:4:", "pose 1"]);
}
