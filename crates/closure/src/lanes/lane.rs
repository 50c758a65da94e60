//! Eight numbers, one a pose, in loops that the compiler makes SIMD of.
//!
//! Everything here is inlined into its caller and written as loops by index: so it is compiled with the
//! instruction set of whoever runs [`Work`](super::Work). No instruction set changes a digit: products
//! and sums are rounded one by one.

// See above.
#![allow(clippy::needless_range_loop)]

use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

use hyperstat_model::LANES;

/// A number of every pose.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(super) struct Lane(pub [f64; LANES]);

/// A vector of every pose.
pub(super) type Vector = [Lane; 3];

/// A matrix of every pose, by columns.
pub(super) type Matrix = [Vector; 3];

impl Lane {
    pub const ZERO: Self = Self([0.0; LANES]);
    pub const ONE: Self = Self([1.0; LANES]);

    /// The same number in all poses.
    #[inline(always)]
    pub fn of(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut mapped = self.0;
        for k in 0..LANES {
            mapped[k] = f(mapped[k]);
        }
        Self(mapped)
    }

    #[inline(always)]
    pub fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut both = self.0;
        for k in 0..LANES {
            both[k] = f(both[k], other.0[k]);
        }
        Self(both)
    }

    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        self.map(f64::abs)
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    #[inline(always)]
    pub fn inverse(self) -> Self {
        self.map(|v| 1.0 / v)
    }

    /// This where `which` says so, else the other.
    #[inline(always)]
    pub fn or(self, which: [bool; LANES], other: Self) -> Self {
        let mut chosen = other.0;
        for k in 0..LANES {
            chosen[k] = if which[k] { self.0[k] } else { chosen[k] };
        }
        Self(chosen)
    }
}

macro_rules! by_lane {
    ($trait:ident, $name:ident, $operator:tt) => {
        impl $trait for Lane {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                self.zip(other, |a, b| a $operator b)
            }
        }
    };
}
by_lane!(Add, add, +);
by_lane!(Sub, sub, -);
by_lane!(Mul, mul, *);

impl Mul<f64> for Lane {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self.map(|v| v * factor)
    }
}

impl Neg for Lane {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|v| -v)
    }
}

impl AddAssign for Lane {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Lane {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

#[inline(always)]
pub(super) fn dot(a: &Vector, b: &Vector) -> Lane {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(super) fn cross(a: &Vector, b: &Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[inline(always)]
pub(super) fn plus(a: &Vector, b: &Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(super) fn minus(a: &Vector, b: &Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// A matrix times a vector.
#[inline(always)]
pub(super) fn times(m: &Matrix, v: &Vector) -> Vector {
    let mut product = [Lane::ZERO; 3];
    for r in 0..3 {
        product[r] = m[0][r] * v[0] + m[1][r] * v[1] + m[2][r] * v[2];
    }
    product
}

/// A matrix times a vector that is the same in all poses.
#[inline(always)]
pub(super) fn times_fixed(m: &Matrix, v: &[f64; 3]) -> Vector {
    let mut product = [Lane::ZERO; 3];
    for r in 0..3 {
        product[r] = m[0][r] * v[0] + m[1][r] * v[1] + m[2][r] * v[2];
    }
    product
}

/// A vector times a number of every pose.
#[inline(always)]
pub(super) fn scaled(v: &Vector, factor: Lane) -> Vector {
    [v[0] * factor, v[1] * factor, v[2] * factor]
}

/// Length of a list of numbers.
#[inline(always)]
pub(super) fn norm(numbers: &[Lane]) -> Lane {
    let mut sum = Lane::ZERO;
    for number in numbers {
        sum += *number * *number;
    }
    sum.sqrt()
}

/// The largest of a list of numbers, by size.
#[inline(always)]
pub(super) fn largest(numbers: &[Lane]) -> Lane {
    let mut most = Lane::ZERO;
    for number in numbers {
        most = most.max(number.abs());
    }
    most
}

/// π/2 in three parts, of which the first two have room for the product with a whole number.
const HALF_PI: [f64; 3] = [
    1.570_796_326_734_125_6,
    6.077_100_506_303_966e-11,
    2.022_266_248_795_950_6e-21,
];

/// Sine and cosine, to 3e-16, of angles up to 1e4 rad; without a branch, so that they are
/// the same on any machine. The polynomials are those of FreeBSD's `k_sin.c` and `k_cos.c`.
#[inline(always)]
pub(super) fn sin_cos(angle: Lane) -> (Lane, Lane) {
    // Adding it leaves a whole number in the last digits.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    let mut sines = Lane::ZERO;
    let mut cosines = Lane::ZERO;
    for k in 0..LANES {
        let shifted = angle.0[k] * std::f64::consts::FRAC_2_PI + ROUND;
        let turns = shifted - ROUND;
        let quadrant = shifted.to_bits();
        let x = ((angle.0[k] - turns * HALF_PI[0]) - turns * HALF_PI[1]) - turns * HALF_PI[2];
        let z = x * x;
        let s = -1.666_666_666_666_663_2e-1
            + z * (8.333_333_333_322_49e-3
                + z * (-1.984_126_982_985_795e-4
                    + z * (2.755_731_370_707_006_8e-6
                        + z * (-2.505_076_025_340_686_3e-8 + z * 1.589_690_995_211_55e-10))));
        let c = 4.166_666_666_666_66e-2
            + z * (-1.388_888_888_887_411e-3
                + z * (2.480_158_728_947_673e-5
                    + z * (-2.755_731_435_139_066_3e-7
                        + z * (2.087_572_321_298_175e-9 + z * -1.135_964_755_778_819_5e-11))));
        let sine = x + x * z * s;
        let half = 0.5 * z;
        let whole = 1.0 - half;
        let cosine = whole + (((1.0 - whole) - half) + z * z * c);
        // Bits instead of branches: which is which, and the signs.
        let odd = 0_u64.wrapping_sub(quadrant & 1);
        let (p, q) = (sine.to_bits(), cosine.to_bits());
        let change = (p ^ q) & odd;
        sines.0[k] = f64::from_bits((p ^ change) ^ ((quadrant >> 1 & 1) << 63));
        cosines.0[k] = f64::from_bits((q ^ change) ^ (((quadrant.wrapping_add(1)) >> 1 & 1) << 63));
    }
    (sines, cosines)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_and_cosines_are_those_of_the_library() {
        let mut angle = -9_999.0_f64;
        while angle < 1e4 {
            let angles = Lane(std::array::from_fn(|k| angle + 0.37 * k as f64));
            let (sines, cosines) = sin_cos(angles);
            for k in 0..LANES {
                let (sine, cosine) = angles.0[k].sin_cos();
                assert!((sines.0[k] - sine).abs() <= 3e-16, "{}", angles.0[k]);
                assert!((cosines.0[k] - cosine).abs() <= 3e-16, "{}", angles.0[k]);
            }
            angle += 0.713;
        }
        let (sines, cosines) = sin_cos(Lane::ZERO);
        assert_eq!((sines, cosines), (Lane::ZERO, Lane::ONE));
    }
}
