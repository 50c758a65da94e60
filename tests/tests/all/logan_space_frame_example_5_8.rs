//! Space frame of three beams: D. L. Logan, *A First Course in the Finite Element Method*,
//! example 5.8 (kip, inch, rad).
//!
//! | node | x | y | z | |
//! |---|---|---|---|---|
//! | N1 | 0 | 0 | 0 | Fy = −50, Mx = −1000 |
//! | N2 | −100 | 0 | 0 | fixed |
//! | N3 | 0 | 0 | −100 | fixed |
//! | N4 | 0 | −100 | 0 | fixed |
//!
//! Beams N2–N1, N3–N1, N4–N1: E = 30000, G = 10000, A = 10, Iy = Iz = 100, J = 50.
//!
//! Displacement of N1, as printed: 7.098e-5, −0.014, −2.352e-3, −3.996e-3, 1.78e-5, −1.033e-4;
//! to more digits: 7.098258e-5, −1.399513e-2, −2.351889e-3, −3.996090e-3, 1.780069e-5,
//! −1.033429e-4.

use std::path::Path;

use hyperstat_assembly::{Model, solve};
use hyperstat_mechanisms::{Disk, Registry, mechanism_from_str};
use hyperstat_tests::build::{assert_printed, general, material, member, node, weld_to_ground};
use nalgebra::{Point3, Vector6};

const PRINTED: [&str; 6] = [
    "7.098e-5",
    "-0.014",
    "-2.352e-3",
    "-3.996e-3",
    "1.78e-5",
    "-1.033e-4",
];
const MORE_DIGITS: [&str; 6] = [
    "7.098258e-5",
    "-1.399513e-2",
    "-2.351889e-3",
    "-3.996090e-3",
    "1.780069e-5",
    "-1.033429e-4",
];

/// Compares the output with the source; returns the number of unknowns.
fn check(model: &Model) -> usize {
    let solution = solve(model).expect("a solution");
    let found = solution.output.displacement;
    assert_printed("N1", found.as_slice(), &PRINTED);
    assert_printed("N1, more digits", found.as_slice(), &MORE_DIGITS);
    solution.unknowns
}

/// One body of three beams, welded at N1.
#[test]
fn one_body_of_three_members() {
    let mut model = Model::new("Logan, example 5.8");
    let points = [
        ("N1", Point3::origin()),
        ("N2", Point3::new(-100.0, 0.0, 0.0)),
        ("N3", Point3::new(0.0, 0.0, -100.0)),
        ("N4", Point3::new(0.0, -100.0, 0.0)),
    ];
    let steel = material(30000.0, 10000.0);
    let section = general(10.0, 100.0, 100.0, 50.0, None);
    let members = [1, 2, 3].map(|end| member([end, 0], &steel, &section));
    model
        .add_elastic("frame", &points, &members)
        .expect("a frame");
    for point in ["N2", "N3", "N4"] {
        weld_to_ground(&mut model, "frame", point);
    }
    let output = node(&model, "frame", "N1");
    let load = Vector6::new(0.0, -50.0, 0.0, -1000.0, 0.0, 0.0);
    model.add_load(output, load).expect("a load");
    model.set_output(output);
    assert_eq!(check(&model), 6);
}

/// Three bodies, each a beam of three elements, and five welds, from a file.
#[test]
fn three_beams_from_a_file() {
    let text = r#"(
    name: "Logan, example 5.8",
    materials: { "steel": (young: 30000.0, shear: 10000.0) },
    sections: { "beam": General(area: 10.0, iy: 100.0, iz: 100.0, torsion: 50.0) },
    points: {
        "N1": (0.0, 0.0, 0.0),
        "N2": (-100.0, 0.0, 0.0),
        "N3": (0.0, 0.0, -100.0),
        "N4": (0.0, -100.0, 0.0),
    },
    bodies: {
        "b2": Beam(through: ["N2", "N1"], section: "beam", material: "steel", elements: 3),
        "b3": Beam(through: ["N3", "N1"], section: "beam", material: "steel", elements: 3),
        "b4": Beam(through: ["N4", "N1"], section: "beam", material: "steel", elements: 3),
    },
    joints: {
        "f2": (at: "N2", between: ("ground", "b2"), kind: Fixed),
        "f3": (at: "N3", between: ("b3", "ground"), kind: Fixed),
        "f4": (at: "N4", between: ("ground", "b4"), kind: Fixed),
        "w23": (at: "N1", between: ("b2", "b3"), kind: Fixed),
        "w24": (at: "N1", between: ("b4", "b2"), kind: Fixed),
    },
    loads: [(on: ("b3", "N1"), force: (0.0, -50.0, 0.0), moment: (-1000.0, 0.0, 0.0))],
    output: ("b4", "N1"),
)"#;
    let path = Path::new("logan_5_8.ron");
    let mechanism =
        mechanism_from_str(text, path, &Disk, &Registry::builtin()).expect("a mechanism");
    check(&mechanism.model);
}
