//! Poses that cannot be taken.

use hyperstat_mechanisms::PoseError;
use hyperstat_mechanisms::prebuilt::{PlanarThreeRrr, Prebuilt, SphericalThreeRrr};
use hyperstat_tests::prebuilt::links::{exechon, orthoglide, planar, spherical, tripteron};

#[test]
fn poses_out_of_reach_and_singular_ones_are_told() {
    let folded = PlanarThreeRrr {
        distal_length: 0.22,
        platform_radius: 0.30,
        ..planar()
    };
    let short = SphericalThreeRrr {
        proximal_angle: 0.3,
        distal_angle: 0.3,
        ..spherical()
    };
    let uneven = SphericalThreeRrr {
        proximal_angle: 0.1,
        distal_angle: 2.0,
        ..spherical()
    };
    let wide = SphericalThreeRrr {
        base_angle: 0.3,
        platform_angle: 0.3,
        proximal_angle: 2.0,
        distal_angle: 2.0,
        ..spherical()
    };
    let opposed = SphericalThreeRrr {
        base_angle: 0.7,
        platform_angle: 0.7,
        proximal_angle: 1.5,
        distal_angle: std::f64::consts::PI - 1.5,
        ..spherical()
    };
    let opposite = [0.0, 0.0, std::f64::consts::PI];
    let (planar, tripteron, orthoglide, exechon) = (planar(), tripteron(), orthoglide(), exechon());
    let unreachable: [(&dyn Prebuilt, [f64; 3], &str); 7] = [
        (
            &planar,
            [0.5, 0.0, 0.0],
            "limb 1: point C1 is too far from A1",
        ),
        (
            &planar,
            [0.0, 0.215, 0.0],
            "limb 1: point C1 is too close to A1",
        ),
        (
            &tripteron,
            [0.0, -0.9, 0.0],
            "limb 1: point C1 is too far from A1",
        ),
        (
            &orthoglide,
            [0.0, 0.0, 0.4],
            "limb 1: point C1 lies 0.400000 m beside the rail",
        ),
        (
            &short,
            [0.0; 3],
            "limb 1: the axis of C1 is too far from that of A1",
        ),
        (
            &uneven,
            [0.0; 3],
            "limb 1: the axis of C1 is too close to that of A1",
        ),
        (
            &wide,
            opposite,
            "limb 1: the axis of C1 is too far from that of A1",
        ),
    ];
    for (mechanism, pose, message) in unreachable {
        match mechanism.model(&pose).map(drop) {
            Err(PoseError::Unreachable { what }) => assert!(what.starts_with(message), "{what}"),
            other => panic!("{} {pose:?}: {other:?}", mechanism.kind()),
        }
    }
    let singular: [(&dyn Prebuilt, [f64; 3], &str); 5] = [
        (&folded, [0.0; 3], "limb 1: point C1 lies on the axis of A1"),
        (
            &orthoglide,
            [0.0, 0.31, 0.0],
            "limb 1: the rods lie along the axes",
        ),
        (
            &opposed,
            opposite,
            "limb 1: the axes of A1 and C1 are in one line",
        ),
        (&exechon, [0.1, 0.5, 0.0], "P lies in the plane of the base"),
        (&exechon, [0.1, 0.25, 0.25], "A3 lies abreast of P"),
    ];
    for (mechanism, pose, message) in singular {
        match mechanism.model(&pose).map(drop) {
            Err(PoseError::Singular { what }) => assert!(what.starts_with(message), "{what}"),
            other => panic!("{} {pose:?}: {other:?}", mechanism.kind()),
        }
    }
}

/// A pose that fails leaves the geometry as it was.
#[test]
fn a_pose_out_of_reach_changes_nothing() {
    let planar = planar();
    let model = planar.model(&[0.0; 3]).expect("in reach");
    let mut geometry = model.geometry().clone();
    assert!(planar.place(&[9.0, 0.0, 0.0], &mut geometry).is_err());
    assert!(planar.place(&[0.0; 2], &mut geometry).is_err());
    assert!(planar.place(&[0.0, 0.0, f64::NAN], &mut geometry).is_err());
    assert_eq!(&geometry, model.geometry());
    let foreign = tripteron().place(&[0.0; 3], &mut geometry);
    assert!(matches!(foreign, Err(PoseError::ForeignGeometry { .. })));
}
