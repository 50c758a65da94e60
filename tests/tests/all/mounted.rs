//! Mechanisms that are mounted in others: on an elastic column the compliance of the tool is the mechanism's own, turned
//! with it, and the column's, brought to the tool; names, values and masses of what is mounted are those of its file.

use std::path::Path;

use hyperstat_assembly::{Model, ValuePlace, solve};
use hyperstat_mechanisms::{LoadError, Mechanism, MemoryFiles, Registry, mechanism_from_str};
use hyperstat_tests::{moved, reference_text, turned_matrix};
use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3};

/// What a mechanism is mounted on.
const COLUMN: &str = r#"(
    name: "column",
    parameters: { "h": "1200 mm" },
    materials: { "iron": (young: "110 GPa", poisson: 0.27, density: 7200.0) },
    sections: { "box": Tube(outer: 0.3, inner: 0.26) },
    points: { "foot": (0.1, 0.0, 0.0), "top": (0.1, 0.2, "= h") },
    bodies: { "frame": Beam(through: ["foot", "top"], section: "box", material: "iron") },
    joints: { "base": (at: "foot", between: ("ground", "frame"), kind: Fixed) },
    MOUNTS
    OUTPUT
)"#;

fn column(mounts: &str, output: &str) -> String {
    COLUMN.replace("MOUNTS", mounts).replace("OUTPUT", output)
}

fn try_read(text: &str, files: &[(&str, &str)]) -> Result<Mechanism, LoadError> {
    let files = MemoryFiles::from_iter(files.iter().copied());
    mechanism_from_str(text, Path::new("column.ron"), &files, &Registry::builtin())
}

fn read(text: &str, files: &[(&str, &str)]) -> Mechanism {
    try_read(text, files).unwrap_or_else(|error| panic!("{error}"))
}

fn compliance(model: &Model) -> Matrix6<f64> {
    let solution = solve(model).expect("a solution");
    solution.output.compliance.expect("a compliance")
}

/// Where the output stands.
fn tool(model: &Model) -> Vector3<f64> {
    model.geometry().positions[model.output().expect("an output").0].coords
}

#[test]
fn compliances_add_up() {
    let turn = Vector3::new(0.3, -0.5, 0.8);
    let shift = Vector3::new(0.1, 0.2, 1.2);
    let alone = read(&column("", "output: (\"frame\", \"top\"),"), &[]).model;
    for (file, node) in [
        ("every_joint.ron", r#"("top", "T")"#),
        ("tricept.ron", r#"("platform", "P")"#),
        ("delta_elastic_joints.ron", r#"("platform", "P")"#),
    ] {
        let text = reference_text(file);
        let at = "at: (0.1, 0.2, \"= h\", 0.3, -0.5, 0.8)";
        let mounts = format!(
            r#"mechanisms: {{ "head": (file: "head.ron", {at}, on: ("frame", "top"), output: {node}) }},"#
        );
        let whole = read(&column(&mounts, ""), &[("head.ron", &text)]).model;
        let head = read(&text, &[]).model;
        let rotation = Rotation3::from_scaled_axis(turn);
        let placed = moved(&head, &rotation, &shift);
        assert!((tool(&whole) - tool(&placed)).norm() < 1e-14, "{file}");
        // A twist at the column's top, at the tool.
        let mut carried = Matrix6::identity();
        let arm: Matrix3<f64> = (tool(&whole) - tool(&alone)).cross_matrix();
        carried.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm);
        let expected = turned_matrix(&rotation, &compliance(&head))
            + carried * compliance(&alone) * carried.transpose();
        let found = compliance(&whole);
        let difference = (found - expected).amax() / expected.amax();
        assert!(difference < 1e-10, "{file}: {difference:e}");
    }
}

const ARM: &str = r#"(
    name: "arm",
    parameters: { "length": 0.5, "d": "20 mm" },
    materials: { "steel": (young: 2.1e11, poisson: 0.3, density: 7850.0) },
    sections: { "rod": Circle(diameter: "= d") },
    groups: {
        "leg": (
            points: { "A": (0.1, 0.0, 0.0), "B": (0.1, 0.0, "= length") },
            bodies: { "rod": Beam(through: ["A", "B"], section: "rod", material: "steel") },
            joints: {
                "foot": (at: "A", between: ("ground", "rod"), kind: Fixed, stiffness: (x: 1e7)),
                "head": (at: "B", between: ("rod", "top"), kind: Fixed),
            },
            masses: [(on: ("rod", "B"), mass: 0.3)],
        ),
    },
    copies: { "leg": Turned(axis: (0.0, 0.0, 1.0), count: 3) },
    points: { "P": (0.0, 0.0, "= length") },
    bodies: { "top": Rigid(points: ["P", "B1", "B2", "B3"]) },
    masses: [(on: ("top", "P"), mass: 2.0)],
    gravity: (0.0, 0.0, -9.81),
    loads: [(on: ("top", "P"), force: (1.0, 0.0, 0.0))],
    output: ("top", "P"),
)"#;

const TWO: &str = r#"mechanisms: {
        "left": (file: "arm.ron", at: (0.1, 0.2, "= h"), on: ("frame", "top")),
        "right": (file: "arm.ron", at: (0.1, 0.2, "= h", 0.0, "90 deg", 0.0), on: ("frame", "top")),
    },"#;

#[test]
fn names_and_values_are_those_of_the_file() {
    let files = [("arm.ron", ARM)];
    let text = column(TWO, "output: (\"right.top\", \"right.P\"),");
    let mechanism = read(&text, &files);
    let model = &mechanism.model;
    let bodies: Vec<_> = model.bodies().iter().map(|body| &*body.name).collect();
    assert_eq!(bodies.len(), 1 + 2 * 5);
    assert!(bodies.contains(&"left.rod1") && bodies.contains(&"right.ground"));
    // Masses come along, what acts does not.
    let masses: Vec<f64> = model.masses().iter().map(|own| own.mass.mass()).collect();
    assert_eq!(masses, [2.0, 0.3, 0.3, 0.3, 2.0, 0.3, 0.3, 0.3]);
    assert!(model.load_set().nodes.is_empty() && model.gravity().norm() == 0.0);
    // Values by their paths, one by one and as one.
    let length = |model: &Model, body: &str| {
        let body = model
            .bodies()
            .iter()
            .position(|own| own.name == body)
            .expect("a body");
        let ends = model
            .segments()
            .iter()
            .find(|own| own.body.0 == body)
            .expect("a beam")
            .ends;
        let [a, b] = ends.map(|node| model.geometry().positions[node.0]);
        (b - a).norm()
    };
    let longer = mechanism
        .with_values(&[("parameters.left.length", 0.7)])
        .expect("a mechanism")
        .model;
    assert!((length(&longer, "left.rod2") - 0.7).abs() < 1e-15);
    assert!((length(&longer, "right.rod2") - 0.5).abs() < 1e-15);
    for (path, value) in [
        ("sections.right.rod.diameter", 0.03),
        ("materials.left.steel.young", 1e11),
        ("joints.right.groups", 1.0),
        ("groups.right.leg.joints.foot.stiffness.x", 2e7),
        ("points.left.P.0", 0.01),
        ("mechanisms.left.at.0", 0.2),
    ] {
        let changed = mechanism.with_values(&[(path, value)]);
        assert_eq!(changed.is_err(), path == "joints.right.groups", "{path}");
    }
    // They are named so.
    let mut named = model.clone();
    mechanism.name_values(&mut named);
    let masses = (0..model.masses().len()).map(|mass| ValuePlace::Mass { mass });
    let places = named.values().into_iter().map(|(place, _)| place);
    let paths: Vec<_> = (places.chain(masses))
        .filter_map(|place| named.value_name(place))
        .collect();
    for path in [
        "sections.box.outer",
        "materials.left.steel.young",
        "masses.right.0.mass",
        "groups.left.leg.masses.0.mass",
    ] {
        assert!(paths.contains(&path), "{path} is not in {paths:?}");
    }
}

#[test]
fn mistakes_are_told_where_they_stand() {
    let files = [
        ("arm.ron", ARM),
        (
            "loop.ron",
            "(name: \"l\", mechanisms: { \"a\": (file: \"loop.ron\", on: (\"ground\", \"x\")) }, points: {}, bodies: {}, joints: {})",
        ),
        (
            "bad.ron",
            "(name: \"b\", points: { \"A\": (0, 0) }, bodies: {}, joints: {}, output: (\"a\", \"A\"))",
        ),
    ];
    let output = "output: (\"frame\", \"top\"),";
    for (mount, told) in [
        (r#"(file: "arm.ron")"#, "no `on`"),
        (
            r#"(file: "none.ron", on: ("frame", "top"))"#,
            "cannot read none.ron",
        ),
        (
            r#"(file: "loop.ron", on: ("frame", "top"))"#,
            "mounts itself",
        ),
        (r#"(file: "bad.ron", on: ("frame", "top"))"#, "bad.ron:1:28"),
        (r#"(file: "arm.ron", on: ("frame", "tip"))"#, "tip"),
        (
            r#"(file: "arm.ron", at: (0.0, 1.0), on: ("frame", "top"))"#,
            "expected a place",
        ),
        (
            r#"(file: "arm.ron", on: ("frame", "top"), output: ("top", "P"))"#,
            "is a second one",
        ),
        (
            r#"(file: "arm.ron", on: ("frame", "top"), turn: 1)"#,
            "turn",
        ),
    ] {
        let text = column(&format!("mechanisms: {{ \"head\": {mount} }},"), output);
        let error = try_read(&text, &files).expect_err(mount).to_string();
        assert!(error.contains(told), "{mount}: {error}");
    }
}
