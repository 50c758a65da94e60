//! Elimination of a front's pivots: the dense kernel of the lanes.
//!
//! L D Lᵀ without pivoting, left-looking, in tiles that stay in registers. Beside the matrix goes
//! an estimate of its errors: every coordinate starts with the rounding of all that was added to
//! its diagonal entry, and an elimination hands `l²` of the pivot's error on, as a perturbation of
//! the pivot would act.

use pulp::Simd;

use super::lane::Lane;

/// Rounding of a sum, relative to its terms: some additions' root mean square.
pub(crate) const ROUNDING: f64 = f64::EPSILON / 4.0;
/// A pivot must be this many times its error to be taken for one.
const PIVOT: f64 = 16.0;
/// A pivot that an idle motion leaves is below this many times its error.
pub(crate) const IDLE: f64 = 4e3;

/// A front's matrix, its lower triangle, column by column at `size` each, and its variables'
/// errors: of the diagonal entries, as a multiple of [`ROUNDING`].
pub(crate) struct Matrix<'a, S: Simd> {
    pub entries: &'a mut [S::f64s],
    pub size: usize,
    pub errors: &'a mut [S::f64s],
    /// Variables, the last ones, that are rows of what acts; nothing is found between them.
    pub rows: usize,
    /// By rows: squares of their entries' errors over [`ROUNDING`]'s square, by variables.
    pub load_errors: &'a mut [S::f64s],
}

/// Eliminates the first `pivots` variables, the last `idle` of which no energy goes into, and
/// writes what is left into `rest`, a square by columns of which the lower triangle counts. A lane
/// whose pivot is none becomes not a number. `panel`: `size · pivots` entries.
#[inline(always)]
pub(crate) fn eliminate<S: Simd>(
    simd: S,
    matrix: &mut Matrix<'_, S>,
    pivots: usize,
    idle: usize,
    panel: &mut [S::f64s],
    rest: &mut [S::f64s],
) {
    let size = matrix.size;
    let columns = size - matrix.rows;
    let epsilon = Lane::splat(simd, ROUNDING);
    let nan = Lane::splat(simd, f64::NAN);
    let errors = &mut matrix.errors[..size];
    let load_errors = &mut *matrix.load_errors;
    let entries = &mut matrix.entries[..size * size];
    for k in 0..pivots {
        let (done, rest) = entries.split_at_mut(k * size);
        let column = &mut rest[..size];
        let (done_panel, rest) = panel.split_at_mut(k * size);
        let out = &mut rest[..size];
        let mut row = k;
        while row + 4 <= size {
            pivot_tile::<S, 4>(simd, done, done_panel, column, size, [row, k]);
            row += 4;
        }
        while row < size {
            pivot_tile::<S, 1>(simd, done, done_panel, column, size, [row, k]);
            row += 1;
        }
        let error = Lane::new(simd, errors[k]);
        let pivot = Lane::new(simd, column[k]);
        if k + idle >= pivots {
            // Nothing resists it: it must have no pivot and act on nothing.
            let still = error * epsilon * Lane::splat(simd, IDLE);
            let zero = Lane::splat(simd, 0.0);
            let mut poison = pivot.abs().if_above(still, nan, zero);
            for i in k + 1..size {
                let entry = Lane::new(simd, column[i]);
                let mut bound =
                    still * Lane::new(simd, errors[i]) * epsilon * Lane::splat(simd, IDLE);
                if i >= columns {
                    let loads = Lane::new(simd, load_errors[(i - columns) * size + k]);
                    let share = (ROUNDING * IDLE) * (ROUNDING * IDLE);
                    bound = loads.mul_add(Lane::splat(simd, share), bound);
                }
                poison += (entry * entry).if_above(bound, nan, zero);
            }
            for out in &mut out[k + 1..] {
                *out = poison.value;
            }
            continue;
        }
        let least = error * epsilon * Lane::splat(simd, PIVOT);
        let minus = -pivot.if_above(least, pivot.recip(), nan);
        let below = column[k + 1..].iter().zip(&mut out[k + 1..]);
        for ((entry, out), sum) in below.zip(&mut errors[k + 1..]) {
            let l = Lane::new(simd, *entry) * minus;
            *out = l.value;
            *sum = (l * l).mul_add(error, Lane::new(simd, *sum)).value;
        }
        for row in 0..matrix.rows {
            let own = &mut load_errors[row * size..(row + 1) * size];
            let error = Lane::new(simd, own[k]);
            for (l, sum) in out[k + 1..columns].iter().zip(&mut own[k + 1..columns]) {
                let l = Lane::new(simd, *l);
                *sum = (l * l).mul_add(error, Lane::new(simd, *sum)).value;
            }
        }
    }
    let left = size - pivots;
    let (done, entries) = entries.split_at_mut(pivots * size);
    let mut column = pivots;
    while column + 2 <= columns {
        let mut row = column;
        while row + 4 <= size {
            rest_tile::<S, 4, 2>(simd, done, panel, entries, rest, [size, left, row, column]);
            row += 4;
        }
        if row + 2 <= size {
            rest_tile::<S, 2, 2>(simd, done, panel, entries, rest, [size, left, row, column]);
            row += 2;
        }
        while row < size {
            rest_tile::<S, 1, 2>(simd, done, panel, entries, rest, [size, left, row, column]);
            row += 1;
        }
        column += 2;
    }
    if column < columns {
        for row in column..size {
            rest_tile::<S, 1, 1>(simd, done, panel, entries, rest, [size, left, row, column]);
        }
    }
}

/// `a_ik −= Σ_j c_ij l_kj` for R rows of column k; the panel holds −l.
#[inline(always)]
fn pivot_tile<S: Simd, const R: usize>(
    simd: S,
    done: &[S::f64s],
    panel: &[S::f64s],
    column: &mut [S::f64s],
    size: usize,
    [row, k]: [usize; 2],
) {
    let own = &mut column[row..row + R];
    let mut sums = [simd.splat_f64s(0.0); R];
    for r in 0..R {
        sums[r] = own[r];
    }
    if !done.is_empty() {
        for (c, l) in done[row..].chunks(size).zip(panel[k..].chunks(size)) {
            if let (Some(c), Some(l)) = (c.first_chunk::<R>(), l.first()) {
                for r in 0..R {
                    sums[r] = simd.mul_add_e_f64s(c[r], *l, sums[r]);
                }
            }
        }
    }
    for r in 0..R {
        own[r] = sums[r];
    }
}

/// The same for R rows and C columns of what is left, which goes to the rest.
#[inline(always)]
fn rest_tile<S: Simd, const R: usize, const C: usize>(
    simd: S,
    done: &[S::f64s],
    panel: &[S::f64s],
    entries: &[S::f64s],
    rest: &mut [S::f64s],
    [size, left, row, column]: [usize; 4],
) {
    let pivots = size - left;
    let mut sums = [[simd.splat_f64s(0.0); R]; C];
    for c in 0..C {
        let from = &entries[(column - pivots + c) * size + row..][..R];
        for r in 0..R {
            sums[c][r] = from[r];
        }
    }
    if !done.is_empty() {
        for (c_k, l_k) in done[row..].chunks(size).zip(panel[column..].chunks(size)) {
            if let (Some(c_k), Some(l_k)) = (c_k.first_chunk::<R>(), l_k.first_chunk::<C>()) {
                for c in 0..C {
                    for r in 0..R {
                        sums[c][r] = simd.mul_add_e_f64s(c_k[r], l_k[c], sums[c][r]);
                    }
                }
            }
        }
    }
    for c in 0..C {
        let to = &mut rest[(column - pivots + c) * left + row - pivots..][..R];
        for r in 0..R {
            to[r] = sums[c][r];
        }
    }
}
