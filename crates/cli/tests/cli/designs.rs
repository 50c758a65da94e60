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

/// Of so many designs not all are checked first: the run ends where one cannot be made, and leaves
/// no file.
#[test]
fn a_design_that_cannot_be_made_ends_the_run() {
    let bench = Bench::new("designs-refused");
    let vary = r#"vary: {
        "rod.section.inner": Range(0.008, 0.012, 101),
        "rod.section.outer": [0.014, 0.011],
        "arm_length": Range(0.3, 0.31, 50),
    }"#;
    let batch = delta_batch("d", "List([(0.0, 0.0, 5.0)])", vary);
    let tube = "Tube(outer: 0.014, inner: 0.01)";
    bench.file("d.ron", &batch.replace("Circle(diameter: 0.014)", tube));
    let outcome = bench
        .hyperstat(&["run", "d.ron", "--out", "out"])
        .ends_with(2);
    outcome.says(&[
        "design 176: `inner` of the section cannot be 0.011",
        "\"rod.section.inner\": Range(0.008, 0.012, 101)",
    ]);
    assert!(bench.names("out").is_empty());
}
