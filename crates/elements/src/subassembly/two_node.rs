//! The paper's form for a beam with two nodes (Eqs. 3–12).

use nalgebra::{Matrix3, Matrix6, Rotation3};

use super::elastic_joint::ElasticJoint;
use crate::beam::Beam;
use crate::error::ElementError;
use crate::frame::Matrix12;
use crate::frame::{rotate_matrix6, transport};

/// Stiffness of a beam with elastic joints at its nodes, element frame, by Eqs. 3–12:
/// \[W1; W2\] = K_s \[u1; u2\] between the outer sides of the two joints.
///
/// Node 1 is held for K22 and K12, node 2 for K11 and K21. In Eq. 11 only the beam's compliance is
/// turned by π about z; as printed, the joints' would be too.
///
/// # Errors
/// [`ElementError::NotPositive`] if a summed compliance is singular.
pub fn two_node_stiffness(
    beam: &Beam,
    first: &ElasticJoint,
    second: &ElasticJoint,
) -> Result<Matrix12, ElementError> {
    let c_b = beam.cantilever_compliance();
    let c_j1 = first.turned_compliance();
    let c_j2 = second.turned_compliance();
    let d12 = -transport(&beam.span()).transpose();
    let d21 = -transport(&-beam.span()).transpose();
    let half_turn =
        Rotation3::from_matrix_unchecked(Matrix3::from_diagonal(&[-1.0, -1.0, 1.0].into()));
    let k22 = inverse(&(c_j2 + c_b + d12.transpose() * c_j1 * d12))?;
    let c_b_from_2 = rotate_matrix6(&c_b, &half_turn);
    let k11 = inverse(&(c_j1 + c_b_from_2 + d21.transpose() * c_j2 * d21))?;
    let mut k = Matrix12::zeros();
    k.fixed_view_mut::<6, 6>(0, 0).copy_from(&k11);
    k.fixed_view_mut::<6, 6>(0, 6).copy_from(&(d12 * k22));
    k.fixed_view_mut::<6, 6>(6, 0).copy_from(&(d21 * k11));
    k.fixed_view_mut::<6, 6>(6, 6).copy_from(&k22);
    Ok(k)
}

fn inverse(compliance: &Matrix6<f64>) -> Result<Matrix6<f64>, ElementError> {
    compliance.try_inverse().ok_or(ElementError::NotPositive)
}
