//! What a member is in its own axes, at no shift and at one.
//!
//! Tension, torsion and bending in two planes are apart from each other, with two displacements of the ends
//! each or four. At a shift σ the inner shapes' coordinates are measured from where they follow the ends at
//! ω² = σ, so that K − σ M does not couple them to the nodes, as K does not: with a = σ/(ω_j² − σ)
//!
//! ```text
//! K − σ M = diag(k − σ m − σ² Σ c_j c_jᵀ/(ω_j² − σ), ω_j² − σ)
//! M = [m + Σ (2 a_j + a_j²) c_j c_jᵀ, (1 + a_j) c_jᵀ; …, 1]
//! ```

use hyperstat_elements::Matrix12;
use nalgebra::{Matrix6, SMatrix};

use crate::modal::member::Member;

/// Displacements of both ends in tension and torsion.
pub(super) const PAIRS: [[usize; 2]; 2] = [[0, 6], [3, 9]];
/// In bending along y and along z.
pub(super) const FOURS: [[usize; 4]; 2] = [[1, 5, 7, 11], [2, 4, 8, 10]];

/// A member.
#[derive(Debug)]
pub(super) struct Kind {
    pub length: f64,
    /// Stiffness at the second end, the first held.
    pub held: Matrix6<f64>,
    pub pairs: [Plane<2>; 2],
    pub fours: [Plane<4>; 2],
}

/// What it is in one direction.
#[derive(Debug)]
pub(super) struct Plane<const N: usize> {
    /// Of the ends; at a shift K − σ M.
    pub stiffness: SMatrix<f64, N, N>,
    pub mass: SMatrix<f64, N, N>,
    pub shapes: Vec<Inner<N>>,
}

/// An inner shape of unit mass.
#[derive(Debug)]
pub(super) struct Inner<const N: usize> {
    /// ω²; at a shift 1/(ω² − σ).
    pub square: f64,
    /// Mass between it and the ends.
    pub coupling: [f64; N],
}

impl Kind {
    /// `None` where its directions are not apart.
    pub fn new(member: &Member) -> Option<Self> {
        let length = member.beam.straight().length();
        let held = member.beam.cantilever_stiffness();
        let stiffness = of_both_ends(&held, length);
        let mut inner: Vec<(f64, [f64; 12])> = Vec::new();
        for (square, coupling) in member.inner.squares().iter().zip(member.inner.couplings()) {
            inner.push((*square, (*coupling).into()));
        }
        let kind = Self {
            length,
            held,
            pairs: PAIRS.map(|rows| Plane::new(rows, &stiffness, &member.mass, &mut inner)),
            fours: FOURS.map(|rows| Plane::new(rows, &stiffness, &member.mass, &mut inner)),
        };
        let rows = PAIRS
            .iter()
            .map(|r| &r[..])
            .chain(FOURS.iter().map(|r| &r[..]));
        let rows: Vec<&[usize]> = rows.collect();
        let apart = |a: usize, b: usize| !rows.iter().any(|r| r.contains(&a) && r.contains(&b));
        let none = |matrix: &Matrix12| {
            let mut all = (0..144).map(|k| (k % 12, k / 12));
            all.all(|(a, b)| matrix[(a, b)] == 0.0 || !apart(a, b))
        };
        (inner.is_empty() && none(&stiffness) && none(&member.mass)).then_some(kind)
    }

    /// The same at a shift.
    pub fn at(&self, shift: f64) -> Self {
        Self {
            length: self.length,
            held: self.held,
            pairs: [0, 1].map(|k| self.pairs[k].at(shift)),
            fours: [0, 1].map(|k| self.fours[k].at(shift)),
        }
    }

    /// Number of its inner shapes.
    pub fn inner(&self) -> usize {
        let pairs = self.pairs.iter().map(|plane| plane.shapes.len());
        pairs
            .chain(self.fours.iter().map(|plane| plane.shapes.len()))
            .sum()
    }
}

impl<const N: usize> Plane<N> {
    /// Takes its own out of the inner shapes.
    fn new(
        rows: [usize; N],
        stiffness: &Matrix12,
        mass: &Matrix12,
        inner: &mut Vec<(f64, [f64; 12])>,
    ) -> Self {
        let part = |of: &Matrix12| SMatrix::from_fn(|r, c| of[(rows[r], rows[c])]);
        let is_own = |coupling: &[f64; 12]| {
            let mut others = (0..12).filter(|k| !rows.contains(k));
            others.all(|k| coupling[k] == 0.0)
        };
        let own = inner.iter().filter(|(_, coupling)| is_own(coupling));
        let shapes = own.map(|(square, coupling)| Inner {
            square: *square,
            coupling: rows.map(|row| coupling[row]),
        });
        let shapes = shapes.collect();
        inner.retain(|(_, coupling)| !is_own(coupling));
        Self {
            stiffness: part(stiffness),
            mass: part(mass),
            shapes,
        }
    }

    fn at(&self, shift: f64) -> Self {
        let mut stiffness = self.stiffness - self.mass * shift;
        let mut mass = self.mass;
        let mut shapes = Vec::with_capacity(self.shapes.len());
        for Inner { square, coupling } in &self.shapes {
            let c = SMatrix::<f64, N, 1>::from(*coupling);
            let follows = shift / (square - shift);
            stiffness -= c * c.transpose() * (shift * follows);
            mass += c * c.transpose() * (follows * (2.0 + follows));
            shapes.push(Inner {
                square: 1.0 / (square - shift),
                coupling: coupling.map(|entry| entry * (1.0 + follows)),
            });
        }
        Self {
            stiffness,
            mass,
            shapes,
        }
    }
}

/// Stiffness of both ends by that of the second, the first held: Bᵀ k B with the deformations
/// B = u₂ − (u₁ carried along).
fn of_both_ends(held: &Matrix6<f64>, length: f64) -> Matrix12 {
    let mut deformation = SMatrix::<f64, 6, 12>::zeros();
    for k in 0..6 {
        deformation[(k, k)] = -1.0;
        deformation[(k, 6 + k)] = 1.0;
    }
    deformation[(1, 5)] = -length;
    deformation[(2, 4)] = length;
    let both = deformation.transpose() * held * deformation;
    (both + both.transpose()) * 0.5
}
