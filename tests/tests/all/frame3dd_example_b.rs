//! Pyramid of four beams with shear deformation: H. P. Gavin, *Frame3DD*, example B (N, mm, rad).
//!
//! | node | x | y | z | |
//! |---|---|---|---|---|
//! | 1 | 0 | 0 | 1000 | load 100, −200, −109.992 (the beams' weight included) |
//! | 2 | −1200 | −900 | 0 | fixed |
//! | 3 | 1200 | −900 | 0 | fixed |
//! | 4 | 1200 | 900 | 0 | fixed |
//! | 5 | −1200 | 900 | 0 | fixed |
//!
//! Beams 2–1, 1–3, 1–4, 5–1: A = 36, shear areas 20 and 20, J = 1000, Iy = Iz = 492, E = 200000,
//! G = 79300.
//!
//! The source prints 0.014127, −0.050229, −0.022374 for node 1 with geometric stiffness. Without
//! it, which is the linear theory here: 0.0141272, −0.0502277, −0.0223740. The beams are slender:
//! shear deformation moves node 1 by 6e-10 only, below the printed digits.

use std::path::Path;

use hyperstat_assembly::{Model, solve};
use hyperstat_mechanisms::{Registry, mechanism_from_str};
use hyperstat_tests::build::{assert_printed, general, material, member, node, weld_to_ground};
use nalgebra::{Point3, Vector6};

const LINEAR: [&str; 3] = ["0.0141272", "-0.0502277", "-0.0223740"];

fn pyramid() -> Model {
    let mut model = Model::new("frame3dd, example B");
    let points = [
        ("1", Point3::new(0.0, 0.0, 1000.0)),
        ("2", Point3::new(-1200.0, -900.0, 0.0)),
        ("3", Point3::new(1200.0, -900.0, 0.0)),
        ("4", Point3::new(1200.0, 900.0, 0.0)),
        ("5", Point3::new(-1200.0, 900.0, 0.0)),
    ];
    let steel = material(200000.0, 79300.0);
    let section = general(36.0, 492.0, 492.0, 1000.0, Some(20.0));
    let members = [[1, 0], [0, 2], [0, 3], [4, 0]].map(|ends| member(ends, &steel, &section));
    model
        .add_elastic("pyramid", &points, &members)
        .expect("a frame");
    for point in ["2", "3", "4", "5"] {
        weld_to_ground(&mut model, "pyramid", point);
    }
    let top = node(&model, "pyramid", "1");
    let load = Vector6::new(100.0, -200.0, -109.992, 0.0, 0.0, 0.0);
    model.add_load(top, load).expect("a load");
    model.set_output(top);
    model
}

#[test]
fn one_body_of_four_members() {
    let solution = solve(&pyramid()).expect("a solution");
    let found = solution.output.displacement;
    assert_printed("node 1", &found.as_slice()[..3], &LINEAR);
}

/// Four bodies and seven welds, from a file.
#[test]
fn four_beams_from_a_file() {
    let text = r#"(
    name: "frame3dd, example B",
    materials: { "steel": (young: 200000.0, shear: 79300.0) },
    sections: {
        "tube": General(
            area: 36.0, iy: 492.0, iz: 492.0, torsion: 1000.0, shear_y: 20.0, shear_z: 20.0,
        ),
    },
    points: {
        "1": (0.0, 0.0, 1000.0),
        "2": (-1200.0, -900.0, 0.0),
        "3": (1200.0, -900.0, 0.0),
        "4": (1200.0, 900.0, 0.0),
        "5": (-1200.0, 900.0, 0.0),
    },
    bodies: {
        "a": Beam(through: ["2", "1"], section: "tube", material: "steel"),
        "b": Beam(through: ["1", "3"], section: "tube", material: "steel"),
        "c": Beam(through: ["1", "4"], section: "tube", material: "steel"),
        "d": Beam(through: ["5", "1"], section: "tube", material: "steel"),
    },
    joints: {
        "2": (at: "2", between: ("ground", "a"), kind: Fixed),
        "3": (at: "3", between: ("ground", "b"), kind: Fixed),
        "4": (at: "4", between: ("c", "ground"), kind: Fixed),
        "5": (at: "5", between: ("ground", "d"), kind: Fixed),
        "ab": (at: "1", between: ("a", "b"), kind: Fixed),
        "bc": (at: "1", between: ("b", "c"), kind: Fixed),
        "da": (at: "1", between: ("d", "a"), kind: Fixed),
    },
    loads: [(on: ("c", "1"), force: (100.0, -200.0, -109.992))],
    output: ("d", "1"),
)"#;
    let path = Path::new("frame3dd_b.ron");
    let mechanism = mechanism_from_str(text, path, &Registry::builtin()).expect("a mechanism");
    let solution = solve(&mechanism.model).expect("a solution");
    let found = solution.output.displacement;
    assert_printed("node 1", &found.as_slice()[..3], &LINEAR);
}
