//! What sparse elimination says of its columns: those with a pivot by those without, solutions of a
//! right side, and which columns the conditions leave open.

use super::dense::RANK_TOLERANCE;
use super::sparse::{CANCELLED, SparseElimination, SparseVector};
use crate::error::SolveError;
use crate::room;
use crate::room::MOST_NUMBERS;

/// Trials that tell open columns from determined ones.
const TRIALS: usize = 3;

/// All columns by those without a pivot.
#[derive(Debug)]
pub(crate) struct SparseMap {
    /// The columns without a pivot, ascending.
    pub independent: Vec<usize>,
    /// Of every column, its weights by the places in `independent`, ascending.
    pub rows: Vec<SparseVector>,
}

impl SparseElimination {
    /// All columns by those without a pivot; `what` has them.
    ///
    /// # Errors
    /// Too many weights.
    pub fn map(&self, what: &'static str) -> Result<SparseMap, SolveError> {
        let mut has_pivot = vec![false; self.columns];
        for column in self.pivot_columns() {
            has_pivot[column] = true;
        }
        let independent: Vec<usize> = (0..self.columns).filter(|c| !has_pivot[*c]).collect();
        let mut rows: Vec<SparseVector> = vec![Vec::new(); self.columns];
        for (place, &column) in independent.iter().enumerate() {
            rows[column].push((place, 1.0));
        }
        let mut sums = vec![0.0; independent.len()];
        let mut seen = vec![false; independent.len()];
        let mut held = independent.len();
        for (&(_, column), upper) in self.pivots.iter().zip(&self.upper).rev() {
            let mut touched = Vec::new();
            for (other, value) in upper {
                for &(place, weight) in &rows[*other] {
                    sums[place] -= value * weight;
                    if !std::mem::replace(&mut seen[place], true) {
                        touched.push(place);
                    }
                }
            }
            touched.sort_unstable();
            let mut row = Vec::with_capacity(touched.len());
            for place in touched {
                seen[place] = false;
                let sum = std::mem::take(&mut sums[place]);
                if sum.abs() > CANCELLED {
                    row.push((place, sum));
                }
            }
            held += row.len();
            room::check(what, held, MOST_NUMBERS / 4)?;
            rows[column] = row;
        }
        Ok(SparseMap { independent, rows })
    }

    /// The solution of `rows · x = right_side` whose columns without a pivot are zero; what the
    /// redundant rows contradict is left out.
    pub fn particular(&self, right_side: &[f64]) -> Vec<f64> {
        let mut reduced: Vec<f64> = Vec::with_capacity(self.pivots.len());
        for (row, _) in &self.pivots {
            let taken = self.lower[*row].iter();
            let taken: f64 = taken.map(|(k, multiple)| multiple * reduced[*k]).sum();
            reduced.push(right_side[*row] - taken);
        }
        for (value, pivot) in reduced.iter_mut().zip(&self.values) {
            *value /= pivot;
        }
        let mut solution = vec![0.0; self.columns];
        self.substitute(&reduced, &mut solution);
        solution
    }

    /// Of every column, whether the conditions leave it open: it has no pivot, or depends on one
    /// that has none. The columns without a pivot are set to numbers of about 1, unlike in each of
    /// some trials, and an open column is not zero in all of them.
    pub fn open(&self) -> Vec<bool> {
        let mut open = vec![true; self.columns];
        for column in self.pivot_columns() {
            open[column] = false;
        }
        let free = open.clone();
        let at_rest = vec![0.0; self.pivots.len()];
        let mut state = 1_u64;
        for _ in 0..TRIALS {
            let mut solution = vec![0.0; self.columns];
            for (value, _) in solution.iter_mut().zip(&free).filter(|(_, free)| **free) {
                // Knuth's MMIX generator: from 1/2 to 3/2.
                state = state.wrapping_mul(6_364_136_223_846_793_005);
                state = state.wrapping_add(1_442_695_040_888_963_407);
                *value = 0.5 + (state >> 11) as f64 / (1_u64 << 53) as f64;
            }
            self.substitute(&at_rest, &mut solution);
            for (open, value) in open.iter_mut().zip(&solution) {
                *open |= value.abs() > RANK_TOLERANCE;
            }
        }
        open
    }

    /// Fills in the columns with pivots from the `reduced` right side and the others' values.
    fn substitute(&self, reduced: &[f64], solution: &mut [f64]) {
        let pivots = self.pivots.iter().zip(&self.upper).zip(reduced);
        for ((&(_, column), upper), value) in pivots.rev() {
            let sum: f64 = upper.iter().map(|(c, v)| v * solution[*c]).sum();
            solution[column] = value - sum;
        }
    }
}
