//! Numbers in reports.

/// A number of six digits, as an engineer reads it.
pub fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let text = format!("{value:.5e}");
    // Its power of ten, after rounding.
    let power = text.split('e').nth(1).and_then(|power| power.parse().ok());
    match power {
        Some(power @ -2..=4) => format!("{value:.*}", (5_i32 - power) as usize),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_have_six_digits() {
        let cases = [
            (0.0, "0"),
            (1.0, "1.00000"),
            (-12.345_678_9, "-12.3457"),
            (0.05, "0.0500000"),
            (99_999.4, "99999.4"),
            (99_999.96, "1.00000e5"),
            (9.999_999_9, "10.0000"),
            (9.999_999_9e-3, "0.0100000"),
            (f64::NAN, "NaN"),
            (123_456_789.0, "1.23457e8"),
            (-1.5e-7, "-1.50000e-7"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }
}
