//! What somebody else's program makes of hyperstat-joints: a joint of its own and a small
//! solver that hangs a platform on legs through joints, without a constraint equation.

use hyperstat_joints::{Dof, DofSet, Joint, JointError, rigid_motion};
use nalgebra::{Matrix6, Rotation3, Vector3};

/// A ball on a slide: a spherical joint that may also move along the frame's y.
#[derive(Debug, Clone)]
pub struct BallOnSlide;

impl Joint for BallOnSlide {
    fn kind(&self) -> &str {
        "BallOnSlide"
    }

    fn free(&self) -> DofSet {
        DofSet::new(&[Dof::Y, Dof::U, Dof::V, Dof::W])
    }

    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(self.clone())
    }
}

/// A leg that carries a rigid platform through a joint.
#[derive(Debug, Clone)]
pub struct Leg {
    /// From the platform's centre to the joint \[m\].
    pub at: Vector3<f64>,
    /// Stiffness of the leg at the joint, global axes, N/m and N·m/rad.
    pub stiffness: Matrix6<f64>,
    /// The joint between the leg (body i) and the platform (body j).
    pub joint: Box<dyn Joint>,
    /// The joint's frame.
    pub frame: Rotation3<f64>,
}

/// The stiffness of the platform at its centre: of every leg, N takes the IDCs of the joint
/// and the platform's displacement to the leg's end, and the IDCs are condensed out.
///
/// # Errors
/// As [`Joint::mapping`].
pub fn platform_stiffness(legs: &[Leg]) -> Result<Matrix6<f64>, JointError> {
    let mut total = Matrix6::zeros();
    for leg in legs {
        let mapping = leg.joint.mapping(&leg.frame, leg.joint.free())?;
        let own = mapping.ground_matrix();
        let shared = mapping.n_j() * rigid_motion(&leg.at);
        let k_ii = own.transpose() * leg.stiffness * &own;
        let k_ij = own.transpose() * leg.stiffness * shared;
        let relaxed = k_ii
            .cholesky()
            .map_or_else(Matrix6::zeros, |k_ii| k_ij.transpose() * k_ii.solve(&k_ij));
        total += shared.transpose() * leg.stiffness * shared - relaxed;
    }
    Ok(total)
}
