//! Coordinates with the digits that tell them apart.

/// A value with the digits that it has among others of its kind, ascending.
pub(crate) fn digits(value: f64, all: &[f64]) -> String {
    let largest = all
        .iter()
        .fold(0.0_f64, |most, value| most.max(value.abs()));
    let steps = all.windows(2).map(|pair| pair[1] - pair[0]);
    let step = steps
        .filter(|step| *step > 0.0)
        .fold(f64::INFINITY, f64::min);
    let resolution = (1e-5 * largest).min(1e-2 * step);
    if !(resolution > 0.0 && resolution.is_finite()) {
        return format!("{}", value + 0.0);
    }
    let decimals = (-resolution.log10()).ceil();
    if !(0.0..=15.0).contains(&decimals) {
        let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
        return match decimals < 0.0 {
            true => format!("{rounded}"),
            false => format!("{rounded:e}"),
        };
    }
    let text = format!("{value:.*}", decimals as usize);
    // What is rounded to zero has no sign, and a number no zeros at its end.
    let number: f64 = text.parse().unwrap_or(value);
    format!("{}", number + 0.0)
}
