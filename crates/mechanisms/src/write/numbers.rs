//! Numbers, and fields that hold them.

use nalgebra::Vector3;

/// `(written, …, name: value, …)`.
pub(super) fn fields<'a>(
    mut written: Vec<String>,
    more: impl IntoIterator<Item = (&'a str, f64)>,
) -> String {
    let more = more.into_iter();
    written.extend(more.map(|(name, value)| format!("{name}: {}", number(value))));
    format!("({})", written.join(", "))
}

/// `(x, y, z)`.
pub(super) fn vector(v: &Vector3<f64>) -> String {
    format!("({}, {}, {})", number(v[0]), number(v[1]), number(v[2]))
}

/// The shortest number that reads back to the same double.
pub(super) fn number(value: f64) -> String {
    // No sign of zero.
    format!("{:?}", value + 0.0)
}
