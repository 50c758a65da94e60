//! The stiffness of one element over its nodes, in global axes: 6×6 blocks by pairs of nodes.
//!
//! Block (r, s) with r ≤ s is the s(s + 1)/2 + r-th, its 36 entries by rows.

use nalgebra::Matrix6;
use pulp::Simd;

use super::lane::{
    Lane, Mat3, Vec3, add, apply, cross, dot, product, product_transposed, scaled, sub, three,
    transposed,
};
use super::program::{Axes, BeamElement, HeldElement};

/// A `y_axis` closer than this to the beam (sine of the angle) counts as along it.
const ALONG: f64 = 1e-6;

/// Place of block (r, s), r ≤ s.
#[inline(always)]
pub(super) fn place(r: usize, s: usize) -> usize {
    36 * (s * (s + 1) / 2 + r)
}

/// A vector of the inputs.
#[inline(always)]
pub(super) fn vector<S: Simd>(simd: S, inputs: &[S::f64s], place: usize) -> Vec3<S> {
    let at = &inputs[3 * place..3 * place + 3];
    three!(k => Lane::new(simd, at[k]))
}

/// From one point of the inputs to another.
#[inline(always)]
pub(super) fn arm<S: Simd>(simd: S, inputs: &[S::f64s], [from, to]: [usize; 2]) -> Vec3<S> {
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
pub(super) fn element_axes<S: Simd>(x: &Vec3<S>, y_axis: &Vec3<S>) -> Mat3<S> {
    let part = normal_part(&unit(y_axis), x);
    let (size, nan) = (dot(&part, &part), x[0].constant(f64::NAN));
    let size = size.if_above(x[0].constant(ALONG * ALONG), size, nan);
    let part = scaled(&part, size.sqrt().recip());
    let y = unit(&normal_part(&part, x));
    [*x, y, cross(x, &y)]
}

/// `Σ cₖ aₖ aₖᵀ` over rows aₖ.
#[inline(always)]
pub(super) fn spectral<S: Simd>(axes: &Mat3<S>, c: [Lane<S>; 3]) -> Mat3<S> {
    let weighted: Mat3<S> = three!(k => scaled(&axes[k], c[k]));
    three!(i => three!(j => {
        weighted[0][i].mul_add(
            axes[0][j],
            weighted[1][i].mul_add(axes[1][j], weighted[2][i] * axes[2][j]),
        )
    }))
}

#[inline(always)]
pub(super) fn negated<S: Simd>(a: &Mat3<S>) -> Mat3<S> {
    three!(i => three!(j => -a[i][j]))
}

/// Writes a 6×6 block from its four 3×3 ones.
#[inline(always)]
pub(super) fn write<S: Simd>(blocks: &mut [S::f64s], place: usize, parts: [&Mat3<S>; 4]) {
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

/// Bending in one plane: force per deflection, force per rotation, moment per rotation at the same
/// node and at the other.
#[inline(always)]
fn bending<S: Simd>(rigidity: f64, shear: f64, per_length: Lane<S>) -> [Lane<S>; 4] {
    let over = per_length * per_length.constant(rigidity);
    let (r, same, other);
    if shear == 0.0 {
        r = over;
        same = over.constant(4.0) * over;
        other = over.constant(2.0) * over;
    } else {
        let s = per_length * per_length * over.constant(shear);
        r = over / (over.constant(1.0) + s);
        same = (over.constant(4.0) + s) * r;
        other = (over.constant(2.0) - s) * r;
    }
    let moment = over.constant(6.0) * r * per_length;
    [
        over.constant(2.0) * moment * per_length,
        moment,
        same,
        other,
    ]
}

/// `across (E − x xᵀ) + along x xᵀ` for a unit vector x.
#[inline(always)]
fn axial<S: Simd>(x: &Vec3<S>, across: Lane<S>, along: Lane<S>) -> Mat3<S> {
    let [a, b, c] = scaled(x, along - across);
    let (ab, ac, bc) = (a * x[1], a * x[2], b * x[2]);
    [
        [a.mul_add(x[0], across), ab, ac],
        [ab, b.mul_add(x[1], across), bc],
        [ac, bc, c.mul_add(x[2], across)],
    ]
}

/// Blocks of a prismatic beam (Eqs. 1–3 with shear, Eq. 38).
#[inline(always)]
pub(super) fn beam<S: Simd>(
    simd: S,
    beam: &BeamElement,
    inputs: &[S::f64s],
    blocks: &mut [S::f64s],
) {
    let span = arm(simd, inputs, beam.ends);
    let per_length = dot(&span, &span).sqrt().recip();
    let x = scaled(&span, per_length);
    let tension = Lane::splat(simd, beam.axial) * per_length;
    let torsion = Lane::splat(simd, beam.torsional) * per_length;
    let (t, b, c, d);
    if let Some(y_axis) = beam.y_axis {
        let axes = element_axes(&x, &vector(simd, inputs, y_axis));
        let [dz, mz, same_y, other_y] = bending(beam.bending[0], beam.shear[0], per_length);
        let [dy, my, same_z, other_z] = bending(beam.bending[1], beam.shear[1], per_length);
        t = spectral(&axes, [tension, dy, dz]);
        c = spectral(&axes, [torsion, same_y, same_z]);
        d = spectral(&axes, [-torsion, other_y, other_z]);
        let (y, z) = (scaled(&axes[1], my), scaled(&axes[2], mz));
        b = three!(i => three!(j => y[i].mul_add(axes[2][j], -(z[i] * axes[1][j]))));
    } else {
        let [deflection, moment, same, other] = bending(beam.bending[0], beam.shear[0], per_length);
        t = axial(&x, deflection, tension);
        c = axial(&x, same, torsion);
        d = axial(&x, other, -torsion);
        let [x0, x1, x2] = scaled(&x, moment);
        let zero = Lane::splat(simd, 0.0);
        b = [[zero, x2, -x1], [-x2, zero, x0], [x1, -x0, zero]];
    }
    let minus_b = negated(&b);
    let minus_b_t = transposed(&minus_b);
    write(blocks, place(0, 0), [&t, &b, &transposed(&b), &c]);
    write(blocks, place(0, 1), [&negated(&t), &b, &minus_b_t, &d]);
    write(blocks, place(1, 1), [&t, &minus_b, &minus_b_t, &c]);
}

/// The axes of a held element as the columns of a rotation.
#[inline(always)]
pub(super) fn held_axes<S: Simd>(simd: S, held: &HeldElement, inputs: &[S::f64s]) -> Mat3<S> {
    let rows = match held.axes {
        Axes::Flexible(columns) => three!(k => vector(simd, inputs, columns[k])),
        Axes::Segment(y_axis) => {
            let span = arm(simd, inputs, [held.points[0], held.points[1]]);
            let x = scaled(&span, dot(&span, &span).sqrt().recip());
            element_axes(&x, &vector(simd, inputs, y_axis))
        }
    };
    transposed(&rows)
}

/// The largest difference between what a held element's stiffness depends on and what it was in
/// the plan's configuration, relative to its size.
#[inline(always)]
pub(super) fn held_change<S: Simd>(
    simd: S,
    held: &HeldElement,
    axes: &Mat3<S>,
    inputs: &[S::f64s],
) -> Lane<S> {
    let to_body = transposed(axes);
    let mut largest = Lane::splat(simd, 0.0);
    for (k, was) in held.arms.iter().enumerate() {
        let now = apply(
            &to_body,
            &arm(simd, inputs, [held.points[0], held.points[k + 1]]),
        );
        for c in 0..3 {
            let change = (now[c] - Lane::splat(simd, was[c])).abs();
            largest = largest.max(change * Lane::splat(simd, held.per_length));
        }
    }
    for joint in &held.joints {
        let columns = three!(k => vector(simd, inputs, joint.columns[k]));
        let turn = product(&to_body, &transposed(&columns));
        for part in &joint.parts {
            let now = turned(simd, &joint.own, part.place, &turn);
            for r in 0..3 {
                for c in 0..3 {
                    let was = joint.turned[(part.place.0 + r, part.place.1 + c)];
                    let change = (now[r][c] - Lane::splat(simd, was)).abs();
                    largest = largest.max(change * Lane::splat(simd, part.per_size));
                }
            }
        }
    }
    largest
}

/// `R B Rᵀ` of the 3×3 block of a constant matrix that starts at `(i, j)`.
#[inline(always)]
pub(super) fn turned<S: Simd>(
    simd: S,
    matrix: &Matrix6<f64>,
    (i, j): (usize, usize),
    turn: &Mat3<S>,
) -> Mat3<S> {
    let block: Mat3<S> = three!(r => three!(c => Lane::splat(simd, matrix[(i + r, j + c)])));
    product_transposed(&product(turn, &block), turn)
}

/// Blocks (r, s), 1 ≤ r ≤ s, of a stiffness over nodes 1..=m in the body's axes (column-major),
/// turned to global axes. `axes`: the body's as columns.
#[inline(always)]
pub(super) fn held_parts<S: Simd>(
    simd: S,
    held: &HeldElement,
    stiffness: &[f64],
    axes: &Mat3<S>,
    blocks: &mut [S::f64s],
) {
    let count = held.points.len() - 1;
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
}

/// Blocks (0, s) of a stiffness held at node 0, from the others by equilibrium (Eqs. 3 and 7).
#[inline(always)]
pub(super) fn unheld<S: Simd>(
    simd: S,
    held: &HeldElement,
    inputs: &[S::f64s],
    blocks: &mut [S::f64s],
) {
    let count = held.points.len() - 1;
    for s in 0..=count {
        for entry in &mut blocks[place(0, s)..place(0, s) + 36] {
            *entry = simd.splat_f64s(0.0);
        }
    }
    for s in 1..=count {
        for r in 1..=count {
            // K_0s −= X_rᵀ K_rs
            let arm = arm(simd, inputs, [held.points[0], held.points[r]]);
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
        let arm = arm(simd, inputs, [held.points[0], held.points[s]]);
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
pub(super) fn bushing<S: Simd>(
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
