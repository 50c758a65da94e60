//! Parameters out of their physical range.

use hyperstat_mechanisms::PoseError;
use hyperstat_mechanisms::prebuilt::{
    Exechon, Orthoglide, ParameterError, PlanarThreeRrr, Prebuilt, SphericalThreeRrr, Tripteron,
};

use crate::mechanisms::{exechon, orthoglide, planar, spherical, tripteron};

/// A field and what puts it out of its range.
type Spoilt<M> = (&'static str, fn(&mut M));

/// Each of `cases` is refused by `check` with the field's name, and by `model` with the same.
fn assert_refused<M: Prebuilt + Clone>(
    good: &M,
    check: fn(&M) -> Result<(), ParameterError>,
    cases: &[Spoilt<M>],
) {
    assert_eq!(check(good), Ok(()));
    for (field, spoil) in cases {
        let mut mechanism = good.clone();
        spoil(&mut mechanism);
        let error = check(&mechanism).expect_err(field);
        assert_eq!(error.field, *field);
        let refused = mechanism.model(&[0.0, 0.0, 0.5]).map(drop);
        assert_eq!(refused, Err(PoseError::Parameter(error)));
    }
}

/// Cases that all five mechanisms share.
macro_rules! common {
    ($($case:expr),* $(,)?) => {
        &[
            $($case,)*
            ("joint_stiffness", |m| m.joint_stiffness[0] = Some(-1.0)),
            ("joint_stiffness", |m| m.joint_stiffness[4] = Some(1.0)),
            ("joint_stiffness", |m| m.joint_stiffness[5] = Some(f64::NAN)),
            ("drive_stiffness", |m| m.drive_stiffness = Some(f64::INFINITY)),
            ("elements", |m| m.elements = 0),
        ]
    };
}

#[test]
fn planar_three_rrr() {
    let cases: &[Spoilt<PlanarThreeRrr>] = common![
        ("base_radius", |m| m.base_radius = -0.1),
        ("platform_radius", |m| m.platform_radius = f64::NAN),
        ("proximal_length", |m| m.proximal_length = 0.0),
        ("distal_length", |m| m.distal_length = f64::INFINITY),
    ];
    assert_refused(&planar(), PlanarThreeRrr::check, cases);
}

#[test]
fn spherical_three_rrr() {
    let cases: &[Spoilt<SphericalThreeRrr>] = common![
        ("radius", |m| m.radius = 0.0),
        ("base_angle", |m| m.base_angle = 0.0),
        ("platform_angle", |m| m.platform_angle = f64::NAN),
        ("proximal_angle", |m| m.proximal_angle = 90.0),
        ("distal_angle", |m| m.distal_angle = std::f64::consts::PI),
    ];
    assert_refused(&spherical(), SphericalThreeRrr::check, cases);
}

#[test]
fn tripteron_parameters() {
    let cases: &[Spoilt<Tripteron>] = common![
        ("rail", |m| m.rail.0 = f64::NAN),
        ("rail", |m| m.rail.1 = f64::NEG_INFINITY),
        ("platform_radius", |m| m.platform_radius = -0.1),
        ("proximal_length", |m| m.proximal_length = -0.3),
        ("distal_length", |m| m.distal_length = 0.0),
    ];
    assert_refused(&tripteron(), Tripteron::check, cases);
}

#[test]
fn orthoglide_parameters() {
    let cases: &[Spoilt<Orthoglide>] = common![
        ("platform_radius", |m| m.platform_radius = -0.1),
        ("rod_length", |m| m.rod_length = f64::NAN),
        ("rod_spacing", |m| m.rod_spacing = 0.0),
    ];
    assert_refused(&orthoglide(), Orthoglide::check, cases);
}

#[test]
fn exechon_parameters() {
    let cases: &[Spoilt<Exechon>] = common![
        ("base_width", |m| m.base_width = 0.0),
        ("base_depth", |m| m.base_depth = -0.5),
        ("platform_width", |m| m.platform_width = f64::NAN),
        ("platform_depth", |m| m.platform_depth = f64::INFINITY),
    ];
    assert_refused(&exechon(), Exechon::check, cases);
}
