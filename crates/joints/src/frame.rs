//! Joint frames from the axes a user gives.

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::error::JointError;

/// Two directions closer than this angle \[rad\] count as parallel.
const PARALLEL: f64 = 1e-6;
/// Components that differ by less tie; the first of them in order is taken.
const TIE: f64 = 1e-9;

/// Frame of a joint with one axis: y along `axis`, x along `x_axis` made normal to y, z = x × y.
///
/// Without `x_axis`, x is the global axis least aligned with y (the first of x, y, z where they
/// tie to 1e-9), made normal to y. Without `axis` the frame is global. The columns of the
/// rotation are the frame's x, y and z in global axes. The vectors need no unit length.
///
/// # Errors
/// A zero or not finite vector, an `x_axis` within 1e-6 rad of the axis, an `x_axis` without
/// an axis.
pub fn frame_from_axis(
    axis: Option<&Vector3<f64>>,
    x_axis: Option<&Vector3<f64>>,
) -> Result<Rotation3<f64>, JointError> {
    let Some(axis) = axis else {
        return match x_axis {
            None => Ok(Rotation3::identity()),
            Some(_) => Err(JointError::XAxisWithoutAxis),
        };
    };
    let y = unit(axis, "axis")?;
    let x = match x_axis {
        None => normal_part(&least_aligned(&y), &y),
        Some(x_axis) => normal_part(&unit(x_axis, "x_axis")?, &y),
    };
    let x = x.ok_or_else(|| JointError::XAxisAlongAxis {
        x_axis: x_axis.copied().unwrap_or_default(),
        axis: *axis,
    })?;
    Ok(frame(&x, &y))
}

/// Frame of a joint with two axes (Universal): x along `a`, y along `b` made normal to x,
/// z = x × y.
///
/// The columns of the rotation are the frame's x, y and z in global axes. The vectors need no
/// unit length.
///
/// # Errors
/// A zero or not finite vector, axes within 1e-6 rad of each other or of opposite directions.
pub fn frame_from_axes(a: &Vector3<f64>, b: &Vector3<f64>) -> Result<Rotation3<f64>, JointError> {
    let x = unit(a, "first axis")?;
    let y = normal_part(&unit(b, "second axis")?, &x)
        .ok_or(JointError::ParallelAxes { a: *a, b: *b })?;
    Ok(frame(&x, &y))
}

fn frame(x: &Vector3<f64>, y: &Vector3<f64>) -> Rotation3<f64> {
    Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[*x, *y, x.cross(y)]))
}

/// `vector` with length 1, whatever its length is.
fn unit(vector: &Vector3<f64>, what: &'static str) -> Result<Vector3<f64>, JointError> {
    if !vector.iter().all(|c| c.is_finite()) {
        return Err(JointError::NotFinite { what });
    }
    let largest = vector.amax();
    if largest == 0.0 {
        return Err(JointError::ZeroAxis { what });
    }
    Ok((vector / largest).normalize())
}

/// The unit vector along the part of `v` normal to the unit vector `n`; `None` where they are
/// parallel. Subtracted twice, so that it is normal to rounding however small that part is.
fn normal_part(v: &Vector3<f64>, n: &Vector3<f64>) -> Option<Vector3<f64>> {
    let part = v - n * n.dot(v);
    if part.norm() < PARALLEL {
        return None;
    }
    let part = part.normalize();
    Some((part - n * n.dot(&part)).normalize())
}

/// The global axis with the smallest component along the unit vector `y`.
fn least_aligned(y: &Vector3<f64>) -> Vector3<f64> {
    let smallest = y.amin();
    let first = y.iter().position(|c| c.abs() <= smallest + TIE);
    Vector3::ith(first.unwrap_or(0), 1.0)
}
