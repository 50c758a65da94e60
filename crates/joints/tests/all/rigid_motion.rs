//! Eq. 37 and its dual.

use hyperstat_joints::{rigid_motion, wrench_transport};
use nalgebra::{Matrix6, Rotation3, Vector3, Vector6};

const R: Vector3<f64> = Vector3::new(0.3, -0.2, 0.7);

#[test]
fn small_rotation_of_a_rigid_body() {
    let phi = Vector3::new(2e-9, -3e-9, 1e-9);
    let delta = Vector3::new(1e-9, 0.0, 4e-9);
    let turned = Rotation3::new(phi) * R;
    let u = Vector6::new(delta.x, delta.y, delta.z, phi.x, phi.y, phi.z);
    let moved = rigid_motion(&R) * u;
    // The exact motion of the point differs in second order, about 1e-17.
    assert!((moved.fixed_rows::<3>(0) - (delta + turned - R)).amax() < 1e-15);
    assert_eq!(moved.fixed_rows::<3>(3), phi);
}

#[test]
fn a_force_has_a_moment_about_another_point() {
    // A force along z at p, about the point 1 m along x from there: M = −x × z = y.
    let w = wrench_transport(&Vector3::x()) * Vector6::new(0.0, 0.0, 1.0, 0.0, 0.0, 0.0);
    assert_eq!(w, Vector6::new(0.0, 0.0, 1.0, 0.0, 1.0, 0.0));
}

#[test]
fn there_and_back_is_nothing() {
    let identity = Matrix6::identity();
    assert!((rigid_motion(&R) * rigid_motion(&-R) - identity).amax() < 1e-16);
    assert!((wrench_transport(&R) * wrench_transport(&-R) - identity).amax() < 1e-16);
}

#[test]
fn work_does_not_depend_on_the_point() {
    let u = Vector6::new(0.1, -0.4, 0.3, 0.7, 0.2, -0.5);
    let w = Vector6::new(3.0, 1.0, -2.0, 0.5, -1.5, 4.0);
    let elsewhere = (wrench_transport(&R) * w).dot(&(rigid_motion(&R) * u));
    assert!((elsewhere - w.dot(&u)).abs() < 1e-15);
}
