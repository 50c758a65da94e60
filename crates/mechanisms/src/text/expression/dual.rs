//! Numbers with their derivative by one parameter.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number and its derivative; no derivative is zero, whatever it is multiplied by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dual {
    pub(crate) value: f64,
    pub(crate) slope: f64,
}

impl Dual {
    pub(crate) const fn constant(value: f64) -> Self {
        Self { value, slope: 0.0 }
    }

    /// A function of it, by its value and its derivative here.
    pub(super) fn through(self, value: f64, derivative: f64) -> Self {
        Self {
            value,
            slope: scaled(self.slope, derivative),
        }
    }

    pub(super) fn power(self, exponent: Self) -> Self {
        let (x, y) = (self.value, exponent.value);
        let value = x.powf(y);
        let slope =
            scaled(self.slope, y * x.powf(y - 1.0)) + scaled(exponent.slope, value * x.ln());
        Self { value, slope }
    }

    pub(super) fn hypot(self, other: Self) -> Self {
        let value = self.value.hypot(other.value);
        let slope =
            scaled(self.slope, self.value / value) + scaled(other.slope, other.value / value);
        Self { value, slope }
    }

    /// The angle of the direction (`x`, `self`).
    pub(super) fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        Self {
            value: self.value.atan2(x.value),
            slope: scaled(self.slope, x.value / square) - scaled(x.slope, self.value / square),
        }
    }
}

/// `slope` times `factor`; nothing stays nothing beside an infinite factor.
fn scaled(slope: f64, factor: f64) -> f64 {
    if slope == 0.0 { 0.0 } else { slope * factor }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            slope: self.slope + other.slope,
        }
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            slope: -self.slope,
        }
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            slope: scaled(self.slope, other.value) + scaled(other.slope, self.value),
        }
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self {
            value,
            slope: scaled(self.slope, 1.0 / other.value) - scaled(other.slope, value / other.value),
        }
    }
}
