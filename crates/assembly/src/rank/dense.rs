//! Linear conditions solved by rank: Gauss–Jordan elimination with complete pivoting.
//!
//! It closes loops (dependent coordinates from independent ones), counts mobility, finds motions
//! without energy and joint forces. Redundant rows are dropped and counted. After trees are formed
//! a redundant row is pure rounding, so rank is judged against the unreduced conditions: callers
//! give unit rows with lengths over the mechanism's size (the book, "Diagnosis").

use nalgebra::{DMatrix, DVector};

/// Pivots up to this are zero: coordinates are typed to six digits or more.
pub(crate) const RANK_TOLERANCE: f64 = 1e-6;
/// Pivots in this range leave a doubt about the rank that the user should know of.
pub(crate) const DOUBTFUL: std::ops::Range<f64> = 1e-12..1e-4;
/// While a pivot this large is left outside the spared coordinates, those are spared.
pub(super) const SPARING: f64 = 1e-3;

/// The solutions of `conditions · x = right side`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Elimination {
    /// Coordinates that may be chosen freely, ascending.
    pub independent: Vec<usize>,
    /// All coordinates from the independent ones: `x = map · x[independent]` without right side.
    /// Its columns are a basis of the null space.
    pub map: DMatrix<f64>,
    /// The solution whose independent coordinates are zero.
    pub particular: DVector<f64>,
    /// A pivot, taken or left, between zero and not zero.
    pub doubtful: Option<f64>,
}

impl Elimination {
    /// Solves `conditions · x = 0`; the first `spared` coordinates become dependent only where
    /// nothing else can.
    pub fn new(conditions: DMatrix<f64>, spared: usize) -> Self {
        let height = conditions.nrows();
        Self::with_right_side(conditions, DVector::zeros(height), spared)
    }

    /// Solves `conditions · x = 0`, doubtful pivots taken as zero.
    pub fn without_doubtful(conditions: DMatrix<f64>) -> Self {
        let height = conditions.nrows();
        Self::solve(conditions, DVector::zeros(height), 0, DOUBTFUL.end)
    }

    /// Solves `conditions · x = right_side`, whose inconsistent part is left out.
    pub fn with_right_side(
        conditions: DMatrix<f64>,
        right_side: DVector<f64>,
        spared: usize,
    ) -> Self {
        Self::solve(conditions, right_side, spared, RANK_TOLERANCE)
    }

    fn solve(
        conditions: DMatrix<f64>,
        mut right_side: DVector<f64>,
        spared: usize,
        tolerance: f64,
    ) -> Self {
        let columns = conditions.ncols();
        let mut rows: Vec<Row> = conditions
            .row_iter()
            .map(|row| Row::new(row.iter().copied().collect(), spared))
            .collect();
        let mut rows_left: Vec<usize> = (0..rows.len()).collect();
        let mut pivots: Vec<(usize, usize)> = Vec::new();
        let mut doubtful: Option<f64> = None;
        while let Some((row, column)) = choose(&rows, &rows_left) {
            let size = rows[row].values[column].abs();
            if DOUBTFUL.contains(&size) {
                doubtful = Some(doubtful.map_or(size, |d| d.max(size)));
            }
            if size <= tolerance {
                break;
            }
            let pivot = rows[row].values[column];
            right_side[row] /= pivot;
            let mut entries = Vec::new();
            for (c, value) in rows[row].values.iter_mut().enumerate() {
                *value /= pivot;
                if *value != 0.0 && c != column {
                    entries.push((c, *value));
                }
            }
            rows_left.retain(|r| *r != row);
            pivots.push((row, column));
            for r in (0..rows.len()).filter(|r| *r != row) {
                let factor = rows[r].values[column];
                if factor != 0.0 {
                    for (c, value) in &entries {
                        rows[r].values[*c] -= factor * value;
                    }
                    rows[r].values[column] = 0.0;
                    rows[r].find_largest(spared);
                    right_side[r] -= factor * right_side[row];
                }
            }
        }
        let mut independent: Vec<usize> = (0..columns).collect();
        independent.retain(|c| pivots.iter().all(|(_, column)| column != c));
        let mut map = DMatrix::zeros(columns, independent.len());
        let mut particular = DVector::zeros(columns);
        for &(row, column) in &pivots {
            particular[column] = right_side[row];
            for (k, &c) in independent.iter().enumerate() {
                map[(column, k)] = -rows[row].values[c];
            }
        }
        for (k, &c) in independent.iter().enumerate() {
            map[(c, k)] = 1.0;
        }
        Self {
            independent,
            map,
            particular,
            doubtful,
        }
    }

    /// Rank of the conditions.
    pub fn rank(&self) -> usize {
        self.map.nrows() - self.independent.len()
    }

    /// Columns of the null space's basis.
    pub fn null_space(&self) -> Vec<DVector<f64>> {
        self.map.column_iter().map(|c| c.into_owned()).collect()
    }
}

/// A condition and its largest entries.
struct Row {
    values: Vec<f64>,
    /// Column and size of the largest entry outside the spared columns, and among them.
    largest: [(usize, f64); 2],
}

impl Row {
    fn new(values: Vec<f64>, spared: usize) -> Self {
        let mut row = Self {
            values,
            largest: [(0, 0.0); 2],
        };
        row.find_largest(spared);
        row
    }

    /// Finds the largest entries anew: of equals (to 1e-9), the first.
    fn find_largest(&mut self, spared: usize) {
        self.largest = [(0, 0.0); 2];
        for (c, value) in self.values.iter().enumerate() {
            let target = &mut self.largest[usize::from(c < spared)];
            if value.abs() > target.1 * (1.0 + 1e-9) {
                *target = (c, value.abs());
            }
        }
    }
}

/// Row and column of the largest entry left, in the first row of equals (to 1e-9); among the
/// spared columns only where the others have none above [`SPARING`]. `None` where all are zero.
///
/// A row without a pivot has no entry in the columns of the pivots, so its largest entry stands.
fn choose(rows: &[Row], rows_left: &[usize]) -> Option<(usize, usize)> {
    let mut best = [(0, 0, 0.0); 2];
    for &r in rows_left {
        for (target, &(c, size)) in best.iter_mut().zip(&rows[r].largest) {
            if size > target.2 * (1.0 + 1e-9) {
                *target = (r, c, size);
            }
        }
    }
    let [other, spare] = best;
    let take_spare = other.2 <= SPARING && spare.2 > other.2;
    let (row, column, size) = if take_spare { spare } else { other };
    (size > 0.0).then_some((row, column))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn redundant_rows_are_dropped() {
        let rows = [1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 0.0, 1.0, 1.0];
        let a = DMatrix::from_row_slice(3, 3, &rows);
        let solved = Elimination::new(a.clone(), 0);
        assert_eq!(solved.independent.len(), 1);
        assert!((a * &solved.map).amax() < 1e-14);
    }

    #[test]
    fn rounding_is_no_condition() {
        let a = DMatrix::from_row_slice(2, 2, &[1.0, -1.0, 3e-16, 2e-16]);
        assert_eq!(Elimination::new(a, 0).independent.len(), 1);
    }

    #[test]
    fn output_coordinates_are_spared() {
        let a = DMatrix::from_row_slice(2, 3, &[1.0, 0.5, 0.2, -1.0, 0.1, 0.4]);
        assert_eq!(Elimination::new(a, 1).independent, [0]);
        let held = DMatrix::from_row_slice(1, 2, &[1.0, 0.0]);
        assert_eq!(Elimination::new(held, 1).independent, [1]);
    }

    #[test]
    fn a_right_side_is_met() {
        let a = DMatrix::from_row_slice(3, 3, &[1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 0.0, 1.0, 1.0]);
        let b = DVector::from_row_slice(&[6.0, 12.0, 2.0]);
        let solved = Elimination::with_right_side(a.clone(), b.clone(), 0);
        assert_eq!(solved.rank(), 2);
        assert!((a * solved.particular - b).amax() < 1e-14);
    }

    #[test]
    fn a_pivot_between_zero_and_not_zero_is_doubtful() {
        let a = DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 0.0, 3e-8]);
        let solved = Elimination::new(a, 0);
        assert_eq!((solved.rank(), solved.doubtful), (1, Some(3e-8)));
    }
}
