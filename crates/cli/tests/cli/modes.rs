//! Natural frequencies in `solve` and `run`.

use crate::support::{Bench, CANTILEVER, assert_near, delta_batch, numbers};

/// The bar of the help with a density and 8 elements.
fn heavy_bar() -> String {
    CANTILEVER
        .replace("poisson: 0.3", "poisson: 0.3, density: 7850.0")
        .replace("material: \"steel\"", "material: \"steel\", elements: 8")
}

/// Euler and Bernoulli's cantilever, (1.875104069/L)² √(EI/ρA) / 2π for a round bar of 20 mm.
fn first_bending() -> f64 {
    let radius_of_gyration = 0.02 / 4.0;
    (1.875_104_069_f64 / 0.5).powi(2) * radius_of_gyration * (2.1e11_f64 / 7850.0).sqrt()
        / std::f64::consts::TAU
}

#[test]
fn solve_reports_modes() {
    let bench = Bench::new("modes-solve");
    bench.file("bar.ron", &heavy_bar());
    let solve = |arguments: &[&str]| {
        let arguments = [&["solve", "bar.ron"], arguments].concat();
        bench.hyperstat(&arguments).ends_with(0)
    };
    let json = solve(&["--modes", "3", "--format", "json"]).json();
    let modes = json["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 3);
    for mode in &modes[..2] {
        // As many digits as λ is written with.
        assert_near(
            mode["frequency"].as_f64().unwrap(),
            first_bending(),
            1e-9,
            first_bending(),
        );
        assert_eq!(numbers(&mode["shape"]["bar.A"]), [0.0; 6]);
        assert_near(
            mode["kinetic_energy"]["bar"].as_f64().unwrap(),
            1.0,
            1e-12,
            1.0,
        );
        assert_eq!(numbers(&mode["effective_mass"]).len(), 3);
        assert_eq!(mode["shape"].as_object().unwrap().len(), 2);
    }
    assert_near(json["mass"].as_f64().unwrap(), 1.233_075, 1e-6, 1.0);
    let inner = solve(&["--modes", "1", "--all-nodes", "--format", "json"]).json();
    assert_eq!(inner["modes"][0]["shape"].as_object().unwrap().len(), 9);
    assert!(inner["modes"][0]["shape"]["bar.A-B.7"].is_array());

    let text = solve(&["--modes", "3"]);
    assert!(
        text.out().contains("Natural frequencies [Hz]"),
        "{}",
        text.out()
    );
    assert!(
        text.out().contains("bar 100 %     57.8863"),
        "{}",
        text.out()
    );
    // The third pair is beyond the two that are counted with the first of the second.
    assert!(
        text.out().contains("  4 of 4 modes below 380."),
        "{}",
        text.out()
    );
    assert!(text.out().contains(" Hz, none missed\n"), "{}", text.out());
    let counted = &json["counted"];
    assert_eq!(
        (&counted["modes"], &counted["found"]),
        (&4.into(), &4.into())
    );
    for lumped in [
        &["--lumped"][..],
        &["--mass", "Lumped"],
        &["--mass", "lumped"],
    ] {
        let lumped = solve(&[&["--modes", "1"], lumped].concat());
        assert!(lumped.out().contains("57.4742"), "{}", lumped.out());
    }
    // Eight consistent elements: some (1.875/8)⁴/1440 above, one by √(12.480/12.362).
    let consistent = ["--modes", "1", "--mass", "Consistent"];
    let eight = solve(&[&consistent[..], &["--format", "json"]].concat()).json();
    let above = eight["modes"][0]["frequency"].as_f64().unwrap() / first_bending() - 1.0;
    assert!((1e-6..3e-6).contains(&above), "{above}");
    bench.file(
        "bar.ron",
        &heavy_bar().replace("elements: 8", "elements: 1"),
    );
    let one = solve(&consistent);
    assert!(one.out().contains("58.16"), "{}", one.out());
    let one = solve(&["--modes", "1"]);
    assert!(one.out().contains("57.8863"), "{}", one.out());
    bench.file("bar.ron", &heavy_bar());
    bench
        .hyperstat(&["solve", "bar.ron", "--lumped", "--mass", "Exact"])
        .ends_with(2);
    let without = solve(&["--format", "json"]).json();
    assert!(without.get("modes").is_none() && without.get("mass").is_none());
}

#[test]
fn what_has_no_density_is_named() {
    let bench = Bench::new("modes-density");
    bench.file("bar.ron", CANTILEVER);
    bench
        .hyperstat(&["solve", "bar.ron", "--modes", "3"])
        .ends_with(2)
        .says(&[
            "bar.ron:6:15",
            "the material of body `bar` has no density, which its weight and natural frequencies need",
            "give its material a `density` in kg/m³; 0.0 is one without mass",
        ]);
    let weightless = heavy_bar().replace("7850.0", "0.0");
    bench.file("bar.ron", &weightless);
    let nothing = bench.hyperstat(&["solve", "bar.ron", "--modes", "3"]);
    nothing
        .ends_with(2)
        .says(&["nothing has mass", "give a material a `density`"]);
    let job = r#"(jobs: [(name: "bar", mechanism: File("light.ron"), modes: 2)])"#;
    bench.file("light.ron", CANTILEVER);
    bench.file("batch.ron", job);
    let run = bench.hyperstat(&["run", "batch.ron", "--out", "out"]);
    run.ends_with(2).says(&[
        "light.ron:6:15",
        "the material of body `bar` has no density",
    ]);
}

/// A sweep's frequencies are those of its poses one by one, in both formats, whatever the threads;
/// what has no result has none.
#[test]
fn run_writes_columns_of_frequencies() {
    let bench = Bench::new("modes-run");
    let poses = "List([(0.0, 0.0, 0.5), (0.1, -0.05, 0.45), (0.0, 0.0, 5.0)])";
    let batch = delta_batch("d", poses, "modes: (count: 4, mass: Lumped)");
    bench.file(
        "d.ron",
        &batch.replace("rod_spacing", "elements: 4, rod_spacing"),
    );
    let mut tables = Vec::new();
    for threads in ["1", "2"] {
        let arguments = ["run", "d.ron", "--out", "out", "--threads", threads];
        bench.hyperstat(&arguments).ends_with(1);
        tables.push(bench.read("out/d.csv"));
    }
    assert_eq!(tables[0], tables[1]);
    let lines: Vec<&str> = tables[0].lines().collect();
    assert!(lines[0].ends_with(",k56,k66,f1,f2,f3,f4"), "{}", lines[0]);
    assert!(lines[3].ends_with(",,,,"), "{}", lines[3]);
    for (pose, line) in lines[1..3].iter().enumerate() {
        let cells = line
            .split(',')
            .skip(35)
            .map(|cell| cell.parse::<f64>().unwrap());
        let pose = pose.to_string();
        let arguments = ["solve", "d.ron", "--pose", &pose, "--format", "json"];
        let solved = bench.hyperstat(&arguments).ends_with(0).json();
        let modes = solved["modes"].as_array().unwrap();
        assert_eq!(modes.len(), 4);
        for (cell, mode) in cells.zip(modes) {
            let alone = mode["frequency"].as_f64().unwrap();
            assert_near(cell, alone, 1e-10, alone);
        }
    }
    bench
        .hyperstat(&["run", "d.ron", "--out", "out", "--format", "parquet"])
        .ends_with(1);
    assert_eq!(bench.results("out"), ["d.csv", "d.parquet"]);
}
