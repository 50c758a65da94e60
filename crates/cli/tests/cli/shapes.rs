//! Deformed shapes, natural modes and budgets as figures: from `plot` and from a job's `figures` the
//! same picture; what their captions say, against closed forms; and what cannot be drawn.

use std::f64::consts::{PI, TAU};
use std::fs;

use crate::support::{Bench, CANTILEVER, delta_batch, hinged};

/// F L³/3EI of the bar in the help \[m\].
fn sag() -> f64 {
    100.0 * 0.5_f64.powi(3) / (3.0 * 2.1e11 * PI * 0.02_f64.powi(4) / 64.0)
}

/// A bench with the bar in the help as `bar.ron`.
fn with_bar(name: &str) -> Bench {
    let bench = Bench::new(name);
    bench.file("bar.ron", CANTILEVER);
    bench
}

/// Text lines of an SVG.
fn texts(svg: &str) -> Vec<&str> {
    let texts = svg.split("<text").skip(1);
    texts
        .filter_map(|text| text.split('>').nth(1)?.split('<').next())
        .map(str::trim)
        .collect()
}

#[test]
fn plot_and_a_jobs_figures_draw_the_same() {
    let bench = Bench::new("shapes-same");
    let figures = "figures: [
        Deformed(pose: 1, scale: 300), Mode(number: 2, pose: 1), Budget(along: z, pose: 1), Budget,
    ],";
    let poses = "List([(0.0, 0.0, 0.5), (-0.2, -0.2, 0.5)])";
    bench.file("delta.ron", &delta_batch("delta", poses, figures));
    bench
        .hyperstat(&["run", "delta.ron", "--out", "out"])
        .ends_with(0);
    for (figure, options) in [
        (
            "deformed",
            vec!["--deformed", "--pose", "1", "--scale", "300", "--verify"],
        ),
        ("mode", vec!["--mode", "2", "--pose", "1"]),
        ("budget-1", vec!["--budget", "--along", "z", "--pose", "1"]),
        ("budget-2", vec!["--budget"]),
    ] {
        let arguments = [&["plot", "delta.ron", "--out", "again"], &*options].concat();
        bench.hyperstat(&arguments).ends_with(0);
        for end in ["svg", "png"] {
            let job = fs::read(bench.path(&format!("out/delta-{figure}.{end}"))).unwrap();
            let plot = fs::read(bench.path(&format!("again.{end}"))).unwrap();
            assert!(job == plot, "{figure}.{end}");
        }
    }
    // The JSON of `solve --why` holds the same budget.
    let why = ["solve", "delta.ron", "--why", "--along", "z", "--pose", "1"];
    let solved = bench.hyperstat(&[&why[..], &["--format", "json"]].concat());
    bench.file("solved.json", solved.ends_with(0).out());
    let outcome = bench.hyperstat(&["plot", "solved.json", "--budget"]);
    let outcome = outcome.ends_with(0);
    assert!(
        outcome
            .out()
            .starts_with("solved-budget.svg\nsolved-budget.png\n")
    );
    for end in ["svg", "png"] {
        let job = fs::read(bench.path(&format!("out/delta-budget-1.{end}"))).unwrap();
        let plot = fs::read(bench.path(&format!("solved-budget.{end}"))).unwrap();
        assert!(job == plot, "{end}");
    }
}

#[test]
fn a_deformed_bar_has_its_sag_and_its_factor_in_the_caption() {
    let bench = with_bar("shapes-deformed");
    let outcome = bench.hyperstat(&["plot", "bar.ron", "--deformed", "--scale", "50"]);
    let outcome = outcome.ends_with(0);
    let told = format!("Largest deflection: {:.2} mm.", 1e3 * sag());
    assert!(
        outcome
            .out()
            .starts_with("bar-deformed.svg\nbar-deformed.png\n")
    );
    assert!(
        outcome.out().contains("deflection × 50."),
        "{}",
        outcome.out()
    );
    assert!(
        outcome.out().ends_with(&format!("{told}\n")),
        "{}",
        outcome.out()
    );
    let svg = bench.read("bar-deformed.svg");
    let texts = texts(&svg);
    for text in [
        "cantilever",
        "undeformed",
        "deformed, × 50",
        "x (m)",
        &*told,
    ] {
        assert!(texts.contains(&text), "no `{text}` in {texts:?}");
    }
    assert!(!svg.contains("reference solver"));
    let compared = [
        "plot",
        "bar.ron",
        "--deformed",
        "--verify",
        "--title",
        "A bar",
    ];
    let outcome = bench.hyperstat(&compared).ends_with(0);
    assert!(
        outcome
            .out()
            .contains("Largest difference between the two methods")
    );
    let svg = bench.read("bar-deformed.svg");
    assert!(svg.contains(">\nreference solver\n<") && svg.contains(">\nA bar\n<"));
}

#[test]
fn a_case_is_drawn_by_its_name() {
    let bench = Bench::new("shapes-case");
    let cases = r#"cases: { "half": [(on: ("bar", "B"), force: (0.0, 50.0, 0.0))] }, output:"#;
    bench.file("bar.ron", &CANTILEVER.replacen("output:", cases, 1));
    let half = ["plot", "bar.ron", "--deformed", "--case", "half"];
    let outcome = bench.hyperstat(&half).ends_with(0);
    let told = format!("Largest deflection: {:.2} mm.", 0.5e3 * sag());
    assert!(outcome.out().contains(&told), "{}", outcome.out());
    assert!(
        bench
            .read("bar-deformed.svg")
            .contains(">\ncantilever, case half\n<")
    );
    bench
        .hyperstat(&["plot", "bar.ron", "--deformed", "--case", "full"])
        .ends_with(2)
        .says(&["bar.ron holds no case `full`", "its cases are half"]);
    let job =
        r#"(jobs: [(name: "bar", mechanism: File("bar.ron"), figures: [Deformed(case: "half")])])"#;
    bench.file("batch.ron", job);
    bench
        .hyperstat(&["run", "batch.ron", "--out", "out"])
        .ends_with(0);
    assert!(bench.read("out/bar-deformed.svg").contains(&told));
}

#[test]
fn a_mode_has_its_frequency_in_its_words() {
    let bench = Bench::new("shapes-mode");
    let dense = CANTILEVER.replace("poisson: 0.3", "poisson: 0.3, density: 7850.0");
    let fine = dense.replace("material: \"steel\")", "material: \"steel\", elements: 12)");
    bench.file("bar.ron", &fine);
    let outcome = bench.hyperstat(&["plot", "bar.ron", "--mode", "3"]);
    let outcome = outcome.ends_with(0);
    assert!(
        outcome
            .out()
            .starts_with("bar-mode-3.svg\nbar-mode-3.png\n")
    );
    // Blevins, Table 8-1: the second pair of modes, λ = 4.694. The caption has four digits.
    let inertia_over_area = 0.02_f64.powi(2) / 16.0;
    let expected = 4.694_091_133_f64.powi(2) / 0.5_f64.powi(2)
        * (2.1e11 * inertia_over_area / 7850.0).sqrt()
        / TAU;
    let told = outcome.out().split("at ").nth(1).unwrap();
    let told: f64 = told.split(' ').next().unwrap().parse().unwrap();
    assert!((told / expected - 1.0).abs() < 3e-4, "{told} {expected}");
    assert!(
        outcome.out().contains("Shape of unit modal mass × "),
        "{}",
        outcome.out()
    );
    let svg = bench.read("bar-mode-3.svg");
    let texts = texts(&svg);
    for text in ["cantilever", "at rest", "mode shape"] {
        assert!(texts.contains(&text), "no `{text}` in {texts:?}");
    }
    // The figure is of the masses that the job's modes have.
    let job = |modes: &str| {
        format!(
            "(jobs: [(name: \"bar\", mechanism: File(\"bar.ron\"), {modes} figures: [Mode]), ])"
        )
    };
    let mut drawn = Vec::new();
    for modes in ["", "modes: (count: 1, mass: Lumped),"] {
        bench.file("batch.ron", &job(modes));
        bench
            .hyperstat(&["run", "batch.ron", "--out", "out"])
            .ends_with(0);
        drawn.push(bench.read("out/bar-mode.svg"));
    }
    assert_ne!(drawn[0], drawn[1]);
}

#[test]
fn a_budget_of_a_bar_is_all_bending() {
    let bench = with_bar("shapes-budget");
    let outcome = bench.hyperstat(&["plot", "bar.ron", "--budget", "--along", "0,0,-2"]);
    let outcome = outcome.ends_with(0);
    let told = format!("100 % is a deflection of {:.3} mm.", 1e3 * sag());
    assert!(outcome.out().contains(&told), "{}", outcome.out());
    assert!(
        outcome.out().contains("bar.B along (0, 0, −1)"),
        "{}",
        outcome.out()
    );
    let svg = bench.read("bar-budget.svg");
    let texts = texts(&svg);
    for text in [
        "By deformation",
        "bending",
        "By body and joint",
        "bar",
        "share (%)",
        &*told,
    ] {
        assert!(texts.contains(&text), "no `{text}` in {texts:?}");
    }
    assert_eq!(texts.iter().filter(|text| **text == "100.0 %").count(), 2);
    // 10 N·m turn its end by T L/GJ, and nothing else does.
    let outcome = bench.hyperstat(&["plot", "bar.ron", "--budget", "--along", "rx"]);
    let twist = 10.0 * 0.5 / (2.1e11 / 2.6 * PI * 0.02_f64.powi(4) / 32.0);
    let told = format!("100 % is a rotation of {:.3} mrad.", 1e3 * twist);
    assert!(outcome.ends_with(0).out().contains(&told));
    assert!(bench.read("bar-budget.svg").contains(">\ntorsion\n<"));
}

#[test]
fn what_a_figure_needs_and_is_not_there_is_told() {
    let bench = with_bar("shapes-wrong");
    let unloaded = hinged().replace("force: (0.0, 0.0, -100.0)", "force: (0.0, 0.0, 0.0)");
    bench.file("hinged.ron", &unloaded);
    bench.file("table.csv", "pose,x,y,z,rx,ry,rz,status,dx\n");
    bench.file("word.json", "{\n  \"name\": 3\n}\n");
    let solve = ["solve", "bar.ron", "--format", "json"];
    bench.file("plain.json", bench.hyperstat(&solve).ends_with(0).out());
    let why = [&solve[..], &["--why"]].concat();
    bench.file("why.json", bench.hyperstat(&why).ends_with(0).out());
    let free = bench.hyperstat(&[
        "solve",
        "hinged.ron",
        "--allow-free",
        "--why",
        "--format",
        "json",
    ]);
    bench.file("free.json", free.ends_with(0).out());
    for (arguments, words) in [
        (&["bar.ron"][..], &["--deformed", "--mode", "--budget"][..]),
        (
            &["table.csv", "--deformed"],
            &["`--deformed` is drawn of a mechanism", "batch file"],
        ),
        (
            &["why.json", "--mode", "1"],
            &["`--mode` is drawn of a mechanism"],
        ),
        (
            &["table.csv", "--map", "dx", "--job", "a"],
            &["`--job` chooses from a batch file"],
        ),
        (
            &["why.json", "--budget", "--pose", "0"],
            &["`--pose` chooses", "leave `--pose` out"],
        ),
        (
            &["why.json", "--budget", "--along", "z"],
            &["is solved already", "solve --why"],
        ),
        (
            &["plain.json", "--budget"],
            &["plain.json holds no budget", "--why --format json"],
        ),
        (&["free.json", "--budget"], &["the output moves freely"]),
        (
            &["word.json", "--budget"],
            &["word.json:2:11", "not the JSON of", "--why"],
        ),
        (&["none.json", "--budget"], &["cannot read none.json"]),
        (
            &["bar.ron", "--budget", "--along", "y"],
            &["does not move along this", "--along"],
        ),
        (
            &["bar.ron", "--budget", "--along", "up"],
            &["`displacement`", "three numbers"],
        ),
        (
            &["bar.ron", "--deformed", "--scale", "0"],
            &["a factor above zero"],
        ),
        (&["bar.ron", "--budget", "--scale", "2"], &["--scale"]),
        (
            &["bar.ron", "--deformed", "--pose", "1"],
            &["`--pose` chooses from a batch file"],
        ),
        (&["bar.ron", "--mode", "0"], &["1..=1000"]),
        (&["bar.ron", "--mode", "1"], &["bar.ron:6:", "density"]),
        (
            &["hinged.ron", "--budget"],
            &["hinged.ron:", "moves freely"],
        ),
        (
            &["bar.ron", "--deformed", "--case", "a"],
            &["holds no case `a`", "no cases"],
        ),
    ] {
        let outcome = bench.hyperstat(&[&["plot"], arguments].concat());
        outcome.ends_with(2).says(words);
    }
    // A bar without mass, with some at its end.
    let light = CANTILEVER.replace("poisson: 0.3", "poisson: 0.3, density: 0.0");
    let massive = light.replace(
        "loads:",
        "masses: [(on: (\"bar\", \"B\"), mass: 1.0)],\n    loads:",
    );
    bench.file("bar.ron", &massive);
    bench
        .hyperstat(&["plot", "bar.ron", "--mode", "7"])
        .ends_with(2)
        .says(&["bar.ron has no mode 7: it has 3", "`elements`"]);
    bench
        .hyperstat(&["plot", "bar.ron", "--mode", "1", "--out", "none/mode"])
        .ends_with(3)
        .says(&["cannot write none/mode.svg"]);
}

#[test]
fn a_jobs_mode_needs_mass_before_the_first_job_runs() {
    let bench = with_bar("shapes-massless");
    let job = r#"(jobs: [(name: "bar", mechanism: File("bar.ron"), modes: (count: 1, mass: Consistent), figures: [Mode])])"#;
    bench.file("batch.ron", job);
    bench
        .hyperstat(&["run", "batch.ron", "--out", "out"])
        .ends_with(2)
        .says(&["bar.ron:6:", "density"]);
    assert!(!bench.path("out").exists());
    let massive = CANTILEVER.replace("poisson: 0.3", "poisson: 0.3, density: 7850.0");
    bench.file("bar.ron", &massive);
    bench.file(
        "batch.ron",
        &job.replace("[Mode]", "[Mode(number: 9), Budget(along: y)]"),
    );
    let outcome = bench.hyperstat(&["run", "batch.ron", "--out", "out"]);
    let outcome = outcome.ends_with(0);
    for told in [
        "no bar-mode: there are 6 modes only",
        "no bar-budget: the output does not move along this direction",
    ] {
        assert!(outcome.out().contains(told), "{}", outcome.out());
    }
    assert_eq!(bench.results("out"), ["bar.csv"]);
}
