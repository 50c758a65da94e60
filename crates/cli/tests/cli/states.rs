//! Weight, temperature, loads along beams, axes that turn and cases as a user checks them: with the
//! independent solver, pose by pose, and by the shares of what gives.

use std::f64::consts::PI;

use nalgebra::{Rotation3, Vector3};
use serde_json::Value;

use crate::support::{Bench, assert_near, delta_batch, numbers};

/// A bent beam that carries everything, with two cases.
const CRANE: &str = r#"(
    name: "crane",
    materials: { "steel": (young: 2.1e11, poisson: 0.3, density: 7850.0, expansion: 1.2e-5) },
    sections: {
        "rod": Circle(diameter: 0.03),
        "beak": Tapered(from: Circle(diameter: 0.03), to: Circle(diameter: 0.02)),
    },
    points: { "A": (0.0, 0.0, 0.0), "B": (0.5, 0.0, 0.2), "C": (0.9, 0.3, 0.2) },
    bodies: {
        "arm": Beam(through: ["A", "B", "C"], section: ["rod", "beak"], material: "steel", temperature: 15.0, elements: 3),
        "hook": Rigid(points: ["C"]),
    },
    joints: {
        "foot": (at: "A", between: ("ground", "arm"), kind: Fixed, stiffness: (x: 1e7, u: 1e5)),
        "wrist": (at: "C", between: ("arm", "hook"), kind: Fixed),
    },
    loads: [
        (on: ("hook", "C"), force: (0.0, 0.0, -50.0)),
        (on: "arm", per_length: (0.0, -4.0, 0.0), moment_per_length: (0.5, 0.0, 0.0)),
        (on: ("arm", "C", "B"), from: (0.0, 0.0, -8.0), to: (0.0, 0.0, -2.0)),
    ],
    cases: {
        "lifting": [(on: ("arm", "B"), force: (0.0, 3.0, -9.0), frame: Body)],
        "idle": [],
    },
    gravity: (0.0, 0.0, -9.81),
    masses: [(on: ("hook", "C"), mass: 2.0)],
    output: ("hook", "C"),
)"#;

/// Asserts that the independent solver agrees, in all states, to rounding.
#[track_caller]
fn assert_verified(report: &Value) {
    assert_eq!(report["warnings"], Value::Array(vec![]));
    let verification = &report["verification"];
    assert_eq!(verification["disagreements"], Value::Array(vec![]));
    let none = serde_json::Map::new();
    let cases = verification["cases"].as_object().unwrap_or(&none).values();
    for state in std::iter::once(verification).chain(cases) {
        for what in ["displacements", "joint_wrenches"] {
            let difference = state[what].as_f64().unwrap();
            assert!((0.0..1e-11).contains(&difference), "{what}: {difference:e}");
        }
    }
}

#[test]
fn every_state_is_verified() {
    let bench = Bench::new("states-verify");
    bench.file("crane.ron", CRANE);
    let solve = |format: &str| {
        bench
            .hyperstat(&["solve", "crane.ron", "--verify", "--format", format])
            .ends_with(0)
    };
    let report = solve("json").json();
    assert_verified(&report);
    let cases = report["verification"]["cases"].as_object().unwrap();
    assert!(cases.len() == 2 && cases.contains_key("idle") && cases.contains_key("lifting"));
    let text = solve("text");
    let expected = "joint wrenches in case `lifting`";
    assert!(text.out().contains(expected), "{}", text.out());
}

/// A bar that may grow, of which all wrenches are zero but for rounding; one between walls under
/// its weight, of which all displacements are.
#[test]
fn rounding_is_no_difference() {
    let bench = Bench::new("states-rounding");
    let bar = |joints: &str, rest: &str| {
        format!(
            r#"(
    name: "bar",
    materials: {{ "steel": (young: 2.1e11, poisson: 0.3, density: 7850.0, expansion: 1.2e-5) }},
    sections: {{ "rod": Circle(diameter: 0.02) }},
    points: {{ "A": (0.0, 0.0, 0.0), "M": (0.31, 0.2, 0.13), "B": (0.7, 0.2, 0.3) }},
    bodies: {{ "bar": Beam(through: ["A", "M", "B"], section: "rod", material: "steel"{rest} }},
    joints: {{
        "A": (at: "A", between: ("ground", "bar"), kind: Fixed),
        {joints}
    }},
    output: ("bar", "M"),
"#
        )
    };
    let other = r#""B": (at: "B", between: ("ground", "bar"), kind: Fixed),
        "M": (at: "M", between: ("ground", "bar"), kind: Fixed),"#;
    let grows = bar("", ", temperature: 30.0)") + ")";
    let held = bar(other, ")") + "gravity: (1.0, 2.0, -9.81),)";
    for text in [grows, held] {
        bench.file("bar.ron", &text);
        let outcome = bench.hyperstat(&["solve", "bar.ron", "--verify", "--format", "json"]);
        assert_verified(&outcome.ends_with(0).json());
    }
}

#[test]
fn figures_of_a_job_with_weight_are_compared() {
    let bench = Bench::new("states-figures");
    let rest = "gravity: (0.0, 0.0, -9.81), masses: [(on: (\"platform\", \"P\"), mass: 1.0)],
            figures: [Trajectory(scale: Auto), Deformed(pose: 1, scale: Auto)],";
    let poses = "List([(0.0, 0.0, 0.45), (0.05, 0.0, 0.5)])";
    bench.file("batch.ron", &delta_batch("delta", poses, rest));
    let outcome = bench.hyperstat(&["run", "batch.ron", "--out", "out"]);
    let told = outcome.ends_with(0);
    let line = told
        .out()
        .lines()
        .find(|line| line.contains("largest difference"));
    let line = line.unwrap_or_else(|| panic!("{}", told.out()));
    let number = line
        .split(": ")
        .nth(1)
        .and_then(|rest| rest.split(' ').next());
    let difference: f64 = number.expect("a number").parse().expect("a number");
    assert!(difference < 1e-11, "{line}");
}

/// The displacements of a table's rows, by the names of its columns.
struct Displacements {
    names: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Displacements {
    fn read(bench: &Bench, job: &str) -> Self {
        let table = bench.read(&format!("out/{job}.csv"));
        let cells = |line: &str| line.split(',').map(String::from).collect::<Vec<_>>();
        let mut lines = table.lines();
        let names = cells(lines.next().expect("a head"));
        let rows = lines.map(cells).collect();
        Self { names, rows }
    }

    /// Of a pose, in the base state or with the prefix of a case.
    fn at(&self, pose: usize, prefix: &str) -> [f64; 6] {
        ["dx", "dy", "dz", "drx", "dry", "drz"].map(|component| {
            let name = format!("{prefix}{component}");
            let place = self.names.iter().position(|n| *n == name);
            let cell = &self.rows[pose][place.expect("a column")];
            cell.parse().expect("a number")
        })
    }
}

#[track_caller]
fn assert_same(found: &[f64], expected: &[f64], tolerance: f64) {
    let largest = |kind: usize| {
        let entries = expected[kind..kind + 3].iter();
        entries.fold(0.0, |l: f64, e| l.max(e.abs()))
    };
    for k in 0..6 {
        assert_near(found[k], expected[k], tolerance, largest(3 * (k / 3)));
    }
}

/// A hexapod whose platform turns. Its output's axes are turned by the pose's rotation vector:
/// a job with global loads, turned by hand, gives the same.
#[test]
fn loads_turn_with_the_output_of_a_sweep() {
    let bench = Bench::new("states-output-frame");
    let poses = [
        [0.02, -0.03, 0.75, 0.2, -0.1, 0.3],
        [0.0, 0.05, 0.7, 0.0, 0.25, -0.1],
        [-0.04, 0.0, 0.8, -0.15, 0.1, 0.05],
    ];
    let (force, moment) = (
        Vector3::new(30.0, -10.0, 80.0),
        Vector3::new(2.0, 4.0, -3.0),
    );
    let tuple = |v: &[f64]| format!("{v:?}").replace('[', "(").replace(']', ")");
    let steel = "material: (young: 2.1e11, poisson: 0.3, density: 7850.0)";
    let job = |name: &str,
               poses: &[[f64; 6]],
               force: &Vector3<f64>,
               moment: &Vector3<f64>,
               frame: &str| {
        let poses: Vec<_> = poses.iter().map(|pose| tuple(pose)).collect();
        let load = format!(
            "[(on: (\"platform\", \"P\"), force: {}, moment: {}, frame: {frame})]",
            tuple(force.as_slice()),
            tuple(moment.as_slice())
        );
        format!(
            r#"(
        name: "{name}",
        mechanism: Hexapod(
            base_radius: 0.5, base_angle: 0.125, platform_radius: 0.3, platform_angle: 0.9,
            leg: (
                cylinder: (section: Tube(outer: 0.06, inner: 0.045), {steel}),
                piston: (section: Circle(diameter: 0.04), {steel}),
                cylinder_length: 0.45, lengths: (0.55, 1.2),
            ),
            drive_stiffness: 5e7,
        ),
        poses: List([{}]),
        loads: {load},
        cases: {{
            "same": {load},
            "along": [(on: "piston1", per_length: (5.0, 0.0, -20.0))],
        }},
        gravity: (0.0, 0.0, -9.81),
        masses: [(on: ("platform", "P"), mass: 8.0)],
    ),"#,
            poses.join(", ")
        )
    };
    let mut jobs = job("output", &poses, &force, &moment, "Output");
    jobs += &job("body", &poses, &force, &moment, "Body");
    for (k, pose) in poses.iter().enumerate() {
        let turn = Rotation3::from_scaled_axis(Vector3::new(pose[3], pose[4], pose[5]));
        let by_hand = job(
            &format!("hand{k}"),
            &[*pose],
            &(turn * force),
            &(turn * moment),
            "Global",
        );
        jobs += &by_hand;
    }
    bench.file("batch.ron", &format!("(jobs: [{jobs}])"));
    bench
        .hyperstat(&["run", "batch.ron", "--out", "out"])
        .ends_with(0);
    for name in ["output", "body"] {
        let table = Displacements::read(&bench, name);
        assert_eq!(table.rows.len(), poses.len());
        for pose in 0..poses.len() {
            let by_hand = Displacements::read(&bench, &format!("hand{pose}"));
            for prefix in ["", "same.", "along."] {
                // The rotation goes through the joints' frames, which are good to some 1e-15.
                assert_same(&table.at(pose, prefix), &by_hand.at(0, prefix), 1e-11);
            }
            let row = |prefix: &str| table.at(pose, prefix);
            let pose = pose.to_string();
            let solve = ["solve", "batch.ron", "--job", name, "--pose", &pose];
            let more = ["--verify", "--format", "json"];
            let report = bench.hyperstat(&[&solve[..], &more].concat());
            let report = report.ends_with(0).json();
            assert_verified(&report);
            // A sweep agrees with `solve` to 1e-11, as the lanes do.
            assert_same(&row(""), &numbers(&report["output"]["displacement"]), 1e-11);
            for case in ["same", "along"] {
                let found = numbers(&report["cases"][case]["output"]["displacement"]);
                assert_same(&row(&format!("{case}.")), &found, 1e-11);
            }
        }
    }
}

/// A crank turned by its drive about z, its load with it: turned by hand it is the same.
#[test]
fn loads_turn_with_a_driven_crank() {
    let bench = Bench::new("states-crank");
    let angles = [0.0_f64, 0.4, -0.7];
    let file = |load: &str| {
        format!(
            r#"(
    name: "crank",
    materials: {{ "steel": (young: 2.1e11, poisson: 0.3, density: 7850.0, expansion: 1.2e-5) }},
    sections: {{ "flat": Rectangle(width: 0.02, height: 0.03), "rod": Circle(diameter: 0.02) }},
    points: {{ "A": (0.0, 0.0, 0.0), "B": (0.3, 0.1, 0.0), "C": (0.3, 0.1, 0.25) }},
    bodies: {{
        "crank": Beam(through: ["A", "B"], section: "flat", material: "steel", temperature: 20.0),
        "rod": Beam(through: ["B", "C"], section: "rod", material: "steel"),
    }},
    joints: {{
        "A": (at: "A", between: ("ground", "crank"), kind: Revolute(axis: (0.0, 0.0, 1.0)), locked: true, stiffness: (v: 2e4)),
        "B": (at: "B", between: ("crank", "rod"), kind: Fixed),
    }},
    gravity: (3.0, -2.0, -9.81),
    loads: {load},
    output: ("rod", "C"),
)"#
        )
    };
    let load = |frame: &str, point: Vector3<f64>, line: Vector3<f64>| {
        let tuple = |v: Vector3<f64>| format!("({:?}, {:?}, {:?})", v.x, v.y, v.z);
        format!(
            "[(on: (\"crank\", \"B\"), force: {}, frame: {frame}), (on: \"crank\", per_length: {}, frame: {frame})]",
            tuple(point),
            tuple(line)
        )
    };
    let (point, line) = (
        Vector3::new(40.0, 9.0, -30.0),
        Vector3::new(7.0, -90.0, 25.0),
    );
    bench.file("turning.ron", &file(&load("Body", point, line)));
    let drives: Vec<String> = angles.iter().map(ToString::to_string).collect();
    bench.file("drives.csv", &format!("A.v\n{}\n", drives.join("\n")));
    let mut jobs =
        r#"(name: "turning", mechanism: File("turning.ron"), poses: Drives(Csv("drives.csv"))),"#
            .to_string();
    for (k, angle) in angles.iter().enumerate() {
        // The joint's v is the turn of the crank against the ground about z.
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), *angle);
        let loads = load("Global", turn * point, turn * line);
        bench.file(&format!("still{k}.ron"), &file(&loads));
        bench.file(&format!("drive{k}.csv"), &format!("A.v\n{angle}\n"));
        jobs += &format!(
            r#"(name: "still{k}", mechanism: File("still{k}.ron"), poses: Drives(Csv("drive{k}.csv"))),"#
        );
    }
    bench.file("batch.ron", &format!("(jobs: [{jobs}])"));
    bench
        .hyperstat(&["run", "batch.ron", "--out", "out"])
        .ends_with(0);
    let table = Displacements::read(&bench, "turning");
    assert_eq!(table.rows.len(), angles.len());
    for k in 0..angles.len() {
        let still = Displacements::read(&bench, &format!("still{k}"));
        // Closure places the crank to some 1e-14.
        assert_same(&table.at(k, ""), &still.at(0, ""), 1e-11);
        let pose = k.to_string();
        let solve = ["solve", "batch.ron", "--job", "turning", "--pose", &pose];
        let report = bench.hyperstat(&[&solve[..], &["--verify", "--format", "json"]].concat());
        let report = report.ends_with(0).json();
        assert_verified(&report);
        let found = numbers(&report["output"]["displacement"]);
        assert_same(&table.at(k, ""), &found, 1e-11);
    }
}

/// A carriage slides along a rail and does not turn: its axes stay the global ones, wherever its
/// point on the rail is.
#[test]
fn loads_on_a_carriage_do_not_turn() {
    let bench = Bench::new("states-carriage");
    let file = |frame: &str| {
        format!(
            r#"(
    name: "carriage",
    points: {{ "A": (0.0, 0.0, 0.0), "M": (0.4, 0.0, 0.0), "T": (0.4, 0.3, 0.1) }},
    bodies: {{ "rail": Rigid(points: ["A", "M"]), "carriage": Rigid(points: ["M", "T"]) }},
    joints: {{
        "foot": (at: "A", between: ("ground", "rail"), kind: Fixed, stiffness: (x: 1e6, y: 2e6, z: 3e6, u: 1e4, v: 2e4, w: 3e4)),
        "slide": (at: "M", between: ("rail", "carriage"), kind: Prismatic(axis: (1.0, 0.0, 0.0)), locked: true, stiffness: (y: 1e6)),
    }},
    loads: [(on: ("carriage", "T"), force: (10.0, 20.0, -30.0), moment: (1.0, 2.0, 3.0), frame: {frame})],
    output: ("carriage", "T"),
)"#
        )
    };
    bench.file("drives.csv", "slide.y\n0\n0.2\n-0.3\n");
    let frames = ["Global", "Body", "Output"];
    let mut jobs = String::new();
    for frame in frames {
        bench.file(&format!("{frame}.ron"), &file(frame));
        jobs += &format!(
            r#"(name: "{frame}", mechanism: File("{frame}.ron"), poses: Drives(Csv("drives.csv"))),"#
        );
    }
    bench.file("batch.ron", &format!("(jobs: [{jobs}])"));
    let outcome = bench.hyperstat(&["run", "batch.ron", "--out", "out"]);
    outcome.ends_with(0);
    let [global, body, output] = frames.map(|frame| Displacements::read(&bench, frame));
    for pose in 0..3 {
        let expected = global.at(pose, "");
        assert_same(&body.at(pose, ""), &expected, 1e-11);
        assert_same(&output.at(pose, ""), &expected, 1e-11);
    }
}

/// A bar under its weight gives all by bending, w L⁴/8EI; heated, all by α ΔT L.
#[test]
fn why_a_bar_gives_under_weight_and_heat() {
    let bench = Bench::new("states-why");
    let text = r#"(
    name: "bar",
    materials: { "steel": (young: 2.1e11, poisson: 0.3, density: 7850.0, expansion: 1.2e-5) },
    sections: { "rod": Circle(diameter: 0.02) },
    points: { "A": (0.0, 0.0, 0.0), "B": (0.8, 0.0, 0.0) },
    bodies: { "bar": Beam(through: ["A", "B"], section: "rod", material: "steel", temperature: 30.0) },
    joints: { "wall": (at: "A", between: ("ground", "bar"), kind: Fixed) },
    gravity: (0.0, 0.0, -9.81),
    output: ("bar", "B"),
)"#;
    bench.file("bar.ron", text);
    let weight = 7850.0 * PI * 0.02_f64.powi(2) / 4.0 * 9.81;
    let sag = weight * 0.8_f64.powi(4) / (8.0 * 2.1e11 * PI * 0.02_f64.powi(4) / 64.0);
    for (along, deformation, total) in [
        ("z", "bending", -sag),
        ("x", "free strain", 1.2e-5 * 30.0 * 0.8),
    ] {
        let arguments = [
            "solve", "bar.ron", "--format", "json", "--why", "--along", along,
        ];
        let report = bench.hyperstat(&arguments).ends_with(0).json();
        let budget = &report["budget"];
        let number = |value: &Value| value.as_f64().expect("a number");
        assert_near(number(&budget["total"]), total, 1e-11, total.abs());
        let [part] = &budget["parts"].as_array().expect("parts")[..] else {
            panic!("{budget}")
        };
        assert_eq!(
            (&part["body"], &part["deformation"]),
            (&"bar".into(), &deformation.into())
        );
        assert_near(number(&part["share"]), 1.0, 1e-11, 1.0);
    }
    // Of all that gives in the crane, and of its loads, the shares add to the displacement.
    bench.file("crane.ron", CRANE);
    for along in ["x", "y", "z", "rx", "ry", "rz"] {
        let arguments = [
            "solve",
            "crane.ron",
            "--format",
            "json",
            "--why",
            "--along",
            along,
        ];
        let report = bench.hyperstat(&arguments).ends_with(0).json();
        let budget = &report["budget"];
        let place = ["x", "y", "z", "rx", "ry", "rz"]
            .iter()
            .position(|a| *a == along);
        let moved = numbers(&report["output"]["displacement"])[place.expect("a direction")];
        let parts = budget["parts"].as_array().expect("parts");
        let sum = |field: &str| {
            parts
                .iter()
                .map(|p| p[field].as_f64().expect(field))
                .sum::<f64>()
        };
        assert_near(sum("displacement"), moved, 1e-11, moved.abs());
        assert_near(sum("share"), 1.0, 1e-11, 1.0);
    }
}
