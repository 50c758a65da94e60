//! Planes of a table's poses: which there are, and the poses on each.

use super::error::PlotError;
use super::table::Column;

/// Coordinates of a pose, as its columns are named.
pub(super) const COORDINATES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// How far two coordinates may be apart to be the same, over the range of all.
const SAME: f64 = 1e-6;

/// How far from a plane it may be asked for, over its distance to the next.
const NEAR: f64 = 0.25;

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
    pub(super) fn new(column: &Column, size: f64) -> Self {
        let mut values: Vec<f64> = column.iter().flatten().copied().collect();
        values.sort_by(f64::total_cmp);
        let range = match (values.first(), values.last()) {
            (Some(first), Some(last)) => last - first,
            _ => 0.0,
        };
        let apart = (SAME * range).max(1e-9 * size);
        values.dedup_by(|b, a| *b - *a <= apart);
        let of_row = column.iter().map(|value| Some(nearest(&values, (*value)?)));
        Self {
            of_row: of_row.collect(),
            values,
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
    use super::{Column, Levels};

    #[test]
    fn values_that_differ_by_rounding_are_one() {
        let column = [0.1, 0.3, 0.1 + 1e-15, 0.2, 0.3, -0.1].map(Some);
        let column: Column = column.into_iter().chain([None]).collect();
        let levels = Levels::new(&column, 1.0);
        assert_eq!(levels.values, [-0.1, 0.1, 0.2, 0.3]);
        let wanted = [1, 3, 1, 2, 3, 0].map(Some).into_iter().chain([None]);
        assert!(levels.of_row.into_iter().eq(wanted));
        let noise = Levels::new(&[0.0, 1e-17, -1e-17].map(Some).into(), 0.5);
        assert_eq!(noise.values.len(), 1);
    }

    #[test]
    fn a_plane_is_asked_for_by_about_its_value() {
        let levels = Levels::new(&[0.45, 0.5, 0.55].map(Some).into(), 1.0);
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
        let only = Levels::new(&vec![Some(0.5); 3], 1.0);
        assert_eq!(only.asked("z", 0.5).unwrap(), 0);
        assert!(only.asked("z", 0.6).is_err());
    }
}
