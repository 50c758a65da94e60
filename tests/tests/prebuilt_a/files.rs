//! Files: batches that name the mechanisms, and examples that write them out.

use std::path::Path;

use hyperstat_assembly::solve;
use hyperstat_mechanisms::prebuilt::{
    CarriageSide, FootJoint, Hexapod, LinearDelta, Prebuilt, Rails, TelescopicLeg, ThreePrs,
    ThreeRps, Tricept,
};
use hyperstat_mechanisms::{Registry, batch_from_str, load_batch, load_mechanism};
use hyperstat_tests::{stiffness, stiffness_difference};

use crate::mechanisms::{
    BEARINGS, cubic, flat, hexapod, leg, linear_delta, round, three_prs, three_rps, tricept,
};

const LEG: &str =
    "leg: (cylinder: FLAT, piston: ROUND, cylinder_length: 0.36, lengths: (0.5, 1.3))";
const STIFFNESS: &str = "joint_stiffness: (x: 1e8, y: 2e8, z: 3e8, u: 1e5, w: 2e5), \
                         drive_stiffness: 4e7, elements: 3";

/// Every field of a batch file ends where it belongs.
#[test]
fn batch_files_are_read_as_their_mechanisms() {
    let (joint_stiffness, drive_stiffness, elements) = (BEARINGS, Some(4e7), 3);
    let leg = TelescopicLeg {
        piston: round(0.02),
        ..leg()
    };
    let rails = Rails {
        radius: 0.5,
        tilt: 0.5,
        travel: 1.2,
        carriage: CarriageSide::Far,
    };
    let rails_text = "rails: (radius: 0.5, tilt: 0.5, travel: 1.2, carriage: Far)";
    type Row<'a> = (Box<dyn Prebuilt>, String, &'a [f64], &'a str);
    let cases: [Row<'_>; 6] = [
        (
            Box::new(Hexapod {
                base_joints: FootJoint::Spherical,
                leg: leg.clone(),
                joint_stiffness,
                drive_stiffness,
                elements,
                ..hexapod()
            }),
            format!(
                "Hexapod(base_radius: 0.5, base_angle: 0.125, platform_radius: 0.3, \
                 platform_angle: 0.45, base_joints: Spherical, {LEG}, {STIFFNESS})"
            ),
            &[0.01, 0.02, 0.8, 0.1, 0.2, 0.3],
            "(0.01, 0.02, 0.8, 0.1, 0.2, 0.3)",
        ),
        (
            Box::new(Hexapod {
                leg: leg.clone(),
                joint_stiffness,
                drive_stiffness,
                elements,
                ..cubic()
            }),
            format!("CubicHexapod(edge: 0.6, {LEG}, {STIFFNESS})"),
            &[0.01, 0.02, 0.4, 0.1, 0.2, 0.1],
            "(0.01, 0.02, 0.4, 0.1, 0.2, 0.1)",
        ),
        (
            Box::new(LinearDelta {
                rails: rails.clone(),
                rod_length: 0.6,
                carriage_joints: FootJoint::Spherical,
                rod: flat(0.03, 0.05),
                joint_stiffness,
                drive_stiffness,
                elements,
                ..linear_delta()
            }),
            format!(
                "LinearDelta({rails_text}, platform_radius: 0.05, rod_length: 0.6, \
                 rod_spacing: 0.08, carriage_joints: Spherical, rod: FLAT, {STIFFNESS})"
            ),
            &[0.01, 0.02, 0.1],
            "(0.01, 0.02, 0.1)",
        ),
        (
            Box::new(Tricept {
                leg: leg.clone(),
                tube: flat(0.03, 0.05),
                spline: round(0.02),
                joint_stiffness,
                drive_stiffness,
                elements,
                ..tricept()
            }),
            format!(
                "Tricept(base_radius: 0.4, platform_radius: 0.18, {LEG}, tube: FLAT, \
                 spline: ROUND, tube_length: 0.45, {STIFFNESS})"
            ),
            &[0.1, 0.2, 0.9],
            "(0.1, 0.2, 0.9)",
        ),
        (
            Box::new(ThreeRps {
                leg,
                joint_stiffness,
                drive_stiffness,
                elements,
                ..three_rps()
            }),
            format!("ThreeRps(base_radius: 0.4, platform_radius: 0.25, {LEG}, {STIFFNESS})"),
            &[0.7, 0.1, 0.2],
            "(0.0, 0.0, 0.7, 0.1, 0.2, 0.0)",
        ),
        (
            Box::new(ThreePrs {
                rails,
                rod_length: 0.6,
                joint_stiffness,
                drive_stiffness,
                elements,
                ..three_prs()
            }),
            format!(
                "ThreePrs({rails_text}, platform_radius: 0.25, rod_length: 0.6, rod: FLAT, \
                 {STIFFNESS})"
            ),
            &[0.2, 0.1, 0.05],
            "(0.0, 0.0, 0.2, 0.1, 0.05, 0.0)",
        ),
    ];
    let steel = "material: (young: 2.1e11, poisson: 0.3)";
    let flat = format!("(section: Rectangle(width: 0.03, height: 0.05), {steel})");
    let round = format!("(section: Circle(diameter: 0.02), {steel})");
    for (mechanism, text, pose, pose_text) in cases {
        let text = text.replace("FLAT", &flat).replace("ROUND", &round);
        let text =
            format!("(jobs: [(name: \"j\", mechanism: {text}, poses: List([{pose_text}]))])");
        let batch = batch_from_str(&text, Path::new("j.ron"), &Registry::builtin());
        let batch = batch.unwrap_or_else(|error| panic!("{error}"));
        let found = batch.jobs[0].model().expect("in reach");
        let expected = mechanism.model(pose).expect("in reach");
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
        "hexapod",
        "cubic-hexapod",
        "linear-delta",
        "tricept",
        "three-rps",
        "three-prs",
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
        let difference = found.output.displacement - expected.output.displacement;
        let largest = expected.output.displacement.amax();
        assert!(difference.amax() < 1e-12 * largest, "{name}: {difference}");
    }
}

/// What the book says of a mechanism is read as the mechanism of a job.
#[test]
fn the_book_s_mechanisms_are_read() {
    let page = std::fs::read_to_string("../docs/src/prebuilt.md").expect("the page");
    let blocks = page.split("```ron,fragment\n").skip(1);
    let blocks: Vec<_> = blocks.filter_map(|rest| rest.split("```").next()).collect();
    for kind in [
        "Hexapod",
        "CubicHexapod",
        "LinearDelta",
        "Tricept",
        "ThreeRps",
        "ThreePrs",
    ] {
        let block = blocks.iter().find(|block| block.starts_with(kind));
        let block = block.unwrap_or_else(|| panic!("the page has no {kind}"));
        let text =
            format!("(jobs: [(name: \"j\", mechanism: {block}, poses: List([(0.0, 0.0, 0.7)]))])");
        let batch = batch_from_str(&text, Path::new("prebuilt.md"), &Registry::builtin());
        batch.unwrap_or_else(|error| panic!("{error}"));
    }
}
