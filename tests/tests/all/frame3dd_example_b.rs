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
//!
//! Under gravity, −9806.33 mm/s² along z with 7.85e-9 t/mm³, the same program (Frame3DD 20140514+
//! as in WISDEM-pyFrame3DD 1.1.1) printed the figures below without geometric stiffness, in three
//! cases; with it, it prints the source's for the first. The source's own second and third case
//! have loads over parts of beams, gradients of temperature and geometric stiffness.

use std::path::Path;

use hyperstat_assembly::{Axes, LineLoad, LoadCase, LoadSet, Model, SegmentId, solve};
use hyperstat_elements::{Elasticity, Material};
use hyperstat_joints::Fixed;
use hyperstat_mechanisms::{Disk, Registry, mechanism_from_str};
use hyperstat_tests::build::{
    assert_printed, assert_printed_in_single, connection, general, material, member, node,
    weld_to_ground,
};
use nalgebra::{Matrix3, Point3, Rotation3, Vector3, Vector6};

const LINEAR: [&str; 3] = ["0.0141272", "-0.0502277", "-0.0223740"];

/// Beams by the places of their ends.
const BEAMS: [[usize; 2]; 4] = [[1, 0], [0, 2], [0, 3], [4, 0]];

fn points() -> [(&'static str, Point3<f64>); 5] {
    [
        ("1", Point3::new(0.0, 0.0, 1000.0)),
        ("2", Point3::new(-1200.0, -900.0, 0.0)),
        ("3", Point3::new(1200.0, -900.0, 0.0)),
        ("4", Point3::new(1200.0, 900.0, 0.0)),
        ("5", Point3::new(-1200.0, 900.0, 0.0)),
    ]
}

fn pyramid() -> Model {
    let mut model = Model::new("frame3dd, example B");
    let points = points();
    let steel = material(200000.0, 79300.0);
    let section = general(36.0, 492.0, 492.0, 1000.0, Some(20.0));
    let members = BEAMS.map(|ends| member(ends, &steel, &section));
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
    let mechanism =
        mechanism_from_str(text, path, &Disk, &Registry::builtin()).expect("a mechanism");
    let solution = solve(&mechanism.model).expect("a solution");
    let found = solution.output.displacement;
    assert_printed("node 1", &found.as_slice()[..3], &LINEAR);
}

/// A body a beam, so that each has its own temperature, welded to a small rigid body at the top.
fn heavy_pyramid() -> Model {
    let mut model = Model::new("frame3dd, example B");
    let points = points();
    let steel = Material::new(200000.0, Elasticity::Shear(79300.0), Some(7.85e-9))
        .and_then(|steel| steel.with_expansion(12e-6))
        .expect("a material");
    let section = general(36.0, 492.0, 492.0, 1000.0, Some(20.0));
    model.add_rigid("top", &points[..1]).expect("a body");
    for (k, ends) in BEAMS.into_iter().enumerate() {
        let body = format!("beam{}", k + 1);
        let ends = ends.map(|end| points[end]);
        let straight = member([0, 1], &steel, &section);
        model
            .add_elastic(&body, &ends, &[straight])
            .expect("a beam");
        let foot = ends
            .iter()
            .find(|(name, _)| *name != "1")
            .expect("a foot")
            .0;
        weld_to_ground(&mut model, &body, foot);
        let between = [
            Some(node(&model, "top", "1")),
            Some(node(&model, &body, "1")),
        ];
        let weld = connection(&body, between, Fixed);
        model
            .add_joint(weld, Rotation3::identity())
            .expect("a joint");
    }
    model.set_output(node(&model, "top", "1"));
    model
        .set_gravity(Vector3::new(0.0, 0.0, -9806.33))
        .expect("gravity");
    model
}

/// A load along a beam, given in its local axes at both ends as Frame3DD has it: y level, z up.
fn along(beam: usize, ends: [[f64; 3]; 2]) -> LineLoad {
    let points = points();
    let [first, second] = BEAMS[beam - 1].map(|end| points[end].1);
    let x = (second - first).normalize();
    let y = Vector3::z().cross(&x).normalize();
    let axes = Matrix3::from_columns(&[x, y, x.cross(&y)]);
    let global = |end: [f64; 3]| {
        let force = axes * Vector3::from(end);
        Vector6::new(force.x, force.y, force.z, 0.0, 0.0, 0.0)
    };
    LineLoad {
        segment: SegmentId(beam - 1),
        ends: ends.map(global),
        axes: Axes::Global,
    }
}

/// Displacement of node 1, then the reactions at 2 and 4.
type Printed = [[&'static str; 6]; 3];

/// Case 1 of the source: the load (100, −200, −100) at node 1.
const WEIGHT: Printed = [
    [
        "0.014127222",
        "-0.050227657",
        "-0.022374027",
        "3.5871909e-5",
        "8.139768e-6",
        "0.000000000",
    ],
    [
        "74.650167",
        "55.995652",
        "64.714926",
        "372.73350",
        "-504.97325",
        "4.9799680",
    ],
    [
        "8.6658157",
        "6.5073881",
        "-4.7229743",
        "-380.72017",
        "499.63165",
        "-4.9799680",
    ],
];

/// Uniform loads on beams 2 (local y, 0.1) and 1 (local z, 0.1); from end to end of beam 3 along
/// local x 0.01 to 0.05, y 0.03 to −0.01, z −0.05 to 0.07, of beam 4 x 0.02 to 0, y 0.05 to 0, z
/// 0.01 to −0.03.
const ALONG: Printed = [
    [
        "0.0053035872",
        "0.016516921",
        "0.0066467179",
        "-0.0048759338",
        "0.013602359",
        "0.032160385",
    ],
    [
        "-2.6523062",
        "3.5466676",
        "-108.84457",
        "-18585.836",
        "21017.107",
        "1691.8190",
    ],
    [
        "-51.735971",
        "-47.669841",
        "15.336751",
        "4848.1120",
        "-1149.8537",
        "3649.3295",
    ],
];

/// Beam 1 warmer by 20 K, beam 3 colder by 15 K.
const HEAT: Printed = [
    [
        "0.28436631",
        "0.37913647",
        "0.046711954",
        "-2.7077410e-4",
        "1.6384507e-4",
        "0.000000000",
    ],
    [
        "74.963512",
        "56.204114",
        "64.947802",
        "389.14300",
        "-497.19391",
        "-11.690656",
    ],
    [
        "-74.832544",
        "-56.142928",
        "64.859396",
        "-351.78260",
        "490.70689",
        "11.690656",
    ],
];

#[test]
fn weight_loads_along_beams_and_heat() {
    let mut model = heavy_pyramid();
    let load = Vector6::new(100.0, -200.0, -100.0, 0.0, 0.0, 0.0);
    model
        .add_load(node(&model, "top", "1"), load)
        .expect("a load");
    let lines = vec![
        along(2, [[0.0, 0.1, 0.0]; 2]),
        along(1, [[0.0, 0.0, 0.1]; 2]),
        along(3, [[0.01, 0.03, -0.05], [0.05, -0.01, 0.07]]),
        along(4, [[0.02, 0.05, 0.01], [0.0, 0.0, -0.03]]),
    ];
    for (name, lines) in [("along", lines), ("rest", Vec::new())] {
        let nodes = Vec::new();
        let loads = LoadSet { nodes, lines };
        let name = name.into();
        model.add_case(LoadCase { name, loads }).expect("a case");
    }
    let cold = solve(&model).expect("a solution");
    for (body, change) in [("beam1", 20.0), ("beam3", -15.0)] {
        let body = model.body(body).expect("a beam");
        model.set_temperature(body, change).expect("a temperature");
    }
    let warm = solve(&model).expect("a solution");
    let joints = |name: &str| {
        let place = model.joints().iter().position(|joint| joint.name == name);
        place.expect("a joint")
    };
    let [second, fourth] = ["2", "4"].map(joints);
    let found = [
        (&cold.output.displacement, &cold.joint_wrenches),
        (
            &cold.cases[0].state.output,
            &cold.cases[0].state.joint_wrenches,
        ),
        (
            &warm.cases[1].state.output,
            &warm.cases[1].state.joint_wrenches,
        ),
    ];
    for (case, ((displacement, wrenches), printed)) in
        found.iter().zip([WEIGHT, ALONG, HEAT]).enumerate()
    {
        let wrench = |joint: usize| wrenches[joint].expect("determined");
        let numbers = [**displacement, wrench(second), wrench(fourth)];
        for (k, (numbers, printed)) in numbers.iter().zip(printed).enumerate() {
            let what = format!("case {}, line {k}", case + 1);
            assert_printed_in_single(&what, numbers, &printed);
        }
    }
}
