//! `hyperstat run`: CSV files, figures, the summary, and failures of poses and of the disk.

use std::fs;

use crate::support::{Bench, CANTILEVER, assert_near, delta_batch, hinged};

/// The header that format.md prescribes, written out.
const HEADER: &str = "pose,x,y,z,rx,ry,rz,status,dx,dy,dz,drx,dry,drz,\
k11,k12,k13,k14,k15,k16,k22,k23,k24,k25,k26,k33,k34,k35,k36,k44,k45,k46,k55,k56,k66";

/// The rows of a CSV file, without its header.
fn rows(csv: &str) -> Vec<Vec<&str>> {
    csv.lines()
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect()
}

fn number(cell: &str) -> f64 {
    cell.parse()
        .unwrap_or_else(|_| panic!("`{cell}` is no number"))
}

#[test]
fn a_grid_is_written_in_order_with_x_fastest() {
    let bench = Bench::new("run-grid");
    let poses = "Grid(x: (-0.02, 0.02, 3), y: (0.0, 0.03, 2), z: (0.45, 0.5, 2))";
    bench.file("grid.ron", &delta_batch("grid", poses, ""));
    let outcome = bench.hyperstat(&["run", "grid.ron", "--out", "out"]);
    let outcome = outcome.ends_with(0);
    assert!(
        outcome.out().contains("grid: 12 poses, all solved"),
        "{}",
        outcome.out()
    );
    assert_eq!(bench.results("out"), ["grid.csv"]);

    let csv = bench.read("out/grid.csv");
    assert_eq!(csv.lines().next(), Some(HEADER));
    let rows = rows(&csv);
    assert_eq!(rows.len(), 12);
    for (pose, row) in rows.iter().enumerate() {
        assert_eq!(row.len(), 35);
        assert_eq!(row[0], pose.to_string());
        assert_eq!(row[7], "ok");
        assert_near(number(row[1]), [-0.02, 0.0, 0.02][pose % 3], 1e-15, 1.0);
        assert_near(number(row[2]), [0.0, 0.03][pose / 3 % 2], 1e-15, 1.0);
        assert_near(number(row[3]), [0.45, 0.5][pose / 6], 1e-15, 1.0);
        assert!(row[8..].iter().all(|cell| number(cell).is_finite()));
    }
}

#[test]
fn a_row_is_what_solve_says_of_the_pose() {
    let bench = Bench::new("run-as-solve");
    let poses = "List([(0.0, 0.0, 0.45), (0.05, -0.02, 0.5)])";
    bench.file("delta.ron", &delta_batch("delta", poses, ""));
    bench
        .hyperstat(&["run", "delta.ron", "--out", "."])
        .ends_with(0);
    let csv = bench.read("delta.csv");
    for (pose, row) in rows(&csv).into_iter().enumerate() {
        let number_of_pose = pose.to_string();
        let arguments = [
            "solve",
            "delta.ron",
            "--format",
            "json",
            "--pose",
            &number_of_pose,
        ];
        let output = bench.hyperstat(&arguments).ends_with(0).json()["output"].clone();
        let k = |r: usize, c: usize| output["stiffness"][r][c].as_f64().unwrap();
        let mut cells = row[14..].iter();
        for r in 0..6 {
            for c in r..6 {
                let scale = (k(r, r) * k(c, c)).sqrt();
                assert_near(number(cells.next().unwrap()), k(r, c), 1e-9, scale);
            }
        }
        for (component, cell) in row[8..14].iter().enumerate() {
            let expected = output["displacement"][component].as_f64().unwrap();
            assert_near(number(cell), expected, 1e-9, 1e-4);
        }
    }
}

#[test]
fn many_poses_come_out_in_order() {
    let bench = Bench::new("run-many");
    // More than the threads solve at a time.
    let poses = "Grid(x: (-0.05, 0.05, 1500), y: (0.0, 0.0, 1), z: (0.45, 0.45, 1))";
    bench.file("line.ron", &delta_batch("line", poses, ""));
    bench
        .hyperstat(&["run", "line.ron", "--out", "out"])
        .ends_with(0);
    let csv = bench.read("out/line.csv");
    let rows = rows(&csv);
    assert_eq!(rows.len(), 1500);
    for (pose, row) in rows.iter().enumerate() {
        assert_eq!(row[0], pose.to_string());
        assert_near(
            number(row[1]),
            -0.05 + 0.1 * pose as f64 / 1499.0,
            1e-15,
            1.0,
        );
    }
}

#[test]
fn a_pose_out_of_reach_is_a_row_and_status_1() {
    let bench = Bench::new("run-unreachable");
    let poses = "List([(0.0, 0.0, 0.45), (9.0, 0.0, 0.5), (0.0, 0.01, 0.45)])";
    bench.file("delta.ron", &delta_batch("delta", poses, ""));
    let outcome = bench.hyperstat(&["run", "delta.ron", "--out", "out"]);
    let outcome = outcome.ends_with(1);
    assert!(
        outcome.out().contains("3 poses, 1 without a result")
            && outcome
                .out()
                .contains("1 unreachable, the first of them pose 1"),
        "{}",
        outcome.out()
    );
    let csv = bench.read("out/delta.csv");
    let rows = rows(&csv);
    let status: Vec<_> = rows.iter().map(|row| row[7]).collect();
    assert_eq!(status, ["ok", "unreachable", "ok"]);
    let failed = &rows[1];
    assert_eq!(failed.len(), 35);
    assert_eq!(number(failed[1]), 9.0);
    assert_eq!(number(failed[3]), 0.5);
    assert!(failed[8..].iter().all(|cell| cell.is_empty()));
}

#[test]
fn what_moves_freely_or_not_at_all_is_a_row_with_its_status() {
    let bench = Bench::new("run-status");
    // A load on the hinge's own point does no work.
    let free = hinged().replace(r#"on: ("bar", "B")"#, r#"on: ("bar", "A")"#);
    let held = CANTILEVER.replace(r#"output: ("bar", "B")"#, r#"output: ("bar", "A")"#);
    bench.file("loaded.ron", &hinged());
    bench.file("free.ron", &free);
    bench.file("held.ron", &held);
    bench.file(
        "batch.ron",
        r#"(jobs: [
            (name: "loaded", mechanism: File("loaded.ron")),
            (name: "free", mechanism: File("free.ron")),
            (name: "held", mechanism: File("held.ron")),
        ])"#,
    );
    bench
        .hyperstat(&["run", "batch.ron", "--out", "out"])
        .ends_with(1);
    for (job, status) in [
        ("loaded", "unrestrained"),
        ("free", "unrestrained"),
        ("held", "rigid"),
    ] {
        let csv = bench.read(&format!("out/{job}.csv"));
        let rows = rows(&csv);
        assert_eq!(rows[0][7], status, "{job}");
        // What is clamped stays where it is: known, unlike the others' displacement.
        let known = if status == "rigid" { 6 } else { 0 };
        let (displacement, others) = rows[0][8..].split_at(known);
        assert!(displacement.iter().all(|cell| number(cell) == 0.0), "{job}");
        assert!(others.iter().all(|cell| cell.is_empty()), "{job}");
    }
}

#[test]
fn no_pose_in_reach_is_still_a_file() {
    let bench = Bench::new("run-none");
    let poses = "List([(9.0, 0.0, 0.5), (0.0, 9.0, 0.5)])";
    let figures = "figures: [Trajectory(scale: Auto), Deformed(pose: 1, scale: Auto)],";
    bench.file("delta.ron", &delta_batch("delta", poses, figures));
    let outcome = bench.hyperstat(&["run", "delta.ron", "--out", "out"]);
    let outcome = outcome.ends_with(1);
    assert!(
        outcome.out().contains("no delta-trajectory"),
        "{}",
        outcome.out()
    );
    assert!(
        outcome.out().contains("no delta-deformed"),
        "{}",
        outcome.out()
    );
    assert_eq!(bench.results("out"), ["delta.csv"]);
    assert_eq!(rows(&bench.read("out/delta.csv")).len(), 2);
}

#[test]
fn a_file_without_poses_is_one_row_and_its_stiffness_is_told() {
    let bench = Bench::new("run-file");
    bench.file("cantilever.ron", CANTILEVER);
    bench.file(
        "batch.ron",
        r#"(jobs: [(name: "bar", mechanism: File("cantilever.ron"))])"#,
    );
    let outcome = bench.hyperstat(&["run", "batch.ron", "--out", "out"]);
    let outcome = outcome.ends_with(0);
    let csv = bench.read("out/bar.csv");
    let rows = rows(&csv);
    assert_eq!(rows.len(), 1);
    assert_eq!(rows[0][..4], ["0", "0.5", "0.0", "0.0"]);
    assert!(
        outcome.out().contains("stiffness of the output"),
        "{}",
        outcome.out()
    );
    // E A / L, in the file and in the summary.
    let axial = 2.1e11 * std::f64::consts::PI * 0.01f64.powi(2) / 0.5;
    assert_near(number(rows[0][14]), axial, 1e-12, axial);
    assert!(outcome.out().contains("1.31947e8"), "{}", outcome.out());
}

#[test]
fn figures_are_written_and_compared_with_the_reference_solver() {
    let bench = Bench::new("run-figures");
    let poses = "List([(0.0, 0.0, 0.45), (0.05, 0.0, 0.45), (0.05, 0.05, 0.45)])";
    let figures = "figures: [Trajectory(scale: Auto), Deformed(pose: 0, scale: Auto), \
                   Deformed(pose: 2, scale: 50.0)],";
    bench.file("delta.ron", &delta_batch("delta", poses, figures));
    let outcome = bench.hyperstat(&["run", "delta.ron", "--out", "out"]);
    let outcome = outcome.ends_with(0);
    assert_eq!(
        bench.results("out"),
        [
            "delta-deformed-1.png",
            "delta-deformed-1.svg",
            "delta-deformed-2.png",
            "delta-deformed-2.svg",
            "delta-trajectory.png",
            "delta-trajectory.svg",
            "delta.csv",
        ]
    );
    assert!(bench.read("out/delta-trajectory.svg").contains("<svg"));
    let png = fs::read(bench.path("out/delta-deformed-1.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
    let line = outcome
        .out()
        .lines()
        .find(|line| line.contains("largest difference from the reference solver"))
        .unwrap_or_else(|| panic!("{}", outcome.out()));
    let difference = line
        .split_whitespace()
        .find_map(|word| word.parse::<f64>().ok())
        .unwrap();
    assert!(difference < 1e-8, "{line}");
}

#[test]
fn all_jobs_are_checked_before_the_first_runs() {
    let bench = Bench::new("run-checked-first");
    bench.file("cantilever.ron", CANTILEVER);
    let sound = r#"(name: "bar", mechanism: File("cantilever.ron"))"#;
    let figure = sound.replace("bar", "late").replace(
        "ron\")",
        "ron\"), figures: [Deformed(pose: 3, scale: Auto)]",
    );
    bench.file("batch.ron", &format!("(jobs: [\n{sound},\n{figure},\n])"));
    let outcome = bench.hyperstat(&["run", "batch.ron", "--out", "out"]);
    outcome.ends_with(2).says(&["batch.ron:3:"]);
    assert!(!bench.path("out").exists());
}

#[test]
fn a_mechanism_file_is_not_run() {
    let bench = Bench::new("run-mechanism");
    bench.file("cantilever.ron", CANTILEVER);
    let outcome = bench.hyperstat(&["run", "cantilever.ron", "--out", "out"]);
    outcome
        .ends_with(2)
        .says(&["cantilever.ron:1:1", "a batch", "help: "]);
}

#[test]
fn an_output_folder_that_cannot_be_made_ends_with_3() {
    let bench = Bench::new("run-no-folder");
    bench.file("cantilever.ron", CANTILEVER);
    bench.file(
        "batch.ron",
        r#"(jobs: [(name: "bar", mechanism: File("cantilever.ron"))])"#,
    );
    bench.file("taken", "a file, not a folder");
    for folder in ["taken", "taken/below"] {
        let outcome = bench.hyperstat(&["run", "batch.ron", "--out", folder]);
        outcome.ends_with(3).says(&["cannot write", "taken"]);
    }
    assert_eq!(bench.read("taken"), "a file, not a folder");
}

#[test]
fn a_file_that_cannot_be_written_ends_with_3_and_leaves_nothing_behind() {
    let bench = Bench::new("run-no-file");
    bench.file("cantilever.ron", CANTILEVER);
    bench.file(
        "batch.ron",
        r#"(jobs: [(name: "bar", mechanism: File("cantilever.ron"))])"#,
    );
    // A folder has the file's name.
    fs::create_dir_all(bench.path("out/bar.csv")).unwrap();
    let outcome = bench.hyperstat(&["run", "batch.ron", "--out", "out"]);
    outcome.ends_with(3).says(&["cannot write", "bar.csv"]);
    assert_eq!(bench.results("out"), ["bar.csv"]);
}

#[test]
fn an_older_result_stays_until_the_new_one_is_complete() {
    let bench = Bench::new("run-again");
    bench.file("cantilever.ron", CANTILEVER);
    bench.file(
        "batch.ron",
        r#"(jobs: [(name: "bar", mechanism: File("cantilever.ron"))])"#,
    );
    fs::create_dir(bench.path("out")).unwrap();
    bench.file("out/bar.csv", "old");
    bench
        .hyperstat(&["run", "batch.ron", "--out", "out"])
        .ends_with(0);
    assert!(bench.read("out/bar.csv").starts_with(HEADER));
    assert_eq!(bench.results("out"), ["bar.csv"]);
}

#[test]
fn a_disk_that_is_full_on_the_way_ends_with_3_and_leaves_the_older_result() {
    let bench = Bench::new("run-full");
    let poses = "Grid(x: (-0.05, 0.05, 1500), y: (0.0, 0.0, 1), z: (0.45, 0.45, 1))";
    bench.file("line.ron", &delta_batch("line", poses, ""));
    for format in ["csv", "parquet"] {
        let name = format!("line.{format}");
        let _ = fs::remove_dir_all(bench.path("out"));
        fs::create_dir(bench.path("out")).unwrap();
        bench.file(&format!("out/{name}"), "old");
        let arguments = ["run", "line.ron", "--out", "out", "--format", format];
        let Some(outcome) = bench.hyperstat_on_a_small_disk(&arguments) else {
            println!("this system has no shell that limits the size of files");
            return;
        };
        outcome.ends_with(3).says(&["cannot write", &name]);
        assert_eq!(bench.results("out"), [name.as_str()]);
        assert_eq!(bench.read(&format!("out/{name}")), "old");
    }
}

#[test]
fn a_number_of_threads_that_is_none_ends_with_2() {
    let bench = Bench::new("run-threads");
    bench.file("cantilever.ron", CANTILEVER);
    bench.file(
        "batch.ron",
        r#"(jobs: [(name: "bar", mechanism: File("cantilever.ron"))])"#,
    );
    for threads in ["many", "1.5"] {
        let arguments = ["run", "batch.ron", "--out", "out", "--threads", threads];
        bench
            .hyperstat(&arguments)
            .ends_with(2)
            .says(&["--threads"]);
    }
    assert!(!bench.path("out").exists());
}
