//! `hyperstat solve`: the report, its JSON, and what the reference data say.

use std::f64::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::support::{Bench, CANTILEVER, assert_near, delta_batch, hinged, numbers};

/// Numbers that must be equal are formed in other ways here.
const EXACT: f64 = 1e-12;

#[test]
fn the_json_of_a_cantilever_is_the_textbook_s() {
    let bench = Bench::new("solve-cantilever");
    bench.file("cantilever.ron", CANTILEVER);
    let outcome = bench.hyperstat(&["solve", "cantilever.ron", "--format", "json"]);
    let report = outcome.ends_with(0).json();

    assert_eq!(report["name"], "cantilever");
    assert_eq!(report["unknowns"], 6);
    assert_eq!(report["mobility"], 0);
    assert_eq!(report["overconstraint"], 0);
    assert_eq!(report["idle_modes"], 0);
    assert_eq!(report["undetermined"], Value::Array(vec![]));
    assert_eq!(report["warnings"], Value::Array(vec![]));

    let (force, torque, length, radius) = (100.0, 10.0, 0.5_f64, 0.01_f64);
    let (young, shear) = (2.1e11, 2.1e11 / 2.6);
    let second_moment = PI * radius.powi(4) / 4.0;
    let polar = 2.0 * second_moment;
    let sag = force * length.powi(3) / (3.0 * young * second_moment);
    let slope = force * length.powi(2) / (2.0 * young * second_moment);
    let twist = torque * length / (shear * polar);
    let expected = [0.0, 0.0, -sag, twist, slope, 0.0];
    for displacement in [
        &report["output"]["displacement"],
        &report["displacements"]["bar.B"],
    ] {
        for (found, expected) in numbers(displacement).into_iter().zip(expected) {
            assert_near(found, expected, EXACT, twist);
        }
    }

    // What the wall does to the bar.
    let wrench = numbers(&report["joints"]["wall"]["wrench"]);
    let reaction = [0.0, 0.0, force, -torque, -force * length, 0.0];
    for (found, expected) in wrench.into_iter().zip(reaction) {
        assert_near(found, expected, EXACT, force);
    }

    let segment = &report["segments"][0];
    assert_eq!(segment["body"], "bar");
    assert_eq!(segment["points"], serde_json::json!(["A", "B"]));
    // Of an upright section along x, local z is global z and local y global y.
    for (found, expected) in numbers(&segment["end_forces"][1])
        .into_iter()
        .zip([0.0, 0.0, -force, torque, 0.0, 0.0])
    {
        assert_near(found, expected, EXACT, force);
    }
    let normal = force * length * radius / second_moment;
    let torsion = torque * radius / polar;
    let mises = (normal.powi(2) + 3.0 * torsion.powi(2)).sqrt();
    let stress = &segment["stress"];
    assert_near(stress["normal"].as_f64().unwrap(), normal, EXACT, normal);
    assert_near(stress["shear"].as_f64().unwrap(), torsion, EXACT, torsion);
    assert_near(stress["von_mises"].as_f64().unwrap(), mises, EXACT, mises);
}

#[test]
fn the_report_shows_what_an_engineer_looks_for() {
    let bench = Bench::new("solve-text");
    bench.file("cantilever.ron", CANTILEVER);
    let outcome = bench.hyperstat(&["solve", "cantilever.ron", "--full"]);
    let outcome = outcome.ends_with(0);
    let expected = [
        "mobility         0",
        "over-constraint  0",
        "unknowns         6",
        "Stiffness of the output",
        "Compliance of the output",
        "bar.B",
        "wall",
        "von Mises",
        "6.36620e7",
    ];
    for part in expected {
        assert!(
            outcome.out().contains(part),
            "no `{part}` in\n{}",
            outcome.out()
        );
    }
    assert_eq!(outcome.err(), "");
}

#[test]
fn the_report_states_its_loads_and_no_rounding() {
    let bench = Bench::new("solve-loads");
    let more = r#"gravity: (0.0, 0.0, -9.81),
    cases: {
        "wind": [(on: "bar", per_length: (0.0, 2.0, 0.0)), (on: ("bar", "B"), force: (1.0, 0.0, 0.0))],
        "rest": [],
    },
    output:"#;
    let dense = CANTILEVER.replace("poisson: 0.3", "poisson: 0.3, density: 7850.0");
    let warm = dense
        .replace("density: 7850.0", "density: 7850.0, expansion: 1.2e-5")
        .replace(
            "material: \"steel\")",
            "material: \"steel\", temperature: 20.0)",
        );
    bench.file("bar.ron", &warm.replacen("output:", more, 1));
    let outcome = bench
        .hyperstat(&["solve", "bar.ron", "--full"])
        .ends_with(0);
    let mut lines = outcome.out().lines();
    for line in [
        "Gravity",
        "  (0, 0, -9.81000) m/s² on all masses, in every case too",
        "Temperature [K], in every case too",
        "  bar   20.0000",
        "Loads [N, N·m]",
        "  on     axes    Fx  Fy        Fz       Mx  My  Mz",
        "  bar.B  global   0   0  -100.000  10.0000   0   0",
        "Loads of case `wind` [N, N·m]",
        "  bar.B  global  1.00000   0   0   0   0   0",
        "Loads of case `wind`, along beams [N/m, N]",
        "  bar.A-B  A   global   0  2.00000   0   0   0   0",
        "  bar.A-B  B   global   0  2.00000   0   0   0   0",
        "Loads of case `rest`",
        "  none",
        "Displacements of the nodes [m, rad]",
    ] {
        assert!(
            lines.any(|found| found == line),
            "no `{line}`, or not there, in\n{}",
            outcome.out()
        );
    }
    let noise = ["e-15", "e-16", "e-17", "e-18"];
    let noise = noise
        .into_iter()
        .find(|digits| outcome.out().contains(digits));
    assert_eq!(noise, None, "{}", outcome.out());
}

#[test]
fn an_output_that_moves_freely_is_told_and_ends_with_2() {
    let bench = Bench::new("solve-free");
    // A load on the hinge's own point does no work.
    let text = hinged().replace(r#"on: ("bar", "B")"#, r#"on: ("bar", "A")"#);
    bench.file("hinged.ron", &text);
    let outcome = bench.hyperstat(&["solve", "hinged.ron", "--format", "json"]);
    let outcome = outcome.ends_with(2);
    outcome.says(&[
        "hinged.ron:9:",
        "output",
        "`bar` turns about (0, ",
        "locked: true",
    ]);
    let report = outcome.json();
    assert_eq!(report["mobility"], 1);
    assert_eq!(report["output"]["compliance"], Value::Null);
    assert!(report["output"]["stiffness"].is_array());
    assert_eq!(
        report["output"]["free_motions"].as_array().unwrap().len(),
        1
    );
}

#[test]
fn a_load_on_a_free_motion_ends_with_2_at_the_load() {
    let bench = Bench::new("solve-load-on-free");
    bench.file("hinged.ron", &hinged());
    let outcome = bench.hyperstat(&["solve", "hinged.ron"]).ends_with(2);
    outcome.says(&["hinged.ron:8:", "load", "`bar` turns about (0, "]);
    assert_eq!(outcome.out(), "");
}

#[test]
fn a_rigidly_held_output_has_a_compliance_and_no_stiffness() {
    let bench = Bench::new("solve-rigid-output");
    let text = CANTILEVER.replace(r#"output: ("bar", "B")"#, r#"output: ("bar", "A")"#);
    bench.file("held.ron", &text);
    let outcome = bench.hyperstat(&["solve", "held.ron", "--format", "json"]);
    let output = &outcome.ends_with(0).json()["output"];
    assert_eq!(output["stiffness"], Value::Null);
    assert_eq!(output["rigid_directions"].as_array().unwrap().len(), 6);
    for row in output["compliance"].as_array().unwrap() {
        assert!(numbers(row).iter().all(|c| *c == 0.0));
    }
    let text = bench.hyperstat(&["solve", "held.ron"]).ends_with(0);
    assert!(text.out().contains("held rigidly"), "{}", text.out());
}

#[test]
fn the_order_of_the_file_is_kept() {
    let bench = Bench::new("solve-order");
    let batch = delta_batch("delta", "List([(0.0, 0.0, 0.45)])", "");
    bench.file("delta.ron", &batch);
    let outcome = bench.hyperstat(&["solve", "delta.ron", "--format", "json"]);
    let outcome = outcome.ends_with(0);
    let place = |name: &str| {
        let quoted = format!("\"{name}\": {{");
        outcome
            .out()
            .find(&quoted)
            .unwrap_or_else(|| panic!("no {quoted}"))
    };
    assert!(place("A1") < place("A2") && place("A2") < place("A3"));
    let report = outcome.json();
    assert_eq!(report["unknowns"], 114);
    assert_eq!(report["mobility"], 3);
    assert_eq!(report["overconstraint"], 12);
    assert_eq!(
        (&report["job"], &report["pose"]),
        (&"delta".into(), &0.into())
    );
}

#[test]
fn a_pose_of_a_batch_is_chosen_by_job_and_number() {
    let bench = Bench::new("solve-batch");
    let batch = delta_batch(
        "delta",
        "List([(0.0, 0.0, 0.45), (0.05, 0.0, 0.5), (9.0, 0.0, 0.5)])",
        "",
    );
    bench.file("delta.ron", &batch);
    let arguments = [
        "solve",
        "delta.ron",
        "--format",
        "json",
        "--job",
        "delta",
        "--pose",
    ];
    let pose = |number| bench.hyperstat(&[&arguments[..], &[number]].concat());
    let report = pose("1").ends_with(0).json();
    assert_eq!(report["pose"], 1);
    let at = numbers(&report["output"]["position"]);
    assert_near(at[0], 0.05, EXACT, 1.0);
    assert_near(at[2], 0.5, EXACT, 1.0);
    pose("2").ends_with(2).says(&["delta.ron:4:", "pose 2"]);
    pose("3")
        .ends_with(2)
        .says(&["delta.ron:4:", "no pose 3", "3 poses", "0 to 2"]);
}

#[test]
fn options_of_a_batch_are_refused_where_they_mean_nothing() {
    let bench = Bench::new("solve-options");
    bench.file("cantilever.ron", CANTILEVER);
    let outcome = bench.hyperstat(&["solve", "cantilever.ron", "--pose", "0"]);
    outcome.ends_with(2).says(&["--pose", "mechanism file"]);

    let one = r#"(name: "NAME", mechanism: File("cantilever.ron"))"#;
    let jobs = [one.replace("NAME", "first"), one.replace("NAME", "second")];
    bench.file("two.ron", &format!("(jobs: [{}])", jobs.join(",\n")));
    let outcome = bench.hyperstat(&["solve", "two.ron"]);
    outcome
        .ends_with(2)
        .says(&["several jobs", "first, second"]);
    let outcome = bench.hyperstat(&["solve", "two.ron", "--job", "thrid"]);
    outcome
        .ends_with(2)
        .says(&["no job `thrid`", "first, second"]);
    bench
        .hyperstat(&["solve", "two.ron", "--job", "second"])
        .ends_with(0);
}

#[cfg(target_os = "linux")]
#[test]
fn a_report_that_cannot_be_written_ends_with_3() {
    let bench = Bench::new("solve-full");
    bench.file("cantilever.ron", CANTILEVER);
    let full = fs::File::create("/dev/full").unwrap();
    let outcome = bench.hyperstat_into(&["solve", "cantilever.ron"], full);
    outcome
        .ends_with(3)
        .says(&["cannot write to standard output"]);
}

/// The reference data, where the workspace is there.
fn references() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/reference");
    let mut paths: Vec<_> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "ron"))
        .collect();
    paths.sort();
    paths
}

#[test]
fn every_reference_file_is_solved() {
    let bench = Bench::new("solve-reference");
    let references = references();
    let is_workspace = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../tests/Cargo.toml")
        .exists();
    assert!(!is_workspace || !references.is_empty());
    for path in references {
        let expected: Value =
            serde_json::from_str(&fs::read_to_string(path.with_extension("json")).unwrap())
                .unwrap();
        let outcome = bench.hyperstat(&["solve", path.to_str().unwrap(), "--format", "json"]);
        let report = outcome.ends_with(0).json();
        for count in ["mobility", "overconstraint", "idle_modes"] {
            assert_eq!(
                report[count],
                expected[count],
                "{count} of {}",
                path.display()
            );
        }
        let redundant = report["redundant_constraints"].as_array().unwrap();
        let overconstraint = report["overconstraint"].as_u64().unwrap();
        assert_eq!(redundant.len() as u64, overconstraint, "{}", path.display());
        let found: Vec<_> = rows(&report["output"]["stiffness"]);
        let wanted: Vec<_> = rows(&expected["output_stiffness"]);
        for r in 0..6 {
            for c in 0..6 {
                let scale = (wanted[r][r] * wanted[c][c]).sqrt();
                assert_near(found[r][c], wanted[r][c], 1e-8, scale);
            }
        }
    }
}

fn rows(matrix: &Value) -> Vec<Vec<f64>> {
    matrix.as_array().unwrap().iter().map(numbers).collect()
}

#[test]
fn all_nodes_adds_those_inside_segments_and_changes_nothing_else() {
    let bench = Bench::new("solve-all-nodes");
    let divided = CANTILEVER.replace("material: \"steel\")", "material: \"steel\", elements: 4)");
    bench.file("cantilever.ron", &divided);
    let plain = bench.hyperstat(&["solve", "cantilever.ron", "--format", "json"]);
    let plain = plain.ends_with(0).json();
    let outcome = bench.hyperstat(&["solve", "cantilever.ron", "--all-nodes", "--format", "json"]);
    let mut all = outcome.ends_with(0).json();

    let (force, length) = (100.0, 0.5);
    let rigidity = 2.1e11 * PI * 0.01_f64.powi(4) / 4.0;
    for k in 1..=3 {
        let found = numbers(&all["displacements"][format!("bar.A-B.{k}")]);
        let x = length * f64::from(k) / 4.0;
        let sag = -force * x * x * (3.0 * length - x) / (6.0 * rigidity);
        assert_near(found[2], sag, EXACT, sag.abs());
    }
    let names = all["displacements"].as_object_mut().unwrap();
    assert_eq!(names.len(), 5);
    names.retain(|name, _| !name.contains('-'));
    assert_eq!(all, plain);

    let outcome = bench.hyperstat(&["solve", "cantilever.ron", "--all-nodes"]);
    assert!(outcome.ends_with(0).out().contains("  bar.A-B.3  "));
    let outcome = bench.hyperstat(&["solve", "cantilever.ron"]);
    assert!(!outcome.ends_with(0).out().contains("A-B."));
}
