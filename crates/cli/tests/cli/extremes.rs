//! Nothing, one and very many of everything, through every command: a result or a message, never a
//! panic, and never an end for want of memory.

use std::ffi::OsString;
use std::fmt::Write as _;
use std::process::ExitCode;

use hyperstat_mechanisms::Registry;

use crate::support::Bench;

/// A number of 16 bits, and one more.
const MANY: usize = 1 << 16;

/// A mechanism file of these fields, after a name, a material and a section.
fn mechanism(name: &str, fields: &str) -> String {
    format!(
        r#"(
    name: "{name}",
    materials: {{ "steel": (young: 2.1e11, poisson: 0.3, density: 7850.0) }},
    sections: {{ "rod": Circle(diameter: 0.02) }},
    {fields}
)"#
    )
}

/// A beam welded to the ground, with a force on its end.
fn cantilever(name: &str, beam: &str, tip: &str) -> String {
    let fields = format!(
        r#"points: {{ "A": (0.0, 0.0, 0.0), "{tip}": (0.5, 0.0, 0.0) }},
    bodies: {{ "{beam}": Beam(through: ["A", "{tip}"], section: "rod", material: "steel") }},
    joints: {{ "weld": (at: "A", between: ("ground", "{beam}"), kind: Fixed) }},
    loads: [(on: ("{beam}", "{tip}"), force: (0.0, 0.0, -50.0))],
    output: ("{beam}", "{tip}"),"#
    );
    mechanism(name, &fields)
}

fn batch(fields: &str) -> String {
    format!("(jobs: [(name: \"job\", mechanism: File(\"m.ron\"), {fields})])")
}

/// No joint moves: there is nothing to follow, and the pose of the file is the only one.
#[test]
fn a_mechanism_without_a_free_joint_has_one_pose() {
    let bench = Bench::new("extremes-no-free-joint");
    bench.file("m.ron", &cantilever("m", "beam", "B"));
    bench.file(
        "b.ron",
        &batch("poses: List([(0.5, 0.0, 0.0), (0.5, 0.0, 0.1)])"),
    );
    bench
        .hyperstat(&["run", "b.ron", "--out", "out"])
        .ends_with(1);
    let table = bench.read("out/job.csv");
    let rows: Vec<_> = table
        .lines()
        .skip(1)
        .map(|row| row.split(',').nth(7))
        .collect();
    assert_eq!(rows, [Some("ok"), Some("unreachable")]);
    bench.hyperstat(&["check", "b.ron"]).ends_with(0);
    bench.hyperstat(&["solve", "b.ron"]).ends_with(0);
    bench
        .hyperstat(&["check", "b.ron", "--pose", "1"])
        .ends_with(2);
    bench.hyperstat(&["export", "b.ron"]).ends_with(0);
}

/// Names around 2^16 characters: widths of a formatter end there.
#[test]
fn names_of_2_to_the_16_characters_are_names() {
    let bench = Bench::new("extremes-names");
    for length in [65_532, MANY] {
        let long = "n".repeat(length);
        bench.file("m.ron", &cantilever("m", &long, &long));
        bench.hyperstat(&["check", "m.ron"]).ends_with(0);
        let solve = ["solve", "m.ron", "--why", "--modes", "1", "--all-nodes"];
        let out = bench.hyperstat(&solve).ends_with(0);
        assert!(out.out().contains(&long));
        bench
            .hyperstat(&["solve", "m.ron", "--format", "json"])
            .ends_with(0);
        bench.hyperstat(&["export", "m.ron"]).ends_with(0);
        bench.file("b.ron", &batch(""));
        bench
            .hyperstat(&["run", "b.ron", "--out", "out", "--summary"])
            .ends_with(0);
        for kind in ["--deformed", "--budget"] {
            bench
                .hyperstat(&["plot", "m.ron", kind, "--out", "figure"])
                .ends_with(0);
        }
    }
}

/// Empty maps and lists: a message with its place, or what is left.
#[test]
fn nothing_at_all_is_told() {
    let bench = Bench::new("extremes-nothing");
    let nothing = [
        "points: {}, bodies: {}, joints: {}, output: (\"a\", \"A\"),",
        "points: { \"A\": (0.0, 0.0, 0.0) }, bodies: { \"a\": Rigid(points: []) }, joints: {}, output: (\"a\", \"A\"),",
        "points: { \"A\": (0.0, 0.0, 0.0) }, bodies: { \"a\": Rigid(points: [\"A\"]) }, joints: {}, output: (\"a\", \"A\"),",
    ];
    for fields in nothing {
        bench.file("m.ron", &mechanism("m", fields));
        for command in ["solve", "check", "plot"] {
            let mut arguments = vec![command, "m.ron"];
            arguments.extend((command == "plot").then_some("--deformed"));
            let outcome = bench.hyperstat(&arguments).ends_with(2);
            assert!(outcome.err().starts_with("error"), "{}", outcome.err());
        }
    }
    // A point that is a body, welded: everything is zero.
    let point = "points: { \"A\": (0.0, 0.0, 0.0) }, bodies: { \"a\": Rigid(points: [\"A\"]) }, \
                 joints: { \"j\": (at: \"A\", between: (\"ground\", \"a\"), kind: Fixed) }, loads: [], \
                 cases: {}, masses: [], output: (\"a\", \"A\"),";
    bench.file("m.ron", &mechanism("m", point));
    bench.hyperstat(&["check", "m.ron"]).ends_with(0);
    bench
        .hyperstat(&["solve", "m.ron", "--verify"])
        .ends_with(0);
    bench
        .hyperstat(&["plot", "m.ron", "--deformed"])
        .ends_with(0);
    for jobs in [
        "(jobs: [])",
        "(jobs: [(name: \"j\", mechanism: File(\"m.ron\"), poses: List([]))])",
    ] {
        bench.file("b.ron", jobs);
        let outcome = bench.hyperstat(&["run", "b.ron", "--out", "out"]);
        assert!([0, 2].contains(&outcome.status()), "{}", outcome.err());
    }
}

/// 2^16 loads, points, masses and cases on one beam.
#[test]
fn very_many_loads_points_masses_and_cases() {
    let bench = Bench::new("extremes-counts");
    let (mut points, mut loads, mut masses) = (String::new(), String::new(), String::new());
    for k in 0..MANY {
        let _ = write!(points, "\"q{k}\": (0.0, 0.0, {k}.0),");
        let _ = write!(loads, "(on: (\"beam\", \"B\"), force: (0.0, 0.0, -0.001)),");
        let _ = write!(masses, "(on: (\"beam\", \"B\"), mass: 0.001),");
    }
    let fields = format!(
        r#"points: {{ "A": (0.0, 0.0, 0.0), "B": (0.5, 0.0, 0.0), {points} }},
    bodies: {{ "beam": Beam(through: ["A", "B"], section: "rod", material: "steel", elements: {MANY}) }},
    joints: {{ "weld": (at: "A", between: ("ground", "beam"), kind: Fixed) }},
    loads: [{loads}], masses: [{masses}], output: ("beam", "B"),"#
    );
    bench.file("m.ron", &mechanism("m", &fields));
    let check = bench.hyperstat(&["check", "m.ron"]).ends_with(0);
    assert!(check.out().contains("`q0`") && check.out().contains("and 65528 more"));
    let json = bench
        .hyperstat(&["solve", "m.ron", "--format", "json"])
        .ends_with(0)
        .json();
    // F L³ / 3 E I, as of one force.
    let expected =
        -65.536 * 0.125 / (3.0 * 2.1e11 * std::f64::consts::PI * 0.02_f64.powi(4) / 64.0);
    let found = json["output"]["displacement"][2].as_f64().unwrap();
    assert!(
        (found / expected - 1.0).abs() < 1e-10,
        "{found}, not {expected}"
    );
    let mut cases = String::new();
    for k in 0..MANY {
        let _ = write!(
            cases,
            "\"c{k}\": [(on: (\"beam\", \"B\"), force: (0.0, 0.0, -{k}.0))],"
        );
    }
    let with_cases =
        cantilever("m", "beam", "B").replace("loads:", &format!("cases: {{ {cases} }}, loads:"));
    bench.file("m.ron", &with_cases);
    bench.hyperstat(&["check", "m.ron"]).ends_with(0);
}

/// 2^16 poses of what cannot move, and as many designs.
#[test]
fn very_many_poses_and_designs() {
    let bench = Bench::new("extremes-rows");
    bench.file("m.ron", &cantilever("m", "beam", "B"));
    let poses = "(0.5, 0.0, 0.0),".repeat(MANY);
    bench.file("b.ron", &batch(&format!("poses: List([{poses}])")));
    bench
        .hyperstat(&["run", "b.ron", "--out", "out"])
        .ends_with(0);
    assert_eq!(bench.read("out/job.csv").lines().count(), MANY + 1);
}

/// Rigid bodies in loops, and in a chain: the limit is told instead of an end for want of memory.
#[test]
fn very_many_rigid_bodies_are_counted() {
    let bench = Bench::new("extremes-rigid");
    let (mut points, mut bodies, mut joints) = (String::new(), String::new(), String::new());
    // A plane grid of 50 × 30 squares, hinged to each other.
    for (x, y) in (0..50).flat_map(|x| (0..30).map(move |y| (x, y))) {
        let _ = write!(
            points,
            "\"h{x}_{y}\": ({x}.5, {y}.0, 0.0), \"v{x}_{y}\": ({x}.0, {y}.5, 0.0),"
        );
        let mut own = format!("\"h{x}_{y}\", \"v{x}_{y}\"");
        if x > 0 {
            let _ = write!(own, ", \"h{}_{y}\"", x - 1);
            let _ = write!(
                joints,
                "\"h{x}_{y}\": (at: \"h{0}_{y}\", between: (\"b{0}_{y}\", \"b{x}_{y}\"), kind: Revolute(axis: (0.0, 0.0, 1.0))),",
                x - 1
            );
        }
        if y > 0 {
            let _ = write!(own, ", \"v{x}_{}\"", y - 1);
            let _ = write!(
                joints,
                "\"v{x}_{y}\": (at: \"v{x}_{0}\", between: (\"b{x}_{0}\", \"b{x}_{y}\"), kind: Revolute(axis: (0.0, 0.0, 1.0))),",
                y - 1
            );
        }
        let _ = write!(bodies, "\"b{x}_{y}\": Rigid(points: [{own}]),");
    }
    let fields = format!(
        r#"points: {{ {points} }}, bodies: {{ {bodies} }},
    joints: {{ {joints} "weld": (at: "h0_0", between: ("ground", "b0_0"), kind: Fixed) }},
    output: ("b49_29", "v49_29"),"#
    );
    bench.file("m.ron", &mechanism("m", &fields));
    // Every square is a parallelogram: its opposite bodies turn alike, so all of one colour of a
    // chessboard do, and those of the weld's colour not at all. One motion is left; the 2920 hinges
    // hold five directions each of 1499 bodies.
    let check = bench.hyperstat(&["check", "m.ron"]).ends_with(2);
    let out = check.out();
    assert!(out.contains("mobility         1\n"), "{out}");
    let redundant = 5 * 2920 + 1 - 6 * 1499;
    let line = format!("over-constraint  {redundant}\n");
    assert!(out.contains(&line), "{out}");
    let solve = bench.hyperstat(&["solve", "m.ron"]).ends_with(2);
    assert!(solve.err().contains("moves freely"), "{}", solve.err());
    // A sweep finds the same.
    bench.file("b.ron", &batch(""));
    let outcome = bench.hyperstat(&["run", "b.ron", "--out", "out"]);
    assert!(outcome.ends_with(1).out().contains("1 unrestrained"));
}

/// A panic, here of a kind of joint from outside, ends with 70 and says that it is a bug.
#[test]
fn a_panic_is_told_as_a_bug() {
    let mut registry = Registry::builtin();
    registry.register("Faulty", &[], |_| panic!("a fault of the test"));
    let bench = Bench::new("extremes-panic");
    let faulty = cantilever("m", "beam", "B").replace("kind: Fixed", "kind: Faulty");
    bench.file("m.ron", &faulty);
    let path = bench.path("m.ron").into_os_string();
    let arguments = [OsString::from("hyperstat"), "check".into(), path];
    let status = hyperstat_cli::run(arguments, &registry);
    // A status tells itself in this form alone.
    assert_eq!(format!("{status:?}"), format!("{:?}", ExitCode::from(70)));
    let help = bench.hyperstat(&["--help"]).ends_with(0);
    assert!(help.out().contains("70  a bug in hyperstat"));
}
