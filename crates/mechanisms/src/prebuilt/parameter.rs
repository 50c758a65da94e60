//! Checks of the parameters of prebuilt mechanisms.

use super::ParameterError;

/// A length (m) that must not vanish.
pub(super) fn positive_length(field: &'static str, value: f64) -> Result<(), ParameterError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(ParameterError {
        field,
        message: format!("{value} m is not a length above zero"),
        help: Some("give a finite length in metres, such as 0.3".into()),
    })
}

/// A radius (m), which may vanish.
pub(super) fn radius(field: &'static str, value: f64) -> Result<(), ParameterError> {
    if value.is_finite() && value >= 0.0 {
        return Ok(());
    }
    Err(ParameterError {
        field,
        message: format!("{value} m is not a radius of zero or more"),
        help: Some("give a finite radius in metres, such as 0.25".into()),
    })
}

/// A joint stiffness; `None` is rigid.
pub(super) fn stiffness(field: &'static str, value: Option<f64>) -> Result<(), ParameterError> {
    match value {
        Some(k) if !(k.is_finite() && k >= 0.0) => Err(ParameterError {
            field,
            message: format!("a stiffness of {k} is not a finite number, zero or more"),
            help: Some("leave the direction out for a rigid one".into()),
        }),
        _ => Ok(()),
    }
}

/// A number of elements a segment is divided into.
pub(super) fn elements(field: &'static str, value: usize) -> Result<(), ParameterError> {
    const MOST: usize = 1_000_000;
    if (1..=MOST).contains(&value) {
        return Ok(());
    }
    Err(ParameterError {
        field,
        message: format!("{value} elements a segment are not between 1 and {MOST}"),
        help: Some("1 is exact for straight beams loaded at their ends".into()),
    })
}
