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

/// σ = M r/I at the wall, with M = F L + w L²/2.
#[test]
fn every_case_has_its_worst_points() {
    let bench = Bench::new("cases-worst");
    let limited = bar(GRAVITY).replace("density: 7850.0", "density: 7850.0, yield: 2e8");
    bench.file("bar.ron", &limited);
    let report = bench
        .hyperstat(&["solve", "bar.ron", "--format", "json"])
        .ends_with(0)
        .json();
    let inertia = PI * DIAMETER.powi(4) / 64.0;
    let per_length = 7850.0 * PI * DIAMETER.powi(2) / 4.0 * 9.81;
    let own = per_length * LENGTH * LENGTH / 2.0;
    for (of, moment) in [
        (&report, own),
        (&report["cases"]["push"], own + FORCE * LENGTH),
        (&report["cases"]["rest"], own),
    ] {
        let worst = &of["bodies"]["bar"]["worst"];
        let stress = moment * DIAMETER / (2.0 * inertia);
        assert_near(worst["von_mises"].as_f64().unwrap(), stress, 1e-11, stress);
        let utilisation = worst["utilisation"].as_f64().unwrap();
        assert_near(utilisation, stress / 2e8, 1e-11, 1.0);
        assert_eq!(worst["at"], 0.0);
    }
    let tables = bench
        .hyperstat(&["solve", "bar.ron", "--full"])
        .ends_with(0);
    let heading = "Case `push`: worst point of every body: ";
    assert!(tables.out().contains(heading), "{}", tables.out());
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

/// A sag by weight goes with d⁻², one by a force with d⁻⁴; both with 1/E. Only the case has the force.
#[test]
fn why_a_case_gives() {
    let bench = Bench::new("cases-why");
    bench.file("bar.ron", &bar(GRAVITY));
    let why = |more: &[&str]| {
        let asked = ["solve", "bar.ron", "--why", "--format", "json"];
        bench
            .hyperstat(&[&asked, more].concat())
            .ends_with(0)
            .json()
    };
    let [weight, push] = sags();
    for (report, case, sags) in [
        (why(&[]), serde_json::Value::Null, [weight, 0.0]),
        (why(&["--case", "rest"]), "rest".into(), [weight, 0.0]),
        (why(&["--case", "push"]), "push".into(), [weight, push]),
    ] {
        let budget = &report["budget"];
        assert_eq!(budget["case"], case);
        assert_eq!(budget["of"], "displacement");
        let sag = sags[0] + sags[1];
        assert_near(budget["total"].as_f64().expect("a total"), sag, 1e-11, sag);
        let parts = budget["parts"].as_array().expect("parts").iter();
        let shares: f64 = parts.filter_map(|part| part["share"].as_f64()).sum();
        assert_near(shares, 1.0, 1e-11, 1.0);
        let sensitivities = report["sensitivities"].as_array().expect("a list");
        let relative = |name: &str| {
            let found = sensitivities.iter().find(|s| s["parameter"] == name);
            found.expect(name)["relative"].as_f64().expect("a number")
        };
        let by_diameter = -(2.0 * sags[0] + 4.0 * sags[1]) / sag;
        assert_near(relative("sections.rod.diameter"), by_diameter, 1e-9, 1.0);
        assert_near(relative("materials.steel.young"), -1.0, 1e-9, 1.0);
        // The report itself is the one without `--case`.
        let own = numbers(&report["output"]["displacement"]);
        assert_near(own[2], -weight, 1e-11, weight);
    }
    let asked = ["solve", "bar.ron", "--why", "--case", "push"];
    let text = bench.hyperstat(&asked).ends_with(0);
    let told = "Under the loads of case `push` the output has a deflection of";
    assert!(text.out().contains(told), "{}", text.out());

    bench
        .hyperstat(&["solve", "bar.ron", "--why", "--case", "pull"])
        .ends_with(2)
        .says(&["bar.ron holds no case `pull`", "its cases are push, rest"]);
    bench
        .hyperstat(&["solve", "bar.ron", "--case", "push"])
        .ends_with(2)
        .says(&["--why"]);
}

/// `plot`, a job's figure and the JSON of `solve --why` draw one budget of a case.
#[test]
fn the_budget_of_a_case_is_drawn() {
    let bench = Bench::new("cases-budget");
    bench.file("bar.ron", &bar(GRAVITY));
    bench.file(
        "batch.ron",
        r#"(jobs: [(name: "bar", mechanism: File("bar.ron"), figures: [Budget(case: "push")])])"#,
    );
    bench
        .hyperstat(&["run", "batch.ron", "--out", "out"])
        .ends_with(0);
    let asked = ["batch.ron", "--case", "push"];
    let solve = [&["solve"], &asked[..], &["--why", "--format", "json"]].concat();
    bench.file("why.json", bench.hyperstat(&solve).ends_with(0).out());
    let plot = [&["plot"], &asked[..], &["--budget", "--out", "plotted"]].concat();
    bench.hyperstat(&plot).ends_with(0);
    bench
        .hyperstat(&["plot", "why.json", "--budget", "--out", "read"])
        .ends_with(0);
    let job = bench.read("out/bar-budget.svg");
    assert!(job.contains("case push"), "{job}");
    assert_eq!(job, bench.read("plotted.svg"));
    assert_eq!(job, bench.read("read.svg"));
    bench
        .hyperstat(&["plot", "why.json", "--budget", "--case", "push"])
        .ends_with(2)
        .says(&["is solved already", "give `--case` to"]);
    bench
        .hyperstat(&["plot", "bar.ron", "--budget", "--case", "pull"])
        .ends_with(2)
        .says(&["bar.ron holds no case `pull`", "its cases are push, rest"]);
    bench
        .hyperstat(&["plot", "batch.ron", "--deformed", "--case", "pull"])
        .ends_with(2)
        .says(&["job `bar` holds no case `pull`", "its cases are push, rest"]);
    bench
        .hyperstat(&["plot", "bar.ron", "--mode", "1", "--case", "push"])
        .ends_with(2)
        .says(&["--case"]);
}
