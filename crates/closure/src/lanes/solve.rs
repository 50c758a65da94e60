//! The normal equations of eight poses: factored, solved, and compared with others.

use crate::lanes::lane::Lane;
use crate::lanes::pattern::Entry;
use crate::lanes::program::Program;

/// The triangle of eight poses.
#[derive(Debug, Clone)]
pub(super) struct Factor {
    triangle: Vec<Lane>,
    /// One over the diagonal, in the order of elimination.
    inverse: Vec<Lane>,
    /// Least share of a diagonal number that is left when it is its turn: squares of the sines between
    /// columns of the Jacobian.
    pub least: Lane,
}

/// The sum of an entry's products of two Jacobians.
#[inline(always)]
fn product(entry: &Entry, left: &[Lane], right: &[Lane]) -> Lane {
    let mut sum = Lane::of(entry.drive);
    for &(one, other, rows) in &entry.products {
        let pairs = left[one..one + rows]
            .iter()
            .zip(&right[other..other + rows]);
        for (a, b) in pairs {
            sum += *a * *b;
        }
    }
    sum
}

impl Factor {
    pub fn new(program: &Program) -> Self {
        Self {
            triangle: vec![Lane::ZERO; program.pattern.entries.len()],
            inverse: vec![Lane::ZERO; program.columns],
            least: Lane::ZERO,
        }
    }

    /// Cholesky's triangle of JᵀJ.
    #[inline(always)]
    pub fn factor(&mut self, program: &Program, jacobian: &[Lane]) {
        self.least = Lane::ONE;
        for (place, entry) in program.pattern.entries.iter().enumerate() {
            let whole = product(entry, jacobian, jacobian);
            let mut left = whole;
            for &(one, other) in &entry.taken {
                left -= self.triangle[one] * self.triangle[other];
            }
            self.triangle[place] = if entry.row == entry.column {
                let share = left * whole.inverse();
                // What is no number is least.
                self.least = self.least.zip(share, |a, b| if b >= a { a } else { b });
                let root = left.sqrt();
                self.inverse[entry.row] = root.inverse();
                root
            } else {
                left * self.inverse[entry.column]
            };
        }
    }

    /// `step = −(JᵀJ)⁻¹ Jᵀ r`.
    #[inline(always)]
    pub fn solve(
        &self,
        program: &Program,
        jacobian: &[Lane],
        misfits: &[Lane],
        work: &mut [Lane],
        step: &mut [Lane],
    ) {
        step.fill(Lane::ZERO);
        for (blocks, rows, row) in program.conditions() {
            for block in blocks {
                let mut sum = step[block.column];
                let pairs = jacobian[block.first..block.first + rows].iter();
                for (rate, misfit) in pairs.zip(&misfits[row..row + rows]) {
                    sum -= *rate * *misfit;
                }
                step[block.column] = sum;
            }
        }
        let first = program.rows - program.drives.len();
        for (row, column) in program.drives.iter().enumerate() {
            step[*column] -= misfits[first + row];
        }
        let pattern = &program.pattern;
        for (place, unknown) in pattern.order.iter().enumerate() {
            work[place] = step[*unknown];
        }
        for column in 0..pattern.order.len() {
            let value = work[column] * self.inverse[column];
            work[column] = value;
            for entry in pattern.starts[column] + 1..pattern.starts[column + 1] {
                work[pattern.entries[entry].row] -= self.triangle[entry] * value;
            }
        }
        for column in (0..pattern.order.len()).rev() {
            let mut value = work[column];
            for entry in pattern.starts[column] + 1..pattern.starts[column + 1] {
                value -= self.triangle[entry] * work[pattern.entries[entry].row];
            }
            work[column] = value * self.inverse[column];
        }
        for (place, unknown) in pattern.order.iter().enumerate() {
            step[*unknown] = work[place];
        }
    }

    /// `det[(J₀ᵀJ₀)⁻¹ J₀ᵀJ₁]`, this triangle being that of J₀; no number where a leading minor is not
    /// positive.
    #[inline(always)]
    pub fn orientation(
        &self,
        program: &Program,
        [start, end]: [&[Lane]; 2],
        lower: &mut [Lane],
        upper: &mut [Lane],
    ) -> Lane {
        let mut determinant = Lane::ONE;
        let mut inverse = Lane::ONE;
        for (place, entry) in program.pattern.entries.iter().enumerate() {
            let mut low = product(entry, start, end);
            for &(one, other) in &entry.taken {
                low -= lower[one] * upper[other];
            }
            lower[place] = low;
            if entry.row == entry.column {
                let before = self.inverse[entry.row];
                let share = low * before * before;
                determinant = determinant * share.map(|s| if s > 0.0 { s } else { f64::NAN });
                inverse = low.inverse();
            } else {
                let mut up = product(entry, end, start);
                for &(one, other) in &entry.taken {
                    up -= upper[one] * lower[other];
                }
                upper[place] = up * inverse;
            }
        }
        determinant
    }
}
