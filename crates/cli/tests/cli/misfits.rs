//! Misfits and preloads as a user meets them: the delta with a rod too long, a bar whose support
//! settles, a misfit that varies, one that does not fit.

use std::path::Path;

use serde_json::Value;

use crate::support::{Bench, assert_near, delta_batch, numbers};

const LENGTH: f64 = 0.8;
const DIAMETER: f64 = 0.02;

/// A bar clamped at both ends with its middle as the output; `support` is what is said of its end.
fn bar(support: &str) -> String {
    format!(
        r#"(
    name: "bar",
    materials: {{ "steel": (young: 2.1e11, poisson: 0.3) }},
    sections: {{ "rod": Circle(diameter: {DIAMETER}) }},
    points: {{ "A": (0.0, 0.0, 0.0), "M": (0.4, 0.0, 0.0), "B": ({LENGTH}, 0.0, 0.0) }},
    bodies: {{ "bar": Beam(through: ["A", "M", "B"], section: "rod", material: "steel") }},
    joints: {{
        "wall": (at: "A", between: ("ground", "bar"), kind: Fixed),
        "support": (at: "B", between: ("ground", "bar"), kind: Fixed, {support}),
    }},
    output: ("bar", "M"),
)
"#
    )
}

/// E I of the bar.
fn bending() -> f64 {
    2.1e11 * std::f64::consts::PI * DIAMETER.powi(4) / 64.0
}

fn wrench(report: &Value, joint: &str) -> Vec<f64> {
    numbers(&report["joints"][joint]["wrench"])
}

/// 12 EI δ/L³ and 6 EI δ/L²; a preload F on a spring k is a misfit F/k.
#[test]
fn a_support_settles() {
    let bench = Bench::new("misfits-settles");
    let settlement = 2e-4;
    bench.file("bar.ron", &bar("misfit: (z: -2e-4)"));
    let json = ["solve", "bar.ron", "--format", "json", "--verify"];
    let report = bench.hyperstat(&json).ends_with(0).json();
    let force = 12.0 * bending() * settlement / LENGTH.powi(3);
    let found = wrench(&report, "support");
    assert_near(found[2], -force, 1e-11, force);
    assert_near(found[4], -force * LENGTH / 2.0, 1e-11, force * LENGTH);
    let misfit = numbers(&report["joints"]["support"]["misfit"]);
    assert_eq!(misfit, [0.0, 0.0, -2e-4, 0.0, 0.0, 0.0]);
    assert!(report["joints"]["wall"].get("misfit").is_none());
    assert!(report["joints"]["support"].get("preload").is_none());
    for of in ["stiffness", "displacements", "joint_wrenches"] {
        let difference = report["verification"][of].as_f64().expect("a number");
        assert!(difference < 1e-11, "{of}: {difference:e}");
    }
    let text = bench.hyperstat(&["solve", "bar.ron", "--why"]).ends_with(0);
    for part in [
        "Misfits that act, second body from the first, in the joint frame [m, rad]",
        "What a misfit of a joint does, along the same",
        "100.0 %",
    ] {
        assert!(text.out().contains(part), "no `{part}` in\n{}", text.out());
    }
    // The same force without a misfit: a preload on a spring of any stiffness is a misfit F/k.
    let spring = "stiffness: (z: 1e6), preload: (z: -200.0)";
    bench.file("preloaded.ron", &bar(spring));
    bench.file(
        "sprung.ron",
        &bar("stiffness: (z: 1e6), misfit: (z: -2e-4)"),
    );
    let solve = |file: &str| {
        let arguments = ["solve", file, "--format", "json"];
        bench.hyperstat(&arguments).ends_with(0).json()
    };
    let (preloaded, sprung) = (solve("preloaded.ron"), solve("sprung.ron"));
    for (a, b) in wrench(&preloaded, "support")
        .iter()
        .zip(wrench(&sprung, "support"))
    {
        assert_near(*a, b, 1e-11, 200.0);
    }
    let text = bench.hyperstat(&["solve", "preloaded.ron"]).ends_with(0);
    let title = "Preloads that act, on the second body, in the joint frame [N, N·m]";
    assert!(text.out().contains(title), "{}", text.out());
}

#[test]
fn a_misfit_varies_by_its_path() {
    let bench = Bench::new("misfits-vary");
    bench.file("bar.ron", &bar("misfit: (z: 0.0)"));
    bench.file(
        "batch.ron",
        r#"(jobs: [(
            name: "settling", mechanism: File("bar.ron"),
            vary: { "joints.support.misfit.z": [-1e-4, 0.0, 2e-4] },
        )])"#,
    );
    bench
        .hyperstat(&["run", "batch.ron", "--out", "out"])
        .ends_with(0);
    let table = bench.read("out/settling.csv");
    let mut lines = table.lines();
    let heads: Vec<_> = lines.next().expect("heads").split(',').collect();
    let dz = heads.iter().position(|head| *head == "dz").expect("a dz");
    let found: Vec<f64> = lines
        .map(|line| {
            line.split(',')
                .nth(dz)
                .expect("dz")
                .parse()
                .expect("a number")
        })
        .collect();
    assert_eq!(found.len(), 3);
    for (found, misfit) in found.iter().zip([-1e-4, 0.0, 2e-4]) {
        assert_near(*found, misfit / 2.0, 1e-11, 1e-4);
    }
}

#[test]
fn a_misfit_that_does_not_fit_is_told_with_its_joint() {
    let bench = Bench::new("misfits-refused");
    let file = bar("misfit: (x: 1e-4)").replace(
        r#"Beam(through: ["A", "M", "B"], section: "rod", material: "steel")"#,
        r#"Rigid(points: ["A", "M", "B"])"#,
    );
    bench.file("block.ron", &file);
    for command in ["solve", "check"] {
        let refused = bench.hyperstat(&[command, "block.ron"]).ends_with(2);
        assert!(refused.err().contains("block.ron:9:9"), "{}", refused.err());
        assert!(
            refused.err().contains("joint `support`"),
            "{}",
            refused.err()
        );
        assert!(
            refused.err().contains("give a `stiffness`"),
            "{}",
            refused.err()
        );
    }
}

/// The example of the book: verified by the independent solver, in balance, and by reciprocity what
/// `--why` of the bare delta says of that joint.
#[test]
fn a_delta_with_a_long_rod() {
    let bench = Bench::new("misfits-delta");
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/delta_long_rod.ron");
    let example = example.to_str().expect("a path");
    let solve = |more: &[&str]| {
        let arguments = [&["solve", example, "--format", "json"], more].concat();
        bench.hyperstat(&arguments).ends_with(0).json()
    };
    let report = solve(&["--verify"]);
    for of in ["stiffness", "displacements", "joint_wrenches"] {
        let difference = report["verification"][of].as_f64().expect("a number");
        assert!(difference < 1e-10, "{of}: {difference:e}");
    }
    assert_eq!(
        report["verification"]["disagreements"],
        serde_json::json!([])
    );
    // The rod that is too long is pressed, the other one as much pulled.
    let (long, other) = (wrench(&report, "Ba1")[0], wrench(&report, "Bb1")[0]);
    assert!(long > 1.0, "{long}");
    assert_near(long + other, 0.0, 1e-2, long);
    let moved = numbers(&report["output"]["displacement"]);
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let why = solve(&["--why", "--along", name]);
        let all = why["misfits"].as_array().expect("a list");
        let own = all
            .iter()
            .find(|m| m["joint"] == "Ba1" && m["direction"] == "x");
        let effect = own.expect("its effect")["per_unit"].as_f64();
        assert_near(effect.expect("a number") * 1e-4, moved[axis], 1e-10, 1e-4);
    }
    // The book quotes the report: what is rounding in it apart.
    let text = bench
        .hyperstat(&["solve", example, "--full", "--why", "--along", "z"])
        .ends_with(0);
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/theory/states.md");
    let page = std::fs::read_to_string(page).expect("the page");
    let (_, from) = page
        .split_once("```text\nOutput platform.P")
        .expect("the report");
    let (quoted, _) = from.split_once("```").expect("its end");
    let words = |line: &str| -> Vec<String> {
        let words = line.split_whitespace();
        let words = words.filter(|word| !(word.contains("e-1") || *word == "0"));
        words.map(str::to_owned).collect()
    };
    let printed: Vec<_> = text.out().lines().map(words).collect();
    for line in quoted.lines().skip(1).filter(|line| line.trim() != "…") {
        assert!(
            printed.contains(&words(line)),
            "`{line}` in\n{}",
            text.out()
        );
    }
}

/// A job gives the joints of a prebuilt mechanism misfits and preloads: over the workspace as by the
/// same mechanism written out, and as by the independent solver.
#[test]
fn joints_of_a_prebuilt_mechanism_have_misfits_and_preloads() {
    let bench = Bench::new("misfits-prebuilt");
    let poses = "List([(0.0, 0.0, 0.5), (-0.2, -0.2, 0.5), (0.1, 0.05, 0.6)])";
    let acting = "misfits: { \"Ba1\": (x: 1e-4), \"C2\": (u: 2e-4) }, \
                  preloads: { \"A1\": (v: 3.0), \"Ca3\": (v: 0.5) },
                  cases: { \"idle\": [] },";
    let drives = "drive_stiffness: 1e5, base_radius";
    let text = delta_batch("long", poses, acting).replace("base_radius", drives);
    bench.file("long.ron", &text);
    bench
        .hyperstat(&["run", "long.ron", "--out", "out"])
        .ends_with(0);
    let table = bench.read("out/long.csv");
    let mut lines = table.lines();
    let heads: Vec<_> = lines.next().expect("heads").split(',').collect();
    let dx = heads.iter().position(|head| *head == "dx").expect("a dx");
    for (pose, line) in lines.enumerate() {
        let pose = pose.to_string();
        let chosen = ["long.ron", "--pose", &pose];
        let json = ["--format", "json", "--verify"];
        let solve = [&["solve"], &chosen[..], &json].concat();
        let report = bench.hyperstat(&solve).ends_with(0).json();
        assert_eq!(
            report["verification"]["disagreements"],
            serde_json::json!([])
        );
        let misfit = numbers(&report["joints"]["Ba1"]["misfit"]);
        assert_eq!(misfit, [1e-4, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let preload = numbers(&report["joints"]["A1"]["preload"]);
        assert_eq!(preload, [0.0, 0.0, 0.0, 0.0, 3.0, 0.0]);
        let export = [&["export"], &chosen[..], &["--out", "written.ron"]].concat();
        bench.hyperstat(&export).ends_with(0);
        let written = bench.hyperstat(&[&["solve", "written.ron"], &json[..]].concat());
        let written = written.ends_with(0).json();
        let cells: Vec<f64> = (line.split(',').skip(dx).take(6))
            .map(|cell| cell.parse().expect("a number"))
            .collect();
        let moved = numbers(&report["output"]["displacement"]);
        let found = numbers(&written["output"]["displacement"]);
        let idle = numbers(&report["cases"]["idle"]["output"]["displacement"]);
        let written_idle = numbers(&written["cases"]["idle"]["output"]["displacement"]);
        let size = moved.iter().fold(0.0_f64, |size, u| size.max(u.abs()));
        for k in 0..6 {
            assert_near(cells[k], moved[k], 1e-11, size);
            assert_near(found[k], moved[k], 1e-11, size);
            assert_near(written_idle[k], idle[k], 1e-11, size);
        }
        assert!(idle.iter().any(|u| u.abs() > 1e-6), "{idle:?}");
    }
}

/// What a job gives stands in place of all that the joints of its file have.
#[test]
fn a_jobs_misfits_replace_those_of_the_file() {
    let bench = Bench::new("misfits-replaced");
    bench.file("bar.ron", &bar("misfit: (z: -2e-4)"));
    let job = |name: &str, misfits: &str| {
        format!(r#"(name: "{name}", mechanism: File("bar.ron"), {misfits})"#)
    };
    let [kept, none, other] = [
        job("kept", ""),
        job("none", "misfits: {}"),
        job("other", r#"misfits: { "wall": (z: 1e-4) }"#),
    ];
    bench.file("batch.ron", &format!("(jobs: [{kept}, {none}, {other}])"));
    for (job, moved) in [("kept", -1e-4), ("none", 0.0), ("other", 5e-5)] {
        let solve = ["solve", "batch.ron", "--job", job, "--format", "json"];
        let report = bench.hyperstat(&solve).ends_with(0).json();
        let found = numbers(&report["output"]["displacement"]);
        assert_near(found[2], moved, 1e-11, 1e-4);
    }
}

/// A preload along a motion that nothing resists is told as one, at its joint.
#[test]
fn a_preload_that_nothing_bears_is_told_with_its_joint() {
    let bench = Bench::new("misfits-free-preload");
    let none = "stiffness: (x: 0.0, y: 0.0, z: 0.0, u: 0.0, v: 0.0, w: 0.0)";
    let text = bar(none).replace(
        "\"bar\"), kind: Fixed),",
        "\"bar\"), kind: Fixed, stiffness: (x: 0.0), preload: (x: 10.0)),",
    );
    bench.file("slides.ron", &text);
    for command in ["solve", "check"] {
        bench
            .hyperstat(&[command, "slides.ron"])
            .ends_with(2)
            .says(&[
                "slides.ron:8:9",
                "the preload of joint `wall` works on a motion that nothing resists: `bar` moves",
                "hold the ",
            ]);
    }
}
