//! Round numbers: 1, 2, 5 × 10ᵏ.

/// The largest round number that is not above `value`; `None` where there is none, because
/// `value` is not finite, not above zero, or at the end of what an `f64` can hold.
pub(crate) fn down(value: f64) -> Option<f64> {
    near(value)?.into_iter().rfind(|round| *round <= value)
}

/// The smallest round number that is not below `value`; `None` as for [`down`].
pub(crate) fn up(value: f64) -> Option<f64> {
    near(value)?.into_iter().find(|round| *round >= value)
}

/// The round numbers from below to above a value, ascending.
fn near(value: f64) -> Option<[f64; 9]> {
    let exponent = value.log10().floor();
    if exponent.is_nan() || exponent.abs() > 300.0 {
        return None;
    }
    // A decade more on each side: the logarithm may have been rounded across a power of ten.
    let lowest = exponent as i32 - 1;
    Some(std::array::from_fn(|k| {
        let decimal = format!("{}e{}", [1, 2, 5][k % 3], lowest + (k / 3) as i32);
        decimal.parse().expect("a number in decimal notation")
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_lie_between_the_round_numbers_next_to_them() {
        for (below, value, above) in [
            (1.0, 1.0, 1.0),
            (1.0, 1.999, 2.0),
            (2.0, 2.0, 2.0),
            (2.0, 4.99, 5.0),
            (5.0, 5.0, 5.0),
            (5.0, 9.999, 10.0),
            (500.0, 999.999_999_999_999_9, 1000.0),
            (1000.0, 1000.0, 1000.0),
            (0.2, 0.3, 0.5),
            (0.001, 0.001, 0.001),
            (5e-9, 7.3e-9, 1e-8),
            (1e-300, 1.5e-300, 2e-300),
        ] {
            assert_eq!(
                (down(value), up(value)),
                (Some(below), Some(above)),
                "{value}"
            );
        }
    }

    #[test]
    fn some_values_have_no_round_number() {
        for value in [
            0.0,
            -1.0,
            f64::NAN,
            f64::INFINITY,
            f64::MAX,
            f64::MIN_POSITIVE,
        ] {
            assert_eq!((down(value), up(value)), (None, None), "{value}");
        }
    }
}
