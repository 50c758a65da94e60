//! L D Lᵀ of a matrix in blocks, and solutions for eight right-hand sides at once.

use pulp::Simd;

use super::blocks::{Blocks, Column, ROW};

/// The registers of a row.
#[inline(always)]
pub(super) fn load<S: Simd>(values: &[f64], at: usize) -> S::f64s {
    S::as_simd_f64s(&values[at..at + S::F64_LANES]).0[0]
}

#[inline(always)]
pub(super) fn store<S: Simd>(values: &mut [f64], at: usize, value: S::f64s) {
    S::as_mut_simd_f64s(&mut values[at..at + S::F64_LANES]).0[0] = value;
}

/// `to -= share · from` of parts of rows.
#[inline(always)]
fn take<S: Simd>(simd: S, values: &mut [f64], to: usize, share: f64, from: usize) {
    let changed = simd.mul_add_e_f64s(
        simd.splat_f64s(-share),
        load::<S>(values, from),
        load::<S>(values, to),
    );
    store::<S>(values, to, changed);
}

/// Factors `values` in place and writes the inverses of the pivots; returns how many are negative, none
/// where one is zero or not finite. `panel`: as many rows as the largest column has.
#[inline(always)]
pub(super) fn factorize<S: Simd>(
    simd: S,
    blocks: &Blocks,
    values: &mut [f64],
    inverses: &mut [f64],
    panel: &mut [f64],
) -> Option<usize> {
    let (mut negative, mut sound) = (0, true);
    for column in &blocks.columns {
        let (first, count) = (column.own.start, column.own.len());
        let inverses = &mut inverses[first..first + count];
        for c in 0..count {
            let pivot = values[(column.diagonal + c) * ROW + c];
            sound &= pivot.is_finite() && pivot != 0.0;
            negative += usize::from(pivot < 0.0);
            inverses[c] = 1.0 / pivot;
            let from = (column.diagonal + c) * ROW;
            for b in c + 1..count {
                let share = values[from + b] * inverses[c];
                let to = (column.diagonal + b) * ROW;
                for part in (0..ROW).step_by(S::F64_LANES) {
                    take(simd, values, to + part, share, from + part);
                }
            }
        }
        for (k, (_, block)) in column.below.iter().enumerate() {
            for c in 0..count {
                let to = (block + c) * ROW;
                for before in 0..c {
                    let entry = (column.diagonal + before) * ROW + c;
                    let share = values[entry] * inverses[before];
                    for part in (0..ROW).step_by(S::F64_LANES) {
                        take(
                            simd,
                            values,
                            to + part,
                            share,
                            (block + before) * ROW + part,
                        );
                    }
                }
                let inverse = simd.splat_f64s(inverses[c]);
                for part in (0..ROW).step_by(S::F64_LANES) {
                    let scaled = simd.mul_f64s(inverse, load::<S>(values, to + part));
                    store::<S>(panel, (k * count + c) * ROW + part, scaled);
                }
            }
        }
        change(simd, blocks, column, values, panel);
        for c in 0..count {
            let inverse = simd.splat_f64s(inverses[c]);
            let own = (column.diagonal + c) * ROW;
            for part in (0..ROW).step_by(S::F64_LANES) {
                let scaled = simd.mul_f64s(inverse, load::<S>(values, own + part));
                store::<S>(values, own + part, scaled);
            }
        }
        for (k, (_, block)) in column.below.iter().enumerate() {
            let (from, to) = (k * count * ROW, block * ROW);
            for at in (0..count * ROW).step_by(S::F64_LANES) {
                store::<S>(values, to + at, load::<S>(panel, from + at));
            }
        }
    }
    sound.then_some(negative)
}

/// Takes off a column's part in the blocks behind it; `panel`: its blocks over their pivots.
#[inline(always)]
fn change<S: Simd>(simd: S, blocks: &Blocks, column: &Column, values: &mut [f64], panel: &[f64]) {
    let count = column.own.len();
    let zero = simd.splat_f64s(0.0);
    let mut next = 0;
    for (j, (target, _)) in column.below.iter().enumerate() {
        let height = blocks.columns[*target].own.len();
        for i in j..column.below.len() {
            let changed = column.changed[next] * ROW;
            next += 1;
            let from = column.below[i].1 * ROW;
            for part in (0..ROW).step_by(S::F64_LANES) {
                let mut rows = [zero; ROW];
                for c in 0..count.min(ROW) {
                    rows[c] = load::<S>(values, from + c * ROW + part);
                }
                let panel = &panel[j * count * ROW..(j + 1) * count * ROW];
                for b in 0..height {
                    let to = changed + b * ROW + part;
                    let mut sum = load::<S>(values, to);
                    for c in 0..count.min(ROW) {
                        let share = simd.splat_f64s(-panel[c * ROW + b]);
                        sum = simd.mul_add_e_f64s(share, rows[c], sum);
                    }
                    store::<S>(values, to, sum);
                }
            }
        }
    }
}

/// Solves in place for eight right-hand sides, a row a coordinate.
#[inline(always)]
pub(super) fn solve<S: Simd>(
    simd: S,
    blocks: &Blocks,
    values: &[f64],
    inverses: &[f64],
    rows: &mut [f64],
) {
    let zero = simd.splat_f64s(0.0);
    for part in (0..ROW).step_by(S::F64_LANES) {
        for column in &blocks.columns {
            let (first, count) = (column.own.start, column.own.len().min(ROW));
            let mut own = [zero; ROW];
            for c in 0..count {
                let mut sum = load::<S>(rows, (first + c) * ROW + part);
                for before in 0..c {
                    let share = values[(column.diagonal + before) * ROW + c];
                    sum = simd.mul_add_e_f64s(simd.splat_f64s(-share), own[before], sum);
                }
                own[c] = sum;
            }
            for (row, block) in &column.below {
                let target = &blocks.columns[*row].own;
                let block = &values[block * ROW..(block + count) * ROW];
                for a in 0..target.len() {
                    let to = (target.start + a) * ROW + part;
                    let mut sum = load::<S>(rows, to);
                    for c in 0..count {
                        let share = simd.splat_f64s(-block[c * ROW + a]);
                        sum = simd.mul_add_e_f64s(share, own[c], sum);
                    }
                    store::<S>(rows, to, sum);
                }
            }
            for c in 0..count {
                store::<S>(rows, (first + c) * ROW + part, own[c]);
            }
        }
        for column in blocks.columns.iter().rev() {
            let (first, count) = (column.own.start, column.own.len().min(ROW));
            let mut own = [zero; ROW];
            for c in 0..count {
                let inverse = simd.splat_f64s(inverses[first + c]);
                own[c] = simd.mul_f64s(inverse, load::<S>(rows, (first + c) * ROW + part));
            }
            for (row, block) in &column.below {
                let target = &blocks.columns[*row].own;
                let block = &values[block * ROW..(block + count) * ROW];
                for a in 0..target.len() {
                    let from = load::<S>(rows, (target.start + a) * ROW + part);
                    for c in 0..count {
                        let share = simd.splat_f64s(-block[c * ROW + a]);
                        own[c] = simd.mul_add_e_f64s(share, from, own[c]);
                    }
                }
            }
            for c in (0..count).rev() {
                for after in c + 1..count {
                    let share = values[(column.diagonal + c) * ROW + after];
                    own[c] = simd.mul_add_e_f64s(simd.splat_f64s(-share), own[after], own[c]);
                }
                store::<S>(rows, (first + c) * ROW + part, own[c]);
            }
        }
    }
}
