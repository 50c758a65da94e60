//! Products of tall blocks of eight columns.

use pulp::Simd;

use super::blocks::ROW;
use super::factor::{load, store};

/// A vector of whose square no more than this part is left beside the others of its block lies among them.
const DEPENDENT: f64 = 1e-12;

/// A matrix of eight rows of eight.
pub(super) type Square = [[f64; ROW]; ROW];

/// `aᵀ b`.
#[inline(always)]
pub(super) fn products<S: Simd>(simd: S, a: &[f64], b: &[f64]) -> Square {
    let zero = simd.splat_f64s(0.0);
    let mut found = [[0.0; ROW]; ROW];
    let count = a.len().min(b.len()) / ROW;
    for part in (0..ROW).step_by(S::F64_LANES) {
        let mut sums = [zero; ROW];
        for row in 0..count {
            let own = load::<S>(b, row * ROW + part);
            let others = &a[row * ROW..row * ROW + ROW];
            for k in 0..ROW {
                sums[k] = simd.mul_add_e_f64s(simd.splat_f64s(others[k]), own, sums[k]);
            }
        }
        for k in 0..ROW {
            store::<S>(&mut found[k], part, sums[k]);
        }
    }
    found
}

/// `b -= a c`, or `b += a c`, by `sign`.
#[inline(always)]
pub(super) fn add<S: Simd>(simd: S, b: &mut [f64], a: &[f64], c: &Square, sign: f64) {
    let zero = simd.splat_f64s(0.0);
    let count = a.len().min(b.len()) / ROW;
    for part in (0..ROW).step_by(S::F64_LANES) {
        let mut shares = [zero; ROW];
        for k in 0..ROW {
            shares[k] = simd.mul_f64s(simd.splat_f64s(sign), load::<S>(&c[k], part));
        }
        for row in 0..count {
            let others = &a[row * ROW..row * ROW + ROW];
            let mut first = load::<S>(b, row * ROW + part);
            let mut second = zero;
            for k in 0..ROW / 2 {
                let entry = simd.splat_f64s(others[2 * k]);
                first = simd.mul_add_e_f64s(entry, shares[2 * k], first);
                let entry = simd.splat_f64s(others[2 * k + 1]);
                second = simd.mul_add_e_f64s(entry, shares[2 * k + 1], second);
            }
            store::<S>(b, row * ROW + part, simd.add_f64s(first, second));
        }
    }
}

/// `a = a c`.
#[inline(always)]
pub(super) fn turn<S: Simd>(simd: S, a: &mut [f64], c: &Square) {
    let mut own = [0.0; ROW];
    let zero = simd.splat_f64s(0.0);
    for row in a.chunks_exact_mut(ROW) {
        own.copy_from_slice(row);
        for part in (0..ROW).step_by(S::F64_LANES) {
            let (mut first, mut second) = (zero, zero);
            for k in 0..ROW / 2 {
                let entry = simd.splat_f64s(own[2 * k]);
                first = simd.mul_add_e_f64s(entry, load::<S>(&c[2 * k], part), first);
                let entry = simd.splat_f64s(own[2 * k + 1]);
                second = simd.mul_add_e_f64s(entry, load::<S>(&c[2 * k + 1], part), second);
            }
            store::<S>(row, part, simd.add_f64s(first, second));
        }
    }
}

/// W with Wᵀ G W = 1, upper triangular, for a symmetric G; `None` where a column depends on others so closely
/// that vectors of unit length would not be orthogonal.
#[inline(always)]
pub(super) fn unit(gram: &Square) -> Option<Square> {
    let mut upper = *gram;
    for c in 0..ROW {
        let pivot = upper[c][c];
        // What is not a number is no pivot.
        if !(pivot > DEPENDENT * gram[c][c] && pivot.is_finite()) {
            return None;
        }
        let inverse = 1.0 / pivot.sqrt();
        for b in c..ROW {
            upper[c][b] *= inverse;
        }
        for r in c + 1..ROW {
            let share = upper[c][r];
            for b in r..ROW {
                upper[r][b] -= share * upper[c][b];
            }
        }
    }
    let mut inverse = [[0.0; ROW]; ROW];
    for c in (0..ROW).rev() {
        let own = 1.0 / upper[c][c];
        inverse[c][c] = own;
        for b in c + 1..ROW {
            let mut sum = 0.0;
            for k in c + 1..=b {
                sum += upper[c][k] * inverse[k][b];
            }
            inverse[c][b] = -own * sum;
        }
    }
    Some(inverse)
}
