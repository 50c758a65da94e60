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
    let text = bench
        .hyperstat(&["solve", "delta.ron", "--why"])
        .ends_with(0);
    for part in [
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
    let least = number(&of("stiffness_least")["min"]["value"]);
    let smallest = rows.iter().map(|row| row[13].min(row[19]).min(row[24]));
    assert!(least <= smallest.fold(f64::MAX, f64::min));
}
