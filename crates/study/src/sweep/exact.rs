//! Sums of doubles without rounding, so that they do not depend on the order or on how rows are divided.

use serde::{Deserialize, Serialize};

/// Bits of a limb.
const BITS: i32 = 32;
/// Exponent of the lowest bit of the first limb, below that of the least double.
const LOWEST: i32 = -1088;
/// Limbs: up to the largest double, and what some 2^60 of them add up to.
const LIMBS: usize = 70;
/// Numbers that are added before limbs hand on what does not fit: each adds less than 2^32 to a limb.
const ROOM: u32 = 1 << 30;
/// Digits of a double.
const DIGITS: i32 = 53;

/// A sum of finite doubles, exact whatever their sizes. Of infinite ones and of none it is none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(into = "Vec<(usize, i64)>", try_from = "Vec<(usize, i64)>")]
pub(super) struct ExactSum {
    /// The lowest first; each counts 2^32 of the one before.
    limbs: [i64; LIMBS],
    /// Numbers added since the limbs were put in order.
    added: u32,
}

impl Default for ExactSum {
    fn default() -> Self {
        Self {
            limbs: [0; LIMBS],
            added: 0,
        }
    }
}

impl ExactSum {
    /// Adds a number.
    pub(super) fn add(&mut self, number: f64) {
        if !number.is_finite() {
            return;
        }
        if self.added == ROOM {
            self.put_in_order();
        }
        self.added += 1;
        let bits = number.to_bits();
        let fraction = bits & ((1 << 52) - 1);
        let (digits, exponent) = match ((bits >> 52) & 0x7ff) as i32 {
            0 => (fraction, -1074),
            power => (fraction | 1 << 52, power - 1075),
        };
        let place = exponent - LOWEST;
        let first = (place / BITS) as usize;
        let wide = u128::from(digits) << (place % BITS);
        for (k, limb) in self.limbs[first..first + 3].iter_mut().enumerate() {
            let part = i64::from((wide >> (32 * k)) as u32);
            *limb += if number < 0.0 { -part } else { part };
        }
    }

    /// Adds another sum.
    pub(super) fn merge(&mut self, other: &Self) {
        let mut other = other.clone();
        self.put_in_order();
        other.put_in_order();
        for (limb, more) in self.limbs.iter_mut().zip(other.limbs) {
            *limb += more;
        }
        self.put_in_order();
    }

    /// Has every limb but the last hold 32 bits, none of them negative.
    fn put_in_order(&mut self) {
        self.added = 0;
        let mut over = 0;
        let (last, lower) = self.limbs.split_last_mut().unwrap_or((&mut over, &mut []));
        let mut carried = 0;
        for limb in lower {
            let all = *limb + carried;
            *limb = all & i64::from(u32::MAX);
            carried = all >> BITS;
        }
        *last += carried;
    }

    /// The double that is nearest to the sum; of two that are, the even one.
    pub(super) fn value(&self) -> f64 {
        let mut size = self.clone();
        size.put_in_order();
        let negative = size.limbs[LIMBS - 1] < 0;
        if negative {
            size.limbs = size.limbs.map(|limb| -limb);
            size.put_in_order();
        }
        let Some(highest) = size.limbs.iter().rposition(|limb| *limb != 0) else {
            return 0.0;
        };
        let limb = |below: usize| highest.checked_sub(below).map_or(0, |at| size.limbs[at]);
        let top = (0..3).fold(0u128, |top, below| (top << BITS) | limb(below) as u128);
        let below = size.limbs[..highest.saturating_sub(2)].iter();
        let rest = below.copied().any(|limb| limb != 0);
        // Exponent of the last bit of `top`.
        let exponent = BITS * (highest as i32 - 2) + LOWEST;
        let digits = 128 - top.leading_zeros() as i32;
        let dropped = (digits - DIGITS).max(-1074 - exponent).max(0);
        let kept = top.checked_shr(dropped as u32).unwrap_or(0);
        let left = top - kept.checked_shl(dropped as u32).unwrap_or(0);
        let half = if dropped > 0 {
            1u128 << (dropped - 1)
        } else {
            0
        };
        let up = dropped > 0 && (left > half || left == half && (rest || kept % 2 == 1));
        let rounded = (kept + u128::from(up)) as f64;
        let value = scaled(rounded, exponent + dropped);
        if negative { -value } else { value }
    }
}

/// A whole number of at most 53 digits times a power of two that leaves it a double.
fn scaled(number: f64, exponent: i32) -> f64 {
    let half = exponent / 2;
    let power = |exponent: i32| 2f64.powi(exponent);
    number * power(half) * power(exponent - half)
}

impl From<ExactSum> for Vec<(usize, i64)> {
    /// Limbs that are not zero, by their places.
    fn from(mut sum: ExactSum) -> Self {
        sum.put_in_order();
        let limbs = sum.limbs.into_iter().enumerate();
        limbs.filter(|(_, limb)| *limb != 0).collect()
    }
}

impl TryFrom<Vec<(usize, i64)>> for ExactSum {
    type Error = String;

    fn try_from(limbs: Vec<(usize, i64)>) -> Result<Self, String> {
        let mut sum = Self::default();
        for (place, limb) in limbs {
            let in_order = place + 1 == LIMBS || u32::try_from(limb).is_ok();
            match sum.limbs.get_mut(place) {
                Some(own) if in_order => *own = limb,
                _ => return Err(format!("a sum has no limb {place} of {limb}")),
            }
        }
        Ok(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::ExactSum;

    fn sum(numbers: &[f64]) -> ExactSum {
        let mut sum = ExactSum::default();
        numbers.iter().for_each(|number| sum.add(*number));
        sum
    }

    #[test]
    fn a_number_alone_is_itself() {
        let tiny = f64::from_bits(1);
        for number in [
            0.0,
            1.0,
            -1.0,
            0.1,
            -1.0 / 3.0,
            tiny,
            -tiny,
            3.0 * tiny,
            f64::MIN_POSITIVE,
            f64::MAX,
            -f64::MAX,
            1e-300,
            1e300,
            123_456_789.123_456_78,
            f64::from_bits(0x000f_ffff_ffff_ffff),
        ] {
            assert_eq!(
                sum(&[number]).value().to_bits(),
                (number + 0.0).to_bits(),
                "{number:e}"
            );
        }
    }

    #[test]
    fn nothing_is_lost() {
        assert_eq!(sum(&[1e300, 1.0, -1e300]).value(), 1.0);
        assert_eq!(sum(&[1e16, 1.0, 1.0]).value(), 1e16 + 2.0);
        // Halfway between two doubles, and a little more.
        assert_eq!(sum(&[2f64.powi(53), 1.0]).value(), 2f64.powi(53));
        assert_eq!(
            sum(&[2f64.powi(53), 1.0, 1e-300]).value(),
            2f64.powi(53) + 2.0
        );
        assert_eq!(sum(&[2f64.powi(53), 3.0]).value(), 2f64.powi(53) + 4.0);
        assert_eq!(sum(&[f64::MAX, f64::MAX]).value(), f64::INFINITY);
        assert_eq!(sum(&[f64::MAX, f64::MAX, -f64::MAX]).value(), f64::MAX);
        assert_eq!(sum(&[0.5, -0.5]).value(), 0.0);
        assert_eq!(sum(&[f64::NAN, f64::INFINITY, 2.0]).value(), 2.0);
    }

    /// Whole numbers of 100 bits, whose sums a program has exactly.
    #[test]
    fn sums_are_those_of_whole_numbers() {
        let mut state = 1u64;
        let mut random = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state
        };
        for _ in 0..200 {
            let numbers: Vec<i128> = (0..50)
                .map(|_| {
                    let digits = i128::from(random() >> 12) << (random() % 50);
                    if random() % 2 == 0 { digits } else { -digits }
                })
                .collect();
            let doubles: Vec<f64> = numbers.iter().map(|number| *number as f64).collect();
            let all = sum(&doubles);
            // Rust rounds a whole number to the nearest double, too.
            assert_eq!(all.value(), numbers.iter().sum::<i128>() as f64);
            let mut parts = sum(&doubles[20..]);
            parts.merge(&sum(&doubles[..7]));
            parts.merge(&sum(&doubles[7..20]));
            assert_eq!(parts.value(), all.value());
            let text = serde_json::to_string(&parts).unwrap();
            let read: ExactSum = serde_json::from_str(&text).unwrap();
            assert_eq!(read, parts);
        }
    }

    #[test]
    fn what_is_no_sum_is_not_read() {
        for text in ["[[70,1]]", "[[0,-1]]", "[[3,4294967296]]", "[[1]]"] {
            assert!(serde_json::from_str::<ExactSum>(text).is_err(), "{text}");
        }
    }
}
