//! The freedoms of a mechanism at home, those that it has and those that it nearly has.

use nalgebra::{DMatrix, SymmetricEigen};

use super::sample::{self, Basis};
use crate::equations::{Goal, System};

/// Singular values up to this are those of exact freedoms, of geometry in doubles.
const EXACT: f64 = 1e-11;
/// How many times the next singular value is larger than the last of the freedoms.
const GAP: f64 = 4.0;
/// The same where nobody doubts it.
const CLEAR: f64 = 30.0;
/// Singular values above this are never those of freedoms.
const LARGE: f64 = 0.03;
/// Loops that stay open by less are closed.
pub(super) const CLOSED: f64 = 1e-11;

/// Motions of the joints at home, and how much each breaks the conditions of the loops.
#[derive(Debug)]
pub(super) struct Freedoms {
    /// Singular values of the conditions, the least first, one a column.
    pub values: Vec<f64>,
    /// The motions, a column each, orthonormal.
    pub motions: DMatrix<f64>,
    /// Entries of the conditions that are not zero.
    entries: usize,
}

impl Freedoms {
    /// Of the system's home.
    pub fn of(system: &System) -> Self {
        let jacobian = system
            .equations(&system.linkage.home(), &Goal::default())
            .jacobian;
        let entries = jacobian.iter().filter(|entry| **entry != 0.0).count();
        let (values, motions) = motions(&jacobian);
        Self {
            values,
            motions,
            entries,
        }
    }

    /// Number of motions that break no condition.
    pub fn exact(&self) -> usize {
        self.values.iter().filter(|value| **value <= EXACT).count()
    }

    /// Numbers of freedoms that geometry with this rounding may have been meant to have, the largest
    /// first; none where all that it has are finite, and no others are near.
    pub fn candidates(&self, system: &System, rounding: f64) -> Vec<usize> {
        let largest = (2.0 * rounding * (self.entries as f64).sqrt()).min(LARGE);
        let exact = self.exact();
        let is_near = |count: &usize| {
            let last = self.values[count - 1];
            let next = self.values.get(*count).copied().unwrap_or(f64::INFINITY);
            last <= largest && next > GAP * last
        };
        let near = (exact + 1..=self.values.len()).rev().filter(is_near);
        let mut wanted: Vec<usize> = near.collect();
        if exact > 0 && rounding > EXACT && !self.are_finite(system, exact) {
            wanted.push(exact);
        }
        wanted
    }

    /// Whether the last of so many freedoms is far from what is none.
    pub fn is_clear(&self, count: usize) -> bool {
        let next = self.values.get(count).copied().unwrap_or(f64::INFINITY);
        count
            .checked_sub(1)
            .is_some_and(|last| next > CLEAR * self.values[last])
    }

    /// Whether the loops stay closed along this many of the freedoms.
    pub fn are_finite(&self, system: &System, count: usize) -> bool {
        const TRIED: usize = 3;
        let basis = Basis::new(&self.motions, count);
        sample::opening(system, &basis, 0..TRIED).is_some_and(|open| open <= CLOSED)
    }
}

/// Singular values, the least first, and right singular vectors as columns. Eigenvalues of JᵀJ tell only
/// those above 1e-8 of the largest apart: the motions below are taken by themselves, again and again.
fn motions(jacobian: &DMatrix<f64>) -> (Vec<f64>, DMatrix<f64>) {
    const TOLD: f64 = 1e-6;
    const NOTHING: f64 = 1e-15;
    let columns = jacobian.ncols();
    let mut motions = DMatrix::identity(columns, columns);
    let mut values = vec![0.0; columns];
    let mut left = columns;
    while left > 0 {
        let some = motions.columns(0, left).into_owned();
        let broken = jacobian * &some;
        let eigen = SymmetricEigen::new(broken.tr_mul(&broken));
        let mut order: Vec<usize> = (0..left).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let turned = some * eigen.eigenvectors.select_columns(&order);
        let broken = jacobian * &turned;
        for (value, column) in values.iter_mut().zip(broken.column_iter()) {
            *value = column.norm();
        }
        motions.columns_mut(0, left).copy_from(&turned);
        let largest = values[left - 1];
        let small = values[..left]
            .iter()
            .filter(|value| **value <= TOLD * largest);
        left = if largest > NOTHING { small.count() } else { 0 };
    }
    (values, motions)
}
