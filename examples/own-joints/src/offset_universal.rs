//! A universal joint whose two axes do not meet.

use hyperstat_joints::{Dof, DofSet, Joint, frame_from_axes, rigid_motion};
use hyperstat_mechanisms::{Arguments, LoadError, Orientation, ParsedJoint};
use nalgebra::{Matrix6, Vector3, Vector6};

/// Two free rotations about skew axes normal to each other, as in heavy Cardan joints.
///
/// The first axis runs through the joint's point along x of its frame. The second, along y,
/// crosses z at `offset` from that point.
#[derive(Debug, Clone)]
pub struct OffsetUniversal {
    /// Distance of the second axis from the joint's point, along z \[m\].
    pub offset: f64,
}

impl OffsetUniversal {
    /// The arguments of `OffsetUniversal(axes: (a, b), offset: …)` in a file.
    pub const ARGUMENTS: &'static [&'static str] = &["axes", "offset"];

    /// Reads the joint from a file.
    ///
    /// # Errors
    /// An argument that is missing or no number, axes that are parallel.
    pub fn read(arguments: &Arguments<'_>) -> Result<ParsedJoint, LoadError> {
        let [a, b] = arguments.two_directions("axes")?;
        frame_from_axes(&a, &b).map_err(|error| arguments.error("axes", error.to_string()))?;
        let offset = arguments.number("offset")?;
        Ok(ParsedJoint {
            joint: Box::new(Self { offset }),
            orientation: Orientation::Axes(a, b),
        })
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_keeps_the_rules_of_a_joint() {
        for offset in [0.0, 0.04, -1.5] {
            hyperstat_joints::testing::assert_conforms(&OffsetUniversal { offset });
        }
    }

    #[test]
    fn the_second_axis_does_not_move() {
        let joint = OffsetUniversal { offset: 0.04 };
        let motion: Vector6<f64> = joint.basis().column(Dof::V.index()).into();
        let on_axis = rigid_motion(&Vector3::new(0.0, 0.7, 0.04)) * motion;
        assert_eq!(on_axis, Vector6::ith(Dof::V.index(), 1.0));
    }
}
