//! Joint frames: how they lie and what is refused.

use hyperstat_joints::{JointError, frame_from_axes, frame_from_axis};
use nalgebra::{Matrix3, Rotation3, Vector3};

fn assert_rotation(frame: &Rotation3<f64>) {
    let m = frame.matrix();
    assert!(
        (m.transpose() * m - Matrix3::identity()).amax() < 1e-15,
        "{m}"
    );
    assert!((m.determinant() - 1.0).abs() < 1e-15, "{m}");
}

#[test]
fn without_an_axis_the_frame_is_global() {
    let frame = frame_from_axis(None, None).unwrap();
    assert_eq!(frame, Rotation3::identity());
}

/// x is the first of the global axes that are least aligned with y.
#[test]
fn default_x_axis() {
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    for (axis, expected) in [
        (y, x),
        (x, y),
        (z, x),
        (-y, x),
        (Vector3::new(1.0, 2.0, 0.0), z),
        (Vector3::new(0.0, 1.0, 1.0), x),
        (Vector3::new(1.0, 0.0, 1.0), y),
        (Vector3::new(1e-10, 0.0, 1.0), x),
        (Vector3::new(1e-8, 0.0, 1.0), y),
    ] {
        let frame = frame_from_axis(Some(&axis), None).unwrap();
        assert_rotation(&frame);
        assert!((frame * y - axis.normalize()).amax() < 1e-15, "{axis}");
        assert!((frame * x - expected).amax() < 2e-10, "{axis}");
    }
    let diagonal = frame_from_axis(Some(&Vector3::new(1.0, 1.0, 1.0)), None).unwrap();
    assert!((diagonal * x - Vector3::new(2.0, -1.0, -1.0).normalize()).amax() < 1e-15);
}

#[test]
fn given_x_axis_is_made_normal_to_the_axis() {
    let axis = Vector3::new(0.0, 0.0, -3.0);
    let frame = frame_from_axis(Some(&axis), Some(&Vector3::new(0.0, 2.0, 9.0))).unwrap();
    assert_rotation(&frame);
    assert_eq!(frame * Vector3::x(), Vector3::y());
    assert_eq!(frame * Vector3::y(), -Vector3::z());
    assert_eq!(frame * Vector3::z(), -Vector3::x());
}

#[test]
fn nearly_parallel_x_axis_still_gives_a_rotation() {
    let axis = Vector3::new(0.3, -0.7, 0.2);
    for off in [1e-3, 1e-5] {
        let x_axis = axis + Vector3::new(off, off, -off);
        assert_rotation(&frame_from_axis(Some(&axis), Some(&x_axis)).unwrap());
    }
}

#[test]
fn length_of_an_axis_does_not_matter() {
    let axis = Vector3::new(1.0, 2.0, -2.0);
    let frame = frame_from_axis(Some(&axis), None).unwrap();
    for length in [1e-320, 1e-200, 1e-3, 1e200, 8e307] {
        let scaled = frame_from_axis(Some(&(axis * length)), None).unwrap();
        let tolerance = if length < 1e-300 { 1e-3 } else { 1e-15 };
        assert!(
            (scaled.matrix() - frame.matrix()).amax() < tolerance,
            "{length}"
        );
    }
}

#[test]
fn universal_frame_has_x_along_the_first_axis() {
    let a = Vector3::new(0.0, 2.0, 0.0);
    let frame = frame_from_axes(&a, &Vector3::new(0.0, 1.0, 1.0)).unwrap();
    assert_rotation(&frame);
    assert_eq!(frame * Vector3::x(), Vector3::y());
    assert_eq!(frame * Vector3::y(), Vector3::z());
    assert_eq!(frame * Vector3::z(), Vector3::x());
}

#[test]
fn mistakes_are_named() {
    let (x, y, zero) = (Vector3::x(), Vector3::y(), Vector3::zeros());
    let nan = Vector3::new(0.0, f64::NAN, 1.0);
    let infinite = Vector3::new(0.0, f64::INFINITY, 1.0);
    let along = y * -2.0 + x * 1e-9;

    let axis = |axis, x_axis: Option<&Vector3<f64>>| frame_from_axis(axis, x_axis).unwrap_err();
    assert_eq!(axis(None, Some(&x)), JointError::XAxisWithoutAxis);
    assert_eq!(
        axis(Some(&zero), None),
        JointError::ZeroAxis { what: "axis" }
    );
    assert_eq!(
        axis(Some(&y), Some(&zero)),
        JointError::ZeroAxis { what: "x_axis" }
    );
    for bad in [&nan, &infinite] {
        assert!(matches!(
            axis(Some(bad), None),
            JointError::NotFinite { what: "axis" }
        ));
        assert!(matches!(
            axis(Some(&y), Some(bad)),
            JointError::NotFinite { what: "x_axis" }
        ));
    }
    let error = axis(Some(&y), Some(&along));
    assert_eq!(
        error,
        JointError::XAxisAlongAxis {
            x_axis: along,
            axis: y
        }
    );
    assert!(
        error.to_string().contains("(0.000000001, -2, 0)"),
        "{error}"
    );

    let axes = |a, b| frame_from_axes(a, b).unwrap_err();
    assert_eq!(
        axes(&y, &along),
        JointError::ParallelAxes { a: y, b: along }
    );
    assert!(matches!(axes(&zero, &y), JointError::ZeroAxis { .. }));
    assert!(matches!(axes(&y, &nan), JointError::NotFinite { .. }));
}
