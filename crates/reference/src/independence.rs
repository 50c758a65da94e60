//! Rank, choice of independent rows, and what is orthogonal to them.

use nalgebra::{DMatrix, DVector};

/// A unit row nearer than this to the span of other rows counts as one of their combinations:
/// coordinates are typed to six digits or more, and what is independent lies above 1e-4.
pub(crate) const RANK_TOLERANCE: f64 = 1e-6;

/// Rows sorted into independent ones and combinations of these.
///
/// Found by Gram–Schmidt orthogonalisation that takes the row farthest from the span of those
/// already taken; each row is brought to unit length first, so that its distance means an angle.
#[derive(Debug, Clone)]
pub(crate) struct Independence {
    /// Orthonormal basis of the rows' span.
    basis: Vec<DVector<f64>>,
    /// Independent rows, in the order they were taken.
    pub independent: Vec<usize>,
    /// The other rows.
    pub dependent: Vec<usize>,
    /// `dependent row k = Σ independent row i · coefficients[(i, k)]`, of unit rows.
    coefficients: DMatrix<f64>,
    /// Number of columns.
    width: usize,
}

impl Independence {
    /// Sorts `rows`, each of length `width`.
    pub fn of(rows: &[DVector<f64>], width: usize) -> Self {
        let unit = |row: &DVector<f64>| row.try_normalize(0.0).unwrap_or_else(|| row.clone());
        let mut rest: Vec<DVector<f64>> = rows.iter().map(unit).collect();
        let mut open: Vec<usize> = (0..rows.len()).collect();
        let mut projections = DMatrix::zeros(rows.len(), rows.len());
        let (mut basis, mut independent) = (Vec::new(), Vec::new());
        while let Some(place) = farthest(&rest, &open) {
            let row = open.remove(place);
            let mut direction = rest[row].clone();
            for known in &basis {
                direction.axpy(-direction.dot(known), known, 1.0);
            }
            projections[(basis.len(), row)] = direction.normalize_mut();
            for &other in &open {
                let along = rest[other].dot(&direction);
                projections[(basis.len(), other)] = along;
                rest[other].axpy(-along, &direction, 1.0);
            }
            basis.push(direction);
            independent.push(row);
        }
        let rank = basis.len();
        let select = |columns: &[usize]| {
            DMatrix::from_fn(rank, columns.len(), |r, c| projections[(r, columns[c])])
        };
        let coefficients = select(&independent)
            .solve_upper_triangular(&select(&open))
            .unwrap_or_else(|| DMatrix::zeros(rank, open.len()));
        Self {
            basis,
            independent,
            dependent: open,
            coefficients,
            width,
        }
    }

    /// Number of independent rows.
    pub fn rank(&self) -> usize {
        self.basis.len()
    }

    /// Orthonormal basis of the rows' span.
    pub fn basis(&self) -> &[DVector<f64>] {
        &self.basis
    }

    /// Orthonormal basis of the vectors that all rows annihilate.
    pub fn null_space(&self) -> Vec<DVector<f64>> {
        let nullity = self.width.saturating_sub(self.rank());
        let mut candidates: Vec<DVector<f64>> = (0..self.width)
            .map(|k| {
                let mut axis = DVector::zeros(self.width);
                axis[k] = 1.0;
                orthogonalise(&mut axis, &self.basis);
                axis
            })
            .collect();
        let mut null: Vec<DVector<f64>> = Vec::with_capacity(nullity);
        for _ in 0..nullity {
            let squares = candidates.iter().map(DVector::norm_squared).enumerate();
            let Some((k, _)) = squares.max_by(|a, b| a.1.total_cmp(&b.1)) else {
                break;
            };
            let mut direction = candidates[k].clone();
            direction.normalize_mut();
            orthogonalise(&mut direction, &self.basis);
            orthogonalise(&mut direction, &null);
            direction.normalize_mut();
            for candidate in &mut candidates {
                candidate.axpy(-candidate.dot(&direction), &direction, 1.0);
            }
            null.push(direction);
        }
        null
    }

    /// Rows that take part in a combination that vanishes: their multipliers are not unique.
    pub fn redundant(&self) -> Vec<usize> {
        let takes_part = |&(place, _): &(usize, &usize)| {
            let row = self.coefficients.row(place);
            row.iter().any(|c| c.abs() > RANK_TOLERANCE)
        };
        let partners = self.independent.iter().enumerate().filter(takes_part);
        let mut rows: Vec<usize> = partners.map(|(_, &row)| row).collect();
        rows.extend(&self.dependent);
        rows
    }
}

/// Place in `open` of the row with the most left of it, the first of equals; `None` where all
/// that is left is zero.
fn farthest(rest: &[DVector<f64>], open: &[usize]) -> Option<usize> {
    let mut best: Option<(usize, f64)> = None;
    for (place, &row) in open.iter().enumerate() {
        let norm = rest[row].norm();
        if norm > best.map_or(RANK_TOLERANCE, |(_, most)| most * (1.0 + 1e-9)) {
            best = Some((place, norm));
        }
    }
    best.map(|(place, _)| place)
}

fn orthogonalise(vector: &mut DVector<f64>, basis: &[DVector<f64>]) {
    for known in basis {
        vector.axpy(-vector.dot(known), known, 1.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(values: &[[f64; 3]]) -> Vec<DVector<f64>> {
        values.iter().map(|v| DVector::from_row_slice(v)).collect()
    }

    #[test]
    fn rank_and_null_space_of_a_plane() {
        let sorted = Independence::of(
            &rows(&[[2.0, 0.0, 0.0], [1.0, 3.0, 0.0], [0.0, 1.0, 0.0]]),
            3,
        );
        assert_eq!(sorted.rank(), 2);
        assert_eq!(sorted.dependent.len(), 1);
        assert_eq!(sorted.redundant().len(), 3);
        let null = sorted.null_space();
        assert_eq!(null.len(), 1);
        assert!((null[0][2].abs() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_row_apart_from_the_redundant_ones_is_not_redundant() {
        let given = rows(&[[0.0, 0.0, 5.0], [1.0, 1.0, 0.0], [2.0, 2.0, 0.0]]);
        let mut redundant = Independence::of(&given, 3).redundant();
        redundant.sort_unstable();
        assert_eq!(redundant, [1, 2]);
    }

    #[test]
    fn typed_digits_do_not_make_a_row_independent() {
        let nearly =
            |gap: f64| Independence::of(&rows(&[[1.0, 0.0, 0.0], [1.0, gap, 0.0]]), 3).rank();
        assert_eq!(nearly(8e-8), 1);
        assert_eq!(nearly(3e-4), 2);
    }

    #[test]
    fn no_rows_leave_everything_free() {
        let sorted = Independence::of(&[], 3);
        assert_eq!((sorted.rank(), sorted.null_space().len()), (0, 3));
        let zero = Independence::of(&rows(&[[0.0; 3]]), 3);
        assert_eq!((zero.rank(), zero.redundant()), (0, vec![0]));
    }
}
