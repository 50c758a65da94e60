//! Property tests: N is right and bounded in every orientation, axis-parallel and nearly
//! axis-parallel ones above all.

use hyperstat_joints::testing::{assert_conforms_in, frames};
use hyperstat_joints::{
    Cylindrical, Fixed, Joint, Planar, Prismatic, Revolute, Screw, Spherical, Universal,
    frame_from_axes, frame_from_axis,
};
use nalgebra::{Rotation3, Unit, UnitQuaternion, Vector3, Vector4, Vector6};
use proptest::prelude::*;

fn joints(pitch: f64) -> [Box<dyn Joint>; 8] {
    [
        Box::new(Fixed),
        Box::new(Revolute),
        Box::new(Prismatic),
        Box::new(Cylindrical),
        Box::new(Screw::new(pitch).unwrap()),
        Box::new(Universal),
        Box::new(Spherical),
        Box::new(Planar),
    ]
}

fn direction() -> impl Strategy<Value = Unit<Vector3<f64>>> {
    prop::array::uniform3(-1.0..1.0)
        .prop_map(Vector3::from)
        .prop_filter_map("too short", |v| Unit::try_new(v, 0.1))
}

fn any_frame() -> impl Strategy<Value = Rotation3<f64>> {
    prop::array::uniform4(-1.0..1.0)
        .prop_map(Vector4::from)
        .prop_filter("too short", |v| v.norm() > 0.1)
        .prop_map(|v| UnitQuaternion::from_quaternion(v.into()).to_rotation_matrix())
}

/// One of the special frames (axis-parallel, tied), turned by 1e-3 … 1e-16 rad about any axis.
fn nearly_special_frame() -> impl Strategy<Value = Rotation3<f64>> {
    (prop::sample::select(frames()), direction(), 3.0..16.0).prop_map(
        |(frame, about, exponent): (_, _, f64)| {
            Rotation3::from_axis_angle(&about, 10.0_f64.powf(-exponent)) * frame
        },
    )
}

fn pitch() -> impl Strategy<Value = f64> {
    (-6.0..1.0, any::<bool>()).prop_map(|(exponent, left): (f64, bool)| {
        let size = 10.0_f64.powf(exponent);
        if left { -size } else { size }
    })
}

/// A global axis, or a direction off it by 1e-3 … 1e-16.
fn nearly_global_axis() -> impl Strategy<Value = Vector3<f64>> {
    (0..3_usize, direction(), 3.0..16.0, any::<bool>()).prop_map(
        |(k, off, exponent, exact): (_, _, f64, _)| {
            let off = if exact { 0.0 } else { 10.0_f64.powf(-exponent) } * *off;
            Vector3::ith(k, 1.0) + off
        },
    )
}

proptest! {
    #[test]
    fn every_joint_in_any_frame(frame in any_frame(), pitch in pitch()) {
        for joint in joints(pitch) {
            assert_conforms_in(joint.as_ref(), &[frame]);
        }
    }

    #[test]
    fn every_joint_in_nearly_special_frames(frame in nearly_special_frame(), pitch in pitch()) {
        for joint in joints(pitch) {
            assert_conforms_in(joint.as_ref(), &[frame]);
        }
    }

    /// The relative motion is the frame's axis to the last digits, however near it is to a
    /// global axis: nothing is rounded to the axis, nothing is lost near it.
    #[test]
    fn the_axis_of_a_revolute_joint_is_kept(axis in nearly_global_axis()) {
        let frame = frame_from_axis(Some(&axis), None).unwrap();
        let mapping = Revolute.mapping(&frame, Revolute.free()).unwrap();
        let column = mapping.column(0);
        let turned = Vector3::new(column[3], column[4], column[5]);
        let exact = axis / axis[axis.iamax()];
        for k in 0..3 {
            // Relative, component by component.
            prop_assert!((turned[k] - exact[k]).abs() <= 4.0 * f64::EPSILON * exact[k].abs());
        }
    }

    /// The rotation of body i about the normal of a universal joint's axes is body j's.
    #[test]
    fn the_axes_of_a_universal_joint_are_kept(
        a in nearly_global_axis(),
        b in nearly_global_axis(),
    ) {
        let Ok(frame) = frame_from_axes(&a, &b) else {
            return Ok(());
        };
        let mapping = Universal.mapping(&frame, Universal.free()).unwrap();
        let z = frame * Vector3::z();
        for column in mapping.n_i() {
            prop_assert!(z.dot(&column.fixed_rows::<3>(3)).abs() < 1e-15);
        }
    }

    /// Both ways of choosing the bodies' order state the same joint.
    #[test]
    fn exchanging_the_bodies_changes_nothing(
        frame in any_frame(),
        pitch in pitch(),
        u_j in prop::array::uniform6(-1.0..1.0),
        q in prop::array::uniform6(-1.0..1.0),
    ) {
        for joint in joints(pitch) {
            let mapping = joint.mapping(&frame, joint.free()).unwrap();
            let u_j = Vector6::from(u_j);
            let mut u_i = mapping.n_j() * u_j;
            for (column, q) in mapping.n_i().iter().zip(q) {
                u_i += column * q;
            }
            // Now u_j from its own IDCs and u_i.
            let mut back = mapping.n_j() * u_i;
            for (column, idc) in mapping.n_i().iter().zip(mapping.idcs().iter()) {
                back += column * u_j[idc.index()];
            }
            prop_assert!((back - u_j).amax() < 1e-13 * (1.0 + pitch.abs()));
        }
    }
}
