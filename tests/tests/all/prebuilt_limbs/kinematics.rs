//! Bodies keep their shape from pose to pose, and `place` gives what `model` gives.

use hyperstat_mechanisms::prebuilt::Prebuilt;
use hyperstat_tests::prebuilt::links::{agile_eye, cases, exechon};
use hyperstat_tests::prebuilt::{check_loops_close, check_place_is_model, posed};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn place_is_model((index, pose) in posed(cases)) {
        check_place_is_model(&cases()[index], &pose)?;
    }

    #[test]
    fn loops_close((index, pose) in posed(cases)) {
        check_loops_close(&cases()[index], &pose)?;
    }
}

#[test]
fn the_agile_eye_is_orthogonal() {
    let model = agile_eye().model(&[0.0; 3]).expect("in reach");
    for at in ["A", "C"] {
        let axis = |limb: usize| {
            let name = format!("{at}{limb}");
            let joint = model.joints().iter().position(|j| j.name == name);
            let frame = model.geometry().frames[joint.expect("the joint")];
            frame.matrix().column(1).into_owned()
        };
        for (r, c) in [(1, 2), (2, 3), (3, 1)] {
            assert!(axis(r).dot(&axis(c)).abs() < 1e-15);
        }
    }
}

/// The platform of the Exechon is not turned where it stands over the middle of the base, and is
/// tilted everywhere else.
#[test]
fn the_exechon_tilts_as_its_legs_ask() {
    let exechon = exechon();
    let mut geometry = exechon
        .model(&[0.0, 0.0, 0.9])
        .expect("in reach")
        .geometry()
        .clone();
    let mut turn = |pose: [f64; 3]| {
        let whole = exechon.place(&pose, &mut geometry).expect("in reach");
        [whole[3], whole[4], whole[5]]
    };
    assert_eq!(turn([0.0, 0.0, 0.9]), [0.0; 3]);
    assert_eq!(turn([0.0, 0.0, -0.9]), [0.0; 3]);
    let [rx, ry, rz] = turn([0.0, -0.9, 0.9]);
    assert!((rx - std::f64::consts::FRAC_PI_4).abs() < 1e-15 && ry == 0.0 && rz == 0.0);
    let [rx, ry, rz] = turn([0.3, 0.0, 0.9]);
    assert!((ry - (1.0 / 3.0_f64).atan()).abs() < 1e-15 && rx == 0.0 && rz == 0.0);
}
