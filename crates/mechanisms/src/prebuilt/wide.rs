//! Numbers of several poses side by side, in loops that the compiler makes SIMD of: inverse kinematics
//! is written once, for one pose and for as many as go together.
//!
//! No digit depends on their number: every operation is rounded by itself, and none takes numbers of two
//! poses.

// Loops by index, on both operands.
#![allow(clippy::needless_range_loop)]

use std::ops::{Add, Div, Mul, Neg, Sub};

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

/// A number of each of `N` poses.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wide<const N: usize>(pub(super) [f64; N]);

/// A vector of each pose.
pub(super) type WideVector<const N: usize> = [Wide<N>; 3];

impl<const N: usize> Wide<N> {
    /// The same number in all poses.
    #[inline(always)]
    pub(super) fn of(value: f64) -> Self {
        Self([value; N])
    }

    #[inline(always)]
    fn map(mut self, f: impl Fn(f64) -> f64) -> Self {
        for k in 0..N {
            self.0[k] = f(self.0[k]);
        }
        self
    }

    #[inline(always)]
    fn zip(mut self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        for k in 0..N {
            self.0[k] = f(self.0[k], other.0[k]);
        }
        self
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    /// Zero where it is not above zero.
    #[inline(always)]
    pub(super) fn not_negative(self) -> Self {
        self.map(|v| if v > 0.0 { v } else { 0.0 })
    }

    /// This where `sign` is zero or above, its opposite elsewhere.
    #[inline(always)]
    pub(super) fn signed_as(self, sign: Self) -> Self {
        self.zip(sign, |v, sign| if sign >= 0.0 { v } else { -v })
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl<const N: usize> $trait for Wide<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.zip(other, |a, b| a $operator b)
            }
        }

        impl<const N: usize> $trait<f64> for Wide<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                self.map(|a| a $operator other)
            }
        }
    };
}
operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl<const N: usize> Neg for Wide<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|v| -v)
    }
}

/// The first `M` coordinates of several poses, zero where there are fewer poses.
#[inline(always)]
pub(super) fn side_by_side<const N: usize, const M: usize>(poses: &[[f64; 6]]) -> [Wide<N>; M] {
    let mut numbers = [Wide::of(0.0); M];
    for (k, pose) in poses.iter().enumerate().take(N) {
        for c in 0..M {
            numbers[c].0[k] = pose[c];
        }
    }
    numbers
}

/// A vector that is the same in all poses.
#[inline(always)]
pub(super) fn same<const N: usize>(v: &Vector3<f64>) -> WideVector<N> {
    [Wide::of(v.x), Wide::of(v.y), Wide::of(v.z)]
}

#[inline(always)]
pub(super) fn plus<const N: usize>(a: &WideVector<N>, b: &WideVector<N>) -> WideVector<N> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(super) fn minus<const N: usize>(a: &WideVector<N>, b: &WideVector<N>) -> WideVector<N> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(super) fn scaled<const N: usize>(a: &WideVector<N>, by: Wide<N>) -> WideVector<N> {
    [a[0] * by, a[1] * by, a[2] * by]
}

#[inline(always)]
pub(super) fn dot<const N: usize>(a: &WideVector<N>, b: &WideVector<N>) -> Wide<N> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(super) fn cross<const N: usize>(a: &WideVector<N>, b: &WideVector<N>) -> WideVector<N> {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[inline(always)]
pub(super) fn unit<const N: usize>(a: &WideVector<N>) -> WideVector<N> {
    let norm = dot(a, a).sqrt();
    [a[0] / norm, a[1] / norm, a[2] / norm]
}

/// The vector of one pose.
#[inline(always)]
pub(super) fn vector_at<const N: usize>(v: &WideVector<N>, pose: usize) -> Vector3<f64> {
    Vector3::new(v[0].0[pose], v[1].0[pose], v[2].0[pose])
}

/// The point of one pose.
#[inline(always)]
pub(super) fn point_at<const N: usize>(v: &WideVector<N>, pose: usize) -> Point3<f64> {
    Point3::from(vector_at(v, pose))
}

/// A frame of each pose: its x and z, beside a y that is known.
pub(super) type WideFrame<const N: usize> = [WideVector<N>; 2];

/// The frame with these x and y, z = x × y. Both are unit vectors, and normal to each other but
/// for rounding, which is taken off x.
#[inline(always)]
pub(super) fn frame<const N: usize>(x: &WideVector<N>, y: &WideVector<N>) -> WideFrame<N> {
    let x = minus(x, &scaled(y, dot(y, x)));
    let z = cross(&x, y);
    [x, z]
}

/// The frame of one pose, with its y.
#[inline(always)]
pub(super) fn frame_at<const N: usize>(
    [x, z]: &WideFrame<N>,
    y: &Vector3<f64>,
    pose: usize,
) -> Rotation3<f64> {
    Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[
        vector_at(x, pose),
        *y,
        vector_at(z, pose),
    ]))
}
