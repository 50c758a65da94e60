//! The mechanisms in batch files, and written out.

use std::path::Path;

use hyperstat_assembly::solve;
use hyperstat_mechanisms::prebuilt::{
    ElbowSide, Exechon, Orthoglide, PlanarThreeRrr, Prebuilt, SphericalThreeRrr, Tripteron,
};
use hyperstat_mechanisms::{Registry, batch_from_str, load_batch, load_mechanism};
use hyperstat_tests::{stiffness, stiffness_difference, vector_differences};

use crate::FLOOR;
use crate::mechanisms::{BEARINGS, exechon, flat, orthoglide, planar, spherical, steel, tripteron};

const LINK: &str =
    "(section: Rectangle(width: 0.03, height: 0.02), material: (young: 2.1e11, poisson: 0.3))";
const STIFFNESS: &str =
    "joint_stiffness: (x: 1e8, y: 2e8, z: 3e8, u: 1e5, w: 2e5), drive_stiffness: 4e5";

/// A job of a batch file reads every parameter into its place.
#[test]
fn a_batch_file_says_every_parameter() {
    let drive_stiffness = Some(4e5);
    let joint_stiffness = BEARINGS;
    let elbow = ElbowSide::Right;
    let cases: [(Box<dyn Prebuilt>, &str, &str); 5] = [
        (
            Box::new(PlanarThreeRrr {
                proximal: steel(0.02),
                distal: flat(0.03, 0.02),
                elbow,
                joint_stiffness,
                drive_stiffness,
                elements: 3,
                ..planar()
            }),
            "PlanarThreeRrr(base_radius: 0.30, platform_radius: 0.08, proximal_length: 0.22,
                distal_length: 0.25, elbow: Right, proximal: ROUND, distal: FLAT, STIFFNESS,
                elements: 3)",
            "(0.03, -0.02, 0.0, 0.0, 0.0, 0.3)",
        ),
        (
            Box::new(SphericalThreeRrr {
                proximal: steel(0.02),
                distal: flat(0.03, 0.02),
                elbow,
                joint_stiffness,
                drive_stiffness,
                elements: 3,
                ..spherical()
            }),
            "SphericalThreeRrr(radius: 0.12, base_angle: 0.9, platform_angle: 1.1,
                proximal_angle: 1.4, distal_angle: 1.5, elbow: Right, proximal: ROUND,
                distal: FLAT, STIFFNESS, elements: 3)",
            "(0.0, 0.0, 0.0, 0.03, -0.02, 0.3)",
        ),
        (
            Box::new(Tripteron {
                proximal: steel(0.02),
                distal: flat(0.03, 0.02),
                elbow,
                joint_stiffness,
                drive_stiffness,
                elements: 3,
                ..tripteron()
            }),
            "Tripteron(rail: (0.5, 0.3), platform_radius: 0.06, proximal_length: 0.35,
                distal_length: 0.40, elbow: Right, proximal: ROUND, distal: FLAT, STIFFNESS,
                elements: 3)",
            "(0.03, -0.02, 0.3)",
        ),
        (
            Box::new(Orthoglide {
                bar: steel(0.02),
                rod: flat(0.03, 0.02),
                joint_stiffness,
                drive_stiffness,
                elements: 3,
                ..orthoglide()
            }),
            "Orthoglide(platform_radius: 0.05, rod_length: 0.31, rod_spacing: 0.08, bar: ROUND,
                rod: FLAT, STIFFNESS, elements: 3)",
            "(0.03, -0.02, 0.3)",
        ),
        (
            Box::new(Exechon {
                housing: steel(0.02),
                ram: flat(0.03, 0.02),
                joint_stiffness,
                drive_stiffness,
                elements: 3,
                ..exechon()
            }),
            "Exechon(base_width: 0.9, base_depth: 0.5, platform_width: 0.3, platform_depth: 0.18,
                housing: ROUND, ram: FLAT, STIFFNESS, elements: 3)",
            "(0.03, -0.02, 0.3)",
        ),
    ];
    for (mechanism, text, pose) in cases {
        let round = LINK.replace(
            "Rectangle(width: 0.03, height: 0.02)",
            "Circle(diameter: 0.02)",
        );
        let text = text
            .replace("ROUND", &round)
            .replace("FLAT", LINK)
            .replace("STIFFNESS", STIFFNESS);
        let text = format!("(jobs: [(name: \"j\", mechanism: {text}, poses: List([{pose}]))])");
        let batch = batch_from_str(&text, Path::new("j.ron"), &Registry::builtin());
        let batch = batch.unwrap_or_else(|error| panic!("{error}"));
        let found = batch.jobs[0].model().expect("in reach");
        let expected = mechanism.model(&[0.03, -0.02, 0.3]).expect("in reach");
        assert_eq!(format!("{found:?}"), format!("{expected:?}"));
    }
}

/// The examples that are written out are the prebuilt ones of `prebuilt.ron`, at pose 1.
#[test]
fn the_written_out_examples_are_the_prebuilt_mechanisms() {
    let examples = Path::new("../examples");
    let registry = Registry::builtin();
    let batch = load_batch(&examples.join("prebuilt.ron"), &registry);
    let batch = batch.unwrap_or_else(|error| panic!("{error}"));
    for name in [
        "tripteron",
        "orthoglide",
        "exechon",
        "spherical-three-rrr",
        "planar-three-rrr",
    ] {
        let job = batch.jobs.iter().find(|job| job.name == name);
        let job = job.expect("the job");
        let mut model = job.model().expect("in reach");
        let mut geometry = model.geometry().clone();
        job.place(1, &mut geometry).expect("in reach");
        model.set_geometry(geometry);
        let expected = solve(&model).expect("a solution");

        let file = examples.join(name.replace('-', "_")).with_extension("ron");
        let written = load_mechanism(&file, &registry).unwrap_or_else(|error| panic!("{error}"));
        let found = solve(&written.model).expect("a solution");
        let difference = stiffness_difference(&stiffness(&found), &stiffness(&expected));
        assert!(difference < 1e-12, "{name}: K_o {difference:e}");
        let nodes = found.displacements.iter().zip(&expected.displacements);
        let difference = vector_differences(nodes, FLOOR);
        assert!(
            difference.iter().all(|d| *d < 1e-12),
            "{name}: {difference:?}"
        );
    }
}

/// What the book says of a mechanism is read as the mechanism of a job.
#[test]
fn the_book_s_mechanisms_are_read() {
    let page = std::fs::read_to_string("../docs/src/prebuilt.md").expect("the page");
    let blocks = page.split("```ron,fragment\n").skip(1);
    let blocks: Vec<_> = blocks.filter_map(|rest| rest.split("```").next()).collect();
    for kind in [
        "Tripteron",
        "Orthoglide",
        "Exechon",
        "SphericalThreeRrr",
        "PlanarThreeRrr",
    ] {
        let block = blocks.iter().find(|block| block.starts_with(kind));
        let block = block.unwrap_or_else(|| panic!("the page has no {kind}"));
        let text =
            format!("(jobs: [(name: \"j\", mechanism: {block}, poses: List([(0.0, 0.0, 0.0)]))])");
        let batch = batch_from_str(&text, Path::new("prebuilt.md"), &Registry::builtin());
        batch.unwrap_or_else(|error| panic!("{error}"));
    }
}
