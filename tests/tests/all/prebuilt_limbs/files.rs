//! The mechanisms in batch files, and written out.

use hyperstat_mechanisms::prebuilt::{
    ElbowSide, Exechon, Orthoglide, PlanarThreeRrr, Prebuilt, SphericalThreeRrr, Tripteron,
};
use hyperstat_tests::prebuilt::links::{exechon, orthoglide, planar, spherical, tripteron};
use hyperstat_tests::prebuilt::{
    BEARINGS, assert_batch_reads, assert_book_is_read, assert_example_is_prebuilt, flat, round,
};

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
                proximal: round(0.02),
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
                proximal: round(0.02),
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
                proximal: round(0.02),
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
                bar: round(0.02),
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
                housing: round(0.02),
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
        let round_text = LINK.replace(
            "Rectangle(width: 0.03, height: 0.02)",
            "Circle(diameter: 0.02)",
        );
        let text = text
            .replace("ROUND", &round_text)
            .replace("FLAT", LINK)
            .replace("STIFFNESS", STIFFNESS);
        assert_batch_reads(&text, pose, &*mechanism, &[0.03, -0.02, 0.3]);
    }
}

#[test]
fn the_written_out_examples_are_the_prebuilt_mechanisms() {
    for name in [
        "tripteron",
        "orthoglide",
        "exechon",
        "spherical-three-rrr",
        "planar-three-rrr",
    ] {
        assert_example_is_prebuilt(name);
    }
}

#[test]
fn the_book_s_mechanisms_are_read() {
    for kind in [
        "Tripteron",
        "Orthoglide",
        "Exechon",
        "SphericalThreeRrr",
        "PlanarThreeRrr",
    ] {
        assert_book_is_read(kind, "(0.0, 0.0, 0.0)");
    }
}
