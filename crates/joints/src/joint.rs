//! What a joint is: the trait that every kind implements.

use std::fmt::Debug;

use nalgebra::{Matrix6, Rotation3};

use crate::dof::DofSet;
use crate::error::JointError;
use crate::mapping::Mapping;

/// A kind of joint between body i and body j, stated in its own frame.
///
/// It knows nothing of names, places or loads. Its frame stands at the joint's point; where
/// that is and how the frame is turned is the user's affair.
///
/// ```
/// use hyperstat_joints::{Dof, DofSet, Joint};
///
/// /// A ball in a slotted socket: it does not turn about z.
/// #[derive(Debug, Clone)]
/// struct Slotted;
///
/// impl Joint for Slotted {
///     fn kind(&self) -> &str {
///         "Slotted"
///     }
///
///     fn free(&self) -> DofSet {
///         DofSet::new(&[Dof::U, Dof::V])
///     }
///
///     fn clone_box(&self) -> Box<dyn Joint> {
///         Box::new(self.clone())
///     }
/// }
///
/// hyperstat_joints::testing::assert_conforms(&Slotted);
/// ```
pub trait Joint: Debug + Send + Sync {
    /// Name of the kind, such as `"Revolute"`.
    fn kind(&self) -> &str;

    /// The directions that are free by kind. A lock or an elasticity does not change them.
    fn free(&self) -> DofSet;

    /// What a unit of each direction is, 6×6: column d is the displacement (linear part first,
    /// m and rad) of body i relative to body j, at the joint's point and in the joint's frame,
    /// where direction d alone has moved by 1.
    ///
    /// All six columns are stated, and they are independent: a direction that is not free may
    /// still be elastic. By default the identity: the six translations and rotations of the
    /// frame. A [`Screw`](crate::Screw) has `[0 p 0 0 1 0]` as its column v.
    fn basis(&self) -> Matrix6<f64> {
        Matrix6::identity()
    }

    /// The joint's own elasticity: the 6×6 compliance from forces to displacements along the
    /// directions of [`Joint::basis`] (m/N, rad/(N·m) where it is the identity), symmetric
    /// positive semidefinite; `None` (the default) is a rigid joint.
    fn compliance(&self) -> Option<Matrix6<f64>> {
        None
    }

    /// The IDCs and N, in global axes.
    ///
    /// * `frame`: its columns are the joint frame's x, y and z in global axes
    ///   ([`frame_from_axis`](crate::frame_from_axis),
    ///   [`frame_from_axes`](crate::frame_from_axes)).
    /// * `moving`: the directions along which the bodies may move relative to each other:
    ///   free and not locked, or elastic with a coordinate of their own. [`Joint::free`] in the
    ///   paper's use.
    ///
    /// The provided method serves every joint. An override must follow the same rules (see
    /// [`testing::assert_conforms`](crate::testing::assert_conforms)) for any of the 64 sets.
    ///
    /// # Errors
    /// As [`Mapping::of`].
    fn mapping(&self, frame: &Rotation3<f64>, moving: DofSet) -> Result<Mapping, JointError> {
        Mapping::of(&self.basis(), frame, moving)
    }

    /// A copy on the heap, in general `Box::new(self.clone())`: it makes `Box<dyn Joint>`
    /// clonable.
    fn clone_box(&self) -> Box<dyn Joint>;
}

impl Clone for Box<dyn Joint> {
    fn clone(&self) -> Self {
        self.as_ref().clone_box()
    }
}
