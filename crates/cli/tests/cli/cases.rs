//! Load cases and self-weight as a user meets them: a steel bar held at one end, against
//! Euler and Bernoulli's w L⁴/8EI and F L³/3EI.

use std::f64::consts::PI;

use crate::support::{Bench, assert_near, numbers};

const LENGTH: f64 = 0.8;
const DIAMETER: f64 = 0.02;
const FORCE: f64 = 100.0;

/// The bar, with its weight, no load of its own and two cases.
fn bar(gravity: &str) -> String {
    format!(
        r#"(
    name: "bar",
    materials: {{ "steel": (young: 2.1e11, poisson: 0.3, density: 7850.0) }},
    sections: {{ "rod": Circle(diameter: 0.02) }},
    points: {{ "A": (0.0, 0.0, 0.0), "B": (0.8, 0.0, 0.0) }},
    bodies: {{ "bar": Beam(through: ["A", "B"], section: "rod", material: "steel", elements: 3) }},
    joints: {{ "wall": (at: "A", between: ("ground", "bar"), kind: Fixed) }},
    {gravity}
    cases: {{
        "push": [(on: ("bar", "B"), force: (0.0, 0.0, -100.0))],
        "rest": [],
    }},
    output: ("bar", "B"),
)
"#
    )
}

fn bending() -> f64 {
    2.1e11 * PI * DIAMETER.powi(4) / 64.0
}

/// How far the tip sinks under its weight, and under the force.
fn sags() -> [f64; 2] {
    let weight = 7850.0 * PI * DIAMETER.powi(2) / 4.0 * 9.81;
    [
        weight * LENGTH.powi(4) / (8.0 * bending()),
        FORCE * LENGTH.powi(3) / (3.0 * bending()),
    ]
}

const GRAVITY: &str = "gravity: (0.0, 0.0, -9.81),";

#[test]
fn weight_acts_in_every_case() {
    let bench = Bench::new("cases-solve");
    bench.file("bar.ron", &bar(GRAVITY));
    let solve = |more: &[&str]| {
        let arguments = [&["solve", "bar.ron", "--format", "json"], more].concat();
        bench.hyperstat(&arguments).ends_with(0).json()
    };
    let [weight, push] = sags();
    let report = solve(&[]);
    for (of, sag) in [
        (&report, weight),
        (&report["cases"]["push"], weight + push),
        (&report["cases"]["rest"], weight),
    ] {
        let found = numbers(&of["output"]["displacement"]);
        assert_near(found[2], -sag, 1e-11, sag);
        assert_eq!(numbers(&of["displacements"]["bar.B"]), found);
        assert!(of["displacements"]["bar.A-B.1"].is_null());
    }
    let wall = numbers(&report["cases"]["push"]["joints"]["wall"]["wrench"]);
    let all = FORCE + 7850.0 * PI * DIAMETER.powi(2) / 4.0 * LENGTH * 9.81;
    assert_near(wall[2], all, 1e-11, all);

    // A third of the way: w x²(6 L² − 4 L x + x²)/24EI and F x²(3 L − x)/6EI.
    let report = solve(&["--all-nodes"]);
    let x = LENGTH / 3.0;
    let per_length = 7850.0 * PI * DIAMETER.powi(2) / 4.0 * 9.81;
    let shape = x * x * (6.0 * LENGTH * LENGTH - 4.0 * LENGTH * x + x * x) / 24.0;
    let weight = per_length * shape / bending();
    let push = FORCE * x * x * (3.0 * LENGTH - x) / (6.0 * bending());
    let inner = |of: &serde_json::Value| numbers(&of["displacements"]["bar.A-B.1"])[2];
    assert_near(inner(&report), -weight, 1e-10, weight);
    let both = weight + push;
    assert_near(inner(&report["cases"]["push"]), -both, 1e-10, both);
}

#[test]
fn cases_are_columns_after_the_stiffness() {
    let bench = Bench::new("cases-run");
    bench.file("bar.ron", &bar(GRAVITY));
    bench.file(
        "batch.ron",
        r#"(jobs: [(name: "bar", mechanism: File("bar.ron"), modes: 2)])"#,
    );
    let ran = bench.hyperstat(&["run", "batch.ron", "--out", "out"]);
    ran.ends_with(0);
    let table = bench.read("out/bar.csv");
    let mut lines = table.lines();
    let names: Vec<_> = lines.next().expect("a head").split(',').collect();
    let row: Vec<_> = lines.next().expect("a row").split(',').collect();
    let place = |name: &str| names.iter().position(|n| *n == name).expect(name);
    let after = place("k66") + 1;
    let mut expected: Vec<String> = Vec::new();
    for case in ["push", "rest"] {
        let components = ["dx", "dy", "dz", "drx", "dry", "drz"];
        expected.extend(components.map(|c| format!("{case}.{c}")));
    }
    expected.extend(["f1".into(), "f2".into()]);
    assert_eq!(names[after..], expected);
    let value = |name: &str| row[place(name)].parse::<f64>().expect("a number");
    let [weight, push] = sags();
    assert_near(value("dz"), -weight, 1e-11, weight);
    assert_near(value("rest.dz"), -weight, 1e-11, weight);
    assert_near(value("push.dz"), -(weight + push), 1e-11, weight + push);
}
