//! Parameters out of their physical range.

use hyperstat_mechanisms::prebuilt::{
    Exechon, Orthoglide, PlanarThreeRrr, SphericalThreeRrr, Tripteron,
};
use hyperstat_tests::prebuilt::assert_refused;
use hyperstat_tests::prebuilt::links::{exechon, orthoglide, planar, spherical, tripteron};

/// A pose, whether in reach or not: parameters are looked at first.
const POSE: [f64; 3] = [0.0, 0.0, 0.5];

/// A field and what puts it out of its range.
type Spoilt<M> = (&'static str, fn(&mut M));

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
    assert_refused(&planar(), PlanarThreeRrr::check, &POSE, cases);
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
    assert_refused(&spherical(), SphericalThreeRrr::check, &POSE, cases);
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
    assert_refused(&tripteron(), Tripteron::check, &POSE, cases);
}

#[test]
fn orthoglide_parameters() {
    let cases: &[Spoilt<Orthoglide>] = common![
        ("platform_radius", |m| m.platform_radius = -0.1),
        ("rod_length", |m| m.rod_length = f64::NAN),
        ("rod_spacing", |m| m.rod_spacing = 0.0),
    ];
    assert_refused(&orthoglide(), Orthoglide::check, &POSE, cases);
}

#[test]
fn exechon_parameters() {
    let cases: &[Spoilt<Exechon>] = common![
        ("base_width", |m| m.base_width = 0.0),
        ("base_depth", |m| m.base_depth = -0.5),
        ("platform_width", |m| m.platform_width = f64::NAN),
        ("platform_depth", |m| m.platform_depth = f64::INFINITY),
    ];
    assert_refused(&exechon(), Exechon::check, &POSE, cases);
}
