//! What is told of numbers that hardly anything has, and that nothing is told of what is meant.

use std::fs;
use std::path::{Path, PathBuf};

use hyperstat_assembly::Model;
use hyperstat_mechanisms::{Disk, Input, Registry, load_str, mechanism_from_str};

use super::{number, of_model, of_solution};
use crate::study::job_model;

/// A bar held by a bearing and a drive, which carries a platform.
const ARM: &str = r#"(
    name: "arm",
    materials: { "steel": (young: 2.1e11, poisson: 0.3, density: 7850.0, yield: 2.5e8) },
    sections: { "rod": Circle(diameter: 0.03) },
    points: { "A": (0.0, 0.0, 0.0), "B": (0.5, 0.0, 0.0), "C": (0.6, 0.0, 0.1) },
    bodies: {
        "bar": Beam(through: ["A", "B"], section: "rod", material: "steel"),
        "platform": Rigid(points: ["B", "C"]),
    },
    joints: {
        "drive": (at: "A", between: ("ground", "bar"), kind: Revolute(axis: (0.0, 1.0, 0.0)), locked: true,
                  stiffness: (x: 2e8, y: 2e8, z: 2e8, u: 1e5, w: 1e5)),
        "weld": (at: "B", between: ("bar", "platform"), kind: Fixed),
    },
    loads: [(on: ("platform", "C"), force: (0.0, 0.0, -100.0))],
    output: ("platform", "C"),
)"#;

fn told(model: &Model) -> Vec<String> {
    let mut told = of_model(model);
    if let Ok(solution) = hyperstat_assembly::solve(model) {
        told.extend(of_solution(model, &solution));
    }
    told
}

/// What is told of the arm with changes.
fn changed(changes: &[(&str, &str)]) -> Vec<String> {
    let mut text = ARM.to_string();
    for (from, to) in changes {
        assert!(text.contains(from), "no `{from}`");
        text = text.replace(from, to);
    }
    let mechanism = mechanism_from_str(&text, Path::new("arm.ron"), &Disk, &Registry::builtin());
    told(&mechanism.unwrap_or_else(|error| panic!("{error}")).model)
}

/// The one sentence that is told, with all of `parts`.
#[track_caller]
fn says(told: &[String], parts: &[&str]) {
    let of = |line: &&String| parts.iter().all(|part| line.contains(part));
    assert_eq!(told.iter().filter(of).count(), 1, "{parts:?} in {told:#?}");
}

#[test]
fn numbers_are_short() {
    for (value, text) in [
        (210.0, "210"),
        (7.85, "7.85"),
        (0.0003, "3.000e-4"),
        (0.1234567, "0.1235"),
        (30.0, "30"),
        (10.8437, "10.84"),
        (2.1e11, "2.100e11"),
        (12345.6, "12346"),
    ] {
        assert_eq!(number(value), text);
    }
}

#[test]
fn nothing_is_told_of_an_arm_as_it_should_be() {
    assert_eq!(changed(&[]), Vec::<String>::new());
}

#[test]
fn units_of_materials() {
    let told = changed(&[("2.1e11", "210.0")]);
    says(
        &told,
        &["Young's modulus of `bar` is 210 N/m²", "GPa", "2.100e11"],
    );
    let told = changed(&[("2.1e11", "2.1e5")]);
    says(&told, &["as soft as rubber", "N/mm²", "2.100e11"]);
    let told = changed(&[("2.1e11", "7e4")]);
    says(&told, &["softer than rubber", "N/mm²", "7.000e10"]);
    let told = changed(&[("2.1e11", "2.1e14")]);
    says(&told, &["stiffer than diamond"]);
    for (density, unit) in [
        ("7.85", "g/cm³"),
        ("7.85e-6", "kg/mm³"),
        ("7.85e-9", "t/mm³"),
    ] {
        says(
            &changed(&[("7850.0", density)]),
            &["density of `bar`", unit, "7850 here"],
        );
    }
    assert_eq!(changed(&[("7850.0", "0.0")]), Vec::<String>::new());
}

#[test]
fn rubber_is_soft_and_shear_moduli_go_with_youngs() {
    // Silicone of 0.5 N/mm², by its Poisson's ratio, by its density, and without either.
    let of = |law: &str| {
        let law = law.to_string();
        let told = changed(&[("young: 2.1e11, poisson: 0.3, density: 7850.0", &law)]);
        let is_of_modulus = |line: &String| line.contains("modulus of");
        told.into_iter().filter(is_of_modulus).collect::<Vec<_>>()
    };
    for silicone in [
        "young: 5e5, poisson: 0.3",
        "young: 3e5, poisson: 0.48",
        "young: 2e5, poisson: 0.3, density: 1100.0",
        "young: 1.2e10, shear: 6e8, density: 600.0",
        "young: 1.4e11, shear: 5e9, density: 1600.0",
    ] {
        assert_eq!(of(silicone), Vec::<String>::new(), "{silicone}");
    }
    for (shear, unit) in [("80.0", "GPa"), ("8e4", "N/mm² (MPa)"), ("8e7", "kPa")] {
        let law = format!("young: 2.1e11, shear: {shear}, density: 7850.0");
        says(
            &of(&law),
            &["the shear modulus of `bar`", unit, "8.000e10 here"],
        );
    }
}

#[test]
fn gravity_and_size_in_mm() {
    let gravity = "output: (\"platform\", \"C\")";
    let told = changed(&[(gravity, &format!("gravity: (0.0, 0.0, -9810.0), {gravity}"))]);
    says(&told, &["gravity is 9810 m/s²", "mm/s²", "9.81 here"]);
    let told = changed(&[
        ("(0.5, 0.0, 0.0)", "(500.0, 0.0, 0.0)"),
        ("(0.6, 0.0, 0.1)", "(600.0, 0.0, 100.0)"),
    ]);
    says(
        &told,
        &["the mechanism is 608.3 m across", "in mm?", "0.6083 here"],
    );
}

#[test]
fn leaves_may_be_wide_and_small_bushings_soft() {
    let circle = "Circle(diameter: 0.03)";
    let across = |section: &str| {
        let told = changed(&[
            (circle, section),
            ("(0.5, 0.0, 0.0)", "(0.002, 0.0, 0.0)"),
            ("(0.6, 0.0, 0.1)", "(0.01, 0.0, 0.0)"),
        ]);
        told.iter().filter(|line| line.contains("across")).count()
    };
    // A leaf of 0.2 mm, 2 mm long and 30 mm wide; a block; one wider than any leaf.
    assert_eq!(across("Rectangle(width: 0.03, height: 0.0002)"), 0);
    assert_eq!(across("Rectangle(width: 0.03, height: 0.002)"), 1);
    assert_eq!(across("Rectangle(width: 0.05, height: 0.0002)"), 1);
    // 10 mN on 500 N/m in a mechanism of 10 mm: 20 µm.
    let bearing = "x: 2e8, y: 2e8, z: 2e8";
    let small = [
        (bearing, "x: 500.0, y: 500.0, z: 500.0"),
        ("(0.5, 0.0, 0.0)", "(0.008, 0.0, 0.0)"),
        ("(0.6, 0.0, 0.1)", "(0.01, 0.0, 0.0)"),
        (circle, "Circle(diameter: 0.001)"),
        ("-100.0", "-0.01"),
    ];
    let told = changed(&small);
    assert!(
        !told.iter().any(|line| line.contains("bearing")),
        "{told:#?}"
    );
}

#[test]
fn what_lies_at_one_place_may_move_too_far() {
    let text = r#"(
        name: "carriage",
        points: { "A": (0.0, 0.0, 0.0) },
        bodies: { "carriage": Rigid(points: ["A"]) },
        joints: { "spring": (at: "A", between: ("ground", "carriage"), kind: Fixed, stiffness: (x: 2e3)) },
        loads: [(on: ("carriage", "A"), force: (1000.0, 0.0, 0.0))],
        output: ("carriage", "A"),
    )"#;
    let mechanism = mechanism_from_str(text, Path::new("m.ron"), &Disk, &Registry::builtin());
    // 1000 N on 2000 N/m: 0.5 m.
    let told = told(&mechanism.unwrap().model);
    says(&told, &["moves by 0.5 m", "at one place"]);
}

#[test]
fn units_of_sections_and_points() {
    // A pin of 30 mm.
    let told = changed(&[("0.03", "30.0")]);
    says(
        &told,
        &["section of `bar` is 30 m across", "0.5 m long", "in mm?"],
    );
    let told = changed(&[
        ("(0.5, 0.0, 0.0)", "(500.0, 0.0, 0.0)"),
        ("(0.6, 0.0, 0.1)", "(600.0, 0.0, 100.0)"),
    ]);
    says(
        &told,
        &["segment of `bar` is 500 m long and 0.03 m thick", "in mm?"],
    );
}

#[test]
fn bearings_that_are_springs() {
    let bearing = "x: 2e8, y: 2e8, z: 2e8";
    let told = changed(&[(bearing, "x: 500.0, y: 500.0, z: 500.0")]);
    says(
        &told,
        &["stiffness of `drive`", "500 N/m", "N/µm", "5.000e8"],
    );
    // 100 N on 500 N/m: 0.2 m.
    says(&told, &["moves by", "beyond a linear model"]);
    // What frees a direction is a spring.
    let spring = "x: 0.0, y: 2e8, z: 800.0";
    let told = changed(&[
        (bearing, spring),
        ("locked: true", "locked: false"),
        ("u: 1e5", "u: 1e5, v: 1e5"),
    ]);
    assert!(
        !told.iter().any(|line| line.contains("bearing")),
        "{told:#?}"
    );
}

#[test]
fn a_forgotten_drive_on_a_balance_spring() {
    // 100 N on an arm of 0.6 m: 60 N·m on 50 N·m/rad turn it by 1.2 rad.
    let told = changed(&[
        ("locked: true", "locked: false"),
        ("u: 1e5", "u: 1e5, v: 50.0"),
    ]);
    says(
        &told,
        &[
            "moves by",
            "% of the mechanism's size of 0.6083 m",
            "every drive locked?",
        ],
    );
    says(&told, &["turns by 1.2", "rad"]);
}

#[test]
fn a_load_a_thousand_times_too_large() {
    // 100 kN bend a bar of 30 mm: far above 250 N/mm².
    let told = changed(&[("-100.0", "-1e5")]);
    // M = 1e5 N × 0.6 m, W = π 0.03³ / 32: 2.264e10 N/m²; over 2.5e8, 90.5.
    says(
        &told,
        &["utilisation of `bar` is 90.", "are all forces in N?"],
    );
    let told = changed(&[("2.5e8", "250.0")]);
    says(&told, &["utilisation of `bar`", "not in MPa?"]);
}

/// Files of a folder with an extension.
fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path, extension));
        } else if path.extension().is_some_and(|other| other == extension) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The whole files among the blocks of a page.
fn blocks(page: &str) -> Vec<String> {
    let mut blocks = page.split("\n```ron\n").skip(1);
    let text = |block: &str| block.split("\n```").next().unwrap_or_default().to_string();
    std::iter::from_fn(|| blocks.next().map(text)).collect()
}

#[test]
fn nothing_is_told_of_the_examples_the_references_and_the_book() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut texts = Vec::new();
    for folder in ["examples", "tests/reference", "crates/cli/help"] {
        for path in files(&root.join(folder), "ron") {
            texts.push((fs::read_to_string(&path).unwrap(), path));
        }
    }
    for page in files(&root.join("docs/src"), "md") {
        let text = fs::read_to_string(&page).unwrap();
        // What the book shows names the files of the examples.
        let place = root.join("examples").join(page.file_name().unwrap());
        texts.extend(
            blocks(&text)
                .into_iter()
                .map(|block| (block, place.clone())),
        );
    }
    assert!(texts.len() > 50, "{} files", texts.len());
    let registry = Registry::builtin();
    let (mut seen, mut wrong) = (0, String::new());
    for (text, path) in texts {
        let mut see = |model: &Model, name: &str| {
            seen += 1;
            for line in told(model) {
                wrong += &format!("{} {name}: {line}\n", path.display());
            }
        };
        match load_str(&text, &path, &Disk, &registry) {
            Ok(Input::Mechanism(mechanism)) => see(&mechanism.model, ""),
            Ok(Input::Batch(batch)) => {
                for job in &batch.jobs {
                    let reached = (0..job.len().min(20)).find_map(|pose| job_model(job, pose).ok());
                    if let Some(model) = reached.or_else(|| job.model().ok()) {
                        see(&model, &job.name);
                    }
                }
            }
            // Files of joints of one's own, and what the book reads from elsewhere.
            Err(_) => {}
        }
    }
    assert!(seen > 60, "{seen} models");
    assert!(wrong.is_empty(), "{wrong}");
}
