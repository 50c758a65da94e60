//! What `solve --why` calls parameters: each name once, and each path one that `vary` takes, with the
//! derivative that `vary` finds.

use std::collections::BTreeSet;

use serde_json::Value;

use crate::support::Bench;

/// A taper over two segments, one between two equal sections, a bar with their diameter, a name that
/// holds a dot and one that begins as another, a frame of members, two hinges alike and one apart.
const MECHANISM: &str = r#"(
    name: "parameters",
    materials: {
        "steel": (young: 2.1e11, poisson: 0.3, density: 7850.0),
        "steel 2": (young: 2.1e11, poisson: 0.3, density: 7850.0),
    },
    sections: {
        "a": Tapered(from: Circle(diameter: 0.02), to: Circle(diameter: 0.01)),
        "same": Tapered(from: Circle(diameter: 0.015), to: Circle(diameter: 0.015)),
        "plain": Circle(diameter: 0.015),
        "a.b": Tube(outer: 0.02, inner: 0.01, shear_y: 1.5e-4, shear_z: 1.4e-4),
        "flat": Rectangle(width: 0.02, height: 0.015),
    },
    points: {
        "A": (0.0, 0.0, 0.0), "B": (0.3, 0.0, 0.0), "C": (0.5, 0.1, 0.0), "D": (0.7, 0.0, 0.0),
        "E": (0.7, 0.3, 0.0), "F": (0.7, 0.6, 0.1), "G": (0.9, 0.6, 0.1),
    },
    bodies: {
        "b": Beam(through: ["A", "B", "C"], section: "a", material: "steel"),
        "c": Beam(through: ["C", "D"], section: "same", material: "steel"),
        "d": Beam(through: ["D", "E"], section: "plain", material: "steel 2"),
        "e": Frame(members: [["E", "F"], (through: ["F", "G"], section: "flat")], section: "a.b", material: "steel"),
    },
    joints: {
        "wall": (at: "A", between: ("ground", "b"), kind: Fixed),
        "j1": (at: "C", between: ("b", "c"), kind: Fixed, stiffness: (w: 900.0)),
        "j2": (at: "D", between: ("c", "d"), kind: Fixed, stiffness: (w: 900.0)),
        "j3": (at: "E", between: ("d", "e"), kind: Fixed, stiffness: (w: 700.0)),
    },
    masses: [(on: ("e", "G"), mass: 0.5, inertia: (1e-3, 1e-3, 1e-3)), (on: ("e", "G"), mass: 0.2, inertia: (2e-3, 1e-3, 2e-3))],
    loads: [(on: ("e", "G"), force: (30.0, -20.0, -40.0))],
    output: ("e", "G"),
)"#;

fn why(bench: &Bench, input: &[&str]) -> Value {
    let arguments = [
        &["solve"],
        input,
        &["--why", "--along", "z", "--modes", "2", "--format", "json"],
    ];
    bench.hyperstat(&arguments.concat()).ends_with(0).json()
}

/// Name, value and relative derivatives: of the deflection, of two frequencies.
fn parameters(report: &Value) -> Vec<(String, f64, [f64; 3])> {
    let frequencies = report["frequency_sensitivities"].as_array().unwrap();
    assert_eq!(frequencies.len(), 2);
    let of_frequency = |k: usize, name: &str| {
        let all = frequencies[k]["sensitivities"].as_array().unwrap();
        let mut own = all.iter().filter(|s| s["parameter"] == name);
        let first = own.next().unwrap_or_else(|| panic!("no {name}"));
        assert!(own.next().is_none(), "{name} twice");
        first["relative"][0].as_f64().unwrap()
    };
    // Lengths and coordinates, of which frequencies have none, are told so.
    let all = report["sensitivities"].as_array().unwrap().iter();
    let all = all.filter(|s| s["by_differences"] != true);
    all.map(|s| {
        let name = s["parameter"].as_str().unwrap().to_owned();
        let relative = s["relative"].as_f64().unwrap();
        let of_frequencies = [0, 1].map(|k| of_frequency(k, &name));
        let relative = [relative, of_frequencies[0], of_frequencies[1]];
        (name, s["value"].as_f64().unwrap(), relative)
    })
    .collect()
}

#[test]
fn every_path_is_one_that_vary_takes() {
    let bench = Bench::new("parameters-paths");
    bench.file("m.ron", MECHANISM);
    // With weight, so that masses and densities are among them.
    let text = MECHANISM.replace("    loads:", "    gravity: (0.0, 0.0, -9.81),\n    loads:");
    bench.file("m.ron", &text);
    let found = parameters(&why(&bench, &["m.ron"]));
    let names: BTreeSet<&str> = found.iter().map(|(name, ..)| name.as_str()).collect();
    assert_eq!(names.len(), found.len(), "{names:?}");
    let mut expected: BTreeSet<&str> = [
        "sections.a.from.diameter",
        "sections.a.to.diameter",
        "sections.same.from.diameter",
        "sections.same.to.diameter",
        "sections.plain.diameter",
        "sections.a.b.outer",
        "sections.a.b.inner",
        "sections.a.b.shear_y",
        "sections.a.b.shear_z",
        "sections.flat.width",
        "sections.flat.height",
        "materials.steel.young",
        "materials.steel.poisson",
        "materials.steel.density",
        "materials.steel 2.young",
        "materials.steel 2.poisson",
        "materials.steel 2.density",
        "joints.j3.stiffness.w",
        "masses.0.mass",
        "masses.1.mass",
    ]
    .into();
    let words = ["stiffness w of j1, j2"];
    expected.extend(words);
    assert_eq!(names, expected);
    let paths: Vec<_> = found
        .iter()
        .filter(|(name, ..)| !words.contains(&name.as_str()))
        .collect();
    let job = |(k, (path, value, _)): (usize, &&(String, f64, [f64; 3]))| {
        let values = [value * (1.0 - 1e-4), value * (1.0 + 1e-4)];
        format!(
            "(name: \"j{k}\", mechanism: File(\"m.ron\"), modes: 2, vary: {{\"{path}\": {values:?}}})"
        )
    };
    let jobs: Vec<_> = paths.iter().enumerate().map(job).collect();
    bench.file("batch.ron", &format!("(jobs: [{}])", jobs.join(", ")));
    bench
        .hyperstat(&["run", "batch.ron", "--out", "out"])
        .ends_with(0);
    for (k, (path, _, relative)) in paths.iter().enumerate() {
        let table = bench.read(&format!("out/j{k}.csv"));
        let mut lines = table
            .lines()
            .map(|line| line.split(',').collect::<Vec<_>>());
        let header = lines.next().unwrap();
        let rows: Vec<_> = lines.collect();
        for (column, relative) in ["dz", "f1", "f2"].iter().zip(relative) {
            let place = header.iter().position(|name| name == column).unwrap();
            let [low, high] = [0, 1].map(|row| rows[row][place].parse::<f64>().unwrap());
            let slope = (high - low) / (high + low) / 1e-4;
            // Differences are good to the third derivatives times 1e-8/6.
            assert!(
                (slope - relative).abs() < 1e-6,
                "{path} {column}: {relative} {slope}"
            );
        }
    }
}

/// Several joints that are one parameter have one path, which varies all of them.
#[test]
fn joints_that_are_one_parameter_have_the_path_that_varies_them() {
    let bench = Bench::new("parameters-groups");
    bench.file("m.ron", MECHANISM);
    let path = "joints.{j1|j2}.stiffness.w";
    let told = bench.hyperstat(&["solve", "m.ron", "--why"]).ends_with(0);
    assert!(
        told.out().contains(&format!("\n    {path}\n")),
        "{}",
        told.out()
    );
    let json = why(&bench, &["m.ron"]);
    let one = |list: &Value| {
        let mut all = list.as_array().unwrap().iter();
        let own = all.find(|own| own["parameter"] == "stiffness w of j1, j2");
        own.unwrap().clone()
    };
    let own = one(&json["sensitivities"]);
    assert_eq!(own["path"], path);
    let modes = json["frequency_sensitivities"].as_array().unwrap();
    assert_eq!(one(&modes[0]["sensitivities"])["path"], path);
    let value = own["value"].as_f64().unwrap();
    let values = [value * (1.0 - 1e-4), value * (1.0 + 1e-4)];
    bench.file(
        "batch.ron",
        &format!(
            "(jobs: [(name: \"j\", mechanism: File(\"m.ron\"), vary: {{\"{path}\": {values:?}}})])"
        ),
    );
    bench
        .hyperstat(&["run", "batch.ron", "--out", "out"])
        .ends_with(0);
    let table = bench.read("out/j.csv");
    let rows = table.lines().map(|line| line.split(',').collect());
    let rows: Vec<Vec<&str>> = rows.collect();
    let place = rows[0].iter().position(|name| *name == "dx").unwrap();
    let [low, high] = [1, 2].map(|row| rows[row][place].parse::<f64>().unwrap());
    let slope = (high - low) / (values[1] - values[0]);
    let exact = own["displacement"][0].as_f64().unwrap();
    assert!((slope / exact - 1.0).abs() < 1e-6, "{slope} {exact}");
}

/// What a job replaces, and what varies as a whole, has no path: it is told in words, once.
#[test]
fn what_vary_does_not_take_is_told_in_words() {
    let bench = Bench::new("parameters-words");
    bench.file("m.ron", MECHANISM);
    bench.file(
        "batch.ron",
        "(jobs: [(name: \"j\", mechanism: File(\"m.ron\"), gravity: (0.0, 0.0, -9.81),
            masses: [(on: (\"e\", \"G\"), mass: 0.5), (on: (\"e\", \"G\"), mass: 0.5)],
            vary: {\"sections.a\": [Tapered(from: Circle(diameter: 0.02), to: Circle(diameter: 0.012))],
                   \"joints.j3.stiffness\": [(w: 800.0)],
                   \"sections.plain.diameter\": [0.016]})])",
    );
    let found = parameters(&why(&bench, &["batch.ron"]));
    let names: BTreeSet<&str> = found.iter().map(|(name, ..)| name.as_str()).collect();
    assert_eq!(names.len(), found.len(), "{names:?}");
    for name in [
        "diameter of first end of b",
        "diameter of second end of b",
        "stiffness w of j3",
        "mass on e.G (1 of 2)",
        "mass on e.G (2 of 2)",
        "sections.plain.diameter",
    ] {
        assert!(names.contains(name), "no {name} in {names:?}");
    }
    assert!(!names.iter().any(|name| name.starts_with("sections.a.from")));
}
