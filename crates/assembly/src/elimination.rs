//! Loop elimination: conditions among the coordinates of one tree, solved by rank.
//!
//! Redundant rows are dropped and counted. After the trees are formed a redundant row is pure
//! rounding, so rank is judged against the unreduced conditions: unit rows, lengths over the
//! mechanism's size (paper-notes, "Rank of closing rows").

use nalgebra::DMatrix;

use crate::kinematics::RANK_TOLERANCE;

/// While a pivot this large is left outside the output's coordinates, those are spared.
const SPARING: f64 = 1e-3;

/// Dependent coordinates as a linear function of the independent ones.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Elimination {
    /// Independent coordinates, ascending.
    pub independent: Vec<usize>,
    /// All coordinates from the independent ones: `x = map · x[independent]`.
    pub map: DMatrix<f64>,
}

impl Elimination {
    /// Solves `conditions · x = 0` for as many coordinates as the rank allows; the first
    /// `spared` coordinates (the output's) become dependent only where nothing else can.
    pub fn new(mut conditions: DMatrix<f64>, spared: usize) -> Self {
        let (rows, columns) = conditions.shape();
        let mut pivots: Vec<(usize, usize)> = Vec::new();
        let mut row_used = vec![false; rows];
        let mut column_used = vec![false; columns];
        while pivots.len() < rows.min(columns) {
            let mut best = (0, 0, 0.0);
            let mut best_spared = (0, 0, 0.0);
            for c in (0..columns).filter(|c| !column_used[*c]) {
                for r in (0..rows).filter(|r| !row_used[*r]) {
                    let size = conditions[(r, c)].abs();
                    let target = if c < spared {
                        &mut best_spared
                    } else {
                        &mut best
                    };
                    if size > target.2 * (1.0 + 1e-9) {
                        *target = (r, c, size);
                    }
                }
            }
            let take_spared = best.2 <= SPARING && best_spared.2 > best.2;
            let (row, column, size) = if take_spared { best_spared } else { best };
            if size <= RANK_TOLERANCE {
                break;
            }
            let pivot = conditions.row(row) / conditions[(row, column)];
            for r in (0..rows).filter(|r| *r != row) {
                let factor = conditions[(r, column)];
                if factor != 0.0 {
                    let mut target = conditions.row_mut(r);
                    target -= &pivot * factor;
                    conditions[(r, column)] = 0.0;
                }
            }
            conditions.row_mut(row).copy_from(&pivot);
            row_used[row] = true;
            column_used[column] = true;
            pivots.push((row, column));
        }
        let independent: Vec<usize> = (0..columns).filter(|c| !column_used[*c]).collect();
        let mut map = DMatrix::zeros(columns, independent.len());
        for (k, &c) in independent.iter().enumerate() {
            map[(c, k)] = 1.0;
            for &(row, column) in &pivots {
                map[(column, k)] = -conditions[(row, c)];
            }
        }
        Self { independent, map }
    }
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
}
