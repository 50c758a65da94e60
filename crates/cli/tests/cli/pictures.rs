//! What `hyperstat plot` and a job's `figures` say of how a picture is: marks, two tables, names, poses by
//! their coordinates, PDF, pictures that move.

use std::fs;

use crate::plot::GRID;
use crate::support::{Bench, Outcome, delta_batch};

/// The column of a table by its name, one cell for each pose.
fn column(bench: &Bench, file: &str, name: &str) -> Vec<Option<f64>> {
    let csv = bench.read(file);
    let names: Vec<_> = csv.lines().next().unwrap().split(',').collect();
    let place = names.iter().position(|own| *own == name).unwrap();
    let cell = |line: &str| {
        line.split(',')
            .nth(place)
            .and_then(|cell| cell.parse().ok())
    };
    csv.lines().skip(1).map(cell).collect()
}

/// A bench with the tables of two deltas, of which one has thicker rods, over the same grid.
fn with_two(name: &str) -> Bench {
    let bench = Bench::new(name);
    let batch = delta_batch("thin", GRID, "");
    bench.file("thin.ron", &batch);
    let thick = batch.replace("diameter: 0.014", "diameter: 0.020");
    assert_ne!(thick, batch);
    bench.file("thick.ron", &thick.replace("\"thin\"", "\"thick\""));
    for file in ["thin.ron", "thick.ron"] {
        let outcome = bench.hyperstat(&["run", file, "--out", "out"]);
        assert!(outcome.status() < 2, "{}", outcome.err());
    }
    bench
}

/// The number that a text begins with, in kN/m or MN/m.
fn stiffness(text: &str) -> f64 {
    let (number, unit) = text.split_once(' ').unwrap();
    let number: f64 = number.parse().unwrap();
    match unit.get(..4) {
        Some("MN/m") => 1e6 * number,
        Some("kN/m") => 1e3 * number,
        _ => panic!("{text}"),
    }
}

fn plot(bench: &Bench, words: &[&str]) -> Outcome {
    bench.hyperstat(&[&["plot"], words].concat())
}

#[test]
fn the_least_value_is_marked_where_the_table_has_it() {
    let bench = with_two("pictures-mark");
    let words = [
        "out/thin.csv",
        "--map",
        "k33",
        "--mark",
        "least",
        "--out",
        "m",
    ];
    let outcome = plot(&bench, &words).ends_with(0);
    let values = column(&bench, "out/thin.csv", "k33");
    let least = values
        .iter()
        .flatten()
        .copied()
        .fold(f64::INFINITY, f64::min);
    let told = outcome
        .out()
        .split("Least, ▼: ")
        .nth(1)
        .unwrap()
        .to_string();
    assert!(
        (stiffness(&told) / least - 1.0).abs() < 1e-3,
        "{told} {least}"
    );
    // The place has this value, to rounding: one of the mirror images may be the first.
    let place = |name: &str| -> f64 {
        let text = told.split(&format!("{name} = ")).nth(1).unwrap();
        let mut words = text.split([' ', ',']);
        let number: f64 = words.next().unwrap().replace('−', "-").parse().unwrap();
        number
            * if text.contains(" mm") && !text.contains(" m,") {
                1e-3
            } else {
                1.0
            }
    };
    let z = place("z");
    let at: Vec<_> = column(&bench, "out/thin.csv", "z")
        .into_iter()
        .zip(values)
        .collect();
    let least_there = at.iter().filter(|(own, _)| (own.unwrap() - z).abs() < 1e-9);
    let least_there = least_there
        .filter_map(|(_, v)| *v)
        .fold(f64::INFINITY, f64::min);
    assert_eq!(least_there, least);
    // One triangle on each plane.
    let svg = bench.read("m.svg");
    assert_eq!(svg.matches("fill=\"#191919\" points=").count(), 3);
    let wrong = plot(&bench, &["out/thin.csv", "--map", "k33", "--mark", "lest"]);
    wrong.ends_with(2).says(&["lest", "`least`, `most`"]);
}

#[test]
fn two_tables_share_a_scale_and_have_a_ratio() {
    let bench = with_two("pictures-two");
    let of_both = ["out/thin.csv", "--map", "k33", "--beside", "out/thick.csv"];
    let with = |more: &[&str]| plot(&bench, &[&of_both[..], more].concat());
    let outcome = with(&["--plane", "z=0.55", "--out", "both"]).ends_with(0);
    let both = ["thin", "thick"].map(|job| column(&bench, &format!("out/{job}.csv"), "k33"));
    let z = column(&bench, "out/thin.csv", "z");
    let on_plane = |k: &usize| z[*k] == Some(0.55);
    let rows: Vec<usize> = (0..z.len()).filter(on_plane).collect();
    let found: Vec<f64> = rows
        .iter()
        .flat_map(|k| [both[0][*k], both[1][*k]])
        .flatten()
        .collect();
    let most = found.iter().copied().fold(0.0, f64::max);
    let told = outcome.out().split(" to ").nth(1).unwrap().to_string();
    assert!(
        (stiffness(&told) / most - 1.0).abs() < 1e-3,
        "{told} {most}"
    );
    let svg = bench.read("both.svg");
    for text in ["thin", "thick", "thin and thick"] {
        assert!(svg.contains(&format!(">\n{text}\n<")), "{text}");
    }
    assert_eq!(svg.matches(">\nk33 (MN/m)\n<").count(), 1);

    let outcome = with(&["--plane", "z=0.55", "--ratio", "--out", "ratio"]).ends_with(0);
    let ratios: Vec<f64> = (rows.iter())
        .filter_map(|k| Some(both[1][*k]? / both[0][*k]?))
        .collect();
    let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
    let told = outcome
        .out()
        .split("ratio from ")
        .nth(1)
        .unwrap()
        .to_string();
    let number: f64 = told.split(' ').next().unwrap().parse().unwrap();
    assert!(
        (number / least - 1.0).abs() < 1e-3 && number > 1.0,
        "{told} {least}"
    );
    assert!(
        outcome.out().contains("thick over thin"),
        "{}",
        outcome.out()
    );
    // All planes of both, plane by plane.
    with(&["--out", "all"]).ends_with(0);
    let svg = bench.read("all.svg");
    assert!(svg.contains(">\nthick, z = 0.65 m\n<"));

    let crossing = [
        "out/thin.csv",
        "--map",
        "dx",
        "--beside",
        "out/thick.csv",
        "--ratio",
    ];
    plot(&bench, &crossing)
        .ends_with(2)
        .says(&["`dx` is zero", "choose a quantity above zero"]);
    let other = delta_batch(
        "other",
        "Grid(x: (-0.2, 0.2, 3), y: (-0.2, 0.2, 3), z: (0.5, 0.55, 2))",
        "",
    );
    bench.file("other.ron", &other);
    assert!(
        bench
            .hyperstat(&["run", "other.ron", "--out", "out"])
            .status()
            < 2
    );
    let of_other = ["out/thin.csv", "--map", "k33", "--beside", "out/other.csv"];
    let refused = |more: &[&str], told: &[&str]| {
        plot(&bench, &[&of_other[..], more].concat())
            .ends_with(2)
            .says(told);
    };
    refused(&[], &["are of other planes", "`--plane z=0.55`"]);
    refused(
        &["--plane", "z=0.55", "--ratio"],
        &["are of other poses", "run both over the same"],
    );
}

#[test]
fn titles_and_names_are_as_they_are_set() {
    let figures = r#"figures: [
        Map(value: "k33", title: "Stiffness", labels: {"k33": "along the spindle", "z": "height"}, mark: ["most"]),
        Deformed(title: "Machine", labels: {"z": "height"}, show: ["pose"]),
    ],"#;
    let bench = Bench::new("pictures-names");
    bench.file("job.ron", &delta_batch("job", GRID, figures));
    assert!(
        bench
            .hyperstat(&["run", "job.ron", "--out", "out", "--pdf"])
            .status()
            < 2
    );
    let map = bench.read("out/job-map.svg");
    // The bar has its name and its unit in two lines.
    for text in [
        "Stiffness",
        "along the spindle",
        "(MN/m)",
        "height = 0.45 m",
    ] {
        assert!(map.contains(&format!(">\n{text}\n<")), "{text}");
    }
    assert!(map.contains("along the spindle: force along z per"));
    let deformed = bench.read("out/job-deformed.svg");
    for text in [
        "Machine",
        "height (m)",
        "x (m)",
        "Pose 0: x = −0.3 m, y = −0.3 m, z = 0.45 m.",
    ] {
        assert!(deformed.contains(&format!(">\n{text}\n<")), "{text}");
    }
    let pdf = fs::read(bench.path("out/job-map.pdf")).unwrap();
    assert!(pdf.starts_with(b"%PDF-"));
    // The command line draws the same.
    let labels = ["--label", "k33=along the spindle", "--label", "z=height"];
    let words = [
        "out/job.csv",
        "--map",
        "k33",
        "--title",
        "Stiffness",
        "--mark",
        "most",
    ];
    plot(
        &bench,
        &[&words[..], &labels, &["--out", "same.pdf"]].concat(),
    )
    .ends_with(0);
    assert_eq!(bench.read("same.svg"), map);
    assert!(fs::read(bench.path("same.pdf")).unwrap() == pdf);
    let wrong = ["out/job.csv", "--map", "k33", "--label", "heigth=z"];
    plot(&bench, &wrong)
        .ends_with(2)
        .says(&["nothing in the figure is called `heigth`"]);
    bench.file(
        "job.ron",
        &delta_batch("job", GRID, "figures: [Deformed(labels: {\"w\": \"h\"})],"),
    );
    let outcome = bench
        .hyperstat(&["run", "job.ron", "--out", "none"])
        .ends_with(2);
    outcome.says(&[
        "job.ron:",
        "nothing in the figure is called `w`",
        "labels are of x, y, z",
    ]);
    bench.file(
        "job.ron",
        &delta_batch(
            "job",
            GRID,
            "figures: [Map(value: \"k33\", mark: [\"lest\"])],",
        ),
    );
    let outcome = bench
        .hyperstat(&["run", "job.ron", "--out", "none"])
        .ends_with(2);
    outcome.says(&[
        "job.ron:",
        "`lest` cannot be marked",
        "did you mean `least`?",
    ]);
}

#[test]
fn a_pose_is_chosen_by_its_coordinates() {
    let bench = Bench::new("pictures-pose");
    bench.file("job.ron", &delta_batch("job", GRID, ""));
    let at = |pose: &str| {
        plot(
            &bench,
            &["job.ron", "--deformed", "--pose", pose, "--out", "at"],
        )
    };
    let outcome = at("x=0,y=0,z=0.55").ends_with(0);
    let told = "Pose 52: x = 0 m, y = 0 m, z = 0.55 m.";
    assert!(outcome.out().contains(told), "{}", outcome.out());
    let with_words = bench.read("at.svg");
    // Without the words it is the picture by number.
    at("52").ends_with(0);
    let by_number = bench.read("at.svg");
    assert!(with_words.contains(told) && !by_number.contains(told));
    assert_eq!(with_words.lines().count(), by_number.lines().count() + 3);
    at("x=0,z=0.55")
        .ends_with(2)
        .says(&["5 poses have x = 0, z = 0.55", "say y, too"]);
    at("x=0,z=0.5")
        .ends_with(2)
        .says(&["no pose has z = 0.5", "poses have z = 0.45, 0.55, 0.65"]);
    at("x=0,u=0.5").ends_with(2).says(&["`u` is no coordinate"]);
    at("x=0;y").ends_with(2).says(&["number of a pose"]);
    let portal = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/portal.ron");
    let refused = plot(&bench, &[portal, "--deformed", "--pose", "x=0"]).ends_with(2);
    refused.says(&["`--pose` chooses from a batch file"]);
}

#[test]
fn pictures_move_without_a_script() {
    let bench = Bench::new("pictures-move");
    let path = "List([(0.0, 0.0, 0.5), (0.05, 0.0, 0.5), (0.1, 0.0, 0.5)])";
    bench.file(
        "job.ron",
        &delta_batch(
            "job",
            path,
            "masses: [(on: (\"platform\", \"P\"), mass: 1.0)],",
        ),
    );
    let moving = |words: &[&str]| {
        let all = [&["job.ron"], words, &["--animate", "--out", "m"]].concat();
        let outcome = plot(&bench, &all).ends_with(0);
        assert!(
            outcome.out().starts_with("m.svg\nm.png\nm.gif\n"),
            "{}",
            outcome.out()
        );
        let gif = fs::read(bench.path("m.gif")).unwrap();
        (bench.read("m.svg"), gif)
    };
    // A mode: eleven pictures, each there and back.
    let (svg, gif) = moving(&["--mode", "1"]);
    assert_eq!(
        svg.matches("<animate attributeName=\"visibility\"").count(),
        11
    );
    assert_eq!(svg.matches("<g visibility=\"visible\">").count(), 1);
    assert!(!svg.contains("<script") && svg.contains("dur=\"2000ms\""));
    assert!(gif.starts_with(b"GIF89a"));
    let again = moving(&["--mode", "1"]);
    assert!(again == (svg, gif));
    // Poses: one picture each, with the pose in words.
    let (svg, _) = moving(&["--deformed"]);
    assert_eq!(svg.matches("<animate ").count(), 3);
    for x in ["0", "0.05", "0.1"] {
        assert!(
            svg.contains(&format!(": x = {x} m, y = 0 m, z = 0.5 m.\n</text>")),
            "{x}"
        );
    }
    assert!(svg.contains("values=\"hidden;visible;hidden\""));
    let (svg, _) = moving(&["--deformed", "--pose", "1"]);
    assert_eq!(svg.matches("<animate ").count(), 11);
    let refused = plot(&bench, &["job.ron", "--budget", "--animate"]).ends_with(2);
    refused.says(&["--animate"]);
}

/// The grid of two poses along x and y, at a height.
fn level(name: &str, z: &str) -> String {
    let poses = format!("Grid(x: (-0.1, 0.1, 2), y: (-0.1, 0.1, 2), z: ({z}, {z}, 1))");
    delta_batch(name, &poses, "")
}

/// Tables of another plane each have no scale and no ratio together, though each has one plane only.
#[test]
fn two_planes_are_not_one() {
    let bench = Bench::new("pictures-planes");
    for (name, z) in [("low", "0.5"), ("high", "0.6")] {
        let file = format!("{name}.ron");
        bench.file(&file, &level(name, z));
        bench
            .hyperstat(&["run", &file, "--out", "out"])
            .ends_with(0);
    }
    let words = ["out/low.csv", "--map", "k33", "--beside", "out/high.csv"];
    for more in [&[][..], &["--ratio"]] {
        let outcome = plot(&bench, &[&words[..], more].concat());
        outcome.ends_with(2).says(&["are of other planes"]);
    }
    let zero = ["out/low.csv", "--map", "drx", "--beside", "out/low.csv"];
    let outcome = plot(&bench, &[&zero[..], &["--ratio", "--out", "same"]].concat());
    assert!(outcome.status() == 0 || outcome.err().contains("has no ratio above zero"));
}

/// A pose of a table is the one that has these coordinates, wherever its row stands.
#[test]
fn a_pose_is_found_in_a_table_in_another_order() {
    let bench = Bench::new("pictures-order");
    bench.file("low.ron", &level("low", "0.5"));
    bench
        .hyperstat(&["run", "low.ron", "--out", "."])
        .ends_with(0);
    let csv = bench.read("low.csv");
    let mut lines: Vec<&str> = csv.lines().collect();
    lines[1..].reverse();
    bench.file("turned.csv", &(lines.join("\n") + "\n"));
    let drawn = |file: &str| {
        let words = [file, "--lines", "k33,k11", "--over", "z"];
        let pose = ["--pose", "x=0.1,y=-0.1", "--title", "one", "--out", "one"];
        plot(&bench, &[&words[..], &pose].concat()).ends_with(0);
        bench.read("one.svg")
    };
    assert_eq!(drawn("low.csv"), drawn("turned.csv"));
}

#[test]
fn what_is_of_another_kind_of_picture_is_refused() {
    let bench = Bench::new("pictures-kinds");
    bench.file("low.ron", &level("low", "0.5"));
    bench
        .hyperstat(&["run", "low.ron", "--out", "."])
        .ends_with(0);
    let lines = ["low.csv", "--lines", "k33"];
    let map = ["low.csv", "--map", "k33"];
    let shape = ["low.ron", "--deformed"];
    for (words, more) in [
        (&lines[..], &["--mark", "least"][..]),
        (&lines, &["--plane", "z=0.5"]),
        (&lines, &["--beside", "low.csv"]),
        (&lines, &["--limits", "1,2"]),
        (&map, &["--over", "x"]),
        (&shape, &["--along", "z"]),
        (&shape, &["--out", "still.gif"]),
    ] {
        let outcome = plot(&bench, &[words, more].concat());
        outcome.ends_with(2);
    }
    plot(&bench, &[&shape[..], &["--out", "still.gif"]].concat()).says(&["give `--animate`"]);
    // A folder gets the usual name; a mark that is asked for twice stands once.
    fs::create_dir(bench.path("here")).unwrap();
    let marks = ["--mark", "least,least", "--out", "here"];
    let told = plot(&bench, &[&map[..], &marks].concat()).ends_with(0);
    assert_eq!(told.out().matches("Least").count(), 1, "{}", told.out());
    assert_eq!(bench.names("here"), ["low-k33.png", "low-k33.svg"]);
}

/// Poses that run begin with the first that can be taken.
#[test]
fn a_pose_out_of_reach_is_left_out_of_what_runs() {
    let bench = Bench::new("pictures-run");
    let poses = "List([(2.0, 0.0, 0.5), (0.0, 0.0, 0.5), (0.1, 0.0, 0.5)])";
    bench.file("far.ron", &delta_batch("far", poses, ""));
    let words = ["far.ron", "--deformed", "--animate", "--out", "far"];
    plot(&bench, &words).ends_with(0);
    assert!(bench.path("far.gif").exists());
    plot(&bench, &["far.ron", "--deformed"])
        .ends_with(2)
        .says(&["pose 0"]);
}

/// A job's figures have what `plot` draws: two designs in the same colours, their ratio, a pose by its
/// coordinates.
#[test]
fn figures_of_jobs_are_of_two_designs_and_of_poses_by_their_coordinates() {
    let bench = Bench::new("pictures-designs");
    let rest = r#"vary: { "rod.section.diameter": [0.014, 0.020] }, figures: [
        Map(value: "k33", plane: z(0.45), beside: 1),
        Map(value: "k33", plane: z(0.45), beside: 1, ratio: true, limits: (0.5, 3)),
        Budget(pose: (x: 0.1, y: 0.15, z: "450 mm")),
    ],"#;
    bench.file("two.ron", &delta_batch("two", GRID, rest));
    let outcome = bench.hyperstat(&["run", "two.ron", "--out", "out"]);
    assert!(outcome.status() < 2, "{}", outcome.err());
    let both = bench.read("out/two-map-1.svg");
    for name in ["design 0", "design 1"] {
        assert!(both.contains(name), "no {name}");
    }
    // The columns' ratio is between the two marks of the bar.
    let ratio = bench.read("out/two-map-2.svg");
    assert!(ratio.contains("design 1 over design 0"), "{ratio}");
    let budget = bench.read("out/two-budget.svg");
    let number = |name: &str| column(&bench, "out/two.csv", name);
    let poses = [number("x"), number("y"), number("z")];
    let is_there = |row: &usize| {
        [0.1, 0.15, 0.45]
            .iter()
            .zip(&poses)
            .all(|(value, column)| column[*row].is_some_and(|own| (own - value).abs() < 1e-9))
    };
    let row = (0..poses[0].len()).find(is_there).expect("a pose");
    assert!(budget.contains(&format!("pose {row}")), "{row}: {budget}");
}

/// A JSON file that is no JSON is told with the place, whatever is to be drawn of it.
#[test]
fn a_mistake_in_json_has_a_place() {
    let bench = Bench::new("pictures-json");
    bench.file("m.json", "{\n  \"name\": \"m\",\n  \"points\": {,}\n}\n");
    for what in [&["--deformed"][..], &["--mode", "1"], &["--budget"]] {
        let outcome = plot(&bench, &[&["m.json"], what].concat()).ends_with(2);
        outcome.says(&["m.json:3:14"]);
    }
}

/// What is no number of anything is told as a value, not as an option that there is not.
#[test]
fn negative_values_of_options_are_told_what_is_right() {
    let bench = with_two("pictures-negative");
    for (words, told) in [
        (
            &["thin.ron", "--deformed", "--scale", "-5"][..],
            "expected a factor above zero, such as 200",
        ),
        (&["thin.ron", "--mode", "-1"], "-1 is not in 1..=1000"),
        (
            &["thin.ron", "--deformed", "--pose", "-3"],
            "expected the number of a pose, from 0",
        ),
    ] {
        plot(&bench, words).ends_with(2).says(&[told]);
    }
}
