//! `hyperstat plot`: figures from tables, the same from CSV and Parquet and from a job's
//! `figures`, and what is wrong with a table or with what is asked of it.

use std::fs;

use crate::support::{Bench, delta_batch};

pub const GRID: &str = "Grid(x: (-0.3, 0.3, 7), y: (-0.3, 0.3, 5), z: (0.45, 0.65, 3))";

/// A bench with the table `out/map.csv` of a grid that is out of reach in its corners.
fn with_table(name: &str, rest: &str) -> Bench {
    let bench = Bench::new(name);
    bench.file("map.ron", &delta_batch("map", GRID, rest));
    let outcome = bench.hyperstat(&["run", "map.ron", "--out", "out"]);
    assert!(outcome.status() < 2, "{}", outcome.err());
    bench
}

#[test]
fn a_map_of_a_plane_and_of_all_planes() {
    let bench = with_table("plot-map", "");
    let arguments = ["plot", "out/map.csv", "--map", "k33", "--plane", "z=0.55"];
    let outcome = bench.hyperstat(&[&arguments[..], &["--out", "one"]].concat());
    let outcome = outcome.ends_with(0);
    assert!(
        outcome
            .out()
            .starts_with("one.svg\none.png\nk33: force along z per")
    );
    assert!(
        outcome.out().contains("z = 0.55 m. k33 from "),
        "{}",
        outcome.out()
    );
    let svg = bench.read("one.svg");
    assert!(svg.contains(">\nk33 (MN/m)\n<") && svg.contains("<title>map</title>"));
    assert_eq!(&fs::read(bench.path("one.png")).unwrap()[..4], b"\x89PNG");

    let all = ["plot", "out/map.csv", "--map", "pure_force_stiffness_min"];
    let outcome = bench.hyperstat(&all).ends_with(0);
    assert!(
        outcome
            .out()
            .starts_with("out/map-pure_force_stiffness_min.svg\n")
    );
    let svg = bench.read("out/map-pure_force_stiffness_min.svg");
    for plane in ["z = 0.45 m", "z = 0.55 m", "z = 0.65 m"] {
        assert!(svg.contains(&format!(">\n{plane}\n<")), "{plane}");
    }
    // Upright: x and z lie in it.
    let upright = ["plot", "out/map.csv", "--map", "dz", "--plane", "y=0"];
    bench
        .hyperstat(&[&upright[..], &["--out", "up"]].concat())
        .ends_with(0);
    let svg = bench.read("up.svg");
    assert!(svg.contains(">\nz (m)\n<") && svg.contains(">\nx (m)\n<"));
}

#[test]
fn the_range_that_is_told_is_that_of_the_table() {
    let bench = with_table("plot-range", "");
    let plane = |line: &&str| line.split(',').nth(3) == Some("0.45");
    let csv = bench.read("out/map.csv");
    let names: Vec<_> = csv.lines().next().unwrap().split(',').collect();
    let place = names.iter().position(|name| *name == "k66").unwrap();
    let values: Vec<f64> = csv
        .lines()
        .filter(plane)
        .filter_map(|line| line.split(',').nth(place)?.parse().ok())
        .collect();
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let arguments = ["plot", "out/map.csv", "--map", "k66", "--plane", "z=0.45"];
    let outcome = bench.hyperstat(&arguments).ends_with(0);
    let told = outcome.out().split(" from ").nth(1).unwrap();
    let told: f64 = told.split(' ').next().unwrap().parse().unwrap();
    // Four digits, in kN·m/rad.
    assert!(outcome.out().contains("kN·m/rad"));
    assert!((told * 1e3 / least - 1.0).abs() < 1e-3, "{told} {least}");
}

#[test]
fn parquet_and_a_jobs_figures_give_the_same_picture() {
    let figures = r#"figures: [Map(value: "deflection", plane: z(0.45)), Map(value: "k11")],"#;
    let bench = with_table("plot-same", figures);
    let names = bench.results("out");
    let expected = [
        "map-map-1.png",
        "map-map-1.svg",
        "map-map-2.png",
        "map-map-2.svg",
        "map.csv",
    ];
    assert_eq!(names, expected);
    let parquet = ["run", "map.ron", "--out", "binary", "--format", "parquet"];
    assert!(bench.hyperstat(&parquet).status() < 2);
    for table in ["out/map.csv", "binary/map.parquet"] {
        for (figure, options) in [
            (
                "map-map-1",
                vec!["--map", "deflection", "--plane", "z=0.45"],
            ),
            ("map-map-2", vec!["--map", "k11"]),
        ] {
            let arguments = [&["plot", table, "--out", "again"], &options[..]].concat();
            bench.hyperstat(&arguments).ends_with(0);
            for end in ["svg", "png"] {
                let job = fs::read(bench.path(&format!("out/{figure}.{end}"))).unwrap();
                let plot = fs::read(bench.path(&format!("again.{end}"))).unwrap();
                assert!(job == plot, "{table} {figure}.{end}");
            }
        }
    }
}

#[test]
fn lines_and_trajectories() {
    let bench = Bench::new("plot-lines");
    let poses = "Grid(x: (-0.1, 0.1, 11), y: (0.0, 0.0, 1), z: (0.5, 0.5, 1))";
    bench.file("path.ron", &delta_batch("path", poses, ""));
    bench
        .hyperstat(&["run", "path.ron", "--out", "out"])
        .ends_with(0);
    let lines = [
        "plot",
        "out/path.csv",
        "--lines",
        "dx,dz,k33",
        "--over",
        "x",
    ];
    bench
        .hyperstat(&[&lines[..], &["--out", "lines.svg"]].concat())
        .ends_with(0);
    let svg = bench.read("lines.svg");
    for text in ["dx, dz (µm)", "k33 (MN/m)", "x (m)"] {
        assert!(svg.contains(&format!(">\n{text}\n<")), "{text}");
    }
    assert!(bench.path("lines.png").exists());
    let path = [
        "plot",
        "out/path.csv",
        "--trajectory",
        "--scale",
        "300",
        "--title",
        "A line",
    ];
    bench.hyperstat(&path).ends_with(0);
    let svg = bench.read("out/path-trajectory.svg");
    assert!(svg.contains("deflection × 300") && svg.contains(">\nA line\n<"));
}

#[test]
fn lines_over_what_varies_take_one_pose_of_each_design() {
    let bench = Bench::new("plot-designs");
    let poses = "List([(0.0, 0.0, 0.45), (0.1, 0.0, 0.5)])";
    let vary = r#"vary: { "rod.section.diameter": Range(0.010, 0.020, 6) },"#;
    bench.file("designs.ron", &delta_batch("designs", poses, vary));
    bench
        .hyperstat(&["run", "designs.ron", "--out", "."])
        .ends_with(0);
    let over = [
        "--over",
        "rod.section.diameter",
        "--pose",
        "1",
        "--out",
        "over",
    ];
    let arguments = [
        &["plot", "designs.csv", "--lines", "pure_force_stiffness_min"],
        &over[..],
    ]
    .concat();
    bench.hyperstat(&arguments).ends_with(0);
    let svg = bench.read("over.svg");
    assert!(svg.contains(">\nrod.section.diameter (mm)\n<"), "{svg}");
    let blue = svg.lines().filter(|line| line.contains("#0072B2"));
    let points = blue.filter(|line| line.contains("<polyline")).map(|line| {
        let list = line.split("points=\"").nth(1).unwrap();
        list.split('"').next().unwrap().split_whitespace().count()
    });
    assert_eq!(points.max(), Some(6));
    bench
        .hyperstat(&["plot", "designs.csv", "--map", "k11", "--design", "6"])
        .ends_with(2)
        .says(&[
            "designs.csv holds no design 6",
            "choose `--design` from 0 to 5",
            "counted from 0",
        ]);
}

#[test]
fn what_is_asked_for_and_not_there_is_told() {
    let bench = with_table("plot-unknown", "");
    let plot = |options: &[&str]| bench.hyperstat(&[&["plot", "out/map.csv"], options].concat());
    plot(&["--map", "k7"]).ends_with(2).says(&[
        "out/map.csv holds no column `k7`",
        "k11, k12",
        "deflection, rotation",
    ]);
    plot(&["--map", "k11", "--plane", "z=0.5"])
        .ends_with(2)
        .says(&["there is no plane z = 0.5", "z = 0.45, 0.55, 0.65"]);
    plot(&["--map", "k11", "--plane", "w=0.5"])
        .ends_with(2)
        .says(&["`w` is no coordinate of these poses", "x, y, z, rx, ry, rz"]);
    plot(&["--map", "k11", "--plane", "z=0.45", "--axes", "x,z"])
        .ends_with(2)
        .says(&["a plane at one z does not lie along z"]);
    plot(&["--lines", "status"])
        .ends_with(2)
        .says(&["the column `status` of out/map.csv holds no numbers"]);
    let held = ["x=0", "y=0", "z=0.45", "rx=0", "ry=0"].map(|plane| ["--plane", plane]);
    plot(&[&["--map", "k11"], held.as_flattened()].concat())
        .ends_with(2)
        .says(&["all coordinates but one are held"]);
    plot(&["--map", "deflecton"])
        .ends_with(2)
        .says(&["did you mean `deflection`?"]);
    plot(&["--map", "k11", "--scale", "200"])
        .ends_with(2)
        .says(&["`--scale 200` is none of a map", "`log` or `linear`"]);
    plot(&["--trajectory", "--scale", "log"])
        .ends_with(2)
        .says(&["`--scale log` is none of what is magnified", "such as 200"]);
    plot(&["--map", "k11", "--limits", "2,1"])
        .ends_with(2)
        .says(&["the lower one first"]);
    plot(&[]).ends_with(2).says(&["--map"]);
    bench
        .hyperstat(&["plot", "out/none.csv", "--map", "k11"])
        .ends_with(2)
        .says(&["cannot read out/none.csv"]);
    bench
        .hyperstat(&["plot", "map.ron", "--map", "k11"])
        .ends_with(2)
        .says(&["map.ron is no table", "hyperstat run"]);
    assert_eq!(bench.results("out"), ["map.csv"]);
}

#[test]
fn a_table_that_is_none_of_a_run_is_told_with_its_place() {
    let bench = Bench::new("plot-broken");
    bench.file("poses.csv", "x,y,z\n0,0,0.5\n");
    bench
        .hyperstat(&["plot", "poses.csv", "--map", "x"])
        .ends_with(2)
        .says(&["poses.csv:1:1", "it has no column `pose`"]);
    let head = "pose,x,y,z,rx,ry,rz,status,dx\n";
    let good = "0,0.0,0.0,0.5,0.0,0.0,0.0,ok,1e-3\n";
    bench.file("cut.csv", &format!("{head}{good}1,0.1,0.0,0.5\n"));
    bench
        .hyperstat(&["plot", "cut.csv", "--lines", "dx"])
        .ends_with(2)
        .says(&["cut.csv:3:", "expected 9 cells, one a column, found 4"]);
    bench.file(
        "word.csv",
        &format!("{head}{good}{}", good.replace("1e-3", "much")),
    );
    bench
        .hyperstat(&["plot", "word.csv", "--lines", "dx"])
        .ends_with(2)
        .says(&[
            "word.csv:3:30",
            "expected a number in the column `dx`, found `much`",
        ]);
    bench.file("no.parquet", "not at all");
    bench
        .hyperstat(&["plot", "no.parquet", "--lines", "dx"])
        .ends_with(2)
        .says(&["no.parquet cannot be read as Parquet"]);
    bench.file(
        "failed.csv",
        &format!("{head}0,0.0,0.0,0.5,0.0,0.0,0.0,unreachable,\n"),
    );
    bench
        .hyperstat(&["plot", "failed.csv", "--map", "dx"])
        .ends_with(2)
        .says(&["no pose of failed.csv has a result there"]);
}

#[test]
fn a_figure_that_cannot_be_written_ends_with_3() {
    let bench = with_table("plot-nowhere", "");
    bench
        .hyperstat(&["plot", "out/map.csv", "--map", "k11", "--out", "none/map"])
        .ends_with(3)
        .says(&["cannot write none/map.svg"]);
}

/// Rods of 0.05 m reach no pose: the first design that has a result is drawn, and named.
#[test]
fn the_first_design_with_a_result_is_drawn() {
    let bench = Bench::new("plot-first-design");
    let vary = r#"vary: { "rod_length": [0.05, 0.6, 0.7] },"#;
    bench.file("d.ron", &delta_batch("d", GRID, vary));
    let outcome = bench.hyperstat(&["run", "d.ron", "--out", "."]);
    assert!(outcome.status() < 2, "{}", outcome.err());
    for options in [&["--map", "k11"], &["--lines", "k11"]] {
        let outcome = bench.hyperstat(&[&["plot", "d.csv"], &options[..]].concat());
        let outcome = outcome.ends_with(0);
        assert!(outcome.out().contains("design 1"), "{}", outcome.out());
    }
    bench.hyperstat(&["plot", "d.csv"]).ends_with(2);
    bench
        .hyperstat(&["plot", "d.csv", "--trajectory"])
        .ends_with(0);
    assert!(bench.read("d-trajectory.svg").contains("d, design 1"));
    let chosen = bench.hyperstat(&["plot", "d.csv", "--map", "k11", "--design", "2"]);
    assert!(chosen.ends_with(0).out().contains("design 2"));
    let table = bench.read("d.csv");
    bench.file("head.csv", &format!("{}\n", table.lines().next().unwrap()));
    for kind in ["--map", "--lines"] {
        bench
            .hyperstat(&["plot", "head.csv", kind, "k11"])
            .ends_with(2)
            .says(&["head.csv has no rows", "run the batch again"]);
    }
}
