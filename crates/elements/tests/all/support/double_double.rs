//! Numbers of about 32 digits, the unevaluated sum of two doubles (Dekker 1971, Knuth).

use std::ops::{Add, Div, Mul, Neg, Sub};

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    pub const ZERO: Self = Self {
        high: 0.0,
        low: 0.0,
    };

    pub fn to_f64(self) -> f64 {
        self.high
    }

    /// The square root of a positive number: a step of Newton's method from that of its first half.
    #[allow(dead_code)] // Not every test that shares this file needs it.
    pub fn sqrt(self) -> Self {
        let root = Self::from(self.high.sqrt());
        let two = Self::from(2.0);
        root + (self - root * root) / (two * root)
    }

    /// The exact sum of `high` and `low`, where |high| ≥ |low|.
    fn renormalised(high: f64, low: f64) -> Self {
        let sum = high + low;
        Self {
            high: sum,
            low: low - (sum - high),
        }
    }
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let two_sum = |a: f64, b: f64| {
            let sum = a + b;
            let part = sum - a;
            (sum, (a - (sum - part)) + (b - part))
        };
        let (high, error) = two_sum(self.high, other.high);
        let (low, rest) = two_sum(self.low, other.low);
        let first = Self::renormalised(high, error + low);
        Self::renormalised(first.high, first.low + rest)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let high = self.high * other.high;
        let error = self.high.mul_add(other.high, -high);
        Self::renormalised(
            high,
            error + (self.high * other.low + self.low * other.high),
        )
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * first.into();
        let second = rest.high / other.high;
        let rest = rest - other * second.into();
        Self::renormalised(first, second) + (rest.high / other.high).into()
    }
}

#[test]
fn square_roots_keep_about_32_digits() {
    let root = DoubleDouble::from(2.0).sqrt();
    assert!((root * root - 2.0.into()).to_f64().abs() < 1e-31);
}

#[test]
fn keeps_about_32_digits() {
    let third = DoubleDouble::from(1.0) / 3.0.into();
    let gap = third * 3.0.into() - 1.0.into();
    assert!(gap.to_f64().abs() < 1e-31);
    let tiny = DoubleDouble::from(1e-20);
    let sum = tiny + 1.0.into();
    assert!(((sum - 1.0.into()).to_f64() - 1e-20).abs() < 1e-32);
    let square = sum * sum - 1.0.into();
    assert!((square.to_f64() / 2e-20 - 1.0).abs() < 1e-11);
}
