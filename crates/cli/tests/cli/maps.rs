//! Maps and lines of `hyperstat plot` and of a job's `figures`: planes and axes of what the poses
//! were asked for by, colours, a curve for each value of what else varies.

use std::fs;

use crate::plot::GRID;
use crate::support::{Bench, delta_batch};

#[test]
fn a_map_that_a_job_cannot_have_is_told_before_the_first_job() {
    let bench = Bench::new("plot-job");
    let refused = |figure: &str, told: &[&str]| {
        let figures = format!("figures: [{figure}],");
        bench.file("map.ron", &delta_batch("map", GRID, &figures));
        let arguments = ["run", "map.ron", "--out", "out"];
        let outcome = bench.hyperstat(&arguments).ends_with(2);
        outcome.says(&[told, &["map.ron:"]].concat());
        assert!(!bench.path("out").exists(), "{figure}");
    };
    for (figure, told) in [
        (
            r#"Map(value: "k77")"#,
            ["there is no quantity `k77`", "k11, k12"],
        ),
        (
            r#"Map(value: "f2")"#,
            ["there is no quantity `f2`", "need `modes: 2` in the job"],
        ),
        (
            r#"Map(value: "status")"#,
            ["there is no quantity `status`", "k11, k12"],
        ),
        (
            r#"Map(value: "deflecton")"#,
            [
                "there is no quantity `deflecton`",
                "did you mean `deflection`?",
            ],
        ),
        (
            r#"Map(value: "k33", limits: ("1 mm", "2 mm"))"#,
            [
                "`limits` of `k33` are a length, `k33` is a force per length",
                "give them in N/m, or without a unit",
            ],
        ),
        (
            r#"Map(value: "k33", limits: (1e-4, "2 mm"))"#,
            ["`limits` of `k33` are a length", "give them in N/m"],
        ),
        (
            r#"Map(value: "k33", limits: ("1 N/mm", "2 m"))"#,
            ["\"2 m\" is a length", "give it in N/m"],
        ),
        (
            r#"Map(value: "k33", beside: 1)"#,
            ["there is no design 1", "give it `vary`"],
        ),
        (
            r#"Map(value: "k33", ratio: true)"#,
            ["a ratio is of two designs", "such as `beside: 1`"],
        ),
        (
            r#"Deformed(pose: (z: 0.5))"#,
            ["no pose has z = 0.5", "poses have z = 0.45, 0.55, 0.65"],
        ),
        (
            r#"Budget(pose: (z: "0.5 kg"))"#,
            ["`z` is a length, \"0.5 kg\" is a mass", "give it in m"],
        ),
        (
            r#"Map(value: "k33", plane: z(0.5))"#,
            [
                "there is no plane z = 0.5",
                "there are planes at z = 0.45, 0.55, 0.65",
            ],
        ),
        (
            r#"Map(value: "k33", plane: [y(0.0), z(0.5)])"#,
            [
                "there is no plane z = 0.5",
                "there are planes at z = 0.45, 0.55, 0.65",
            ],
        ),
        (
            r#"Map(value: "k33", plane: rx(0.0))"#,
            [
                "`rx` follows from x, y, z: it has no planes",
                "choose a plane of x, y, z",
            ],
        ),
        (
            r#"Map(value: "k33", axes: ("A1.v", "A2.v"))"#,
            [
                "`A1.v` is no coordinate of these poses",
                "x, y, z, rx, ry, rz",
            ],
        ),
        (
            r#"Map(value: "k33", plane: z(0.45), axes: (x, z))"#,
            ["a plane at one z does not lie along z", "choose other"],
        ),
    ] {
        refused(figure, &told);
    }
}

#[test]
fn a_map_that_cannot_be_is_told_where_the_mistake_is() {
    let bench = Bench::new("map-places");
    for (figure, wrong) in [
        (r#"Map(value: "k77", plane: z(0.45))"#, r#""k77""#),
        (r#"Map(value: "k33", plane: z(0.5))"#, "z(0.5)"),
        (r#"Map(value: "k33", axes: ("A1.v", x))"#, r#"("A1.v", x)"#),
        (
            r#"Map(value: "k33", labels: {"k34": "u"})"#,
            r#"{"k34": "u"}"#,
        ),
        (
            r#"Map(value: "k33", limits: ("1 mm", "2 mm"))"#,
            r#"("1 mm", "2 mm")"#,
        ),
        (r#"Map(value: "k33", beside: 1)"#, "1)"),
        (r#"Deformed(pose: (z: 0.5))"#, "(z: 0.5)"),
    ] {
        let text = delta_batch("map", GRID, &format!("figures: [{figure}],"));
        bench.file("map.ron", &text);
        let at = text.find(figure).unwrap() + figure.find(wrong).unwrap();
        let line = text[..at].lines().count();
        let column = 1 + at - text[..at].rfind('\n').map_or(0, |end| end + 1);
        for arguments in [
            &["check", "map.ron"][..],
            &["run", "map.ron", "--out", "out"],
        ] {
            let outcome = bench.hyperstat(arguments).ends_with(2);
            outcome.says(&[&format!("map.ron:{line}:{column}")]);
        }
    }
}

/// A batch of a tripod whose platform is turned as its position says.
const EXECHON: &str = r#"(jobs: [(
    name: "tripod",
    mechanism: Exechon(
        base_width: 0.9, base_depth: 0.5, platform_width: 0.3, platform_depth: 0.18,
        housing: (section: Tube(outer: 0.12, inner: 0.09), material: (young: 2.1e11, poisson: 0.3)),
        ram: (section: Circle(diameter: 0.06), material: (young: 2.1e11, poisson: 0.3)),
    ),
    poses: Grid(x: (-0.2, 0.2, 5), y: (-0.3, 0.1, 4), z: (0.9, 1.1, 3)),
    figures: [Map(value: "k33")],
)])"#;

/// A batch of a tripod whose platform moves aside as its tilt says.
const TILTS: &str = r#"(jobs: [(
    name: "tilts",
    mechanism: ThreePrs(
        rails: (radius: 0.4, tilt: 0.0, travel: 0.8, carriage: Near), platform_radius: 0.25,
        rod_length: 0.5,
        rod: (section: Circle(diameter: 0.04), material: (young: 2.1e11, poisson: 0.3)),
        drive_stiffness: 5e7,
    ),
    poses: Grid(z: (0.9, 0.9, 1), rx: (0.0, 0.4, 5), ry: (-0.4, 0.4, 7)),
    figures: [Map(value: "k33"), Map(value: "k11", axes: (ry, rx), limits: (1e5, 1e8), scale: Log)],
)])"#;

/// Whether a map is of filled cells, without a dot.
fn is_filled(svg: &str) -> bool {
    !svg.contains("<circle")
}

#[test]
fn only_what_was_asked_for_makes_planes() {
    let bench = Bench::new("plot-follows");
    bench.file("tripod.ron", EXECHON);
    let run = ["run", "tripod.ron", "--out", "out"];
    bench.hyperstat(&run).ends_with(0);
    let svg = bench.read("out/tripod-map.svg");
    assert!(is_filled(&svg) && svg.contains("; 3 planes of z."), "{svg}");
    for plane in ["z = 0.9 m", "z = 1 m", "z = 1.1 m"] {
        assert!(svg.contains(&format!(">\n{plane}\n<")), "{plane}");
    }
    // The same from the table, which does not say what was asked for.
    let again = ["plot", "out/tripod.csv", "--map", "k33", "--out", "again"];
    bench.hyperstat(&again).ends_with(0);
    assert_eq!(bench.read("again.svg"), svg);
    // One plane of it, and what follows as axes.
    let one = [
        "plot",
        "out/tripod.csv",
        "--map",
        "k33",
        "--plane",
        "z=1",
        "--out",
        "one",
    ];
    let outcome = bench.hyperstat(&one).ends_with(0);
    assert!(
        outcome.out().contains("; z = 1 m. k33"),
        "{}",
        outcome.out()
    );
    assert!(is_filled(&bench.read("one.svg")));
    let turned = [
        "plot",
        "out/tripod.csv",
        "--map",
        "k33",
        "--axes",
        "rx,ry",
        "--out",
        "turned",
    ];
    bench.hyperstat(&turned).ends_with(0);
    let svg = bench.read("turned.svg");
    assert_eq!(svg.matches("<circle").count(), 60);
    assert!(svg.contains("; 3 planes of z."));
    bench
        .hyperstat(&["plot", "out/tripod.csv", "--map", "k33", "--plane", "rx=0"])
        .ends_with(2)
        .says(&["`rx` follows from x, y, z: it has no planes"]);
    bench.file(
        "tripod.ron",
        &EXECHON.replace("\"k33\"", "\"k33\", plane: rx(0.0)"),
    );
    bench
        .hyperstat(&["run", "tripod.ron", "--out", "none"])
        .ends_with(2)
        .says(&["tripod.ron:", "`rx` follows from x, y, z"]);
}

#[test]
fn maps_are_along_what_was_asked_for() {
    let bench = Bench::new("plot-tilts");
    bench.file("tilts.ron", TILTS);
    bench
        .hyperstat(&["run", "tilts.ron", "--out", "out"])
        .ends_with(0);
    let svg = bench.read("out/tilts-map-1.svg");
    assert!(is_filled(&svg) && svg.contains("all other displacements zero; z = 0.9 m."));
    for axis in ["rx (rad)", "ry (rad)"] {
        assert!(svg.contains(&format!(">\n{axis}\n<")), "{axis}");
    }
    let other = bench.read("out/tilts-map-2.svg");
    assert!(is_filled(&other));
    assert!(
        other.contains("Logarithmic colours from 100 kN/m to 100 MN/m."),
        "{other}"
    );
    // `plot` finds the axes by itself, and takes all that a job's map takes.
    let plot = ["plot", "out/tilts.csv", "--out", "again", "--map"];
    bench
        .hyperstat(&[&plot[..], &["k33"]].concat())
        .ends_with(0);
    assert_eq!(bench.read("again.svg"), svg);
    let options = [
        "k11", "--axes", "ry,rx", "--limits", "1e5,1e8", "--scale", "log",
    ];
    bench
        .hyperstat(&[&plot[..], &options].concat())
        .ends_with(0);
    assert_eq!(bench.read("again.svg"), other);
    // A curve for each tilt about the other axis.
    let lines = [
        "plot",
        "out/tilts.csv",
        "--lines",
        "k33",
        "--over",
        "ry",
        "--out",
        "lines",
    ];
    bench.hyperstat(&lines).ends_with(0);
    let svg = bench.read("lines.svg");
    for name in ["rx", "0 rad", "0.1 rad", "0.4 rad"] {
        assert!(svg.contains(&format!(">\n{name}\n<")), "{name}");
    }
}

/// The head of a table with these columns after the stiffness.
fn head(more: &str) -> String {
    let upper = (1..=6).flat_map(|i| (i..=6).map(move |j| format!("k{i}{j}")));
    let upper: Vec<_> = upper.collect();
    let first = "pose,x,y,z,rx,ry,rz,status,dx,dy,dz,drx,dry,drz";
    format!("{first},{}{more}\n", upper.join(","))
}

#[test]
fn poses_of_drives_are_drawn_over_the_drives() {
    let bench = Bench::new("plot-drives");
    let mut table = head(",A1.v,A2.v");
    for row in 0..12 {
        let (a, b) = (f64::from(row % 4), f64::from(row / 4));
        let place = match row {
            3 => ",,,,,,unreachable".into(),
            _ => format!(
                "{},{},-7.79989e-17,0.0,0.0,{},ok",
                a.cos() + b.cos(),
                a.sin(),
                a * b
            ),
        };
        let numbers = match row {
            3 => ",".repeat(27),
            _ => format!(",{}", a + b) + &",1.0".repeat(26),
        };
        table += &format!("{row},{place}{numbers},{},{}\n", 0.1 * a, 0.1 * b);
    }
    bench.file("drives.csv", &table);
    let plot = ["plot", "drives.csv", "--map", "dx", "--out", "map"];
    let outcome = bench.hyperstat(&plot).ends_with(0);
    assert!(
        outcome
            .out()
            .ends_with("along x. dx from 0 m to 5 m. 1 of 12 poses without a result, marked ×.\n"),
        "{}",
        outcome.out()
    );
    let svg = bench.read("map.svg");
    assert!(is_filled(&svg));
    for axis in ["A1.v (rad)", "A2.v (rad)"] {
        assert!(svg.contains(&format!(">\n{axis}\n<")), "{axis}");
    }
    // Over where the output stands: of one pose that is not known. And z is zero.
    let plot = [
        "plot",
        "drives.csv",
        "--map",
        "dx",
        "--axes",
        "x,y",
        "--out",
        "map",
    ];
    let outcome = bench.hyperstat(&plot).ends_with(0);
    let told = "along x; z = 0 m, 1 pose has no place here. dx from";
    assert!(outcome.out().contains(told), "{}", outcome.out());
    assert_eq!(bench.read("map.svg").matches("<circle").count(), 11);
    let plane = ["--plane", "A2.v=0.1", "--axes", "A1.v,x", "--out", "map"];
    bench
        .hyperstat(&[&["plot", "drives.csv", "--map", "dx"], &plane[..]].concat())
        .ends_with(0);
    // Lines take what is not known as a gap.
    bench
        .hyperstat(&[
            "plot",
            "drives.csv",
            "--lines",
            "dx",
            "--over",
            "x",
            "--out",
            "map",
        ])
        .ends_with(0);
}

#[test]
fn a_curve_for_each_value_of_what_else_varies() {
    let bench = Bench::new("plot-two-varied");
    let vary = r#"vary: {
        "rod.section.diameter": Range(0.010, 0.020, 6),
        "arm.section": [Circle(diameter: 0.025), Tube(outer: 0.030, inner: 0.024)],
    },"#;
    let poses = "List([(0.0, 0.0, 0.45)])";
    bench.file("designs.ron", &delta_batch("designs", poses, vary));
    bench
        .hyperstat(&["run", "designs.ron", "--out", "."])
        .ends_with(0);
    let lines = |table: &str, over: &str| {
        let arguments = [
            "plot", table, "--lines", "k33", "--over", over, "--out", "over",
        ];
        bench.hyperstat(&arguments).ends_with(0);
        bench.read("over.svg")
    };
    let svg = lines("designs.csv", "rod.section.diameter");
    for name in [
        "arm.section",
        "Circle(diameter: 0.025)",
        "Tube(outer: 0.030, inner: 0.024)",
    ] {
        assert!(svg.contains(&format!(">\n{name}\n<")), "{name}: {svg}");
    }
    // Two curves of six points, none of twelve.
    let places = |svg: &str, color: &str| {
        let dots = svg
            .lines()
            .filter(|line| line.contains("<circle") && line.contains(color));
        dots.count()
    };
    assert_eq!((places(&svg, "#0072B2"), places(&svg, "#D55E00")), (6, 6));
    // Over the arms: categories, and a curve for each diameter of the rods.
    let svg = lines("designs.csv", "arm.section");
    for name in ["rod.section.diameter", "10 mm", "20 mm", "arm.section"] {
        assert!(svg.contains(&format!(">\n{name}\n<")), "{name}: {svg}");
    }
    assert_eq!(places(&svg, "#0072B2"), 3);
    // The same of Parquet.
    let run = ["run", "designs.ron", "--out", ".", "--format", "parquet"];
    bench.hyperstat(&run).ends_with(0);
    assert_eq!(lines("designs.parquet", "arm.section"), svg);
    // Side by side nothing else varies: one curve.
    let zip = vary.replace("Range(0.010, 0.020, 6)", "[0.020, 0.010]") + "zip: true,";
    bench.file("designs.ron", &delta_batch("zipped", poses, &zip));
    bench
        .hyperstat(&["run", "designs.ron", "--out", "."])
        .ends_with(0);
    let svg = lines("zipped.csv", "rod.section.diameter");
    assert!(!svg.contains(">\narm.section\n<"));
    assert_eq!((places(&svg, "#0072B2"), places(&svg, "#D55E00")), (2, 0));
}

#[test]
fn a_trajectory_is_compared_where_it_is_marked() {
    let bench = Bench::new("plot-long-trajectory");
    let poses = "Grid(x: (-0.1, 0.1, 300), y: (0.0, 0.0, 1), z: (0.5, 0.5, 1))";
    let figures = "figures: [Trajectory(scale: Auto)],";
    bench.file("path.ron", &delta_batch("path", poses, figures));
    bench
        .hyperstat(&["run", "path.ron", "--out", "out"])
        .ends_with(0);
    let svg = bench.read("out/path-trajectory.svg");
    // At most 41 places, and the ring in the legend; the reference solver is slow.
    let rings = svg
        .lines()
        .filter(|line| line.contains("<circle") && line.contains("#D55E00"));
    assert!((30..=42).contains(&rings.count()));
    assert!(svg.contains("Largest difference between the two methods"));
}

#[test]
fn the_example_of_maps_runs() {
    let bench = Bench::new("plot-example");
    let example = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/maps.ron");
    bench.file("maps.ron", &fs::read_to_string(example).unwrap());
    let outcome = bench.hyperstat(&["run", "maps.ron", "--out", "maps"]);
    // The corners of the delta's grid are out of reach.
    let outcome = outcome.ends_with(1);
    assert!(!outcome.out().contains("  no "), "{}", outcome.out());
    let pictures = bench.names("maps");
    let count = pictures
        .iter()
        .filter(|name| name.ends_with(".png"))
        .count();
    assert_eq!(count, 5);
    for name in pictures.iter().filter(|name| name.ends_with(".svg")) {
        assert!(is_filled(&bench.read(&format!("maps/{name}"))), "{name}");
    }
}

/// A map that cannot be drawn of the results is left out, and the jobs behind it run.
#[test]
fn a_figure_that_cannot_be_drawn_does_not_end_the_run() {
    let bench = Bench::new("maps-undrawable");
    let figures = r#"figures: [Map(value: "dx", scale: Log), Map(value: "k33")],"#;
    let one = delta_batch("m", GRID, figures);
    let job = one.split_once("jobs: [").unwrap().1;
    let job = job.rsplit_once("],").unwrap().0;
    let later = job.replace("\"m\"", "\"later\"").replace(figures, "");
    bench.file("b.ron", &format!("(jobs: [{job}{later}])"));
    let outcome = bench.hyperstat(&["run", "b.ron", "--out", "out"]);
    let outcome = outcome.ends_with(0);
    let line = "  no m-map-1: a logarithmic scale needs values above zero, and would begin at -";
    assert!(outcome.out().contains(line), "{}", outcome.out());
    let names = bench.results("out");
    assert_eq!(
        names,
        ["later.csv", "m-map-2.png", "m-map-2.svg", "m.csv"],
        "{}",
        outcome.out()
    );
    // `plot` was asked for something that cannot be: the status says so, in numbers of few digits.
    for (options, words) in [
        (&["--map", "dx", "--scale", "log"][..], "would begin at -"),
        (
            &["--map", "k33", "--scale", "log", "--limits", "-0.1,1e9"],
            "would begin at -0.1",
        ),
        (&["--trajectory", "--scale", "1e300"], "beyond "),
    ] {
        let outcome = bench.hyperstat(&[&["plot", "out/m.csv"], options].concat());
        let outcome = outcome.ends_with(2);
        outcome.says(&[words]);
        let long = |word: &str| word.chars().filter(char::is_ascii_digit).count() > 9;
        assert!(
            !outcome.err().split_whitespace().any(long),
            "{}",
            outcome.err()
        );
    }
}

/// Planes of three axes side by side, in a job and of its table.
#[test]
fn planes_of_three_axes_are_side_by_side() {
    let bench = Bench::new("maps-three");
    let grid = "Grid(x: (-0.1, 0.1, 5), y: (-0.1, 0.1, 5), z: (0.45, 0.55, 3))";
    let figure =
        r#"figures: [Map(value: "k33", planes: [x(0.0), y(0.05), z(0.5)], mark: ["least"])],"#;
    bench.file("m.ron", &delta_batch("m", grid, figure));
    let ran = bench
        .hyperstat(&["run", "m.ron", "--out", "out"])
        .ends_with(0);
    assert!(ran.out().contains("out/m-map.svg"), "{}", ran.out());
    let three = [
        "plot",
        "out/m.csv",
        "--map",
        "k33",
        "--planes",
        "x=0,y=0.05,z=0.5",
    ];
    let marked = [&three[..], &["--mark", "least", "--out", "own"]].concat();
    bench.hyperstat(&marked).ends_with(0);
    assert_eq!(bench.read("own.svg"), bench.read("out/m-map.svg"));
    let svg = bench.read("own.svg");
    let texts = |svg: &str, text: &str| svg.lines().filter(|line| *line == text).count();
    for name in ["x = 0 m", "y = 0.05 m", "z = 0.5 m"] {
        assert_eq!(texts(&svg, name), 1, "{name}");
    }
    for name in ["x (m)", "y (m)", "z (m)"] {
        assert_eq!(texts(&svg, name), 2, "{name}");
    }
    // Two tables beside each other, plane by plane.
    let beside = [&three[..], &["--beside", "out/m.csv", "--out", "two"]].concat();
    bench.hyperstat(&beside).ends_with(0);
    let two = bench.read("two.svg");
    assert_eq!(
        two.lines()
            .filter(|line| line.ends_with(", z = 0.5 m"))
            .count(),
        2
    );
    for (options, told) in [
        (&["--planes", "x=0,q=1"][..], "q"),
        (&["--planes", "z=0.7"], "0.7"),
        (&["--planes", "x=0", "--axes", "y,z"], "cannot be used with"),
        (
            &["--planes", "x=0,z=0.5", "--plane", "z=0.5"],
            "z is held twice",
        ),
    ] {
        let arguments = [&["plot", "out/m.csv", "--map", "k33"], options].concat();
        bench.hyperstat(&arguments).ends_with(2).says(&[told]);
    }
    for (figure, told) in [
        (r#"Map(value: "k33", planes: [])"#, "give planes such as"),
        (
            r#"Map(value: "k33", planes: [x(0.0)], axes: (y, z))"#,
            "leave one of them out",
        ),
        (
            r#"Map(value: "k33", planes: [x(0.0), z(0.5)], plane: z(0.5))"#,
            "z is held twice",
        ),
        (r#"Map(value: "k33", planes: [x(0.0), z(0.7)])"#, "0.7"),
    ] {
        bench.file(
            "bad.ron",
            &delta_batch("m", grid, &format!("figures: [{figure}],")),
        );
        let told = [told, "bad.ron:"];
        bench
            .hyperstat(&["check", "bad.ron"])
            .ends_with(2)
            .says(&told);
    }
}
