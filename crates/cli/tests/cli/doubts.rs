//! What is accepted but can hardly be meant: warnings of `solve` and `check`, each once, and notes.

use serde_json::Value;

use crate::support::Bench;

/// A beam and a rigid plate on it, with everything that can hardly be meant.
const DOUBTFUL: &str = r#"(
    name: "doubtful",
    materials: { "steel": (young: 2.1e11, poisson: 0.3, density: 7850.0) },
    sections: {
        "odd": General(area: 1e-4, iy: 1e-9, iz: 1e-9, torsion: 5e-9, shear_y: 2e-4),
    },
    points: { "A": (0.0, 0.0, 0.0), "B": (0.5, 0.0, 0.0), "C": (0.5, 0.5, 0.0), "D": (1.0, 0.0, 0.0), "E": (2.0, 0.0, 0.0) },
    bodies: {
        "beam": Beam(through: ["A", "B", "C"], section: "odd", material: "steel"),
        "plate": Rigid(points: ["C"]),
        "stone": Rigid(points: ["B"]),
    },
    joints: {
        "foot": (at: "A", between: ("ground", "beam"), kind: Fixed),
        "head": (at: "C", between: ("beam", "plate"), kind: Fixed),
        "side": (at: "B", between: ("beam", "stone"), kind: Fixed),
    },
    gravity: (0.0, 0.0, -9.81),
    masses: [(on: ("stone", "B"), mass: 2.0, inertia: (1.0, 1.0, 5.0))],
    loads: [(on: ("plate", "C")), (on: ("plate", "C"))],
    output: ("plate", "C"),
)"#;

const WARNINGS: [&str; 5] = [
    "gravity acts, but body `plate` has no mass",
    "no body has the inertia of the mass on `stone.B`",
    "`shear_y` of body `beam`",
    "the torsion constant of body `beam`",
    "the load on `plate.C` has neither force nor moment",
];

#[test]
fn what_can_hardly_be_meant_is_a_warning_once() {
    let bench = Bench::new("doubts");
    bench.file("m.ron", DOUBTFUL);
    for command in ["solve", "check"] {
        let text = bench.hyperstat(&[command, "m.ron"]).ends_with(0);
        let json = bench.hyperstat(&[command, "m.ron", "--format", "json"]);
        let json = json.ends_with(0).json();
        let warnings = json["warnings"].as_array().unwrap();
        assert_eq!(warnings.len(), WARNINGS.len(), "{warnings:?}");
        for (warning, words) in warnings.iter().zip(WARNINGS) {
            assert!(warning.as_str().unwrap().starts_with(words), "{warning}");
            assert_eq!(text.out().matches(words).count(), 1, "{words}");
        }
    }
    let json = bench
        .hyperstat(&["check", "m.ron", "--format", "json"])
        .json();
    let notes = Value::from(vec!["no body runs through the points `D`, `E`"]);
    assert_eq!(json["notes"], notes);
    let text = bench.hyperstat(&["check", "m.ron"]);
    assert!(
        text.out()
            .contains("Notes\n  - no body runs through the points `D`, `E`\n")
    );
}

/// A stiffness of 0 frees: a bar on a `Fixed` with `w: 0.0` and on a pad of zeros is a hinged bar.
#[test]
fn a_stiffness_of_zero_counts_as_a_freedom() {
    let bench = Bench::new("doubts-zero");
    let file = |kind: &str| {
        format!(
            r#"(
    name: "bar",
    points: {{ "A": (0.0, 0.0, 0.0), "B": (0.5, 0.0, 0.0) }},
    bodies: {{ "bar": Rigid(points: ["A", "B"]) }},
    joints: {{
        "hinge": (at: "A", between: ("ground", "bar"), {kind}),
        "pad": (at: "B", between: ("ground", "bar"), kind: Fixed, stiffness: (x: 0.0, y: 0.0, z: 0.0, u: 0.0, v: 0.0, w: 0.0)),
    }},
    output: ("bar", "B"),
)"#
        )
    };
    for kind in [
        "kind: Fixed, stiffness: (w: 0.0)",
        "kind: Revolute(axis: (0.0, 0.0, 1.0))",
    ] {
        bench.file("m.ron", &file(kind));
        let check = bench.hyperstat(&["check", "m.ron", "--format", "json"]);
        let json = check.ends_with(2).json();
        assert_eq!(
            (&json["mobility"], &json["overconstraint"]),
            (&1.into(), &0.into())
        );
        assert_eq!(json["redundant_constraints"], Value::Array(Vec::new()));
        let solve = ["solve", "m.ron", "--format", "json", "--allow-free"];
        let json = bench.hyperstat(&solve).ends_with(0).json();
        assert_eq!(
            (&json["mobility"], &json["overconstraint"]),
            (&1.into(), &0.into())
        );
    }
}

/// The stiffness of a full matrix has no direction.
#[test]
fn a_full_matrix_is_named_once() {
    let bench = Bench::new("doubts-matrix");
    let row = |k: usize| {
        let entry = |c: usize| if c == k { "1e6" } else { "0.0" };
        format!("({})", (0..6).map(entry).collect::<Vec<_>>().join(", "))
    };
    let matrix = (0..6).map(row).collect::<Vec<_>>().join(", ");
    let file = DOUBTFUL.replace(
        r#"("ground", "beam"), kind: Fixed"#,
        &format!(r#"("ground", "beam"), kind: Fixed, stiffness: Matrix([{matrix}])"#),
    );
    bench.file("m.ron", &file);
    let json = bench.hyperstat(&["solve", "m.ron", "--why", "--format", "json"]);
    let json = json.ends_with(0).json();
    let sensitivities = json["sensitivities"].as_array().unwrap();
    let names = sensitivities.iter().filter_map(|s| s["parameter"].as_str());
    let names: Vec<_> = names.filter(|name| name.contains("stiffness")).collect();
    assert_eq!(names, ["stiffness of foot"]);
}

/// A rigid output has no stiffness, but a displacement.
#[test]
fn a_rigid_row_has_a_displacement() {
    let bench = Bench::new("doubts-rigid");
    bench.file(
        "m.ron",
        r#"(
    name: "slide",
    points: { "A": (0.0, 0.0, 0.0), "B": (0.5, 0.0, 0.0) },
    bodies: { "bar": Rigid(points: ["A", "B"]) },
    joints: { "slide": (at: "A", between: ("ground", "bar"), kind: Prismatic(axis: (1.0, 0.0, 0.0)), locked: true, stiffness: (y: 1e5)) },
    loads: [(on: ("bar", "B"), force: (10.0, 0.0, 0.0))],
    cases: { "back": [(on: ("bar", "B"), force: (-20.0, 0.0, 0.0))] },
    output: ("bar", "B"),
)"#,
    );
    bench.file(
        "b.ron",
        r#"(jobs: [(name: "job", mechanism: File("m.ron"))])"#,
    );
    bench
        .hyperstat(&["run", "b.ron", "--out", "out"])
        .ends_with(1);
    let table = bench.read("out/job.csv");
    let mut lines = table
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let (names, row) = (lines.next().unwrap(), lines.next().unwrap());
    let cell = |name: &str| row[names.iter().position(|n| *n == name).unwrap()];
    assert_eq!(cell("status"), "rigid");
    let number = |name: &str| cell(name).parse::<f64>().unwrap();
    assert!((number("dx") - 1e-4).abs() < 1e-18 && (number("back.dx") + 2e-4).abs() < 1e-18);
    assert_eq!((number("dy"), cell("k11"), cell("k66")), (0.0, "", ""));
}
