//! One number a pose: arithmetic over SIMD registers, and small vectors and matrices of them.
//!
//! Everything here is `inline(always)`, and nothing hot is a closure or goes through
//! `array::from_fn`, which cannot be: all must be compiled with the instruction set that
//! [`pulp::Arch`] has chosen at run time, not with the crate's.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use pulp::Simd;

/// `[f(0), f(1), f(2)]`, written out in place.
macro_rules! three {
    ($k:ident => $value:expr) => {
        [
            {
                let $k = 0_usize;
                $value
            },
            {
                let $k = 1_usize;
                $value
            },
            {
                let $k = 2_usize;
                $value
            },
        ]
    };
}
pub(crate) use three;

/// The same of six.
macro_rules! six {
    ($k:ident => $value:expr) => {
        [
            {
                let $k = 0_usize;
                $value
            },
            {
                let $k = 1_usize;
                $value
            },
            {
                let $k = 2_usize;
                $value
            },
            {
                let $k = 3_usize;
                $value
            },
            {
                let $k = 4_usize;
                $value
            },
            {
                let $k = 5_usize;
                $value
            },
        ]
    };
}
pub(crate) use six;

/// The block for each constant `$k` from 0 on below `$end`, which is at most 6, one after the other: what
/// a loop by index would keep in memory stays in registers.
macro_rules! unrolled {
    ($k:ident < $end:expr => $body:block) => {
        unrolled!(0, $k < $end => $body);
        unrolled!(1, $k < $end => $body);
        unrolled!(2, $k < $end => $body);
        unrolled!(3, $k < $end => $body);
        unrolled!(4, $k < $end => $body);
        unrolled!(5, $k < $end => $body);
    };
    ($value:literal, $k:ident < $end:expr => $body:block) => {{
        const $k: usize = $value;
        if $k < $end $body
    }};
}
pub(crate) use unrolled;

/// Lower triangle of a 6×6 matrix.
pub(crate) const TRIANGLE: usize = 21;

/// A register: one number for each pose in the lanes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lane<S: Simd> {
    simd: S,
    pub value: S::f64s,
}

/// A vector of three components.
pub(crate) type Vec3<S> = [Lane<S>; 3];
/// A 3×3 matrix by rows.
pub(crate) type Mat3<S> = [[Lane<S>; 3]; 3];

impl<S: Simd> Lane<S> {
    #[inline(always)]
    pub fn new(simd: S, value: S::f64s) -> Self {
        Self { simd, value }
    }

    /// The same number for every pose.
    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        Self::new(simd, simd.splat_f64s(value))
    }

    /// The same number for every pose, beside this one.
    #[inline(always)]
    pub fn constant(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    /// `self · a + b`; fused where the machine has it.
    #[inline(always)]
    pub fn mul_add(self, a: Self, b: Self) -> Self {
        Self::new(
            self.simd,
            self.simd.mul_add_e_f64s(self.value, a.value, b.value),
        )
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self::new(self.simd, self.simd.sqrt_f64s(self.value))
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        // Not `abs_f64s`: with AVX-512 it is a call, around which every register is saved.
        self.max(-self)
    }

    /// The smaller of two; the second where the first is not a number.
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        Self::new(self.simd, self.simd.min_f64s(self.value, other.value))
    }

    /// The larger of two; which one where a lane is not a number is not said.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        Self::new(self.simd, self.simd.max_f64s(self.value, other.value))
    }

    /// `then` where `self` is above `bound`, else (not a number, too) `otherwise`.
    #[inline(always)]
    pub fn if_above(self, bound: Self, then: Self, otherwise: Self) -> Self {
        let mask = self.simd.greater_than_f64s(self.value, bound.value);
        let value = self.simd.select_f64s(mask, then.value, otherwise.value);
        Self::new(self.simd, value)
    }

    #[inline(always)]
    pub fn recip(self) -> Self {
        self.constant(1.0) / self
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $simd:ident) => {
        impl<S: Simd> $trait for Lane<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self::new(self.simd, self.simd.$simd(self.value, other.value))
            }
        }
    };
}
operator!(Add, add, add_f64s);
operator!(Sub, sub, sub_f64s);
operator!(Mul, mul, mul_f64s);
operator!(Div, div, div_f64s);

impl<S: Simd> Neg for Lane<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.constant(0.0) - self
    }
}

impl<S: Simd> AddAssign for Lane<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

#[inline(always)]
pub(crate) fn add<S: Simd>(a: &Vec3<S>, b: &Vec3<S>) -> Vec3<S> {
    three!(k => a[k] + b[k])
}

#[inline(always)]
pub(crate) fn sub<S: Simd>(a: &Vec3<S>, b: &Vec3<S>) -> Vec3<S> {
    three!(k => a[k] - b[k])
}

#[inline(always)]
pub(crate) fn scaled<S: Simd>(a: &Vec3<S>, by: Lane<S>) -> Vec3<S> {
    three!(k => a[k] * by)
}

#[inline(always)]
pub(crate) fn dot<S: Simd>(a: &Vec3<S>, b: &Vec3<S>) -> Lane<S> {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}

#[inline(always)]
pub(crate) fn cross<S: Simd>(a: &Vec3<S>, b: &Vec3<S>) -> Vec3<S> {
    three!(k => {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i].mul_add(b[j], -(a[j] * b[i]))
    })
}

/// `a b`.
#[inline(always)]
pub(crate) fn product<S: Simd>(a: &Mat3<S>, b: &Mat3<S>) -> Mat3<S> {
    three!(i => three!(j => {
        a[i][0].mul_add(b[0][j], a[i][1].mul_add(b[1][j], a[i][2] * b[2][j]))
    }))
}

/// `a bᵀ`.
#[inline(always)]
pub(crate) fn product_transposed<S: Simd>(a: &Mat3<S>, b: &Mat3<S>) -> Mat3<S> {
    three!(i => three!(j => dot(&a[i], &b[j])))
}

#[inline(always)]
pub(crate) fn transposed<S: Simd>(a: &Mat3<S>) -> Mat3<S> {
    three!(i => three!(j => a[j][i]))
}

/// The vector that a matrix by rows makes of another.
#[inline(always)]
pub(crate) fn apply<S: Simd>(a: &Mat3<S>, v: &Vec3<S>) -> Vec3<S> {
    three!(i => dot(&a[i], v))
}
