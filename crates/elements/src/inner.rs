//! What a beam does between its nodes: shapes that make its mass exact, with no node inside it.
//!
//! A vibrating beam is its exact static curve through its nodes and, with both of them held, its
//! answer to its own inertia along it. That is smooth: in every direction (tension, torsion, bending
//! in two planes) answers of the held beam to loads P₀, P₁, P₂ … (Legendre's polynomials, of moments
//! too where sections turn on their own) come to it faster than any power. No force at the nodes
//! works on what they hold, so that K does not couple them to the nodes; made orthonormal in the mass
//! once a beam, the whole is
//!
//! ```text
//! K = diag(k, ω_j²)        M = [m cᵀ; c 1]
//! ```
//!
//! with k and m over the nodes. The answers are made by integration of the sections' compliances,
//! as the static ones are, so that tapered beams and those with shear deformation are no less exact.

use nalgebra::{DMatrix, SVector, SymmetricEigen, Vector3, Vector6};

use crate::frame::transport;
use crate::mass::{LineMass, MassShape, RotaryInertia};
use crate::quadrature::gauss;
use crate::straight::StraightBeam;

/// Answers to distributed loads in a direction at the most: with 12 the integrals of their products
/// are still exact by the 16-point rule. Enough to rounding below half of the lowest ω² of the held
/// beam.
const MOST: usize = 12;
/// So much, of ω², what is left out may add to a frequency.
const LEFT_OUT: f64 = 1e-13;

/// Displacements of both nodes, the first's before the second's, element frame.
type Vector12 = SVector<f64, 12>;

/// The shapes of a beam between its held nodes, orthonormal in its mass.
#[derive(Debug, Clone, Default)]
pub struct InnerShapes {
    /// ω² of each shape \[rad²/s²\].
    squares: Vec<f64>,
    /// The mass that couples each of them to the nodes \[√kg, √kg·m\].
    couplings: Vec<Vector12>,
    /// Each as a sum of answers: which of them is the first, and their weights.
    weights: Vec<(usize, Vec<f64>)>,
    answers: Vec<Answer>,
    /// What is to be taken off the answers for the second node to be held.
    ends: Vec<Vector6<f64>>,
    resolved: f64,
}

/// A direction that is independent of the others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Direction {
    Tension,
    Torsion,
    AlongY,
    AlongZ,
}

/// A section wrench that polynomial loads make, up to wrenches at the nodes.
#[derive(Debug, Clone, Copy)]
struct Answer {
    direction: Direction,
    degree: usize,
    /// Of a distributed moment: the shear force is P of this degree, and there is no moment.
    of_moments: bool,
}

impl Direction {
    const ALL: [Self; 4] = [Self::Tension, Self::Torsion, Self::AlongY, Self::AlongZ];

    /// Its displacements among those of both nodes.
    fn rows(self) -> &'static [usize] {
        match self {
            Self::Tension => &[0, 6],
            Self::Torsion => &[3, 9],
            Self::AlongY => &[1, 5, 7, 11],
            Self::AlongZ => &[2, 4, 8, 10],
        }
    }

    /// Its answers: to loads, and where there is shear and rotary inertia to moments, by turns.
    fn answers(self, moments: bool) -> Vec<Answer> {
        let first = match self {
            Self::Tension | Self::Torsion => 1,
            Self::AlongY | Self::AlongZ => 2,
        };
        let answer = |degree, of_moments| Answer {
            direction: self,
            degree,
            of_moments,
        };
        let both = |k| {
            [
                Some(answer(first + k, false)),
                moments.then(|| answer(k, true)),
            ]
        };
        (0..MOST).flat_map(both).flatten().collect()
    }
}

/// Legendre's polynomials and their derivatives over −1 to 1, at one place.
struct Legendre {
    values: [f64; MOST + 2],
    slopes: [f64; MOST + 2],
}

impl Legendre {
    /// At `xi` of 0 to 1.
    fn at(xi: f64) -> Self {
        let x = 2.0 * xi - 1.0;
        let (mut values, mut slopes) = ([1.0; MOST + 2], [0.0; MOST + 2]);
        (values[1], slopes[1]) = (x, 1.0);
        for n in 2..MOST + 2 {
            let k = n as f64;
            values[n] = ((2.0 * k - 1.0) * x * values[n - 1] - (k - 1.0) * values[n - 2]) / k;
            slopes[n] = slopes[n - 2] + (2.0 * k - 1.0) * values[n - 1];
        }
        Self { values, slopes }
    }
}

impl Answer {
    /// Section wrench of the beam of this length.
    fn wrench(&self, legendre: &Legendre, length: f64) -> Vector6<f64> {
        let (value, slope) = (legendre.values[self.degree], legendre.slopes[self.degree]);
        let mut wrench = Vector6::zeros();
        let (force, moment, sign) = match self.direction {
            Direction::Tension => (0, None, 1.0),
            Direction::Torsion => (3, None, 1.0),
            // Without moments along the beam Vy = −dMz/dx, Vz = dMy/dx.
            Direction::AlongY => (1, Some(5), -1.0),
            Direction::AlongZ => (2, Some(4), 1.0),
        };
        match moment {
            None => wrench[force] = value,
            Some(_) if self.of_moments => wrench[force] = value / length,
            Some(moment) => {
                wrench[moment] = value;
                wrench[force] = sign * 2.0 * slope / length;
            }
        }
        wrench
    }
}

/// Displacements at `xi` that these section wrenches make, node 1 held and node 2 free.
fn free_displacements(
    beam: &(impl StraightBeam + ?Sized),
    answers: &[Answer],
    xi: f64,
) -> Vec<Vector6<f64>> {
    let length = beam.length();
    let mut sums = vec![Vector6::zeros(); answers.len()];
    beam.intervals(xi, &mut |first, last| {
        gauss(first, last, |place, weight| {
            let give = beam.section_compliance_at(place);
            let (legendre, arm) = (Legendre::at(place), length * (xi - place));
            for (sum, answer) in sums.iter_mut().zip(answers) {
                let strain = give.component_mul(&answer.wrench(&legendre, length));
                let mut moved = strain;
                moved[1] += arm * strain[5];
                moved[2] -= arm * strain[4];
                *sum += moved * (length * weight);
            }
        });
    });
    sums
}

impl LineMass {
    /// The inner shapes of `beam`, whose sections these are, so many that what is left out changes
    /// no ω² up to `limit` \[rad²/s²\] by more than 1e-13 of it: where `limit` is not above
    /// [`InnerShapes::resolved`], else all that there are. With `rotary` as in
    /// [`LineMass::consistent`], beside whose mass of [exact](MassShape::Exact) shapes they stand.
    pub fn inner_shapes(
        &self,
        beam: &(impl StraightBeam + ?Sized),
        rotary: RotaryInertia,
        limit: f64,
    ) -> InnerShapes {
        let mut found = InnerShapes {
            resolved: f64::INFINITY,
            ..InnerShapes::default()
        };
        if self.total(beam.length()) <= 0.0 {
            return found;
        }
        let (length, give) = (beam.length(), beam.section_compliance_at(0.5));
        let turning = |direction| match direction {
            Direction::AlongY => rotary == RotaryInertia::Included && give[1] > 0.0,
            Direction::AlongZ => rotary == RotaryInertia::Included && give[2] > 0.0,
            _ => false,
        };
        let all = Direction::ALL.map(|direction| direction.answers(turning(direction)));
        let answers = all.concat();
        let ends = free_displacements(beam, &answers, 1.0);
        let count = answers.len();
        let [mut energy, mut mass] = [(); 2].map(|()| DMatrix::<f64>::zeros(count, count));
        let mut coupling = DMatrix::<f64>::zeros(12, count);
        let carried = beam.cantilever_stiffness();
        self.each_place(beam, MassShape::Exact, rotary, |xi, weight, n| {
            let (give, per_length) = (
                beam.section_compliance_at(xi),
                self.per_length_at(xi, rotary),
            );
            let (legendre, shape) = (Legendre::at(xi), beam.shape(xi));
            let to_section = transport(&(beam.span() * (1.0 - xi))).transpose() * carried;
            let mut moved = free_displacements(beam, &answers, xi);
            let mut wrenches = Vec::with_capacity(count);
            for ((moved, answer), end) in moved.iter_mut().zip(&answers).zip(&ends) {
                *moved -= shape * end;
                wrenches.push(answer.wrench(&legendre, length) - to_section * end);
            }
            let mut first = 0;
            for direction in &all {
                let last = first + direction.len();
                for b in first..last {
                    let strain = give.component_mul(&wrenches[b]) * weight;
                    let inertia = per_length.component_mul(&moved[b]) * weight;
                    for a in first..=b {
                        energy[(b, a)] += wrenches[a].dot(&strain);
                        mass[(b, a)] += moved[a].dot(&inertia);
                    }
                    let coupled = n.transpose() * inertia;
                    for row in direction[0].direction.rows() {
                        coupling[(*row, b)] += coupled[*row];
                    }
                }
                first = last;
            }
        });
        let nodes = self.consistent(beam, MassShape::Exact, rotary);
        let mut first = 0;
        for own in &all {
            let (count, rows) = (own.len(), own[0].direction.rows());
            let part = |of: &DMatrix<f64>| {
                DMatrix::from_fn(count, count, |r, c| {
                    of[(first + r.max(c), first + r.min(c))]
                })
            };
            let block = Block {
                energy: part(&energy),
                mass: part(&mass),
                coupling: DMatrix::from_fn(rows.len(), count, |r, c| {
                    coupling[(rows[r], first + c)]
                }),
                nodes: DMatrix::from_fn(rows.len(), rows.len(), |r, c| nodes[(rows[r], rows[c])]),
            };
            if let Some((kept, resolved)) = block.kept(limit) {
                found.resolved = found.resolved.min(resolved);
                for k in 0..kept.squares.len() {
                    found.squares.push(kept.squares[k]);
                    let mut whole = Vector12::zeros();
                    for (r, row) in rows.iter().enumerate() {
                        whole[*row] = kept.coupling[(r, k)];
                    }
                    found.couplings.push(whole);
                    let weights = kept.weights.column(k).iter().copied().collect();
                    found.weights.push((first, weights));
                }
            }
            first += count;
        }
        found.answers = answers;
        found.ends = ends;
        found
    }
}

/// The answers of one direction.
struct Block {
    energy: DMatrix<f64>,
    mass: DMatrix<f64>,
    /// Mass between the nodes' displacements and the answers.
    coupling: DMatrix<f64>,
    /// Mass of the static shapes.
    nodes: DMatrix<f64>,
}

/// The first answers of a direction, made orthonormal in the mass.
struct Kept {
    squares: Vec<f64>,
    coupling: DMatrix<f64>,
    weights: DMatrix<f64>,
}

impl Block {
    /// As many answers as `limit` needs, and up to which ω² all of them would be enough; `None`
    /// where numbers overflow.
    fn kept(&self, limit: f64) -> Option<(Kept, f64)> {
        let scales = self.energy.diagonal().map(|e| 1.0 / e.sqrt());
        let scaled = DMatrix::from_fn(scales.len(), scales.len(), |r, c| {
            self.energy[(r, c)] * scales[r] * scales[c]
        });
        // U = answers that are orthonormal in the energy, each a sum of the first ones.
        let factor = scaled.cholesky()?.l();
        let mut sums = DMatrix::from_diagonal(&scales);
        if !factor.solve_lower_triangular_mut(&mut sums) {
            return None;
        }
        let sums = sums.transpose();
        let mass = sums.transpose() * &self.mass * &sums;
        let coupling = &self.coupling * &sums;
        let held = self.nodes.clone().cholesky()?;
        let first = |count: usize| {
            if count == 0 {
                return Kept {
                    squares: Vec::new(),
                    coupling: DMatrix::zeros(coupling.nrows(), 0),
                    weights: DMatrix::zeros(0, 0),
                };
            }
            let eigen = SymmetricEigen::new(mass.view((0, 0), (count, count)).into_owned());
            let unit = eigen.eigenvalues.map(|value| 1.0 / value.sqrt());
            let vectors = eigen.eigenvectors * DMatrix::from_diagonal(&unit);
            Kept {
                squares: eigen.eigenvalues.iter().map(|value| 1.0 / value).collect(),
                coupling: coupling.columns(0, count) * &vectors,
                weights: sums.view((0, 0), (count, count)) * vectors,
            }
        };
        // What inner shapes take off the stiffness at ω², over ω² and the mass of the nodes' own
        // shapes: the sum of what they take off ω² in each of them.
        let taken = |kept: &Kept, square: f64| -> f64 {
            let forces = kept.squares.iter().enumerate().map(|(k, own)| {
                let c = kept.coupling.column(k);
                square / (own - square) * c.dot(&held.solve(&c.into_owned()))
            });
            forces.sum()
        };
        let count = self.mass.nrows();
        let all = first(count);
        let lowest = all.squares.iter().copied().fold(f64::INFINITY, f64::min);
        let resolved = BELOW_HELD * lowest;
        let square = limit.min(resolved);
        let whole = taken(&all, square);
        let enough = (0..count).find_map(|count| {
            let kept = first(count);
            (whole - taken(&kept, square) <= LEFT_OUT).then_some(kept)
        });
        let kept = enough.unwrap_or(all);
        let finite = kept
            .coupling
            .iter()
            .chain(&kept.squares)
            .all(|v| v.is_finite());
        finite.then_some((kept, resolved))
    }
}

/// Up to this part of the lowest ω² of the held beam its inner shapes are enough to rounding.
const BELOW_HELD: f64 = 0.5;

impl InnerShapes {
    /// ω² of every shape, both nodes held \[rad²/s²\].
    pub fn squares(&self) -> &[f64] {
        &self.squares
    }

    /// The mass between every shape and the displacements of the nodes, node 1's before node 2's,
    /// element frame \[√kg, √kg·m\].
    pub fn couplings(&self) -> &[SVector<f64, 12>] {
        &self.couplings
    }

    /// Up to which ω² \[rad²/s²\] a beam of this length is right; it is below all those that it has
    /// with both nodes held. Above, divide it.
    pub fn resolved(&self) -> f64 {
        self.resolved
    }

    /// The amounts of all answers that these amounts of the shapes are.
    fn of_answers(&self, amounts: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.answers.len()];
        for (amount, (first, weights)) in amounts.iter().zip(&self.weights) {
            for (sum, weight) in sums[*first..].iter_mut().zip(weights) {
                *sum += amount * weight;
            }
        }
        sums
    }

    /// Displacement of `beam` at `xi` by these amounts of the shapes, element frame.
    pub fn displacement(
        &self,
        beam: &(impl StraightBeam + ?Sized),
        xi: f64,
        amounts: &[f64],
    ) -> Vector6<f64> {
        let sums = self.of_answers(amounts);
        let free = free_displacements(beam, &self.answers, xi);
        let weighted = |of: &[Vector6<f64>]| -> Vector6<f64> {
            of.iter().zip(&sums).map(|(moved, sum)| moved * *sum).sum()
        };
        weighted(&free) - beam.shape(xi) * weighted(&self.ends)
    }

    /// Section wrench of `beam` at `xi` by these amounts of the shapes, element frame.
    pub fn section_wrench(
        &self,
        beam: &(impl StraightBeam + ?Sized),
        xi: f64,
        amounts: &[f64],
    ) -> Vector6<f64> {
        let sums = self.of_answers(amounts);
        let legendre = Legendre::at(xi);
        let answers = self.answers.iter().zip(&sums);
        let free: Vector6<f64> = answers
            .map(|(answer, sum)| answer.wrench(&legendre, beam.length()) * *sum)
            .sum();
        let end: Vector6<f64> = self
            .ends
            .iter()
            .zip(&sums)
            .map(|(end, sum)| end * *sum)
            .sum();
        let arm = Vector3::new(beam.length() * (1.0 - xi), 0.0, 0.0);
        free - transport(&arm).transpose() * (beam.cantilever_stiffness() * end)
    }
}
