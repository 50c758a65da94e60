//! Parameters that are refused.

use hyperstat_mechanisms::prebuilt::Hexapod;
use hyperstat_tests::prebuilt::assert_refused;
use hyperstat_tests::prebuilt::legs::{
    EDGE, cubic, hexapod, leg, linear_delta, three_prs, three_rps, tricept,
};

#[test]
fn of_the_hexapod_and_of_telescopic_legs() {
    assert_refused(
        &hexapod(),
        Hexapod::check,
        &[0.0, 0.0, 0.8, 0.0, 0.0, 0.0],
        &[
            ("base_radius", |m| m.base_radius = 0.0),
            ("base_angle", |m| m.base_angle = -0.1),
            ("base_angle", |m| m.base_angle = f64::NAN),
            ("platform_radius", |m| m.platform_radius = f64::INFINITY),
            ("platform_angle", |m| m.platform_angle = 1.05),
            ("cylinder_length", |m| m.leg.cylinder_length = 0.0),
            ("lengths", |m| m.leg.lengths.0 = 0.36),
            ("lengths", |m| m.leg.lengths.0 = f64::NAN),
            ("lengths", |m| m.leg.lengths.1 = 0.4),
            ("lengths", |m| m.leg.lengths.1 = f64::INFINITY),
            ("joint_stiffness", |m| m.joint_stiffness[0] = Some(-1.0)),
            ("joint_stiffness", |m| m.joint_stiffness[4] = Some(1.0)),
            ("drive_stiffness", |m| m.drive_stiffness = Some(f64::NAN)),
            ("elements", |m| m.elements = 0),
        ],
    );
    for edge in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = Hexapod::cubic(edge, leg()).expect_err("an edge");
        assert_eq!(error.field, "edge");
    }
    assert_eq!(cubic().base_radius, EDGE * (2.0_f64 / 3.0).sqrt());
}

#[test]
fn of_the_linear_delta_and_of_rails() {
    let right = std::f64::consts::FRAC_PI_2;
    let mut level = linear_delta();
    for tilt in [right, -right] {
        level.rails.tilt = tilt;
        assert_eq!(level.check(), Ok(()));
    }
    assert_refused(
        &linear_delta(),
        |m| m.check(),
        &[0.0, 0.0, 0.7],
        &[
            ("radius", |m| m.rails.radius = -0.1),
            ("tilt", |m| m.rails.tilt = 1.58),
            ("tilt", |m| m.rails.tilt = f64::NAN),
            ("travel", |m| m.rails.travel = 0.0),
            ("platform_radius", |m| m.platform_radius = -0.1),
            ("rod_length", |m| m.rod_length = 0.0),
            ("rod_spacing", |m| m.rod_spacing = 0.0),
            ("joint_stiffness", |m| m.joint_stiffness[4] = Some(1.0)),
            ("drive_stiffness", |m| m.drive_stiffness = Some(-1.0)),
            ("elements", |m| m.elements = 1_000_001),
        ],
    );
}

#[test]
fn of_the_tricept() {
    assert_refused(
        &tricept(),
        |m| m.check(),
        &[0.0, 0.0, 0.9],
        &[
            ("base_radius", |m| m.base_radius = 0.0),
            ("platform_radius", |m| m.platform_radius = 0.0),
            ("lengths", |m| m.leg.lengths.0 = 0.1),
            ("tube_length", |m| m.tube_length = 0.0),
            ("joint_stiffness", |m| m.joint_stiffness[4] = Some(1.0)),
            ("drive_stiffness", |m| m.drive_stiffness = Some(-1.0)),
            ("elements", |m| m.elements = 0),
        ],
    );
}

#[test]
fn of_the_three_rps_and_the_three_prs() {
    assert_refused(
        &three_rps(),
        |m| m.check(),
        &[0.7, 0.0, 0.0],
        &[
            ("base_radius", |m| m.base_radius = -0.1),
            ("platform_radius", |m| m.platform_radius = 0.0),
            ("lengths", |m| m.leg.lengths.0 = 0.1),
            ("joint_stiffness", |m| m.joint_stiffness[4] = Some(1.0)),
            ("drive_stiffness", |m| m.drive_stiffness = Some(-1.0)),
            ("elements", |m| m.elements = 0),
        ],
    );
    assert_refused(
        &three_prs(),
        |m| m.check(),
        &[0.9, 0.0, 0.0],
        &[
            ("travel", |m| m.rails.travel = -0.1),
            ("platform_radius", |m| m.platform_radius = 0.0),
            ("rod_length", |m| m.rod_length = f64::NAN),
            ("joint_stiffness", |m| m.joint_stiffness[4] = Some(1.0)),
            ("drive_stiffness", |m| m.drive_stiffness = Some(-1.0)),
            ("elements", |m| m.elements = 0),
        ],
    );
}
