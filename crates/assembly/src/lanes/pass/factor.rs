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
/// whose pivot is none becomes not a number. `panel`: `size · (pivots + 1)` entries.
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
    let first_idle = pivots - idle;
    let mut k = 0;
    // Two columns at a time, so that what they take from those before is read once.
    while k + 1 < pivots {
        update::<S, 2>(simd, matrix, k, panel);
        pivot(simd, matrix, k, k >= first_idle, panel);
        let l = Lane::new(simd, panel[k * size + k + 1]);
        let (column, next) = matrix.entries[k * size..].split_at_mut(size);
        for (own, next) in column[k + 1..].iter().zip(&mut next[k + 1..size]) {
            *next = Lane::new(simd, *own)
                .mul_add(l, Lane::new(simd, *next))
                .value;
        }
        pivot(simd, matrix, k + 1, k + 1 >= first_idle, panel);
        k += 2;
    }
    if k < pivots {
        update::<S, 1>(simd, matrix, k, panel);
        pivot(simd, matrix, k, k >= first_idle, panel);
    }
    let left = size - pivots;
    let entries = &*matrix.entries;
    let mut column = pivots;
    while column + 2 <= columns {
        let mut row = column;
        while row + 4 <= size {
            rest_tile::<S, 4, 2>(simd, entries, panel, rest, [size, left, row, column]);
            row += 4;
        }
        if row + 2 <= size {
            rest_tile::<S, 2, 2>(simd, entries, panel, rest, [size, left, row, column]);
            row += 2;
        }
        while row < size {
            rest_tile::<S, 1, 2>(simd, entries, panel, rest, [size, left, row, column]);
            row += 1;
        }
        column += 2;
    }
    if column < columns {
        for row in column..size {
            rest_tile::<S, 1, 1>(simd, entries, panel, rest, [size, left, row, column]);
        }
    }
}

/// Takes what the columns before k ask for from the C columns from k on.
#[inline(always)]
fn update<S: Simd, const C: usize>(
    simd: S,
    matrix: &mut Matrix<'_, S>,
    k: usize,
    panel: &[S::f64s],
) {
    let size = matrix.size;
    let mut row = k;
    while row + 4 <= size {
        pivot_tile::<S, 4, C>(simd, matrix.entries, panel, size, [row, k]);
        row += 4;
    }
    if row + 2 <= size {
        pivot_tile::<S, 2, C>(simd, matrix.entries, panel, size, [row, k]);
        row += 2;
    }
    if row < size {
        pivot_tile::<S, 1, C>(simd, matrix.entries, panel, size, [row, k]);
    }
}

/// Writes the column of pivot k over minus the pivot into the panel, and hands its errors on.
#[inline(always)]
fn pivot<S: Simd>(
    simd: S,
    matrix: &mut Matrix<'_, S>,
    k: usize,
    is_idle: bool,
    panel: &mut [S::f64s],
) {
    let size = matrix.size;
    let columns = size - matrix.rows;
    let epsilon = Lane::splat(simd, ROUNDING);
    let nan = Lane::splat(simd, f64::NAN);
    let column = &matrix.entries[k * size..][..size];
    let out = &mut panel[k * size..][..size];
    let errors = &mut matrix.errors[..size];
    let load_errors = &mut *matrix.load_errors;
    let error = Lane::new(simd, errors[k]);
    let pivot = Lane::new(simd, column[k]);
    if is_idle {
        // Nothing resists it: it must have no pivot and act on nothing.
        let still = error * epsilon * Lane::splat(simd, IDLE);
        let zero = Lane::splat(simd, 0.0);
        let mut poison = pivot.abs().if_above(still, nan, zero);
        for i in k + 1..size {
            let entry = Lane::new(simd, column[i]);
            let mut bound = still * Lane::new(simd, errors[i]) * epsilon * Lane::splat(simd, IDLE);
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
        return;
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

/// `a_ik −= Σ_j c_ij l_kj` for R rows of the C columns from k on; the panel holds −l. Above the diagonal
/// is nothing that counts.
#[inline(always)]
fn pivot_tile<S: Simd, const R: usize, const C: usize>(
    simd: S,
    entries: &mut [S::f64s],
    panel: &[S::f64s],
    size: usize,
    [row, k]: [usize; 2],
) {
    let mut sums = [[simd.splat_f64s(0.0); R]; C];
    for c in 0..C {
        let own = &entries[(k + c) * size + row..][..R];
        for r in 0..R {
            sums[c][r] = own[r];
        }
    }
    products(simd, entries, panel, [size, k, row, k], &mut sums);
    for c in 0..C {
        let own = &mut entries[(k + c) * size + row..][..R];
        for r in 0..R {
            own[r] = sums[c][r];
        }
    }
}

/// The same for R rows and C columns of what is left, which goes to the rest.
#[inline(always)]
fn rest_tile<S: Simd, const R: usize, const C: usize>(
    simd: S,
    entries: &[S::f64s],
    panel: &[S::f64s],
    rest: &mut [S::f64s],
    [size, left, row, column]: [usize; 4],
) {
    let pivots = size - left;
    let mut sums = [[simd.splat_f64s(0.0); R]; C];
    for c in 0..C {
        let from = &entries[(column + c) * size + row..][..R];
        for r in 0..R {
            sums[c][r] = from[r];
        }
    }
    products(simd, entries, panel, [size, pivots, row, column], &mut sums);
    for c in 0..C {
        let to = &mut rest[(column - pivots + c) * left + row - pivots..][..R];
        for r in 0..R {
            to[r] = sums[c][r];
        }
    }
}

/// Adds `Σ_j c_ij (−l_kj)` over the first `done` columns, for R rows and C columns.
#[inline(always)]
fn products<S: Simd, const R: usize, const C: usize>(
    simd: S,
    entries: &[S::f64s],
    panel: &[S::f64s],
    [size, done, row, column]: [usize; 4],
    sums: &mut [[S::f64s; R]; C],
) {
    let own = entries[row..][..done * size].chunks_exact(size);
    let by = panel[column..][..done * size].chunks_exact(size);
    for (c_k, l_k) in own.zip(by) {
        if let (Some(c_k), Some(l_k)) = (c_k.first_chunk::<R>(), l_k.first_chunk::<C>()) {
            for c in 0..C {
                for r in 0..R {
                    sums[c][r] = simd.mul_add_e_f64s(c_k[r], l_k[c], sums[c][r]);
                }
            }
        }
    }
}
