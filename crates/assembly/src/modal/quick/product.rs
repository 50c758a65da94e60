//! The mass times eight vectors, member by member.

use nalgebra::Matrix6;
use pulp::Simd;

use super::blocks::ROW;
use super::factor::{load, store};
use super::kinds::{FOURS, Kind, PAIRS, Plane};
use super::table::{End, Table};

/// The mass at a shift in one configuration.
pub(super) struct Mass<'a> {
    pub table: &'a Table,
    pub kinds: &'a [Kind],
    pub locals: &'a [f64],
    pub masses: &'a [Matrix6<f64>],
}

impl Mass<'_> {
    /// `out = M x`, a row a coordinate, those of the inner shapes last.
    #[inline(always)]
    pub fn times<S: Simd>(&self, simd: S, x: &[f64], out: &mut [f64]) {
        let zero = simd.splat_f64s(0.0);
        out[..self.table.nodes * ROW].fill(0.0);
        for part in (0..ROW).step_by(S::F64_LANES) {
            for member in &self.table.members {
                let kind = &self.kinds[member.kind];
                let (mut moved, mut force) = ([zero; 12], [zero; 12]);
                gather::<S, 0>(simd, &member.ends[0], self.locals, x, part, &mut moved);
                gather::<S, 6>(simd, &member.ends[1], self.locals, x, part, &mut moved);
                let mut at = member.inner * ROW + part;
                let (u, f) = (&moved, &mut force);
                at = plane(simd, &kind.pairs[0], PAIRS[0], u, f, (x, out), at);
                at = plane(simd, &kind.pairs[1], PAIRS[1], u, f, (x, out), at);
                at = plane(simd, &kind.fours[0], FOURS[0], u, f, (x, out), at);
                plane(simd, &kind.fours[1], FOURS[1], u, f, (x, out), at);
                scatter::<S, 0>(simd, &member.ends[0], self.locals, &force, part, out);
                scatter::<S, 6>(simd, &member.ends[1], self.locals, &force, part, out);
            }
            for (mass, matrix) in self.table.masses.iter().zip(self.masses) {
                let mut moved = [zero; 12];
                gather::<S, 0>(simd, &mass.end, self.locals, x, part, &mut moved);
                let force = rigid(simd, matrix, &moved);
                scatter::<S, 0>(simd, &mass.end, self.locals, &force, part, out);
            }
        }
    }
}

/// Force of a node's mass.
#[inline(always)]
pub(super) fn rigid<S: Simd>(
    simd: S,
    matrix: &Matrix6<f64>,
    moved: &[S::f64s; 12],
) -> [S::f64s; 12] {
    let mut force = [simd.splat_f64s(0.0); 12];
    for a in 0..6 {
        for b in 0..6 {
            let entry = simd.splat_f64s(matrix[(a, b)]);
            force[a] = simd.mul_add_e_f64s(entry, moved[b], force[a]);
        }
    }
    force
}

/// Displacement of a node, from component `FIRST` on.
#[inline(always)]
pub(super) fn gather<S: Simd, const FIRST: usize>(
    simd: S,
    end: &End,
    locals: &[f64],
    x: &[f64],
    part: usize,
    moved: &mut [S::f64s; 12],
) {
    let zero = simd.splat_f64s(0.0);
    let mut sums = [zero; 6];
    let locals = &locals[end.start..end.start + 6 * end.places.len()];
    for k in 0..end.places.len() {
        let own = &locals[6 * k..6 * k + 6];
        let amount = load::<S>(x, end.places[k] * ROW + part);
        for r in 0..6 {
            sums[r] = simd.mul_add_e_f64s(simd.splat_f64s(own[r]), amount, sums[r]);
        }
    }
    for r in 0..6 {
        moved[FIRST + r] = sums[r];
    }
}

/// Adds a force on a node, from component `FIRST` on, to the coordinates'.
#[inline(always)]
pub(super) fn scatter<S: Simd, const FIRST: usize>(
    simd: S,
    end: &End,
    locals: &[f64],
    force: &[S::f64s; 12],
    part: usize,
    out: &mut [f64],
) {
    let locals = &locals[end.start..end.start + 6 * end.places.len()];
    for k in 0..end.places.len() {
        let own = &locals[6 * k..6 * k + 6];
        let to = end.places[k] * ROW + part;
        let mut sum = load::<S>(out, to);
        for r in 0..6 {
            sum = simd.mul_add_e_f64s(simd.splat_f64s(own[r]), force[FIRST + r], sum);
        }
        store::<S>(out, to, sum);
    }
}

/// Adds the forces of a direction, and writes those of its inner shapes; returns where the next begin.
#[inline(always)]
fn plane<S: Simd, const N: usize>(
    simd: S,
    plane: &Plane<N>,
    rows: [usize; N],
    moved: &[S::f64s; 12],
    force: &mut [S::f64s; 12],
    (x, out): (&[f64], &mut [f64]),
    mut at: usize,
) -> usize {
    let zero = simd.splat_f64s(0.0);
    let mut sums = [zero; N];
    for a in 0..N {
        for b in 0..N {
            let entry = simd.splat_f64s(plane.mass[(a, b)]);
            sums[a] = simd.mul_add_e_f64s(entry, moved[rows[b]], sums[a]);
        }
    }
    for shape in &plane.shapes {
        let own = load::<S>(x, at);
        let mut coupled = own;
        for a in 0..N {
            let entry = simd.splat_f64s(shape.coupling[a]);
            coupled = simd.mul_add_e_f64s(entry, moved[rows[a]], coupled);
            sums[a] = simd.mul_add_e_f64s(entry, own, sums[a]);
        }
        store::<S>(out, at, coupled);
        at += ROW;
    }
    for a in 0..N {
        force[rows[a]] = simd.add_f64s(force[rows[a]], sums[a]);
    }
    at
}
