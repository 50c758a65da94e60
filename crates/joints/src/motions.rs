//! The relative motions of a joint, separated into rotations and pure translations.

use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3};

use crate::dof::{Dof, DofSet};
use crate::error::JointError;
use crate::subspace::Subspace;

/// A part of a column that is smaller than this, relative to the largest such part among the
/// six columns of the basis, is rounding.
const ROUNDING: f64 = 1e-12;

/// Every relative motion of a joint: `φ` in `rotations` and `Δ = coupling · φ + p` with `p` in
/// `translations`.
pub(crate) struct Motions {
    pub rotations: Subspace,
    pub translations: Subspace,
    /// Metres per radian; used on vectors of `rotations` only.
    pub coupling: Matrix3<f64>,
}

impl Motions {
    /// Separates the columns `moving` of `basis` by column reduction (Gram–Schmidt with the
    /// largest column first): what turns, then what is left of the other columns.
    ///
    /// # Errors
    /// Columns that depend on each other.
    pub fn of(basis: &Matrix6<f64>, moving: DofSet) -> Result<Self, JointError> {
        let mut delta = Dof::ALL.map(|d| basis.fixed_view::<3, 1>(0, d.index()).into_owned());
        let mut phi = Dof::ALL.map(|d| basis.fixed_view::<3, 1>(3, d.index()).into_owned());
        let smallest_delta = ROUNDING * largest_norm(&delta);
        let smallest_phi = ROUNDING * largest_norm(&phi);
        let mut left = moving;

        let mut rotations = Orthonormal::default();
        let mut coupling = Matrix3::zeros();
        while let Some(pivot) = rotations.next_pivot(&phi, left, smallest_phi) {
            left.remove(pivot);
            let size = phi[pivot.index()].norm();
            let w = phi[pivot.index()] / size;
            let t = delta[pivot.index()] / size;
            rotations.push(w);
            coupling += t * w.transpose();
            for k in left.iter().map(Dof::index) {
                let part = w.dot(&phi[k]);
                phi[k] -= w * part;
                delta[k] -= t * part;
            }
        }
        let mut translations = Orthonormal::default();
        while let Some(pivot) = translations.next_pivot(&delta, left, smallest_delta) {
            left.remove(pivot);
            let p = delta[pivot.index()].normalize();
            translations.push(p);
            for k in left.iter().map(Dof::index) {
                delta[k] -= p * p.dot(&delta[k]);
            }
        }
        if let Some(direction) = left.iter().next() {
            return Err(JointError::DependentMotions { direction });
        }
        Ok(Self {
            rotations: Subspace::spanned_by(rotations.vectors()),
            translations: Subspace::spanned_by(translations.vectors()),
            coupling,
        })
    }

    /// The same motions in the axes that `frame` turns into.
    pub fn turned(&self, frame: &Rotation3<f64>) -> Self {
        Self {
            rotations: self.rotations.turned(frame),
            translations: self.translations.turned(frame),
            coupling: frame.matrix() * self.coupling * frame.matrix().transpose(),
        }
    }
}

fn largest_norm(parts: &[Vector3<f64>; 6]) -> f64 {
    parts.iter().map(Vector3::norm).fold(0.0, f64::max)
}

/// Up to three orthonormal vectors.
#[derive(Default)]
struct Orthonormal {
    len: usize,
    vectors: [Vector3<f64>; 3],
}

impl Orthonormal {
    fn vectors(&self) -> &[Vector3<f64>] {
        &self.vectors[..self.len]
    }

    fn push(&mut self, vector: Vector3<f64>) {
        self.vectors[self.len] = vector;
        self.len += 1;
    }

    /// The first of the columns `left` with the largest part, if that is more than `smallest`
    /// and there is room for it.
    fn next_pivot(&self, parts: &[Vector3<f64>; 6], left: DofSet, smallest: f64) -> Option<Dof> {
        if self.len == self.vectors.len() {
            return None;
        }
        let mut pivot = None;
        let mut largest = smallest;
        for dof in left.iter() {
            let norm = parts[dof.index()].norm();
            if norm > largest {
                largest = norm;
                pivot = Some(dof);
            }
        }
        pivot
    }
}
