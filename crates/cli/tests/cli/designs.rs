//! Jobs that vary: a row for every pose of every design, which is what the design alone gives.

use std::path::Path;

use crate::support::{Bench, delta_batch};

const POSES: &str = "List([(0.0, 0.0, 0.45), (0.05, -0.02, 0.5), (0.0, 0.0, 5.0)])";

/// The cells of a CSV file's rows, without its header; none of them is in quotes.
fn rows(csv: &str) -> Vec<Vec<&str>> {
    let lines = csv.lines().skip(1);
    lines.map(|line| line.split(',').collect()).collect()
}

#[test]
fn every_design_is_what_it_gives_alone() {
    let bench = Bench::new("designs-alone");
    let vary = r#"vary: { "rod.section.diameter": [0.012, 0.016], "elements": Range(1, 3, 3) }"#;
    let written = |elements: &str| {
        delta_batch("d", POSES, "").replace("rod_spacing", &format!("{elements}rod_spacing"))
    };
    let batch = written("elements: 1, ").replace("loads:", &format!("{vary}, loads:"));
    bench.file("designs.ron", &batch);
    let outcome = bench.hyperstat(&["run", "designs.ron", "--out", "all", "--threads", "1"]);
    let outcome = outcome.ends_with(1);
    let summary = "d: 6 designs, 18 poses, 6 without a result\n  6 unreachable, the first of them design 0, pose 2: ";
    assert!(outcome.out().contains(summary), "{}", outcome.out());
    let all = bench.read("all/d.csv");
    let header = all.lines().next().unwrap();
    assert!(
        header.ends_with(",k56,k66,design,rod.section.diameter,elements"),
        "{header}"
    );
    let all = rows(&all);
    assert_eq!(all.len(), 18);
    for (number, design) in all.chunks(3).enumerate() {
        let (diameter, elements) = (["0.012", "0.016"][number % 2], number / 2 + 1);
        let alone = written(&format!("elements: {elements}, "))
            .replace("diameter: 0.014", &format!("diameter: {diameter}"));
        bench.file("alone.ron", &alone);
        bench
            .hyperstat(&["run", "alone.ron", "--out", "alone"])
            .ends_with(1);
        let alone = bench.read("alone/d.csv");
        for (row, alone) in design.iter().zip(rows(&alone)) {
            assert_eq!(row[..35], alone, "design {number}");
            let last = [&number.to_string(), diameter, &format!("{elements}.0")];
            assert_eq!(row[35..], last);
        }
    }
    assert_ne!(all[0][8..], all[3][8..]);
}

#[test]
fn the_bytes_do_not_depend_on_the_threads() {
    let bench = Bench::new("designs-threads");
    let vary =
        r#"vary: { "rod.section.diameter": Range(0.01, 0.02, 150), "arm_length": [0.3, 0.31] }"#;
    bench.file("d.ron", &delta_batch("d", POSES, vary));
    for threads in ["1", "3"] {
        for format in ["csv", "parquet"] {
            let arguments = [
                "run",
                "d.ron",
                "--out",
                threads,
                "--threads",
                threads,
                "--format",
                format,
            ];
            bench.hyperstat(&arguments).ends_with(1);
        }
    }
    for name in ["d.csv", "d.parquet"] {
        let [one, three] =
            ["1", "3"].map(|folder| std::fs::read(bench.path(folder).join(name)).unwrap());
        assert!(one == three, "{name}");
    }
}

#[test]
fn the_example_runs() {
    let bench = Bench::new("designs-example");
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/designs.ron");
    let example = example.to_str().unwrap();
    let outcome = bench
        .hyperstat(&["run", example, "--out", "."])
        .ends_with(0);
    assert!(
        outcome
            .out()
            .contains("delta-rods-and-arms: 12 designs, 24 poses, all solved")
    );
    assert!(
        outcome
            .out()
            .contains("portal-arms: 3 designs, 3 poses, all solved")
    );
    let table = bench.read("portal-arms.csv");
    // What the 35 columns before leave of a line: no cell of theirs is in quotes.
    let ends: Vec<_> = table
        .lines()
        .filter_map(|line| line.splitn(36, ',').nth(35))
        .collect();
    assert_eq!(
        ends,
        [
            "design,sections.rod,materials.steel.young",
            "0,Circle(diameter: 0.014),210000000000.0",
            "1,\"Tube(outer: 0.018, inner: 0.014)\",210000000000.0",
            "2,Circle(diameter: 0.020),70000000000.0",
        ]
    );
}

#[test]
fn one_design_is_solved_in_full() {
    let bench = Bench::new("designs-solve");
    let vary = r#"vary: { "rod.section.diameter": [0.012, 0.016] }"#;
    bench.file("designs.ron", &delta_batch("d", POSES, vary));
    bench.file(
        "alone.ron",
        &delta_batch("d", POSES, "").replace("0.014", "0.016"),
    );
    let solve = [
        "solve",
        "designs.ron",
        "--format",
        "json",
        "--design",
        "1",
        "--pose",
        "1",
    ];
    let mut found = bench.hyperstat(&solve).ends_with(0).json();
    let solve = ["solve", "alone.ron", "--format", "json", "--pose", "1"];
    let wanted = bench.hyperstat(&solve).ends_with(0).json();
    assert_eq!(
        found.as_object_mut().unwrap().remove("design"),
        Some(1.into())
    );
    assert_eq!(found, wanted);

    let report = bench
        .hyperstat(&["solve", "designs.ron", "--design", "1"])
        .ends_with(0);
    assert!(
        report.out().contains("(job d, design 1, pose 0)"),
        "{}",
        report.out()
    );
    let outcome = bench
        .hyperstat(&["solve", "designs.ron", "--design", "2"])
        .ends_with(2);
    outcome.says(&[
        "job `d` has no design 2: it has 2, counted from 0",
        "choose `--design` from 0 to 1",
    ]);
    let outcome = bench
        .hyperstat(&["check", "alone.ron", "--design", "1"])
        .ends_with(2);
    outcome.says(&["job `d` has no design 1", "leave `--design` out"]);
}

/// The batch of a delta with rods of tubes, `vary` and more of the job after it.
fn tubes(vary: &str, poses: &str) -> String {
    let tube = "Tube(outer: 0.014, inner: 0.01)";
    delta_batch("d", poses, vary).replace("Circle(diameter: 0.014)", tube)
}

/// A row of a table as its status, its design and the two values.
fn told(csv: &str) -> Vec<(String, usize, f64, f64)> {
    let names: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    let place = |name: &str| names.iter().position(|known| *known == name).unwrap();
    let [status, design, a, b] =
        ["status", "design", "rod.section.outer", "rod.section.inner"].map(place);
    let row = |row: Vec<&str>| {
        assert_eq!(row.len(), names.len());
        let number = |place: usize| row[place].parse::<f64>().unwrap();
        (
            row[status].to_string(),
            number(design) as usize,
            number(a),
            number(b),
        )
    };
    rows(csv).into_iter().map(row).collect()
}

/// Designs that cannot be are rows, so that there are designs × poses of them always; the run goes on,
/// later jobs too, and says which was the first.
#[test]
fn a_design_that_cannot_be_is_rows() {
    let bench = Bench::new("designs-impossible");
    let vary = r#"vary: {
        "rod.section.outer": [0.010, 0.014, 0.018],
        "rod.section.inner": [0.012, 0.009, 0.016],
    }, figures: [Deformed(pose: 1), Trajectory],"#;
    let batch = tubes(vary, POSES);
    let later = r#"(name: "later", mechanism: SingleFreedom(
        lengths: (0.4, 0.3), sections: (Circle(diameter: 0.02), Circle(diameter: 0.025)),
        material: (young: 2.1e11, poisson: 0.3), joint_stiffness: (2e7, 3e7))),
    ],
)"#;
    let end = batch.rfind("],").unwrap();
    bench.file("d.ron", &format!("{}{later}", &batch[..end]));
    let mut tables = Vec::new();
    for threads in ["1", "3"] {
        let arguments = ["run", "d.ron", "--out", "out", "--threads", threads];
        let outcome = bench.hyperstat(&arguments).ends_with(1);
        let message = "  9 design, the first of them design 0, pose 0: d.ron:";
        assert!(outcome.out().contains(message), "{}", outcome.out());
        let why =
            "design 0: `inner` of the section cannot be 0.012; it must be zero or more and below";
        assert!(outcome.out().contains(why), "{}", outcome.out());
        assert!(
            outcome
                .out()
                .contains("d: 9 designs, 27 poses, 15 without a result")
        );
        assert!(outcome.out().contains("later: 1 pose, all solved"));
        // The figures are of the first that can be.
        assert!(bench.read("out/d-deformed.svg").contains("design 1"));
        assert!(bench.path("out/d-trajectory.svg").exists());
        tables.push(bench.read("out/d.csv"));
    }
    assert_eq!(tables[0], tables[1]);
    let found = told(&tables[0]);
    assert_eq!(found.len(), 27);
    for (row, (status, design, outer, inner)) in found.into_iter().enumerate() {
        assert_eq!(design, row / 3);
        assert_eq!(outer, [0.010, 0.014, 0.018][design % 3]);
        assert_eq!(inner, [0.012, 0.009, 0.016][design / 3]);
        let expected = match row % 3 {
            _ if inner >= outer => "design",
            2 => "unreachable",
            _ => "ok",
        };
        assert_eq!(status, expected, "design {design}");
        let line = rows(&tables[0])[row].clone();
        if status == "design" {
            assert!(line[8..35].iter().all(|cell| cell.is_empty()));
            // What was asked for, and the orientation that a delta keeps.
            assert_eq!(line[3], ["0.45", "0.5", "5.0"][row % 3]);
            assert_eq!(line[4], "0.0");
        }
    }
    // `solve` of such a design says what is wrong with it.
    let solve = ["solve", "d.ron", "--job", "d", "--design", "0"];
    bench
        .hyperstat(&solve)
        .ends_with(2)
        .says(&["design 0: `inner` of the section cannot be 0.012"]);
    bench
        .hyperstat(&["solve", "d.ron", "--job", "d", "--design", "1"])
        .ends_with(0);
}

/// So is one among so many that they are not all looked at first.
#[test]
fn a_late_design_that_cannot_be_is_rows() {
    let bench = Bench::new("designs-late");
    let vary = r#"vary: {
        "rod.section.inner": Range(0.008, 0.012, 101),
        "rod.section.outer": [0.014, 0.011],
        "arm_length": Range(0.3, 0.31, 50),
    }"#;
    bench.file("d.ron", &tubes(vary, "List([(0.0, 0.0, 5.0)])"));
    let outcome = bench
        .hyperstat(&["run", "d.ron", "--out", "out"])
        .ends_with(1);
    let why = "design 176: `inner` of the section cannot be 0.011";
    assert!(outcome.out().contains(why), "{}", outcome.out());
    let found = told(&bench.read("out/d.csv"));
    assert_eq!(found.len(), 101 * 2 * 50);
    for (status, design, outer, inner) in found {
        let expected = if inner >= outer {
            "design"
        } else {
            "unreachable"
        };
        assert_eq!(status, expected, "design {design}");
    }
}

/// What is wrong in every design, and what is no value at all, ends the run before its first job.
#[test]
fn what_is_wrong_in_every_design_ends_with_2() {
    let bench = Bench::new("designs-wrong");
    for (vary, message) in [
        (
            r#""rod.section.inner": [0.014, 0.02]"#,
            "design 0: `inner` of the section",
        ),
        (
            r#""rod.section.inner": [0.008, "thin"]"#,
            "design 1: expected a number",
        ),
        (
            r#""rod.section": [Circle(diameter: 0.01), Circle(radius: 0.01)]"#,
            "design 1: unknown field `radius`",
        ),
        (r#""rod.section.iner": [0.008]"#, "`iner`"),
    ] {
        bench.file("d.ron", &tubes(&format!("vary: {{ {vary} }}"), POSES));
        bench
            .hyperstat(&["run", "d.ron", "--out", "out"])
            .ends_with(2)
            .says(&[message]);
        assert!(!bench.path("out").exists());
    }
}

/// A design whose topology cannot be solved is rows with their status, the first one too.
#[test]
fn a_design_that_nothing_holds_is_rows() {
    let bench = Bench::new("designs-unheld");
    bench.file(
        "two.ron",
        r#"(
            name: "two", points: { "A": (0, 0, 0), "B": (0.5, 0, 0) },
            materials: { "steel": (young: 2.1e11, poisson: 0.3) },
            sections: { "rod": Circle(diameter: 0.02) },
            bodies: {
                "bar": Beam(through: ["A", "B"], section: "rod", material: "steel"),
                "frame": Rigid(points: ["B"]),
                "hand": Rigid(points: ["B"]),
            },
            joints: {
                "wall": (at: "A", between: ("ground", "bar"), kind: Fixed),
                "tip": (at: "B", between: ("bar", "frame"), kind: Fixed),
                "grip": (at: "B", between: ("frame", "hand"), kind: Fixed),
            },
            output: ("bar", "B"),
        )"#,
    );
    let job = |first: &str| {
        format!(
            r#"(jobs: [(name: "two", mechanism: File("two.ron"),
                vary: {{ "joints.tip.between.0": [{first}] }})])"#
        )
    };
    bench.file("d.ron", &job(r#""hand", "bar""#));
    let run = ["run", "d.ron", "--out", "out"];
    let outcome = bench.hyperstat(&run).ends_with(1);
    assert!(
        outcome.out().contains("1 unrestrained"),
        "{}",
        outcome.out()
    );
    let table = bench.read("out/two.csv");
    let status: Vec<_> = rows(&table).iter().map(|row| row[7].to_string()).collect();
    assert_eq!(status, ["unrestrained", "ok"]);
    assert_eq!(rows(&table)[0][1..4], ["0.5", "0.0", "0.0"]);
    bench.file("d.ron", &job(r#""hand""#));
    bench.hyperstat(&run).ends_with(2).says(&["nothing holds"]);
}
