//! Planes of a table's poses: which there are, and the poses on each.

use crate::digits::digits;
use crate::plot_error::PlotError;

/// How far two coordinates may be apart to be the same, over the range of all.
const SAME: f64 = 1e-6;

/// How far from a plane it may be asked for, over its distance to the next.
const NEAR: f64 = 0.25;

/// A value this small over the size of the whole is the rounding of zero.
const NOTHING: f64 = 1e-9;

/// The different values of a coordinate, and which of them each row has.
#[derive(Debug, Clone)]
pub(super) struct Levels {
    /// Ascending.
    pub(super) values: Vec<f64>,
    /// `None` where it is not known.
    pub(super) of_row: Vec<Option<usize>>,
}

impl Levels {
    /// Sorts out values, of which those that differ by rounding are one. `size` is that of the
    /// whole workspace.
    pub(super) fn new(column: &[Option<f64>], size: f64) -> Self {
        // The rounding of zero is zero.
        let clean = |value: f64| {
            if value.abs() <= NOTHING * size {
                0.0
            } else {
                value
            }
        };
        let mut values: Vec<f64> = column.iter().copied().flatten().map(clean).collect();
        values.sort_by(f64::total_cmp);
        let range = match (values.first(), values.last()) {
            (Some(first), Some(last)) => last - first,
            _ => 0.0,
        };
        let apart = (SAME * range).max(NOTHING * size);
        values.dedup_by(|b, a| *b - *a <= apart);
        let of_row = column
            .iter()
            .map(|value| value.map(|value| nearest(&values, value)));
        Self {
            of_row: of_row.collect(),
            values,
        }
    }

    /// Whether all of its values are equally far from the next.
    pub(super) fn even(&self) -> bool {
        let steps = || self.values.windows(2).map(|pair| pair[1] - pair[0]);
        let least = steps().fold(f64::INFINITY, f64::min);
        let most = steps().fold(0.0, f64::max);
        most - least <= 1e-3 * most
    }

    /// One of the values with the digits it has: six of the largest, or as many as tell it from
    /// the next.
    pub(super) fn label(&self, level: usize) -> String {
        let label = digits(self.values[level], &self.values);
        // A minus, not a hyphen.
        match label.strip_prefix('-') {
            Some(magnitude) => format!("−{magnitude}"),
            None => label,
        }
    }

    /// The place of the value nearest to what is asked for, where it is near enough to be meant.
    pub(super) fn asked(&self, axis: &str, value: f64) -> Result<usize, PlotError> {
        let place = nearest(&self.values, value);
        let unknown = || PlotError::NoPlane {
            axis: axis.into(),
            value,
            known: self.values.clone(),
        };
        let found = *self.values.get(place).ok_or_else(unknown)?;
        let beside = [place.checked_sub(1), place.checked_add(1)];
        let others = beside
            .into_iter()
            .flatten()
            .filter_map(|k| self.values.get(k));
        let next = others.map(|other| (other - found).abs());
        let next = next.fold(f64::INFINITY, f64::min);
        let next = if next.is_finite() {
            next
        } else {
            0.04 * found.abs()
        };
        if (found - value).abs() <= (NEAR * next).max(1e-12) {
            Ok(place)
        } else {
            Err(unknown())
        }
    }
}

/// Place of the value nearest to another in an ascending list.
fn nearest(values: &[f64], value: f64) -> usize {
    let above = values.partition_point(|known| *known < value);
    match above.checked_sub(1) {
        Some(below) if above == values.len() || value - values[below] <= values[above] - value => {
            below
        }
        _ => above,
    }
}

#[cfg(test)]
mod tests {
    use super::Levels;
    use crate::digits::digits;

    #[test]
    fn values_that_differ_by_rounding_are_one() {
        let column = [0.1, 0.3, 0.1 + 1e-15, 0.2, 0.3, -0.1].map(Some);
        let levels = Levels::new(&column, 1.0);
        assert_eq!(levels.values, [-0.1, 0.1, 0.2, 0.3]);
        assert_eq!(levels.of_row, [1, 3, 1, 2, 3, 0].map(Some));
        let noise = Levels::new(&[0.0, 1e-17, -1e-17].map(Some), 0.5);
        assert_eq!(noise.values.len(), 1);
        let unknown = Levels::new(&[Some(1.0), None, Some(2.0)], 2.0);
        assert_eq!(unknown.of_row, [Some(0), None, Some(1)]);
        assert!(levels.label(0) == "−0.1" && !levels.even());
    }

    #[test]
    fn values_are_told_with_the_digits_they_have() {
        let label = |value: f64, size| Levels::new(&[Some(value)], size).label(0);
        // What loop closure leaves of zero.
        assert_eq!(label(-0.000_000_000_000_000_077_998_9, 0.5), "0");
        assert_eq!(label(0.1 + 0.2, 0.5), "0.3");
        assert_eq!(label(0.475, 0.5), "0.475");
        assert_eq!(label(-0.25, 1.0), "−0.25");
        assert_eq!(label(1234.5, 1234.5), "1234.5");
        let third = digits(1.0 / 3.0, &[0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0]);
        assert_eq!(third, "0.33333");
        // As many as tell neighbours apart.
        assert_eq!(digits(1000.001, &[1000.0, 1000.001]), "1000.001");
        assert_eq!(digits(1e-30, &[1e-30, 2e-30]), "1e-30");
    }

    #[test]
    fn a_plane_is_asked_for_by_about_its_value() {
        let levels = Levels::new(&[0.45, 0.5, 0.55].map(Some), 1.0);
        assert_eq!(levels.asked("z", 0.5).unwrap(), 1);
        assert_eq!(levels.asked("z", 0.51).unwrap(), 1);
        for value in [0.47, 0.6, 0.3] {
            let error = levels.asked("z", value).unwrap_err();
            assert_eq!(
                (error.to_string(), error.help().unwrap()),
                (
                    format!("there is no plane z = {value}"),
                    "there are planes at z = 0.45, 0.5, 0.55".to_string()
                )
            );
        }
        let only = Levels::new(&[Some(0.5); 3], 1.0);
        assert_eq!(only.asked("z", 0.5).unwrap(), 0);
        assert!(only.asked("z", 0.6).is_err());
    }
}
