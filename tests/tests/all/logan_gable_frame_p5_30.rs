//! Gable frame in a plane: D. L. Logan, *A First Course in the Finite Element Method*, problem
//! P5.30 (kip, inch, rad).
//!
//! | node | x | y | |
//! |---|---|---|---|
//! | N1 | 0 | 0 | fixed |
//! | N2 | 0 | 360 | |
//! | N3 | 180 | 480 | Fy = −30 |
//! | N4 | 420 | 480 | Fy = −30 |
//! | N5 | 600 | 360 | |
//! | N6 | 600 | 0 | fixed |
//!
//! One frame through N1 … N6: E = 30000, A = 12, I = 200.
//!
//! Reaction at N1: Fx = 11.6877, Fy = 30, Mz = −1810.0745; displacement of N3: Dy = −6.666757.
//!
//! The source knows the plane only: what resists motions out of it (Iy, J, G) is chosen here, two
//! ways, and must not matter.

use std::path::Path;

use hyperstat_assembly::{Model, solve};
use hyperstat_mechanisms::{Disk, Registry, mechanism_from_str};
use hyperstat_tests::build::{assert_printed, general, material, node, weld_to_ground};
use nalgebra::{Point3, Vector3, Vector6};

const NODES: [(&str, [f64; 2]); 6] = [
    ("N1", [0.0, 0.0]),
    ("N2", [0.0, 360.0]),
    ("N3", [180.0, 480.0]),
    ("N4", [420.0, 480.0]),
    ("N5", [600.0, 360.0]),
    ("N6", [600.0, 0.0]),
];

/// Compares the reaction of joint N1 (from the ground on the frame) and N3's deflection.
fn check(model: &Model) {
    let solution = solve(model).expect("a solution");
    let first = model.joints().iter().position(|j| j.name == "N1");
    let reaction = solution.joint_wrenches[first.expect("a joint")].expect("a determined wrench");
    let in_plane = [reaction[0], reaction[1], reaction[5]];
    assert_printed("reaction", &in_plane, &["11.6877", "30.0000", "-1810.0745"]);
    let third = solution.displacements[node(model, "frame", "N3").0];
    assert_printed("third node", &[third.y], &["-6.666757"]);
    for (name, value) in [
        ("Fz", reaction[2]),
        ("Mx", reaction[3]),
        ("My", reaction[4]),
    ] {
        assert!(value.abs() < 1e-9, "out of the plane: {name} = {value:e}");
    }
    assert!(third.z.abs() < 1e-12, "out of the plane: {:e}", third.z);
}

/// One bent beam whose local y lies in the plane: I is the section's `iz`.
#[test]
fn one_bent_beam() {
    let mut model = Model::new("Logan, P5.30");
    let points = NODES.map(|(name, [x, y])| (name, Point3::new(x, y, 0.0)));
    let section = general(12.0, 700.0, 200.0, 900.0, None);
    let in_plane = Some(Vector3::new(0.6, 0.8, 0.0));
    let steel = material(30000.0, 11000.0);
    model
        .add_beam("frame", &points, &steel, &section, in_plane, 1)
        .expect("a frame");
    for point in ["N1", "N6"] {
        weld_to_ground(&mut model, "frame", point);
    }
    for point in ["N3", "N4"] {
        let load = Vector6::new(0.0, -30.0, 0.0, 0.0, 0.0, 0.0);
        let at = node(&model, "frame", point);
        model.add_load(at, load).expect("a load");
    }
    model.set_output(node(&model, "frame", "N3"));
    check(&model);
}

/// The same from a file, where local y is out of the plane: I is the section's `iy`.
#[test]
fn one_bent_beam_from_a_file() {
    let text = r#"(
    name: "Logan, P5.30",
    materials: { "steel": (young: 30000.0, poisson: 0.3) },
    sections: { "frame": General(area: 12.0, iy: 200.0, iz: 30.0, torsion: 5.0) },
    points: {
        "N1": (0.0, 0.0, 0.0), "N2": (0.0, 360.0, 0.0), "N3": (180.0, 480.0, 0.0),
        "N4": (420.0, 480.0, 0.0), "N5": (600.0, 360.0, 0.0), "N6": (600.0, 0.0, 0.0),
    },
    bodies: {
        "frame": Beam(
            through: ["N1", "N2", "N3", "N4", "N5", "N6"],
            section: "frame", material: "steel", y_axis: (0.0, 0.0, 1.0), elements: 2,
        ),
    },
    joints: {
        "N1": (at: "N1", between: ("ground", "frame"), kind: Fixed),
        "N6": (at: "N6", between: ("ground", "frame"), kind: Fixed),
    },
    loads: [
        (on: ("frame", "N3"), force: (0.0, -30.0, 0.0)),
        (on: ("frame", "N4"), force: (0.0, -30.0, 0.0)),
    ],
    output: ("frame", "N3"),
)"#;
    let path = Path::new("logan_p5_30.ron");
    let mechanism =
        mechanism_from_str(text, path, &Disk, &Registry::builtin()).expect("a mechanism");
    check(&mechanism.model);
}
