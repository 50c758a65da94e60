//! A joint defined outside the crate: a universal joint whose two axes are skew.
//!
//! Heavy Cardan joints have an offset between their axes. The first axis runs through the
//! joint's point along x; the second, along y, passes at `offset` from it along z.
//!
//! `cargo run -p hyperstat-joints --example offset_universal`

use hyperstat_joints::testing::assert_conforms;
use hyperstat_joints::{Dof, DofSet, Joint, JointError, frame_from_axes, rigid_motion};
use nalgebra::{Matrix6, Vector3, Vector6};

/// Two rotations about axes that are normal to each other and do not meet.
#[derive(Debug, Clone)]
struct OffsetUniversal {
    /// Distance of the second axis from the joint's point, along z of the joint's frame \[m\].
    offset: f64,
}

impl Joint for OffsetUniversal {
    fn kind(&self) -> &str {
        "OffsetUniversal"
    }

    fn free(&self) -> DofSet {
        DofSet::new(&[Dof::U, Dof::V])
    }

    fn basis(&self) -> Matrix6<f64> {
        // A rotation about the second axis, carried from that axis to the joint's point.
        let to_point = Vector3::new(0.0, 0.0, -self.offset);
        let second = rigid_motion(&to_point) * Vector6::ith(Dof::V.index(), 1.0);
        let mut basis = Matrix6::identity();
        basis.set_column(Dof::V.index(), &second);
        basis
    }

    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(self.clone())
    }
}

fn main() -> Result<(), JointError> {
    let joint = OffsetUniversal { offset: 0.04 };

    // Every rule that a joint has to keep, in some thousands of frames.
    assert_conforms(&joint);
    println!("{joint:?} conforms");

    let frame = frame_from_axes(&Vector3::new(0.2, 0.1, 1.0), &Vector3::y())?;
    let mapping = joint.mapping(&frame, joint.free())?;
    println!("IDCs of body i: {}", mapping.idcs());
    println!("N, body to body:{:.4}", mapping.matrix());

    // With the first axis held it is a hinge about the second.
    let hinge = joint.mapping(&frame, DofSet::new(&[Dof::V]))?;
    println!(
        "N with the first axis locked, body to ground:{:.4}",
        hinge.ground_matrix()
    );
    Ok(())
}
