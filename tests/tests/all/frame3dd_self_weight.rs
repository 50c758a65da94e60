//! Leaning cantilever under its weight: H. P. Gavin, *Frame3DD*, `examples/selfweight.3dd` with the
//! results printed in `selfweight.out` (version 20091203; kip, in, s), without shear deformation and
//! geometric stiffness.
//!
//! Nodes (0, 0, 0), (10, 10, 10), (40, 40, 40), (80, 80, 80), (100, 100, 100), the first fixed; four
//! beams: A = 10, J = 100, Iy = Iz = 1000, E = 1e5, G = 1e4, density 0.1. Case 1: gravity (0, 0, −1).
//! Case 2: the same as a load along local axes, −1/√3 along x and −√2/√3 along z.

use hyperstat_assembly::{Axes, LineLoad, LoadSet, Model, SegmentId, Solution, solve};
use hyperstat_elements::{Elasticity, Material};
use hyperstat_tests::build::{assert_printed_in_single, general, member, node, weld_to_ground};
use nalgebra::{Point3, Vector3, Vector6};

const NAMES: [&str; 5] = ["1", "2", "3", "4", "5"];

/// Displacements of nodes 2 to 5.
const DISPLACEMENTS: [[&str; 6]; 4] = [
    [
        "0.006063",
        "0.006063",
        "-0.014975",
        "-0.001355",
        "0.001355",
        "0.0",
    ],
    [
        "0.088000",
        "0.088000",
        "-0.185600",
        "-0.003920",
        "0.003920",
        "0.0",
    ],
    [
        "0.270400",
        "0.270400",
        "-0.555200",
        "-0.004960",
        "0.004960",
        "0.0",
    ],
    [
        "0.370000",
        "0.370000",
        "-0.755000",
        "-0.005000",
        "0.005000",
        "0.0",
    ],
];
/// Wrenches on the beams at their ends, local axes.
const END_FORCES: [[&str; 6]; 8] = [
    ["100.000", "0.0", "141.421", "0.0", "-12247.449", "0.0"],
    ["-90.000", "0.0", "-127.279", "0.0", "9920.434", "0.0"],
    ["90.000", "0.0", "127.279", "0.0", "-9920.434", "0.0"],
    ["-60.000", "0.0", "-84.853", "0.0", "4409.082", "0.0"],
    ["60.000", "0.0", "84.853", "0.0", "-4409.082", "0.0"],
    ["-20.000", "0.0", "-28.284", "0.0", "489.898", "0.0"],
    ["20.000", "0.0", "28.284", "0.0", "-489.898", "0.0"],
    ["0.0", "0.0", "0.0", "0.0", "0.0", "0.0"],
];
const REACTION: [&str; 6] = ["0.0", "0.0", "173.205", "8660.254", "-8660.254", "0.0"];

fn cantilever() -> Model {
    let mut model = Model::new("self-weight");
    let points: Vec<_> = (NAMES.iter().zip([0.0, 10.0, 40.0, 80.0, 100.0]))
        .map(|(name, at)| (*name, Point3::new(at, at, at)))
        .collect();
    let elastic = Elasticity::Shear(1e4);
    let material = Material::new(1e5, elastic, Some(0.1)).expect("a material");
    let section = general(10.0, 1000.0, 1000.0, 100.0, None);
    let members = [0, 1, 2, 3].map(|k| member([k, k + 1], &material, &section));
    model.add_elastic("bar", &points, &members).expect("a body");
    weld_to_ground(&mut model, "bar", "1");
    model.set_output(node(&model, "bar", "5"));
    model
}

fn assert_as_printed(solution: &Solution) {
    for (k, printed) in DISPLACEMENTS.iter().enumerate() {
        let found = solution.displacements[k + 1];
        assert_printed_in_single(NAMES[k + 1], &found, printed);
    }
    let ends = solution.segments.iter().flat_map(|segment| &segment.ends);
    for (k, (found, printed)) in ends.zip(END_FORCES).enumerate() {
        let what = format!("end {} of beam {}", k % 2 + 1, k / 2 + 1);
        assert_printed_in_single(&what, found, &printed);
    }
    let wrench = solution.joint_wrenches[0].expect("determined");
    assert_printed_in_single("reaction", &wrench, &REACTION);
}

#[test]
fn under_gravity() {
    let mut model = cantilever();
    model.set_gravity(-Vector3::z()).expect("gravity");
    assert_as_printed(&solve(&model).expect("a solution"));
}

#[test]
fn under_a_load_along_it() {
    let mut model = cantilever();
    // Local x runs along (1, 1, 1), local z is normal to it and upright.
    let x = Vector3::new(1.0, 1.0, 1.0).normalize();
    let z = Vector3::new(-1.0, -1.0, 2.0).normalize();
    let force = x * -0.577350269189626 + z * -0.816496580927726;
    let load = |k| LineLoad {
        segment: SegmentId(k),
        ends: [Vector6::new(force.x, force.y, force.z, 0.0, 0.0, 0.0); 2],
        axes: Axes::Global,
    };
    let lines = (0..4).map(load).collect();
    let nodes = Vec::new();
    model.set_loads(LoadSet { nodes, lines }).expect("loads");
    assert_as_printed(&solve(&model).expect("a solution"));
}
