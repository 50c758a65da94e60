//! Every built-in joint runs through the public conformance test.

use hyperstat_joints::testing::{assert_conforms, frames};
use hyperstat_joints::{
    Cylindrical, Fixed, Planar, Prismatic, Revolute, Screw, Spherical, Universal,
};
use nalgebra::Matrix3;

#[test]
fn fixed() {
    assert_conforms(&Fixed);
}

#[test]
fn revolute() {
    assert_conforms(&Revolute);
}

#[test]
fn prismatic() {
    assert_conforms(&Prismatic);
}

#[test]
fn cylindrical() {
    assert_conforms(&Cylindrical);
}

#[test]
fn screw() {
    for pitch in [0.0, 1e-6, 0.0008, -0.005, 2.0] {
        assert_conforms(&Screw::new(pitch).unwrap());
    }
}

#[test]
fn universal() {
    assert_conforms(&Universal);
}

#[test]
fn spherical() {
    assert_conforms(&Spherical);
}

#[test]
fn planar() {
    assert_conforms(&Planar);
}

/// The frames are rotations; the 24 axis-parallel ones are among them, and ones off these by
/// every power of ten from 1e-3 to 1e-16.
#[test]
fn frames_cover_what_they_promise() {
    let frames = frames();
    let mut parallel: Vec<Matrix3<f64>> = Vec::new();
    let mut off_axis = [false; 17];
    for frame in &frames {
        let m = frame.matrix();
        assert!(
            (m.transpose() * m - Matrix3::identity()).amax() < 1e-14,
            "{m}"
        );
        assert!(m.determinant() > 0.0, "{m}");
        let off = (m.abs() - m.abs().map(f64::round)).amax();
        if off == 0.0 && m.iter().all(|v| *v == 0.0 || v.abs() == 1.0) && !parallel.contains(m) {
            parallel.push(*m);
        }
        let exponent = -off.log10().round();
        if (3.0..=16.0).contains(&exponent) {
            off_axis[exponent as usize] = true;
        }
    }
    assert_eq!(parallel.len(), 24);
    assert!(off_axis[3..].iter().all(|&found| found), "{off_axis:?}");
}
