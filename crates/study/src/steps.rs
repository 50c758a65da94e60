//! Steps of derivatives that are differences of designs:
//! `(f(p − 2h) − 8 f(p − h) + 8 f(p + h) − f(p + 2h)) / 12 h`.

/// Steps from the value, over h, with the weights of what is found there.
pub(crate) const STEPS: [(f64, f64); 4] = [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)];
/// The step h over the value: what it leaves out goes with its fourth power, rounding with its inverse.
const STEP: f64 = 5e-4;
/// A value counts as at least this share of the mechanism's size, so that one that is zero has a step.
const LEAST: f64 = 0.02;

/// The step h for a value of a mechanism of this size \[m\].
pub(crate) fn step_of(value: f64, size: f64) -> f64 {
    STEP * value.abs().max(LEAST * size)
}
