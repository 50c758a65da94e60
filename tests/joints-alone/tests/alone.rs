//! hyperstat-joints used alone, as a user's own program would.

use hyperstat_joints::testing::assert_conforms;
use hyperstat_joints::{Fixed, Joint, Spherical, frame_from_axis};
use joints_alone::{BallOnSlide, Leg, platform_stiffness};
use nalgebra::{Matrix6, Rotation3, Vector3, Vector6};

#[test]
fn a_joint_of_our_own_conforms() {
    assert_conforms(&BallOnSlide);
}

#[test]
fn a_boxed_joint_can_be_cloned() {
    let joint: Box<dyn Joint> = Box::new(BallOnSlide);
    assert_eq!(joint.clone().kind(), "BallOnSlide");
}

fn leg(joint: impl Joint + 'static, frame: Rotation3<f64>) -> Leg {
    Leg {
        at: Vector3::zeros(),
        stiffness: Matrix6::from_diagonal(&Vector6::new(3e6, 4e6, 5e6, 600.0, 700.0, 800.0)),
        joint: Box::new(joint),
        frame,
    }
}

/// A weld carries everything, a ball joint forces only, a ball on a slide no force along it.
#[test]
fn a_leg_carries_what_its_joint_lets_through() {
    let global = Rotation3::identity();
    let along_z = frame_from_axis(Some(&Vector3::z()), None).unwrap();
    for (leg, carried) in [
        (leg(Fixed, global), [3e6, 4e6, 5e6, 600.0, 700.0, 800.0]),
        (leg(Spherical, global), [3e6, 4e6, 5e6, 0.0, 0.0, 0.0]),
        (leg(BallOnSlide, along_z), [3e6, 4e6, 0.0, 0.0, 0.0, 0.0]),
    ] {
        let expected = Matrix6::from_diagonal(&Vector6::from(carried));
        let stiffness = platform_stiffness(&[leg]).unwrap();
        assert!((stiffness - expected).amax() < 1e-8, "{stiffness}");
    }
}

/// A slide that is tilted carries the force normal to it: for a leg with stiffness k along
/// every axis, k (E − y yᵀ).
#[test]
fn a_tilted_slide_carries_the_force_normal_to_it() {
    let y = Vector3::new(0.3, -0.5, 0.8).normalize();
    let mut leg = leg(BallOnSlide, frame_from_axis(Some(&y), None).unwrap());
    leg.stiffness = Matrix6::identity();
    let stiffness = platform_stiffness(&[leg]).unwrap();
    for column in 0..3 {
        let push = Vector3::ith(column, 1.0);
        let force = push - y * y.dot(&push);
        assert!((stiffness.fixed_view::<3, 1>(0, column) - force).amax() < 1e-15);
    }
}
