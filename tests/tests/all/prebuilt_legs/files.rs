//! Files: batches that name the mechanisms, and examples that write them out.

use hyperstat_mechanisms::prebuilt::{
    CarriageSide, FootJoint, Hexapod, LinearDelta, Prebuilt, Rails, TelescopicLeg, ThreePrs,
    ThreeRps, Tricept,
};
use hyperstat_tests::prebuilt::legs::{
    cubic, hexapod, leg, linear_delta, three_prs, three_rps, tricept,
};
use hyperstat_tests::prebuilt::{
    BEARINGS, assert_batch_reads, assert_book_is_read, assert_example_is_prebuilt, flat, round,
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
        assert_batch_reads(&text, pose_text, &*mechanism, pose);
    }
}

#[test]
fn the_written_out_examples_are_the_prebuilt_mechanisms() {
    for name in [
        "hexapod",
        "cubic-hexapod",
        "linear-delta",
        "tricept",
        "three-rps",
        "three-prs",
    ] {
        assert_example_is_prebuilt(name);
    }
}

#[test]
fn the_book_s_mechanisms_are_read() {
    for kind in [
        "Hexapod",
        "CubicHexapod",
        "LinearDelta",
        "Tricept",
        "ThreeRps",
        "ThreePrs",
    ] {
        assert_book_is_read(kind, "(0.0, 0.0, 0.7)");
    }
}
