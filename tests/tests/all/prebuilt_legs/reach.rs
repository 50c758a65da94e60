//! Poses that are refused.

use hyperstat_mechanisms::PoseError;
use hyperstat_mechanisms::prebuilt::Prebuilt;
use hyperstat_tests::prebuilt::legs::{hexapod, linear_delta, three_prs, three_rps, tricept};

#[test]
fn poses_out_of_reach_and_singular_ones_are_told() {
    let cases: [(&dyn Prebuilt, &[f64], &str); 9] = [
        (
            &hexapod(),
            &[0.0, 0.0, 1.4, 0.0, 0.0, 0.0],
            "out of reach: leg 1: S1 is 1.419755 m from B1, where the leg reaches 1.300000 m",
        ),
        (
            &hexapod(),
            &[0.0, 0.0, 0.3, 0.0, 0.0, 0.0],
            "out of reach: leg 1: S1 is 0.381713 m from B1, where the leg is no shorter than \
             0.500000 m",
        ),
        (
            &three_rps(),
            &[0.2, 0.0, 0.0],
            "out of reach: leg 1: S1 is 0.250000 m from B1, where the leg is no shorter than",
        ),
        (
            &linear_delta(),
            &[0.0, -0.35, 0.7],
            "out of reach: limb 1: C1 is 0.600000 m from its rail, too far for 0.450000 m",
        ),
        (
            &linear_delta(),
            &[0.0, 0.0, 0.3],
            "out of reach: limb 1: the carriage would stand at -0.074166 m on its rail, which \
             goes from 0 to 0.800000 m",
        ),
        (
            &linear_delta(),
            &[0.45, 0.25, 0.5],
            "singular pose: the rods of limb 1: in line with the first axis of the universal joint",
        ),
        (
            &tricept(),
            &[0.1, 0.1, 0.4],
            "out of reach: the middle leg: P is 0.424264 m from O, where the tube alone is \
             0.450000 m",
        ),
        (
            &tricept(),
            &[0.5, 0.0, 0.0],
            "singular pose: the middle leg: in line with the first axis of the universal joint",
        ),
        (&three_prs(), &[0.9, 1.4, 0.0], "out of reach: limb 1:"),
    ];
    for (mechanism, pose, message) in cases {
        let what = format!("{} {pose:?}", mechanism.kind());
        let error = mechanism.model(pose).map(drop).expect_err(&what);
        assert!(error.to_string().starts_with(message), "{what}: {error}");
    }
}

/// A pose that fails leaves the geometry as it was.
#[test]
fn a_pose_out_of_reach_changes_nothing() {
    let hexapod = hexapod();
    let model = hexapod
        .model(&[0.0, 0.0, 0.8, 0.0, 0.0, 0.0])
        .expect("in reach");
    let mut geometry = model.geometry().clone();
    assert!(
        hexapod
            .place(&[9.0, 0.0, 0.8, 0.0, 0.0, 0.0], &mut geometry)
            .is_err()
    );
    assert!(hexapod.place(&[0.0, 0.0, 0.8], &mut geometry).is_err());
    assert!(
        hexapod
            .place(&[0.0, 0.0, f64::NAN, 0.0, 0.0, 0.0], &mut geometry)
            .is_err()
    );
    assert_eq!(&geometry, model.geometry());
    let foreign = tricept().place(&[0.0, 0.0, 0.9], &mut geometry);
    assert!(matches!(foreign, Err(PoseError::ForeignGeometry { .. })));
}

/// Numbers whose squares overflow are refused as others are; far along x the middle leg of the
/// Tricept is in line with its first axis.
#[test]
fn enormous_poses_are_refused() {
    let mechanisms: [&dyn Prebuilt; 5] = [
        &hexapod(),
        &linear_delta(),
        &tricept(),
        &three_rps(),
        &three_prs(),
    ];
    for mechanism in mechanisms {
        let coordinates = mechanism.coordinates().len();
        for index in 0..coordinates {
            for enormous in [1e200, -1e308] {
                let mut pose = vec![0.1; coordinates];
                pose[index] = enormous;
                let result = mechanism.model(&pose).map(drop);
                match result {
                    Err(PoseError::Unreachable { .. } | PoseError::Singular { .. }) => {}
                    other => panic!("{} {pose:?}: {other:?}", mechanism.kind()),
                }
            }
        }
    }
}
