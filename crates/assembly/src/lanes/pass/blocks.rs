//! The stiffness of one element over its nodes, in global axes: 6×6 blocks by pairs of nodes.
//!
//! Block (r, s) with r ≤ s is the s(s + 1)/2 + r-th, its 36 entries by rows.

use nalgebra::Matrix6;
use pulp::Simd;

use super::lane::{
    Lane, Mat3, Vec3, add, cross, dot, product, product_transposed, scaled, sub, three, transposed,
};
use crate::lanes::program::element::FlexibleElement;
use crate::lanes::program::inputs::Point;

/// A `y_axis` closer than this to the beam (sine of the angle) counts as along it.
const ALONG: f64 = 1e-6;

/// Place of block (r, s), r ≤ s.
#[inline(always)]
pub(crate) fn place(r: usize, s: usize) -> usize {
    36 * (s * (s + 1) / 2 + r)
}

/// A vector of the inputs.
#[inline(always)]
pub(crate) fn vector<S: Simd>(simd: S, inputs: &[S::f64s], place: usize) -> Vec3<S> {
    let at = &inputs[3 * place..3 * place + 3];
    three!(k => Lane::new(simd, at[k]))
}

/// Two vectors of the inputs.
#[inline(always)]
pub(crate) fn both<S: Simd>(simd: S, inputs: &[S::f64s], places: [usize; 2]) -> [Vec3<S>; 2] {
    [
        vector(simd, inputs, places[0]),
        vector(simd, inputs, places[1]),
    ]
}

/// A wrench, or a twist or displacement: its linear part, then its angular one.
pub(crate) type Pair<S> = (Vec3<S>, Vec3<S>);

/// The pair at a place of a list of them.
#[inline(always)]
pub(crate) fn pair<S: Simd>(simd: S, pairs: &[S::f64s], place: usize) -> Pair<S> {
    let at = &pairs[6 * place..6 * place + 6];
    (
        three!(k => Lane::new(simd, at[k])),
        three!(k => Lane::new(simd, at[3 + k])),
    )
}

/// Writes the pair at a place of a list of them.
#[inline(always)]
pub(crate) fn write_pair<S: Simd>(
    pairs: &mut [S::f64s],
    place: usize,
    (linear, angular): &Pair<S>,
) {
    let out = &mut pairs[6 * place..6 * place + 6];
    for k in 0..3 {
        out[k] = linear[k].value;
        out[3 + k] = angular[k].value;
    }
}

/// From one point of the inputs to another.
#[inline(always)]
pub(crate) fn arm<S: Simd>(simd: S, inputs: &[S::f64s], [from, to]: [usize; 2]) -> Vec3<S> {
    sub(&vector(simd, inputs, to), &vector(simd, inputs, from))
}

/// The part of `v` normal to the unit vector `x`.
#[inline(always)]
fn normal_part<S: Simd>(v: &Vec3<S>, x: &Vec3<S>) -> Vec3<S> {
    sub(v, &scaled(x, dot(x, v)))
}

#[inline(always)]
fn unit<S: Simd>(v: &Vec3<S>) -> Vec3<S> {
    scaled(v, dot(v, v).sqrt().recip())
}

/// Unit vectors of an element frame as rows, as
/// [`element_frame`](hyperstat_elements::element_frame) has them; not numbers where it has none.
#[inline(always)]
pub(crate) fn element_axes<S: Simd>(x: &Vec3<S>, y_axis: &Vec3<S>) -> Mat3<S> {
    let part = normal_part(&unit(y_axis), x);
    let (size, nan) = (dot(&part, &part), x[0].constant(f64::NAN));
    let size = size.if_above(x[0].constant(ALONG * ALONG), size, nan);
    let part = scaled(&part, size.sqrt().recip());
    let y = unit(&normal_part(&part, x));
    [*x, y, cross(x, &y)]
}

/// `Σ cₖ aₖ aₖᵀ` over rows aₖ.
#[inline(always)]
pub(crate) fn spectral<S: Simd>(axes: &Mat3<S>, c: [Lane<S>; 3]) -> Mat3<S> {
    let weighted: Mat3<S> = three!(k => scaled(&axes[k], c[k]));
    three!(i => three!(j => {
        weighted[0][i].mul_add(
            axes[0][j],
            weighted[1][i].mul_add(axes[1][j], weighted[2][i] * axes[2][j]),
        )
    }))
}

#[inline(always)]
pub(crate) fn negated<S: Simd>(a: &Mat3<S>) -> Mat3<S> {
    three!(i => three!(j => -a[i][j]))
}

/// Writes a 6×6 block from its four 3×3 ones.
#[inline(always)]
pub(crate) fn write<S: Simd>(blocks: &mut [S::f64s], place: usize, parts: [&Mat3<S>; 4]) {
    let out = &mut blocks[place..place + 36];
    for i in 0..3 {
        for j in 0..3 {
            out[6 * i + j] = parts[0][i][j].value;
            out[6 * i + 3 + j] = parts[1][i][j].value;
            out[6 * (3 + i) + j] = parts[2][i][j].value;
            out[6 * (3 + i) + 3 + j] = parts[3][i][j].value;
        }
    }
}

/// `R B Rᵀ` of the 3×3 block of a constant matrix that starts at `(i, j)`.
#[inline(always)]
pub(crate) fn turned<S: Simd>(
    simd: S,
    matrix: &Matrix6<f64>,
    (i, j): (usize, usize),
    turn: &Mat3<S>,
) -> Mat3<S> {
    let block: Mat3<S> = three!(r => three!(c => Lane::splat(simd, matrix[(i + r, j + c)])));
    product_transposed(&product(turn, &block), turn)
}

/// Blocks of a flexible body: its stiffness, held at node 0, turned to global axes, and what
/// follows for node 0.
#[inline(always)]
pub(crate) fn flexible<S: Simd>(
    simd: S,
    body: &FlexibleElement,
    inputs: &[S::f64s],
    blocks: &mut [S::f64s],
) {
    let axes = &transposed(&three!(k => vector(simd, inputs, body.axes[k])));
    let stiffness = &body.stiffness;
    let count = body.points.len() - 1;
    for s in 1..=count {
        for r in 1..=s {
            let part = |i: usize, j: usize| (6 * count, 6 * (r - 1) + i, 6 * (s - 1) + j);
            let a = held_part(simd, stiffness, axes, part(0, 0));
            let b = held_part(simd, stiffness, axes, part(0, 3));
            let d = held_part(simd, stiffness, axes, part(3, 3));
            let c = if r == s {
                transposed(&b)
            } else {
                held_part(simd, stiffness, axes, part(3, 0))
            };
            write(blocks, place(r, s), [&a, &b, &c, &d]);
        }
    }
    unheld(simd, &body.points, inputs, blocks);
}

/// Blocks (0, s) of a stiffness held at node 0, from the others by equilibrium (Eqs. 3 and 7).
#[inline(always)]
fn unheld<S: Simd>(simd: S, points: &[Point], inputs: &[S::f64s], blocks: &mut [S::f64s]) {
    let count = points.len() - 1;
    for s in 0..=count {
        for entry in &mut blocks[place(0, s)..place(0, s) + 36] {
            *entry = simd.splat_f64s(0.0);
        }
    }
    for s in 1..=count {
        for r in 1..=count {
            // K_0s −= X_rᵀ K_rs
            let arm = arm(simd, inputs, [points[0], points[r]]);
            let (from, [rows, columns]) = if r <= s {
                (place(r, s), [6, 1])
            } else {
                (place(s, r), [1, 6])
            };
            for j in 0..6 {
                let start = from + j * columns;
                let linear: Vec3<S> = three!(i => Lane::new(simd, blocks[start + i * rows]));
                let angular: Vec3<S> = three!(i => Lane::new(simd, blocks[start + (3 + i) * rows]));
                let angular = add(&angular, &cross(&arm, &linear));
                for i in 0..3 {
                    subtract(simd, &mut blocks[place(0, s) + 6 * i + j], linear[i]);
                    subtract(simd, &mut blocks[place(0, s) + 6 * (3 + i) + j], angular[i]);
                }
            }
        }
        // K_00 −= K_0s X_s
        let arm = arm(simd, inputs, [points[0], points[s]]);
        for i in 0..6 {
            let at = place(0, s) + 6 * i;
            let linear: Vec3<S> = three!(j => Lane::new(simd, blocks[at + j]));
            let angular: Vec3<S> = three!(j => Lane::new(simd, blocks[at + 3 + j]));
            let angular = add(&angular, &cross(&arm, &linear));
            for j in 0..3 {
                subtract(simd, &mut blocks[6 * i + j], linear[j]);
                subtract(simd, &mut blocks[6 * i + 3 + j], angular[j]);
            }
        }
    }
}

/// A 3×3 part of a constant matrix (its number of rows, first row and column) in global axes.
#[inline(always)]
fn held_part<S: Simd>(
    simd: S,
    matrix: &[f64],
    axes: &Mat3<S>,
    (rows, i, j): (usize, usize, usize),
) -> Mat3<S> {
    let block: Mat3<S> =
        three!(k => three!(l => Lane::splat(simd, matrix[(j + l) * rows + i + k])));
    product_transposed(&product(axes, &block), axes)
}

/// Blocks of a stiffness between two nodes at one point, or of one node and the ground.
#[inline(always)]
pub(crate) fn bushing<S: Simd>(
    simd: S,
    columns: &[usize; 3],
    stiffness: &Matrix6<f64>,
    nodes: usize,
    inputs: &[S::f64s],
    blocks: &mut [S::f64s],
) {
    let frame = transposed(&three!(k => vector(simd, inputs, columns[k])));
    let a = turned(simd, stiffness, (0, 0), &frame);
    let b = turned(simd, stiffness, (0, 3), &frame);
    let d = turned(simd, stiffness, (3, 3), &frame);
    write(blocks, place(0, 0), [&a, &b, &transposed(&b), &d]);
    if nodes == 2 {
        write(blocks, place(1, 1), [&a, &b, &transposed(&b), &d]);
        let (a, b, d) = (negated(&a), negated(&b), negated(&d));
        write(blocks, place(0, 1), [&a, &b, &transposed(&b), &d]);
    }
}

#[inline(always)]
fn subtract<S: Simd>(simd: S, entry: &mut S::f64s, value: Lane<S>) {
    *entry = simd.sub_f64s(*entry, value.value);
}
