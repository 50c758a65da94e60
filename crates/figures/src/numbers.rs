//! Numbers as they are written in figures.

/// A magnification or a difference: plain where that is short, else with an exponent.
pub(crate) fn number(value: f64) -> String {
    if value == 0.0 || (1e-3..1e6).contains(&value.abs()) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// A relative difference: in percent where it is of that order, else with an exponent.
pub(crate) fn relative(difference: f64) -> String {
    if difference >= 1e-4 {
        format!("{} %", number(rounded(100.0 * difference, 2)))
    } else if difference == 0.0 {
        "0".into()
    } else {
        format!("{difference:.1e}")
    }
}

/// A length with three digits and a unit that fits it.
pub(crate) fn metres(length: f64) -> String {
    let units = [(1.0, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm")];
    let fitting = units
        .into_iter()
        .find(|(unit, _)| rounded(length / unit, 2) >= 1.0);
    match fitting {
        _ if length == 0.0 => "0 m".into(),
        Some((unit, name)) => format!("{} {name}", number(rounded(length / unit, 2))),
        None => format!("{length:.2e} m"),
    }
}

/// A coordinate at a tick, with the decimals that ticks so far apart need.
pub(crate) fn tick(value: f64, step: f64) -> String {
    let exponent = step.log10().floor() as i32;
    let text = match exponent {
        -6..=5 => format!("{value:.*}", usize::try_from(-exponent).unwrap_or(0)),
        _ => format!("{value:.2e}"),
    };
    // The sign is a minus, not a hyphen; the one in an exponent stays as it is.
    match text.strip_prefix('-') {
        // What is rounded to zero has no sign.
        Some(zero) if !zero.contains(|c: char| ('1'..='9').contains(&c)) => zero.into(),
        Some(magnitude) => format!("−{magnitude}"),
        None => text,
    }
}

/// A number of four digits, with a minus that is none of a hyphen.
pub(crate) fn short(value: f64) -> String {
    // Zero has no sign.
    let text = number(rounded(value, 3) + 0.0);
    match text.strip_prefix('-') {
        Some(magnitude) => format!("−{magnitude}"),
        None => text,
    }
}

/// The value with so many decimals in scientific notation.
pub(crate) fn rounded(value: f64, decimals: usize) -> f64 {
    format!("{value:.decimals$e}")
        .parse()
        .expect("a number as it was written")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn magnifications() {
        assert_eq!(number(500.0), "500");
        assert_eq!(number(0.05), "0.05");
        assert_eq!(number(200_000.0), "200000");
        assert_eq!(number(2e9), "2e9");
        assert_eq!(number(5e-4), "5e-4");
    }

    #[test]
    fn differences() {
        assert_eq!(relative(0.0105), "1.05 %");
        assert_eq!(relative(0.0094), "0.94 %");
        assert_eq!(relative(2.34e-12), "2.3e-12");
        assert_eq!(relative(0.0), "0");
        assert_eq!(relative(3.0), "300 %");
    }

    #[test]
    fn lengths() {
        assert_eq!(metres(2.0841e-4), "208 µm");
        assert_eq!(metres(0.99999), "1 m");
        assert_eq!(metres(1.5e-3), "1.5 mm");
        assert_eq!(metres(0.0), "0 m");
        assert_eq!(metres(3e-14), "3.00e-14 m");
        assert_eq!(metres(12.0), "12 m");
    }

    #[test]
    fn ticks() {
        assert_eq!(tick(-0.2, 0.1), "−0.2");
        assert_eq!(tick(0.05, 0.05), "0.05");
        assert_eq!(tick(0.0, 0.5), "0.0");
        assert_eq!(tick(-0.04, 0.1), "0.0");
        assert_eq!(tick(20.0, 10.0), "20");
        assert_eq!(tick(3e-9, 1e-9), "3.00e-9");
    }
}
