//! Stiffness and flexibility of a chain with elastic joints in 32 digits, without the recursions
//! of the crate's own forms.

use hyperstat_elements::subassembly::ElasticJoint;
use nalgebra::{DMatrix, Matrix6, Vector3};

use super::double_double::DoubleDouble;
use super::random::Link;

type Matrix = DMatrix<f64>;

/// A dense matrix of [`DoubleDouble`], by rows.
#[derive(Clone)]
struct Extended(Vec<Vec<DoubleDouble>>);

impl Extended {
    fn zeros(rows: usize, columns: usize) -> Self {
        Self(vec![vec![DoubleDouble::ZERO; columns]; rows])
    }

    fn identity(size: usize) -> Self {
        let mut out = Self::zeros(size, size);
        for k in 0..size {
            out.0[k][k] = 1.0.into();
        }
        out
    }

    fn from6(matrix: &Matrix6<f64>) -> Self {
        let row = |i| (0..6).map(|j| matrix[(i, j)].into()).collect();
        Self((0..6).map(row).collect())
    }

    /// u(p + r) = M u(p).
    fn transport(r: &Vector3<f64>) -> Self {
        let mut out = Self::identity(6);
        for (i, j, value) in [
            (0, 4, r.z),
            (0, 5, -r.y),
            (1, 3, -r.z),
            (1, 5, r.x),
            (2, 3, r.y),
            (2, 4, -r.x),
        ] {
            out.0[i][j] = value.into();
        }
        out
    }

    fn transposed(&self) -> Self {
        let row = |i: usize| self.0.iter().map(|r| r[i]).collect();
        Self((0..self.0[0].len()).map(row).collect())
    }

    fn times(&self, other: &Self) -> Self {
        let mut out = Self::zeros(self.0.len(), other.0[0].len());
        for (out_row, row) in out.0.iter_mut().zip(&self.0) {
            for (factor, other_row) in row.iter().zip(&other.0) {
                for (entry, value) in out_row.iter_mut().zip(other_row) {
                    *entry = *entry + *factor * *value;
                }
            }
        }
        out
    }

    fn add_block(&mut self, row: usize, column: usize, block: &Self) {
        for (i, block_row) in block.0.iter().enumerate() {
            for (j, value) in block_row.iter().enumerate() {
                let entry = &mut self.0[row + i][column + j];
                *entry = *entry + *value;
            }
        }
    }

    /// self⁻¹ · right, by elimination with partial pivoting.
    fn solve(mut self, mut right: Self) -> Self {
        let size = self.0.len();
        for column in 0..size {
            let size_at = |row: &usize| self.0[*row][column].to_f64().abs();
            let pivot = (column..size)
                .max_by(|a, b| size_at(a).total_cmp(&size_at(b)))
                .unwrap();
            self.0.swap(column, pivot);
            right.0.swap(column, pivot);
            for row in 0..size {
                if row == column {
                    continue;
                }
                let factor = self.0[row][column] / self.0[column][column];
                for k in column..size {
                    self.0[row][k] = self.0[row][k] - factor * self.0[column][k];
                }
                for k in 0..right.0[0].len() {
                    right.0[row][k] = right.0[row][k] - factor * right.0[column][k];
                }
            }
        }
        for (row, values) in right.0.iter_mut().enumerate() {
            for value in values {
                *value = *value / self.0[row][row];
            }
        }
        right
    }

    fn rounded(&self) -> Matrix {
        Matrix::from_fn(self.0.len(), self.0[0].len(), |i, j| self.0[i][j].to_f64())
    }
}

/// Stiffness with node 0 held of a chain with elastic joints at its nodes, right to the last
/// digits of a double.
pub fn stiffness(links: &[Link], joints: &[ElasticJoint]) -> Matrix {
    let compliances: Vec<_> = links
        .iter()
        .map(|link| Extended::from6(&link.stiffness()).solve(Extended::identity(6)))
        .collect();
    let flexibility = summed(links, &compliances, joints);
    let size = flexibility.0.len();
    flexibility.solve(Extended::identity(size)).rounded()
}

/// Flexibility with node 0 held of a chain with elastic joints at its nodes, right to the last
/// digits of a double.
pub fn flexibility(links: &[Link], joints: &[ElasticJoint]) -> Matrix {
    let compliance = |link: &Link| Extended::from6(&link.compliance());
    let compliances: Vec<_> = links.iter().map(compliance).collect();
    summed(links, &compliances, joints).rounded()
}

/// Every compliance is carried from its own place to every pair of nodes.
fn summed(links: &[Link], compliances: &[Extended], joints: &[ElasticJoint]) -> Extended {
    let count = links.len();
    let mut places = vec![Vector3::zeros()];
    for link in links {
        places.push(places[places.len() - 1] + link.span());
    }
    let compliance = |joint: &ElasticJoint| {
        let factor = Extended::from6(&joint.factor());
        factor.times(&factor.transposed())
    };
    let mut f = Extended::zeros(6 * count, 6 * count);
    // (place, compliance, nodes that it moves)
    let mut springs = vec![(0, compliance(&joints[0]), 1..=count)];
    for node in 1..=count {
        springs.push((node, compliance(&joints[node]), node..=node));
        springs.push((node, compliances[node - 1].clone(), node..=count));
    }
    for (place, compliance, nodes) in springs {
        for row in nodes.clone() {
            for column in nodes.clone() {
                let carry = |node: usize| Extended::transport(&(places[node] - places[place]));
                let block = carry(row)
                    .times(&compliance)
                    .times(&carry(column).transposed());
                f.add_block(6 * (row - 1), 6 * (column - 1), &block);
            }
        }
    }
    f
}

/// Largest |a − b| of an entry over √(b_ii b_jj), the measure that is free of units.
pub fn scaled_error(a: &Matrix, b: &Matrix) -> f64 {
    assert_eq!(a.shape(), b.shape());
    let mut largest = 0f64;
    for i in 0..b.nrows() {
        for j in 0..b.ncols() {
            let error = (a[(i, j)] - b[(i, j)]).abs() / (b[(i, i)] * b[(j, j)]).sqrt();
            // Keeps NaN, which f64::max would drop.
            largest = if error <= largest { largest } else { error };
        }
    }
    largest
}
