//! Every joint in one mechanism, against a solution in 60-digit interval arithmetic.
//!
//! Source: the project's reference data, case `every_joint`: the mechanism is written out below
//! from its file, the numbers are the file's, rounded to doubles.

use crate::common;

use common::{JointSpec, assert_close, node, steel, stiffness_error};
use hyperstat_elements::{Section, SectionShape};
use hyperstat_joints::{
    Cylindrical, Fixed, Planar, Prismatic, Revolute, Screw, Spherical, Universal, frame_from_axes,
    frame_from_axis,
};
use hyperstat_model::Model;
use hyperstat_reference::solve;
use nalgebra::{Matrix6, Point3, Rotation3, Vector3, Vector6};

#[rustfmt::skip]
const STIFFNESS: [f64; 36] = [
    27407968.210817423, 43326527.48961382, -44824990.99856541, 15819363.040435396, 375069.1903441656, 5877742.875307363,
    43326527.48961382, 158620174.8693205, 20254737.898418564, 30600696.594578248, -1165573.637678083, 5048140.857473654,
    -44824990.99856541, 20254737.898418564, 176789279.61599523, -21088508.37326553, -2970890.1170751955, -14662622.48697041,
    15819363.040435396, 30600696.594578248, -21088508.37326553, 9584781.319887688, 151188.50621514546, 3187169.9439634453,
    375069.1903441656, -1165573.637678083, -2970890.1170751955, 151188.50621514546, 138679.27034119362, 219286.03220534278,
    5877742.875307363, 5048140.857473654, -14662622.48697041, 3187169.9439634453, 219286.03220534278, 1547748.232051676,
];

/// Some displacements, by body and point.
const DISPLACEMENTS: [(&str, &str, [f64; 6]); 5] = [
    (
        "l2",
        "b",
        [
            4.3687999689731675e-06,
            -5.209940949610348e-06,
            -7.014445630545513e-05,
            0.0008737599937946334,
            -0.0010419881899220696,
            -0.014028891261091025,
        ],
    ),
    (
        "l3",
        "c",
        [
            0.0019077435814023095,
            -0.01645511380374053,
            0.014199969003208232,
            -0.06552271658414023,
            -0.007019961744351078,
            -6.30166537896992e-05,
        ],
    ),
    (
        "l4",
        "e",
        [
            0.00019533408144921637,
            -3.193137939955013e-05,
            6.307469629327412e-06,
            -0.0002674911485849585,
            0.000173742746187967,
            -6.30166537896992e-05,
        ],
    ),
    (
        "l6",
        "g",
        [
            0.0,
            0.0,
            0.0,
            -8.009865646347966e-06,
            0.00021781896209308109,
            -0.0001437366541900269,
        ],
    ),
    (
        "top",
        "T",
        [
            0.0002095575233785281,
            -5.182264541054293e-06,
            1.9682027058575333e-05,
            -0.0002674911485849585,
            0.000173742746187967,
            -6.30166537896992e-05,
        ],
    ),
];

/// The wrenches that are not zero, by joint.
const WRENCHES: [(usize, [f64; 6]); 6] = [
    (
        5,
        [
            46.416243943770404,
            121.05314776809601,
            -64.52464249955233,
            2.3047831040607583,
            0.0,
            0.8359965528832602,
        ],
    ),
    (
        6,
        [
            -76.9239114249981,
            111.97835127145328,
            50.152990675663496,
            -7.923330266249874,
            -7.751133974821357,
            6.211048220374607,
        ],
    ),
    (
        7,
        [
            -36.73711504038214,
            -66.65509779808579,
            48.200385641997144,
            -2.264551302466482,
            0.0,
            -1.725983736550688,
        ],
    ),
    (
        8,
        [
            -34.674963251291814,
            -30.000526934181753,
            77.54618086787315,
            0.0,
            0.0,
            0.0,
        ],
    ),
    (
        9,
        [
            43.45834441879404,
            3.6372130882126785,
            52.704121538735016,
            0.0,
            0.0,
            -2.982923069494369,
        ],
    ),
    (
        10,
        [
            8.48748210364405,
            65.90577506188703,
            16.247243054549784,
            12.953629586103082,
            -3.94183899183351,
            -0.4533744792224349,
        ],
    ),
];

const POINTS: [(&str, [f64; 3]); 9] = [
    ("a", [0.0, 0.0, 0.0]),
    ("b", [0.2, 0.05, 0.3]),
    ("c", [0.35, -0.1, 0.55]),
    ("d", [0.2, 0.1, 0.8]),
    ("e", [0.1, 0.3, 0.9]),
    ("f", [-0.2, 0.4, 0.2]),
    ("g", [0.5, 0.4, 0.1]),
    ("h", [0.0, -0.4, 0.5]),
    ("T", [0.1, 0.25, 1.0]),
];

/// Name, ends and local y of each beam.
const BEAMS: [(&str, [&str; 2], [f64; 3]); 7] = [
    (
        "l1",
        ["a", "b"],
        [0.003033931306655539, 0.736797110260639, -0.676107102146101],
    ),
    (
        "l2",
        ["b", "c"],
        [
            -0.6323984977372046,
            -0.32285622772920797,
            -0.7041562300201517,
        ],
    ),
    (
        "l3",
        ["c", "d"],
        [
            0.042087685075105526,
            0.9378646231969613,
            -0.3444395089426308,
        ],
    ),
    (
        "l4",
        ["d", "e"],
        [-0.7153653745955425, 0.5647545804432578, 0.4114664563462483],
    ),
    (
        "l5",
        ["f", "e"],
        [
            0.11251663010909582,
            -0.9931591773409472,
            -0.031222690664738276,
        ],
    ),
    (
        "l6",
        ["g", "d"],
        [0.4397684526343243, -0.8501947872232488, -0.289434849052471],
    ),
    (
        "l7",
        ["h", "e"],
        [-0.6457060961328479, -0.4379615088444376, -0.625502481360051],
    ),
];

fn axis(x: f64, y: f64, z: f64) -> Rotation3<f64> {
    frame_from_axis(Some(&Vector3::new(x, y, z)), None).unwrap()
}

fn axes(a: [f64; 3], b: [f64; 3]) -> Rotation3<f64> {
    frame_from_axes(&Vector3::from(a), &Vector3::from(b)).unwrap()
}

fn every_joint() -> Model {
    let mut model = Model::new("every joint in one chain");
    let at = |name: &'static str| {
        let (_, p) = POINTS.iter().find(|(point, _)| *point == name).unwrap();
        (name, Point3::from(*p))
    };
    let shape = SectionShape::Rectangle {
        width: 0.02,
        height: 0.035,
    };
    let section = Section::new(shape, None, None).unwrap();
    for (name, ends, y) in BEAMS {
        let y = Some(Vector3::from(y));
        model
            .add_beam(name, &ends.map(at), &steel(), &section, y, 1)
            .unwrap();
    }
    model.add_rigid("top", &["T", "e", "d"].map(at)).unwrap();
    let joints = [
        JointSpec::new("C", "a", ["ground", "l1"], Cylindrical)
            .frame(axis(
                -0.17846471749248888,
                -0.9621565782328235,
                0.20592489789637095,
            ))
            .springs(&[(1, 3e6), (4, 2e4)]),
        JointSpec::new("W", "b", ["l1", "l2"], Screw::new(0.005).unwrap()).frame(axis(
            0.061992342737848004,
            -0.07392795442362761,
            -0.9953349220220354,
        )),
        JointSpec::new("E", "c", ["l2", "l3"], Planar)
            .frame(axis(
                -0.9748101118994784,
                -0.08776654078450971,
                0.20504214214947925,
            ))
            .springs(&[(3, 5e4)]),
        JointSpec::new("U", "d", ["l3", "l4"], Universal)
            .frame(axes([1.0, 0.0, 0.0], [0.0, 1.0, 0.0])),
        JointSpec::new("F", "e", ["l4", "top"], Fixed).springs(&[(0, 1e8), (5, 1e5)]),
        JointSpec::new("L", "e", ["l5", "top"], Revolute).frame(axis(
            -0.8147480753327208,
            -0.25438825162287537,
            -0.5210299330920287,
        )),
        JointSpec::new("Q", "f", ["ground", "l5"], Prismatic)
            .frame(axis(
                -0.518673443823403,
                0.6803098518682638,
                -0.517838164027481,
            ))
            .springs(&[(1, 1e6)]),
        JointSpec::new("R", "g", ["ground", "l6"], Revolute).frame(axis(
            -0.0306782249992451,
            0.8342585785119032,
            -0.5505192736773115,
        )),
        JointSpec::new("S", "d", ["l6", "top"], Spherical),
        JointSpec::new("K", "h", ["ground", "l7"], Universal).frame(axes(
            [-0.6588077408447982, 0.6515072738611054, 0.37617899025469737],
            [0.3, -0.2, 0.9],
        )),
        JointSpec::new("N", "e", ["l7", "top"], Fixed),
    ];
    for joint in joints {
        joint.add(&mut model);
    }
    let output = node(&model, "top", "T");
    let load = Vector6::new(100.0, -50.0, 30.0, 3.0, -4.0, 5.0);
    model.add_load(output, load).unwrap();
    model.set_output(output);
    model
}

#[test]
fn agrees_with_interval_arithmetic() {
    let model = every_joint();
    let solution = solve(&model).unwrap();
    assert_eq!((solution.mobility, solution.overconstraint), (2, 4));
    assert_eq!((solution.idle_modes, solution.free_motions.len()), (0, 0));
    let expected = Matrix6::from_row_slice(&STIFFNESS);
    assert!(stiffness_error(&solution.stiffness.unwrap(), &expected) < 1e-13);
    for (body, point, expected) in DISPLACEMENTS {
        let found = solution.displacements[node(&model, body, point).0];
        assert_close(&found, &expected.into(), 1e-12);
    }
    for (joint, expected) in WRENCHES {
        let found = solution.joint_wrenches[joint].unwrap();
        assert_close(&found, &expected.into(), 1e-12);
    }
    // The chain of C, W, E, U and F can carry nothing.
    for wrench in &solution.joint_wrenches[..5] {
        assert!(wrench.unwrap().amax() < 1e-10);
    }
    assert!(solution.last_change < 1e-12);
}
