//! How runs come out: no number of a row that is `ok` is anything but finite, whoever reads, and whichever way
//! the poses go.

use crate::support::{Bench, CANTILEVER, Table, assert_near, delta_batch};

/// Numbers beyond all measure are refused where they can be told, and no result elsewhere.
#[test]
fn no_number_of_an_ok_row_is_infinite() {
    let bench = Bench::new("rows-finite");
    for act in [
        r#"misfits: { "Ba1": (x: 1e307) },"#,
        "gravity: (0.0, 0.0, 1e307),",
        r#"preloads: { "A1": (v: -1e307) },"#,
        r#"cases: { "c": [(on: ("platform", "P"), force: (1e307, 0.0, 0.0))] },"#,
        r#"masses: [(on: ("platform", "P"), mass: 1e307)], gravity: (0.0, 0.0, 1.0),"#,
    ] {
        bench.file("d.ron", &delta_batch("d", "List([(0.0, 0.0, 0.5)])", act));
        bench
            .hyperstat(&["run", "d.ron", "--out", "out"])
            .ends_with(2)
            .says(&["nothing that acts may be larger than 1e50", "d.ron:14:"]);
    }
    // 1e50 N on 1e-260 N/m.
    let soft = CANTILEVER
        .replace("kind: Fixed", "kind: Fixed, stiffness: (x: 1e-260)")
        .replace("force: (0.0, 0.0, -100.0)", "force: (1e50, 0.0, 0.0)");
    assert!(soft.contains("1e50"), "{soft}");
    bench.file("soft.ron", &soft);
    let solved = bench.hyperstat(&["solve", "soft.ron", "--format", "json"]);
    solved.ends_with(2).says(&["the results overflow"]);
    bench.file(
        "soft-batch.ron",
        r#"(jobs: [
            (name: "one", mechanism: File("soft.ron")),
            (name: "case", mechanism: File("soft.ron"), loads: [],
                cases: { "c": [(on: ("bar", "B"), force: (1e50, 0.0, 0.0))] }),
        ])"#,
    );
    for more in [
        &[][..],
        &["--one-by-one"],
        &["--format", "parquet"],
        &["--summary"],
    ] {
        let arguments = [&["run", "soft-batch.ron", "--out", "out"][..], more].concat();
        bench.hyperstat(&arguments).ends_with(1);
    }
    for job in ["one", "case"] {
        let table = Table::read(&bench, &format!("out/{job}.csv"));
        assert_eq!(table.cell(0, "status"), "failed", "{job}");
        assert!(table.rows[0][8..].iter().all(String::is_empty));
    }
}

/// Who closes standard output does not want to read; the results are files.
#[test]
fn a_closed_standard_output_ends_no_batch() {
    let bench = Bench::new("rows-closed");
    let poses = "List([(0.0, 0.0, 0.5)])";
    let job = |name: &str, poses| {
        let batch = delta_batch(name, poses, "");
        let inner = batch.trim().trim_start_matches("(\n    jobs: [");
        inner.trim_end_matches("],\n)").trim().to_string()
    };
    let sound = format!("(jobs: [{} {}])", job("a", poses), job("b", poses));
    bench.file("d.ron", &sound);
    let failing = job("b", "List([(0.0, 0.0, 0.5), (0.0, 0.0, 9.0)])");
    bench.file("e.ron", &format!("(jobs: [{} {failing}])", job("a", poses)));
    for (batch, status) in [("d.ron", 0), ("e.ron", 1)] {
        let _ = std::fs::remove_dir_all(bench.path("out"));
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let run = ["run", batch, "--out", "out"];
        let outcome = bench.hyperstat_into(&run, writer).ends_with(status);
        assert_eq!(outcome.err(), "");
        assert_eq!(bench.results("out"), ["a.csv", "b.csv"]);
    }
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let plot = ["plot", "out/b.csv", "--lines", "k11"];
    bench.hyperstat_into(&plot, writer).ends_with(0);
    assert!(bench.path("out/b-k11.svg").exists());
}

/// One by one is the same to what the lanes promise, and as `solve` has it to rounding.
#[test]
fn one_by_one_is_another_way_to_the_same() {
    let bench = Bench::new("rows-one-by-one");
    let poses = "List([(0.0, 0.0, 0.45), (0.05, -0.02, 0.5), (9.0, 0.0, 0.0), (-0.1, 0.1, 0.55)])";
    bench.file("d.ron", &delta_batch("d", poses, ""));
    bench
        .hyperstat(&["run", "d.ron", "--out", "lanes"])
        .ends_with(1);
    bench
        .hyperstat(&["run", "d.ron", "--out", "one", "--one-by-one"])
        .ends_with(1);
    let [lanes, one] = ["lanes", "one"].map(|out| Table::read(&bench, &format!("{out}/d.csv")));
    assert_eq!(lanes.names, one.names);
    assert_alike(&lanes, &one);
    assert_ne!(lanes.rows, one.rows, "two ways round differently");
}

/// Rows of the lanes are those of one by one, K to 1e-11 of √(K_ii K_jj).
fn assert_alike(lanes: &Table, one: &Table) {
    for (row, (a, b)) in lanes.rows.iter().zip(&one.rows).enumerate() {
        assert_eq!(a[..8], b[..8]);
        if a[7] != "ok" {
            assert_eq!(a, b);
            continue;
        }
        let scale = |r: usize, c: usize| {
            let k = |k: usize| one.number(row, &format!("k{k}{k}"));
            (k(r) * k(c)).sqrt()
        };
        for r in 1..=6 {
            for c in r..=6 {
                let name = format!("k{r}{c}");
                let [a, b] = [lanes, one].map(|table| table.number(row, &name));
                assert_near(a, b, 1e-11, scale(r, c));
            }
        }
    }
}

/// Joints that give way a thousand metres per newton in one direction, beside directions of 1e-6 m/N: a
/// reflection that swaps the two leaves the rounding of the large one in the small one.
#[test]
fn soft_joints_take_no_digits_in_silence() {
    let bench = Bench::new("rows-soft");
    for (x, y, z, u, w) in [
        (1e-3, 1e9, 1.0, 1e6, 1e6),
        (1e-3, 1e15, 30.0, 1e14, 1e13),
        (1.0, 1e8, 0.01, 1e5, 1e5),
        (100.0, 1e8, 1.0, 1e5, 1e5),
    ] {
        let aluminium = "material: (young: 7.0e10, poisson: 0.33)";
        let batch = format!(
            r#"(jobs: [(name: "d", mechanism: Tripteron(
                rail: (0.5, 0.3), platform_radius: 0.06, proximal_length: 0.35, distal_length: 0.40,
                elbow: Left,
                proximal: (section: Rectangle(width: 0.08, height: 0.05), {aluminium}),
                distal: (section: Tube(outer: 0.06, inner: 0.05), {aluminium}),
                joint_stiffness: (x: {x:e}, y: {y:e}, z: {z:e}, u: {u:e}, w: {w:e}),
                drive_stiffness: 1e7,
            ), poses: Grid(x: (-0.05, 0.05, 3), y: (-0.05, 0.05, 2), z: (0.0, 0.08, 2)))])"#
        );
        bench.file("d.ron", &batch);
        let [lanes, one] = [&[][..], &["--one-by-one"]].map(|more| {
            let run = [&["run", "d.ron", "--out", "out"][..], more].concat();
            bench.hyperstat(&run).ends_with(0);
            Table::read(&bench, "out/d.csv")
        });
        assert_eq!(one.rows.len(), 12);
        assert_alike(&lanes, &one);
    }
}
