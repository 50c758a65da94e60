//! The projected problem: those eigenvectors of a small symmetric matrix, block tridiagonal, that are near
//! a place, by inverse iteration of eight vectors.
//!
//! The matrix is (K − σ M)⁻¹ M among the vectors of a basis, θ = 1/(ω² − σ). Vectors come to those whose ω²
//! is near s by x + μ (T − μ)⁻¹ x with μ = 1/(s − σ): by the distances of ω² from s, so that the many
//! high frequencies, whose θ lie close together at zero, are far away.

use pulp::Simd;

use super::blocks::ROW;
use super::dense::{Square, unit};
use super::factor::{load, store};
use super::krylov::MOST_BLOCKS;

/// Steps from vectors that are not known yet.
const FIRST_STEPS: usize = 8;
/// Steps from there on, at the least and at the most, and to which part they bring the vectors' errors.
const LEAST_STEPS: f64 = 4.0;
const MOST_STEPS: f64 = 40.0;
const CONVERGED: f64 = 1e-10;
/// The place is no nearer to the wanted ω² than this part of the distance of the farthest.
const BESIDE: f64 = 0.1;
/// Sweeps of rotations at the most.
const MOST_SWEEPS: usize = 12;
/// A value below zero by no more than this part of the largest may be rounding.
const DOUBTFUL: f64 = 1e-6;

const ZERO: Square = [[0.0; ROW]; ROW];

/// Blocks of amounts of the basis.
pub(super) type Amounts = [Square; MOST_BLOCKS];

/// Eight of its pairs.
pub(super) struct Pairs {
    /// 1/(ω² − σ), and the vectors, a lane each: the lowest ω² below σ first, then those above it.
    pub values: [f64; ROW],
    pub vectors: Amounts,
    /// How many are below σ without a doubt.
    pub below: usize,
}

/// The matrix by its blocks, columns of the upper triangle.
pub(super) struct Projected<'a> {
    pub entries: &'a [Square],
    pub blocks: usize,
}

impl Projected<'_> {
    /// Eight pairs whose ω² − σ are near `place`, first; then near the lowest `count` of these.
    #[inline(always)]
    pub fn pairs<S: Simd>(&self, simd: S, place: f64, count: usize) -> Option<Pairs> {
        let mut found = Pairs {
            values: [0.0; ROW],
            vectors: [ZERO; MOST_BLOCKS],
            below: 0,
        };
        for k in 0..ROW {
            found.vectors[0][k][k] = 1.0;
            // Not without what other blocks have to say.
            for block in 1..self.blocks {
                found.vectors[block][k][k] = 0.5 / block as f64;
            }
        }
        self.iterate(simd, 1.0 / place, FIRST_STEPS, &mut found.vectors)?;
        self.rotate(simd, &mut found)?;
        if found.below < count {
            return None;
        }
        let (first, last) = (1.0 / found.values[0], 1.0 / found.values[count - 1]);
        let (place, half) = ((first + last) * 0.5, (last - first).abs() * 0.5);
        let mut far = 0.0_f64;
        for k in 0..ROW {
            far = far.max((1.0 / found.values[k] - place).abs());
        }
        // Not at an ω², where one vector were all that is left.
        let beside = (BESIDE * far - half).max(0.0);
        let place = place - beside;
        let steps = CONVERGED.ln() / ((half + beside) / far).ln();
        let steps = steps.clamp(LEAST_STEPS, MOST_STEPS) as usize;
        self.iterate(simd, 1.0 / place, steps, &mut found.vectors)?;
        self.rotate(simd, &mut found)?;
        Some(found)
    }

    /// Diagonal block, symmetric.
    #[inline(always)]
    fn diagonal(&self, block: usize) -> Square {
        let own = &self.entries[block * (block + 1) / 2 + block];
        let mut out = ZERO;
        for r in 0..ROW {
            for c in 0..ROW {
                out[r][c] = (own[r][c] + own[c][r]) * 0.5;
            }
        }
        out
    }

    /// The block above a diagonal one.
    #[inline(always)]
    fn above(&self, block: usize) -> &Square {
        &self.entries[block * (block + 1) / 2 + block - 1]
    }

    #[inline(always)]
    fn iterate<S: Simd>(
        &self,
        simd: S,
        shift: f64,
        steps: usize,
        vectors: &mut Amounts,
    ) -> Option<()> {
        let (mut inverses, mut hands) = ([ZERO; MOST_BLOCKS], [ZERO; MOST_BLOCKS]);
        for block in 0..self.blocks {
            let mut own = self.diagonal(block);
            for k in 0..ROW {
                own[k][k] -= shift;
            }
            if block > 0 {
                let mut hand = ZERO;
                add::<S, false>(
                    simd,
                    &mut hand,
                    &inverses[block - 1],
                    self.above(block),
                    1.0,
                );
                add::<S, true>(simd, &mut own, self.above(block), &hand, -1.0);
                hands[block] = hand;
            }
            inverses[block] = inverse(simd, own)?;
        }
        let last = self.blocks - 1;
        for step in 0..steps {
            let mut moved = *vectors;
            for block in 1..self.blocks {
                let before = moved[block - 1];
                add::<S, true>(simd, &mut moved[block], &hands[block], &before, -1.0);
            }
            for block in (0..self.blocks).rev() {
                let mut own = ZERO;
                add::<S, false>(simd, &mut own, &inverses[block], &moved[block], 1.0);
                if block < last {
                    let after = moved[block + 1];
                    add::<S, false>(simd, &mut own, &hands[block + 1], &after, -1.0);
                }
                moved[block] = own;
            }
            for block in 0..self.blocks {
                for r in 0..ROW {
                    for part in (0..ROW).step_by(S::F64_LANES) {
                        let own = load::<S>(&vectors[block][r], part);
                        let more = load::<S>(&moved[block][r], part);
                        let sum = simd.mul_add_e_f64s(simd.splat_f64s(shift), more, own);
                        store::<S>(&mut vectors[block][r], part, sum);
                    }
                }
            }
            if step % 2 == 1 || step + 1 == steps {
                self.orthonormalize(simd, vectors)?;
            }
        }
        Some(())
    }

    #[inline(always)]
    fn orthonormalize<S: Simd>(&self, simd: S, vectors: &mut Amounts) -> Option<()> {
        let mut gram = ZERO;
        for block in 0..self.blocks {
            add::<S, true>(simd, &mut gram, &vectors[block], &vectors[block], 1.0);
        }
        let turned = unit(&gram)?;
        self.turn(simd, vectors, &turned);
        Some(())
    }

    #[inline(always)]
    fn turn<S: Simd>(&self, simd: S, vectors: &mut Amounts, by: &Square) {
        for block in 0..self.blocks {
            let own = vectors[block];
            vectors[block] = ZERO;
            add::<S, false>(simd, &mut vectors[block], &own, by, 1.0);
        }
    }

    /// Turns orthonormal vectors to the eigenvectors among them.
    #[inline(always)]
    fn rotate<S: Simd>(&self, simd: S, found: &mut Pairs) -> Option<()> {
        let vectors = &mut found.vectors;
        let mut among = ZERO;
        for block in 0..self.blocks {
            let mut image = ZERO;
            add::<S, false>(
                simd,
                &mut image,
                &self.diagonal(block),
                &vectors[block],
                1.0,
            );
            if block > 0 {
                add::<S, true>(
                    simd,
                    &mut image,
                    self.above(block),
                    &vectors[block - 1],
                    1.0,
                );
            }
            if block + 1 < self.blocks {
                add::<S, false>(
                    simd,
                    &mut image,
                    self.above(block + 1),
                    &vectors[block + 1],
                    1.0,
                );
            }
            add::<S, true>(simd, &mut among, &vectors[block], &image, 1.0);
        }
        let (values, turned) = eigenvectors(among);
        let mut order = [0, 1, 2, 3, 4, 5, 6, 7];
        // Of negative ones the nearest to zero first, which are the lowest ω²; then the largest.
        order.sort_by(|a: &usize, b: &usize| {
            let (a, b) = (values[*a], values[*b]);
            (a >= 0.0).cmp(&(b >= 0.0)).then(b.total_cmp(&a))
        });
        let mut largest = 0.0_f64;
        for k in 0..ROW {
            largest = largest.max(values[k].abs());
        }
        let mut sorted = ZERO;
        found.below = 0;
        for k in 0..ROW {
            found.values[k] = values[order[k]];
            found.below += usize::from(values[order[k]] < -DOUBTFUL * largest);
            for r in 0..ROW {
                sorted[r][k] = turned[r][order[k]];
            }
        }
        if !found.values.iter().all(|value| value.is_finite()) {
            return None;
        }
        self.turn(simd, &mut found.vectors, &sorted);
        Some(())
    }
}

/// `out += sign a b`, or aᵀ b.
#[inline(always)]
fn add<S: Simd, const TRANSPOSED: bool>(
    simd: S,
    out: &mut Square,
    a: &Square,
    b: &Square,
    sign: f64,
) {
    for part in (0..ROW).step_by(S::F64_LANES) {
        let zero = simd.splat_f64s(0.0);
        let mut rows = [zero; ROW];
        for k in 0..ROW {
            rows[k] = simd.mul_f64s(simd.splat_f64s(sign), load::<S>(&b[k], part));
        }
        for r in 0..ROW {
            let mut first = load::<S>(&out[r], part);
            let mut second = zero;
            for k in 0..ROW / 2 {
                let (even, odd) = (2 * k, 2 * k + 1);
                let entry = if TRANSPOSED { a[even][r] } else { a[r][even] };
                first = simd.mul_add_e_f64s(simd.splat_f64s(entry), rows[even], first);
                let entry = if TRANSPOSED { a[odd][r] } else { a[r][odd] };
                second = simd.mul_add_e_f64s(simd.splat_f64s(entry), rows[odd], second);
            }
            store::<S>(&mut out[r], part, simd.add_f64s(first, second));
        }
    }
}

/// Inverse of a symmetric matrix, its pivots in order.
#[inline(always)]
fn inverse<S: Simd>(simd: S, mut a: Square) -> Option<Square> {
    for c in 0..ROW {
        let pivot = a[c][c];
        if !(pivot != 0.0 && pivot.is_finite()) {
            return None;
        }
        let own = 1.0 / pivot;
        a[c][c] = 1.0;
        for part in (0..ROW).step_by(S::F64_LANES) {
            let row = simd.mul_f64s(simd.splat_f64s(own), load::<S>(&a[c], part));
            store::<S>(&mut a[c], part, row);
        }
        for r in 0..ROW {
            if r == c {
                continue;
            }
            let share = a[r][c];
            a[r][c] = 0.0;
            for part in (0..ROW).step_by(S::F64_LANES) {
                let (own, row) = (load::<S>(&a[r], part), load::<S>(&a[c], part));
                let rest = simd.mul_add_e_f64s(simd.splat_f64s(-share), row, own);
                store::<S>(&mut a[r], part, rest);
            }
        }
    }
    Some(a)
}

/// Eigenvalues and vectors, a column each, by rotations (Jacobi 1846).
fn eigenvectors(mut a: Square) -> ([f64; ROW], Square) {
    let mut vectors = ZERO;
    for k in 0..ROW {
        vectors[k][k] = 1.0;
    }
    for _ in 0..MOST_SWEEPS {
        let mut largest = 0.0_f64;
        for p in 0..ROW {
            for q in p + 1..ROW {
                let (off, size) = (a[p][q], (a[p][p] * a[q][q]).abs().sqrt());
                if off.abs() <= 1e-17 * size || off == 0.0 {
                    continue;
                }
                largest = largest.max(off.abs() / size.max(f64::MIN_POSITIVE));
                let theta = (a[q][q] - a[p][p]) / (2.0 * off);
                let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
                let c = 1.0 / (t * t + 1.0).sqrt();
                let s = t * c;
                for k in 0..ROW {
                    let (x, y) = (a[k][p], a[k][q]);
                    (a[k][p], a[k][q]) = (c * x - s * y, s * x + c * y);
                }
                for k in 0..ROW {
                    let (x, y) = (a[p][k], a[q][k]);
                    (a[p][k], a[q][k]) = (c * x - s * y, s * x + c * y);
                }
                for row in &mut vectors {
                    let (x, y) = (row[p], row[q]);
                    (row[p], row[q]) = (c * x - s * y, s * x + c * y);
                }
            }
        }
        if largest < 1e-12 {
            break;
        }
    }
    let mut values = [0.0; ROW];
    for k in 0..ROW {
        values[k] = a[k][k];
    }
    (values, vectors)
}
