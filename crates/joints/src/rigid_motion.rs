//! Displacements and wrenches carried from point to point of a rigid body (paper Eq. 37).

use nalgebra::{Matrix6, Vector3};

/// The displacement of the point at `r` \[m\] from a point of a rigid body: `u(p + r) = M u(p)`,
/// `M = [E  −[r×]; 0  E]` (Eq. 37, where `L_ij` runs from i to j, so `r = −L_ij`).
///
/// Both displacements (Δ \[m\], φ \[rad\]) and `r` are in the same axes.
pub fn rigid_motion(r: &Vector3<f64>) -> Matrix6<f64> {
    let mut m = Matrix6::identity();
    m.fixed_view_mut::<3, 3>(0, 3).copy_from(&-r.cross_matrix());
    m
}

/// The same wrench about another point: `w(p + r) = M w(p)`, `M = [E  0; −[r×]  E]`.
///
/// Both wrenches (F \[N\], M \[N·m\]) and `r` \[m\] are in the same axes. It is the inverse transpose
/// of [`rigid_motion`]: the work `wᵀ u` does not depend on the point.
pub fn wrench_transport(r: &Vector3<f64>) -> Matrix6<f64> {
    let mut m = Matrix6::identity();
    m.fixed_view_mut::<3, 3>(3, 0).copy_from(&-r.cross_matrix());
    m
}
