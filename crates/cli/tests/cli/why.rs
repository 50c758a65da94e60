//! `hyperstat solve --why`: budget, measures and sensitivities, and the worst points.

use std::f64::consts::PI;

use serde_json::Value;

use crate::support::{Bench, CANTILEVER, delta_batch, numbers};

/// Nothing more than the job has anyway.
const LOADS: &str = "";

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

fn near(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-11 * expected.abs(),
        "{found} {expected}"
    );
}

/// 100 N across and 10 N·m about the axis of a round bar: all bending along z, all torsion about x.
#[test]
fn why_a_cantilever_gives() {
    let bench = Bench::new("why-cantilever");
    bench.file("cantilever.ron", CANTILEVER);
    let why = |along: &[&str]| {
        let arguments = [
            &["solve", "cantilever.ron", "--format", "json", "--why"],
            along,
        ]
        .concat();
        bench.hyperstat(&arguments).ends_with(0).json()
    };
    let report = why(&[]);
    let budget = &report["budget"];
    assert_eq!(budget["of"], "displacement");
    let sag = -number(&report["output"]["displacement"][2]);
    near(number(&budget["total"]), sag);
    assert_eq!(budget["parts"].as_array().unwrap().len(), 1);
    assert_eq!(budget["parts"][0]["body"], "bar");
    assert_eq!(budget["parts"][0]["deformation"], "bending");
    near(number(&budget["parts"][0]["share"]), 1.0);
    // The sag goes with 1/(E d⁴).
    let relative = |report: &Value, parameter: &str| {
        let all = report["sensitivities"].as_array().unwrap();
        let found = all.iter().find(|s| s["parameter"] == parameter);
        number(&found.unwrap_or_else(|| panic!("no {parameter}"))["relative"])
    };
    near(relative(&report, "sections.rod.diameter"), -4.0);
    near(relative(&report, "materials.steel.young"), -1.0);
    assert_eq!(
        report["sensitivities"][0]["parameter"],
        "sections.rod.diameter"
    );
    // The twist with 2 (1 + ν)/(E d⁴).
    let twist = why(&["--along", "rx"]);
    assert_eq!(twist["budget"]["parts"][0]["deformation"], "torsion");
    near(relative(&twist, "materials.steel.poisson"), 0.3 / 1.3);
    // Held at one end, free to turn at the other: 3 EI/L³ against a pure force.
    let inertia = PI * 0.02_f64.powi(4) / 64.0;
    let compliances = &report["measures"]["translational_compliances"]["values"];
    near(
        number(&compliances[2]),
        0.5_f64.powi(3) / (3.0 * 2.1e11 * inertia),
    );
    let stiffness = &report["measures"]["translational_stiffnesses"]["values"];
    near(
        number(&stiffness[0]),
        12.0 * 2.1e11 * inertia / 0.5_f64.powi(3),
    );
    // A bar's centre of stiffness is its middle.
    let centre = numbers(&report["measures"]["centre_of_stiffness"]);
    near(centre[0], 0.25);
}

#[test]
fn the_worst_point_of_a_cantilever_is_at_the_wall() {
    let bench = Bench::new("why-worst");
    bench.file(
        "cantilever.ron",
        &CANTILEVER.replace("poisson: 0.3", "poisson: 0.3, yield: 2e8"),
    );
    let report = bench
        .hyperstat(&["solve", "cantilever.ron", "--format", "json"])
        .ends_with(0)
        .json();
    let worst = &report["bodies"]["bar"]["worst"];
    assert_eq!(worst["segment"], serde_json::json!(["A", "B"]));
    assert_eq!(worst["at"], 0.0);
    let (moment, torque, radius) = (50.0, 10.0, 0.01_f64);
    let normal = 4.0 * moment / (PI * radius.powi(3));
    let shear = 2.0 * torque / (PI * radius.powi(3));
    near(number(&worst["normal"]).abs(), normal);
    near(number(&worst["shear"]), shear);
    let von_mises = (normal * normal + 3.0 * shear * shear).sqrt();
    near(number(&worst["von_mises"]), von_mises);
    near(number(&worst["utilisation"]), von_mises / 2e8);
    near(number(&worst["z"]).abs(), radius);
    assert!(number(&worst["y"]).abs() < 1e-15);
    // Pulled down at the end, the bar is in tension on its upper side.
    assert!(number(&worst["normal"]) * number(&worst["z"]) > 0.0);
    let forces = report["segments"][0]["section_forces"].as_array().unwrap();
    assert_eq!(forces.len(), 2);
    near(numbers(&forces[0]["wrench"])[4].abs(), moment);
    let joint = &report["joints"]["wall"];
    for (first, second) in numbers(&joint["first"])
        .iter()
        .zip(numbers(&joint["wrench"]))
    {
        assert_eq!(*first, -second);
    }
}

#[test]
fn why_a_delta_gives() {
    let bench = Bench::new("why-delta");
    bench.file(
        "delta.ron",
        &delta_batch("one", "List([(0.0, 0.0, 0.5)])", LOADS),
    );
    let report = bench
        .hyperstat(&[
            "solve",
            "delta.ron",
            "--why",
            "--along",
            "0,0,-2",
            "--format",
            "json",
        ])
        .ends_with(0)
        .json();
    let parts = report["budget"]["parts"].as_array().unwrap();
    let shares: f64 = parts.iter().filter_map(|part| part["share"].as_f64()).sum();
    assert!((shares - 1.0).abs() < 1e-9, "{shares}");
    assert_eq!(
        numbers(&report["budget"]["along"]),
        [0.0, 0.0, -1.0, 0.0, 0.0, 0.0]
    );
    // Named as `vary` takes them.
    let sensitivities = report["sensitivities"].as_array().unwrap();
    let named = |name: &str| sensitivities.iter().any(|s| s["parameter"] == name);
    assert!(named("arm.section.diameter") && named("rod.material.young"));
    let text = bench
        .hyperstat(&["solve", "delta.ron", "--why"])
        .ends_with(0);
    for part in [
        "  arm.section.diameter  ",
        "What is soft, and why",
        "bending",
        "What 1 % more",
        "Eigenscrews",
        "█",
    ] {
        assert!(text.out().contains(part), "no `{part}` in\n{}", text.out());
    }
    let wrong = bench
        .hyperstat(&["solve", "delta.ron", "--why", "--along", "up"])
        .ends_with(2);
    assert!(wrong.err().contains("three numbers"), "{}", wrong.err());
}

/// The bar of the help under its own weight and a mass at its tip: the weight's part grows with d²,
/// the rest not at all; both bend it by 1/(E d⁴).
#[test]
fn weight_has_its_part_in_sensitivities() {
    let bench = Bench::new("why-weight");
    let heavy = CANTILEVER
        .replace("poisson: 0.3", "poisson: 0.3, density: 7850.0")
        .replace(
            "loads: [",
            "gravity: (0.0, 0.0, -9.81), masses: [(on: (\"bar\", \"B\"), mass: 1.0)], loads: [",
        );
    bench.file("bar.ron", &heavy);
    let solve = |more: &[&str]| {
        let arguments = [&["solve", "bar.ron", "--why"], more].concat();
        bench.hyperstat(&arguments).ends_with(0)
    };
    let report = solve(&["--along", "z", "--format", "json"]).json();
    assert_eq!(report["warnings"].as_array().unwrap().len(), 0);
    let (inertia, area) = (PI * 0.02_f64.powi(4) / 64.0, PI * 1e-4);
    let weight = 7850.0 * 9.81 * area * 0.5_f64.powi(4) / (8.0 * 2.1e11 * inertia);
    let tip = |force: f64| force * 0.5_f64.powi(3) / (3.0 * 2.1e11 * inertia);
    let whole = weight + tip(9.81) + tip(100.0);
    let relative = |parameter: &str| {
        let all = report["sensitivities"].as_array().unwrap();
        let found = all.iter().find(|s| s["parameter"] == parameter);
        number(&found.unwrap_or_else(|| panic!("no {parameter}"))["relative"])
    };
    near(relative("materials.steel.density"), weight / whole);
    near(relative("masses.0.mass"), tip(9.81) / whole);
    near(
        relative("sections.rod.diameter"),
        -4.0 + 2.0 * weight / whole,
    );
    let text = solve(&["--along", "z"]);
    assert!(text.out().contains("masses.0.mass"), "{}", text.out());
}

/// Bending of a round bar goes with d √(E/ρ), in both planes at once.
#[test]
fn what_changes_frequencies() {
    let bench = Bench::new("why-frequencies");
    let heavy = CANTILEVER.replace("poisson: 0.3", "poisson: 0.3, density: 7850.0");
    bench.file("bar.ron", &heavy);
    let arguments = ["solve", "bar.ron", "--why", "--modes", "1"];
    let report = bench.hyperstat(&[&arguments[..], &["--format", "json"]].concat());
    let report = report.ends_with(0).json();
    let groups = report["frequency_sensitivities"].as_array().unwrap();
    assert_eq!(groups.len(), 1);
    assert_eq!(groups[0]["modes"], serde_json::json!([1, 2]));
    assert_eq!(report["modes"].as_array().unwrap().len(), 1);
    let frequency = number(&groups[0]["frequency"]);
    near(number(&report["modes"][0]["frequency"]), frequency);
    let found = groups[0]["sensitivities"].as_array().unwrap();
    assert_eq!(found[0]["parameter"], "sections.rod.diameter");
    for (parameter, expected, value) in [
        ("sections.rod.diameter", 1.0, 0.02),
        ("materials.steel.young", 0.5, 2.1e11),
        ("materials.steel.density", -0.5, 7850.0),
    ] {
        let own = found.iter().find(|s| s["parameter"] == parameter).unwrap();
        for k in [0, 1] {
            near(numbers(&own["relative"])[k], expected);
            near(numbers(&own["derivative"])[k], expected * frequency / value);
        }
    }
    let text = bench.hyperstat(&arguments).ends_with(0);
    let told = "What 1 % more of each value changes in frequencies 1 and 2 (";
    assert!(text.out().contains(told), "{}", text.out());
    let row = text
        .out()
        .lines()
        .find(|line| line.ends_with("+1.000 % frequency"));
    assert!(
        row.is_some_and(|row| row.contains("sections.rod.diameter")),
        "{}",
        text.out()
    );
    // Frequencies without `--why`, and `--why` without frequencies, have none of it.
    for without in ["--why", "--modes"] {
        let arguments: Vec<_> = match without {
            "--why" => vec!["solve", "bar.ron", "--modes", "1"],
            _ => vec!["solve", "bar.ron", "--why"],
        };
        let text = bench.hyperstat(&arguments).ends_with(0);
        assert!(!text.out().contains("changes in freq"), "{}", text.out());
    }
}

/// What would leave an idle motion out of balance has no derivative, and the report says so.
#[test]
fn what_would_unbalance_is_told() {
    let bench = Bench::new("why-balance");
    let text = CANTILEVER
        .replace("poisson: 0.3", "poisson: 0.3, density: 0.0")
        .replace(
            "points: {",
            "points: { \"L\": (0.5, 0.1, 0.0), \"R\": (0.5, -0.1, 0.0),",
        )
        .replace(
            "bodies: {",
            "bodies: { \"balance\": Rigid(points: [\"L\", \"B\", \"R\"]),",
        )
        .replace(
            "joints: {",
            "joints: { \"hinge\": (at: \"B\", between: (\"bar\", \"balance\"), \
             kind: Revolute(axis: (1.0, 0.0, 0.0))),",
        )
        .replace(
            "loads: [",
            "gravity: (0.0, 0.0, -9.81), masses: [(on: (\"balance\", \"L\"), mass: 1.0), \
             (on: (\"balance\", \"R\"), mass: 1.0)], loads: [",
        );
    bench.file("balance.ron", &text);
    let arguments = ["solve", "balance.ron", "--why", "--format", "json"];
    let report = bench.hyperstat(&arguments).ends_with(0).json();
    let warnings = report["warnings"].as_array().unwrap();
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    assert!(warnings[0].as_str().unwrap().contains("`masses.0.mass`"));
    let all = report["sensitivities"].as_array().unwrap();
    let mass = all
        .iter()
        .find(|s| s["parameter"] == "masses.1.mass")
        .unwrap();
    assert!(mass["relative"].is_null() && mass["displacement"].is_null());
}

/// The summary of a grid against the numbers of its table.
#[test]
fn the_summary_of_a_grid_is_that_of_its_table() {
    let bench = Bench::new("why-summary");
    let grid = "Grid(x: (-0.2, 0.2, 9), y: (-0.1, 0.2, 8), z: (0.45, 0.55, 7))";
    bench.file("grid.ron", &delta_batch("grid", grid, LOADS));
    let run = |threads: &str, out: &str| {
        let arguments = [
            "run",
            "grid.ron",
            "--out",
            out,
            "--summary",
            "--threads",
            threads,
        ];
        bench.hyperstat(&arguments).ends_with(0)
    };
    let outcome = run("1", "one");
    assert!(
        outcome.out().contains("over the workspace"),
        "{}",
        outcome.out()
    );
    run("2", "two");
    let text = bench.read("one/grid-summary.json");
    assert_eq!(text, bench.read("two/grid-summary.json"));
    let summary: Value = serde_json::from_str(&text).unwrap();
    let of = |measure: &str| {
        let all = summary.as_array().unwrap();
        all.iter()
            .find(|m| m["measure"] == measure)
            .unwrap()
            .clone()
    };
    let table = bench.read("one/grid.csv");
    let rows: Vec<Vec<f64>> = table
        .lines()
        .skip(1)
        .map(|line| {
            let cells = line.split(',').filter(|cell| *cell != "ok");
            cells.map(|cell| cell.parse().unwrap()).collect()
        })
        .collect();
    let moved = |row: &Vec<f64>| row[7].hypot(row[8]).hypot(row[9]);
    let deflection = of("deflection");
    let (worst, row) = (rows.iter().enumerate())
        .max_by(|a, b| moved(a.1).total_cmp(&moved(b.1)))
        .unwrap();
    near(number(&deflection["max"]["value"]), moved(row));
    assert_eq!(deflection["max"]["row"], worst);
    assert_eq!(numbers(&deflection["max"]["at"])[..3], row[1..4]);
    let mean = rows.iter().map(moved).sum::<f64>() / rows.len() as f64;
    near(number(&deflection["mean"]), mean);
    let mut sorted: Vec<f64> = rows.iter().map(moved).collect();
    sorted.sort_by(f64::total_cmp);
    let median = sorted[rows.len().div_ceil(2) - 1];
    let found = number(&deflection["percentiles"][1]["value"]);
    assert!((found / median - 1.0).abs() < 1e-3, "{found} {median}");
    // The translational block's trace bounds its eigenvalues.
    let least = number(&of("pure_translation_stiffness_min")["min"]["value"]);
    let smallest = rows.iter().map(|row| row[13].min(row[19]).min(row[24]));
    assert!(least <= smallest.fold(f64::MAX, f64::min));
    // Rotations free: the inverse of the largest compliance, softer than with them held.
    let free = of("pure_force_stiffness_min");
    let softest = number(&of("softest_force")["max"]["value"]);
    near(number(&free["min"]["value"]), 1.0 / softest);
    assert!(number(&free["min"]["value"]) <= least);
}
