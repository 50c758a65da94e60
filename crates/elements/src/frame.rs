//! Element frames, rotation to global axes, and transport of displacements and wrenches.

use nalgebra::{Matrix3, Matrix6, Rotation3, SMatrix, Vector3, Vector6};

use crate::error::ElementError;

/// A 12×12 matrix over the two nodes of a beam, node 1 first.
pub type Matrix12 = SMatrix<f64, 12, 12>;

/// A `y_axis` closer than this to the beam (sine of the angle) counts as along it.
const ALONG: f64 = 1e-6;

/// The global z axis serves as local z unless the beam is closer to it than this (cosine).
const UPRIGHT: f64 = 0.9;

/// The element frame of a beam with this span (node 1 to node 2, global axes, any length unit):
/// the columns of the rotation are local x, y and z in global axes.
///
/// Local x runs along the span. With `y_axis`, local y is that direction made normal to x.
/// Without, local z is global z made normal to x (global x where |x·z| ≥ 0.9) and y = z × x, so
/// that a rectangle stands upright.
///
/// # Errors
/// [`ElementError::NoLength`] for a span that is zero or not finite,
/// [`ElementError::NoDirection`] for such a `y_axis`, [`ElementError::AlongBeam`] for a
/// `y_axis` within 1e-6 rad of the beam.
pub fn element_frame(
    span: &Vector3<f64>,
    y_axis: Option<&Vector3<f64>>,
) -> Result<Rotation3<f64>, ElementError> {
    let x = direction(span).ok_or(ElementError::NoLength {
        length: span.norm(),
    })?;
    let (y, z) = match y_axis {
        Some(given) => {
            let [gx, gy, gz] = (*given).into();
            let y = direction(given).ok_or(ElementError::NoDirection {
                x: gx,
                y: gy,
                z: gz,
            })?;
            if x.cross(&y).norm() < ALONG {
                return Err(ElementError::AlongBeam {
                    x: gx,
                    y: gy,
                    z: gz,
                });
            }
            let y = normal_part(&y, &x);
            (y, x.cross(&y))
        }
        None => {
            let up = if x.z.abs() < UPRIGHT {
                Vector3::z()
            } else {
                Vector3::x()
            };
            let z = normal_part(&up, &x);
            (z.cross(&x), z)
        }
    };
    Ok(Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[
        x, y, z,
    ])))
}

/// The unit vector along `v`; `None` if `v` is zero or not finite. Safe from overflow.
fn direction(v: &Vector3<f64>) -> Option<Vector3<f64>> {
    let size = v.amax();
    (size > 0.0 && v.iter().all(|c| c.is_finite())).then(|| (v / size).normalize())
}

/// The unit vector along the part of `v` normal to the unit vector `x`. The part is taken twice:
/// once leaves rounding along `x` that grows as `v` nears `x`.
fn normal_part(v: &Vector3<f64>, x: &Vector3<f64>) -> Vector3<f64> {
    let once = (v - x * x.dot(v)).normalize();
    (once - x * x.dot(&once)).normalize()
}

/// The matrix M that carries a displacement of a rigid body from a point p to p + r:
/// u(p + r) = M u(p), with r in m (Eq. 37).
///
/// Wrenches go the other way with its transpose: a wrench W at p + r acts as Mᵀ W at p.
pub fn transport(r: &Vector3<f64>) -> Matrix6<f64> {
    let mut m = Matrix6::identity();
    m.fixed_view_mut::<3, 3>(0, 3).copy_from(&-r.cross_matrix());
    m
}

/// A displacement or wrench turned by `rotation`: both its parts are.
pub fn rotate_vector6(vector: &Vector6<f64>, rotation: &Rotation3<f64>) -> Vector6<f64> {
    let mut out = Vector6::zeros();
    for k in [0, 3] {
        let part = rotation * vector.fixed_rows::<3>(k);
        out.fixed_rows_mut::<3>(k).copy_from(&part);
    }
    out
}

/// A stiffness or compliance of one node, from the frame whose axes are the columns of
/// `rotation` to the axes those columns are given in: T M Tᵀ with T = diag(R, R).
pub fn rotate_matrix6(matrix: &Matrix6<f64>, rotation: &Rotation3<f64>) -> Matrix6<f64> {
    let r = rotation.matrix();
    let mut out = Matrix6::zeros();
    for i in [0, 3] {
        for j in [0, 3] {
            let block = r * matrix.fixed_view::<3, 3>(i, j) * r.transpose();
            out.fixed_view_mut::<3, 3>(i, j).copy_from(&block);
        }
    }
    out
}

/// A stiffness of two nodes from the element frame to global axes (Eq. 38); `rotation` as given
/// by [`element_frame`].
pub fn rotate_matrix12(matrix: &Matrix12, rotation: &Rotation3<f64>) -> Matrix12 {
    let r = rotation.matrix();
    let mut out = Matrix12::zeros();
    for i in (0..12).step_by(3) {
        for j in (0..12).step_by(3) {
            let block = r * matrix.fixed_view::<3, 3>(i, j) * r.transpose();
            out.fixed_view_mut::<3, 3>(i, j).copy_from(&block);
        }
    }
    out
}
