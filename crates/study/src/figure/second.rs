//! A second method in a figure, and how far it is off.

/// Name of the second method in the figures.
pub(super) const SECOND: &str = "reference solver";

/// The largest difference between two lists of displacements over the largest displacement in
/// either, over `least` where all are smaller; zero where nothing moves.
pub(super) fn difference(ours: &[[f64; 3]], others: &[[f64; 3]], least: f64) -> f64 {
    difference_in(ours, others, ours, least)
}

/// The same over the largest displacement of the second list or of `all`.
pub(super) fn difference_in(
    ours: &[[f64; 3]],
    others: &[[f64; 3]],
    all: &[[f64; 3]],
    least: f64,
) -> f64 {
    let norm = |v: &[f64; 3]| v[0].hypot(v[1]).hypot(v[2]);
    let largest = all.iter().chain(others).map(norm).fold(least, f64::max);
    let pairs = ours.iter().zip(others);
    let apart = pairs
        .map(|(a, b)| norm(&[a[0] - b[0], a[1] - b[1], a[2] - b[2]]))
        .fold(0.0, f64::max);
    if largest == 0.0 { 0.0 } else { apart / largest }
}

#[cfg(test)]
mod tests {
    use super::difference;

    #[test]
    fn the_difference_is_relative_to_the_largest_displacement() {
        let ours = [[0.0, 3.0, 4.0], [1.0, 0.0, 0.0]];
        let others = [[0.0, 3.0, 4.0], [1.0, 0.5, 0.0]];
        assert_eq!(difference(&ours, &others, 1.0), 0.1);
        assert_eq!(difference(&[[0.0; 3]], &[[0.0; 3]], 0.0), 0.0);
        assert_eq!(difference(&[[0.0; 3]], &[[0.0, 2.0, 0.0]], 0.0), 1.0);
        assert_eq!(difference(&[[0.0; 3]], &[[0.0, 2.0, 0.0]], 4.0), 0.5);
    }
}
