//! Stiffnesses that change with the pose: a run of segments, or a body given by its stiffness, with
//! the elastic joints at its nodes absorbed (paper §2.1).
//!
//! The arithmetic is that of
//! [`absorb_joints`](hyperstat_elements::subassembly::absorb_joints), in global axes: with W the
//! columns of the joints' factors, `Q = (I + Wᵀ K W)⁻¹ Wᵀ K` and `P = I − W Q`, the stiffness is
//! `Pᵀ K P + Qᵀ Q`. An error in Q enters only squared.

use hyperstat_elements::subassembly::ElasticJoint;
use hyperstat_elements::{PlaneFlexibility, TaperedBeam};
use nalgebra::{Matrix6, Rotation3};
use pulp::Simd;

use super::blocks::{
    arm, beam, element_axes, held_axes, held_change, held_parts, negated, place, spectral, unheld,
    vector, write,
};
use super::inputs::Point;
use super::lane::{Lane, Mat3, Vec3, add, cross, dot, scaled, six, three, transposed};
use super::program::{BeamElement, HeldElement};

/// An element farther than this, relative to its size, from the plan's configuration is formed
/// anew.
const CHANGED: f64 = 1e-12;

/// How an element's stiffness is formed at a pose.
#[derive(Debug)]
pub(super) struct Form {
    pub body: Body,
    /// The columns of the absorbed joints' factors.
    pub columns: Vec<FactorColumn>,
}

/// A body before its joints are absorbed.
#[derive(Debug)]
pub(super) enum Body {
    /// Segments from node to node.
    Run(Vec<SegmentForm>),
    /// A stiffness over nodes 1..=m with node 0 held, in the body's axes, column-major.
    Given(Vec<f64>),
}

#[derive(Debug)]
pub(super) enum SegmentForm {
    Prismatic(BeamElement),
    Tapered(TaperedElement),
}

/// A beam whose section changes, by its flexibilities at unit length.
#[derive(Debug)]
pub(super) struct TaperedElement {
    ends: [Point; 2],
    /// Direction of local y.
    y_axis: usize,
    axial: f64,
    torsional: f64,
    /// Bending with deflection along y and along z.
    planes: [PlaneFlexibility; 2],
}

/// A relative displacement in a joint that takes one unit of energy, doubled: a column of a factor
/// of the joint's compliance.
#[derive(Debug)]
pub(super) struct FactorColumn {
    /// The joint's node.
    node: usize,
    /// Columns of the joint's frame (places in the inputs), with what each gives to the translation
    /// and to the rotation.
    axes: Vec<(usize, f64, f64)>,
}

impl FactorColumn {
    /// Of a joint at `node` with this compliance in its own frame.
    pub fn all_of(node: usize, compliance: &Matrix6<f64>, frame: [usize; 3]) -> Vec<Self> {
        let joint = ElasticJoint {
            compliance: *compliance,
            frame: Rotation3::identity(),
        };
        let factor = joint.factor();
        let columns = factor.column_iter().map(|column| {
            let axes = (0..3).map(|c| (frame[c], column[c], column[3 + c]));
            let axes = axes.filter(|(_, along, about)| *along != 0.0 || *about != 0.0);
            let axes = axes.collect();
            Self { node, axes }
        });
        columns.filter(|c| !c.axes.is_empty()).collect()
    }
}

impl TaperedElement {
    /// A beam of unit length between two points, run through backwards where `reversed` says so.
    pub fn new(beam: &TaperedBeam, reversed: bool, ends: [Point; 2], y_axis: usize) -> Self {
        let [axial, torsional] = beam.axial_and_torsional_flexibility();
        let mut planes = beam.plane_flexibilities();
        if reversed {
            for plane in &mut planes {
                plane.centre = 1.0 - plane.centre;
            }
        }
        Self {
            ends,
            y_axis,
            axial,
            torsional,
            planes,
        }
    }
}

impl Form {
    /// Numbers a pose that forming a stiffness over nodes 0..=n needs.
    pub fn workspace(&self, n: usize) -> usize {
        let (size, elastic) = (6 * n, self.columns.len());
        2 * size * size + 2 * size * elastic + elastic * elastic + 2 * size
    }
}

/// Blocks of a held element: from its stiffness in the plan's configuration where the pose leaves
/// what that depends on as it was, else formed anew. `formed`: as many entries as `blocks`.
#[inline(always)]
pub(super) fn held<S: Simd>(
    simd: S,
    element: &HeldElement,
    inputs: &[S::f64s],
    blocks: &mut [S::f64s],
    formed: &mut [S::f64s],
    workspace: &mut [S::f64s],
) {
    let axes = held_axes(simd, element, inputs);
    let change = held_change(simd, element, &axes, inputs);
    let bound = Lane::splat(simd, CHANGED);
    // What is not a number counts as unchanged: its axes are none. It must not reach the maximum
    // over the poses, which would then say nothing of the others.
    let (one, zero) = (Lane::splat(simd, 1.0), Lane::splat(simd, 0.0));
    let changed = change.if_above(bound, one, zero);
    let any = simd.reduce_max_f64s(changed.value) > 0.0;
    let all = simd.reduce_min_f64s(changed.value) > 0.0;
    if !all {
        held_parts(simd, element, &element.stiffness, &axes, blocks);
    }
    if all {
        form(simd, element, &axes, inputs, blocks, workspace);
    } else if any {
        form(simd, element, &axes, inputs, formed, workspace);
        let count = element.points.len() - 1;
        for s in 1..=count {
            for k in place(1, s)..place(s, s) + 36 {
                let (own, given) = (Lane::new(simd, formed[k]), Lane::new(simd, blocks[k]));
                blocks[k] = change.if_above(bound, own, given).value;
            }
        }
    }
    unheld(simd, element, inputs, blocks);
}

/// Blocks (r, s), 1 ≤ r ≤ s, of a stiffness formed at the pose. All of `blocks` is overwritten.
#[inline(always)]
fn form<S: Simd>(
    simd: S,
    element: &HeldElement,
    axes: &Mat3<S>,
    inputs: &[S::f64s],
    blocks: &mut [S::f64s],
    workspace: &mut [S::f64s],
) {
    let nodes = element.points.len() - 1;
    let size = 6 * nodes;
    let columns = &element.form.columns;
    let elastic = columns.len();
    let (k, rest) = workspace.split_at_mut(size * size);
    let (p, rest) = rest.split_at_mut(size * size);
    let (w, rest) = rest.split_at_mut(size * elastic);
    let (q, rest) = rest.split_at_mut(size * elastic);
    let (sum, rest) = rest.split_at_mut(elastic * elastic);
    let (p_column, rest) = rest.split_at_mut(size);
    let k_p = &mut rest[..size];
    match &element.form.body {
        Body::Run(segments) => run(simd, segments, inputs, blocks, k),
        Body::Given(stiffness) => {
            held_parts(simd, element, stiffness, axes, blocks);
            if elastic > 0 {
                spread(nodes, blocks, k);
            }
        }
    }
    if elastic == 0 {
        if let Body::Run(_) = element.form.body {
            gather(nodes, k, blocks);
        }
        return;
    }
    for (column, out) in columns.iter().zip(w.chunks_exact_mut(size)) {
        carry(simd, element, column, inputs, out);
    }
    for (w_j, q_j) in w.chunks_exact(size).zip(q.chunks_exact_mut(size)) {
        multiply(simd, k, w_j, q_j);
    }
    sum_of_energies(simd, size, w, q, sum);
    solve(simd, size, elastic, sum, q);
    for c in 0..size {
        // Column c of P, which is kept by rows.
        for b in (0..size).step_by(6) {
            let mut part = [Lane::splat(simd, 0.0); 6];
            if (b..b + 6).contains(&c) {
                part[c - b] = Lane::splat(simd, 1.0);
            }
            for (w_j, q_j) in w.chunks_exact(size).zip(q.chunks_exact(size)) {
                let minus = -Lane::new(simd, q_j[c]);
                let w_j = &w_j[b..b + 6];
                for i in 0..6 {
                    part[i] = minus.mul_add(Lane::new(simd, w_j[i]), part[i]);
                }
            }
            for i in 0..6 {
                p_column[b + i] = part[i].value;
            }
        }
        for row in 0..size {
            p[row * size + c] = p_column[row];
        }
    }
    for c in 0..size {
        for row in 0..size {
            p_column[row] = p[row * size + c];
        }
        multiply(simd, k, p_column, k_p);
        let s = c / 6;
        for r in 0..=s {
            let mut energy = [Lane::splat(simd, 0.0); 6];
            for (p_row, k_p) in p.chunks_exact(size).zip(&*k_p) {
                let (p_row, k_p) = (&p_row[6 * r..6 * r + 6], Lane::new(simd, *k_p));
                for i in 0..6 {
                    energy[i] = k_p.mul_add(Lane::new(simd, p_row[i]), energy[i]);
                }
            }
            for q_j in q.chunks_exact(size) {
                let (own, q_c) = (&q_j[6 * r..6 * r + 6], Lane::new(simd, q_j[c]));
                for i in 0..6 {
                    energy[i] = q_c.mul_add(Lane::new(simd, own[i]), energy[i]);
                }
            }
            let out = &mut blocks[place(r + 1, s + 1)..][..36];
            let j = c % 6;
            for i in 0..6 {
                if r < s {
                    out[6 * i + j] = energy[i].value;
                } else if i <= j {
                    out[6 * i + j] = energy[i].value;
                    out[6 * j + i] = energy[i].value;
                }
            }
        }
    }
}

/// Stiffness of a run of segments with its first node held, every entry of it. `blocks`: of one
/// segment in turn.
#[inline(always)]
fn run<S: Simd>(
    simd: S,
    segments: &[SegmentForm],
    inputs: &[S::f64s],
    blocks: &mut [S::f64s],
    k: &mut [S::f64s],
) {
    let size = 6 * segments.len();
    if segments.len() > 1 {
        k.fill(simd.splat_f64s(0.0));
    }
    for (far, segment) in segments.iter().enumerate() {
        match segment {
            SegmentForm::Prismatic(b) => beam(simd, b, inputs, blocks),
            SegmentForm::Tapered(t) => tapered(simd, t, inputs, blocks),
        }
        for j in 0..6 {
            for i in 0..6 {
                k[(6 * far + j) * size + 6 * far + i] = blocks[place(1, 1) + 6 * i + j];
            }
        }
        let Some(near) = far.checked_sub(1) else {
            continue;
        };
        for j in 0..6 {
            for i in 0..6 {
                let own = &mut k[(6 * near + j) * size + 6 * near + i];
                *own = simd.add_f64s(*own, blocks[6 * i + j]);
                let coupling = blocks[place(0, 1) + 6 * i + j];
                k[(6 * far + j) * size + 6 * near + i] = coupling;
                k[(6 * near + i) * size + 6 * far + j] = coupling;
            }
        }
    }
}

/// From blocks by pairs of nodes to all entries, column by column.
#[inline(always)]
fn spread<S: Copy>(nodes: usize, blocks: &[S], k: &mut [S]) {
    let size = 6 * nodes;
    for s in 0..nodes {
        for r in 0..=s {
            let block = &blocks[place(r + 1, s + 1)..][..36];
            for i in 0..6 {
                for j in 0..6 {
                    k[(6 * s + j) * size + 6 * r + i] = block[6 * i + j];
                    k[(6 * r + i) * size + 6 * s + j] = block[6 * i + j];
                }
            }
        }
    }
}

/// From all entries to blocks by pairs of nodes.
#[inline(always)]
fn gather<S: Copy>(nodes: usize, k: &[S], blocks: &mut [S]) {
    let size = 6 * nodes;
    for s in 0..nodes {
        for r in 0..=s {
            let block = &mut blocks[place(r + 1, s + 1)..][..36];
            for i in 0..6 {
                for j in 0..6 {
                    block[6 * i + j] = k[(6 * s + j) * size + 6 * r + i];
                }
            }
        }
    }
}

/// A column of a joint's factor at the nodes that move with the joint.
#[inline(always)]
fn carry<S: Simd>(
    simd: S,
    element: &HeldElement,
    column: &FactorColumn,
    inputs: &[S::f64s],
    out: &mut [S::f64s],
) {
    let zero = Lane::splat(simd, 0.0);
    let (mut linear, mut angular): (Vec3<S>, Vec3<S>) = ([zero; 3], [zero; 3]);
    for (axis, along, about) in &column.axes {
        let axis = vector(simd, inputs, *axis);
        linear = add(&linear, &scaled(&axis, Lane::splat(simd, *along)));
        angular = add(&angular, &scaled(&axis, Lane::splat(simd, *about)));
    }
    for (node, out) in (1..).zip(out.chunks_exact_mut(6)) {
        let (mut moved, mut turned) = (linear, angular);
        if column.node == 0 {
            let arm = arm(simd, inputs, [element.points[0], element.points[node]]);
            moved = add(&linear, &cross(&angular, &arm));
        } else if column.node != node {
            (moved, turned) = ([zero; 3], [zero; 3]);
        }
        for k in 0..3 {
            out[k] = moved[k].value;
            out[3 + k] = turned[k].value;
        }
    }
}

/// `out = k x`, k column by column.
#[inline(always)]
fn multiply<S: Simd>(simd: S, k: &[S::f64s], x: &[S::f64s], out: &mut [S::f64s]) {
    let size = x.len();
    for (b, out) in out.chunks_exact_mut(6).enumerate() {
        let mut sum = [Lane::splat(simd, 0.0); 6];
        for (column, x) in k.chunks_exact(size).zip(x) {
            let (column, x) = (&column[6 * b..6 * b + 6], Lane::new(simd, *x));
            for i in 0..6 {
                sum[i] = x.mul_add(Lane::new(simd, column[i]), sum[i]);
            }
        }
        for i in 0..6 {
            out[i] = sum[i].value;
        }
    }
}

/// The lower triangle of `I + Wᵀ (K W)`, column by column.
#[inline(always)]
fn sum_of_energies<S: Simd>(
    simd: S,
    size: usize,
    w: &[S::f64s],
    k_w: &[S::f64s],
    sum: &mut [S::f64s],
) {
    let elastic = w.len() / size;
    for (j, k_w_j) in k_w.chunks_exact(size).enumerate() {
        for (i, w_i) in w.chunks_exact(size).enumerate().skip(j) {
            let mut six: [Lane<S>; 6] =
                six!(row => Lane::new(simd, w_i[row]) * Lane::new(simd, k_w_j[row]));
            for (w, k_w) in w_i[6..].chunks_exact(6).zip(k_w_j[6..].chunks_exact(6)) {
                for row in 0..6 {
                    six[row] = Lane::new(simd, w[row]).mul_add(Lane::new(simd, k_w[row]), six[row]);
                }
            }
            let own = Lane::splat(simd, if i == j { 1.0 } else { 0.0 });
            let energy = own + ((six[0] + six[1]) + (six[2] + six[3])) + (six[4] + six[5]);
            sum[j * elastic + i] = energy.value;
        }
    }
}

/// `Qᵀ = K W (I + Wᵀ K W)⁻¹` in place of `K W`, by L D Lᵀ; the pivots are 1 or more, and one that
/// rounding brought below is 1.
#[inline(always)]
fn solve<S: Simd>(simd: S, size: usize, elastic: usize, sum: &mut [S::f64s], q: &mut [S::f64s]) {
    for c in 0..elastic {
        let (column, later) = sum[c * elastic..].split_at_mut(elastic);
        let pivot = Lane::new(simd, column[c]).max(Lane::splat(simd, 1.0));
        let inverse = pivot.recip();
        for row in c + 1..elastic {
            let minus = -(Lane::new(simd, column[row]) * inverse);
            let out = &mut later[(row - c - 1) * elastic..][..elastic];
            for i in row..elastic {
                let entry = Lane::new(simd, out[i]);
                out[i] = minus.mul_add(Lane::new(simd, column[i]), entry).value;
            }
        }
        column[c] = inverse.value;
        for row in c + 1..elastic {
            column[row] = (-(Lane::new(simd, column[row]) * inverse)).value;
        }
    }
    // The panel holds −l.
    for j in 0..elastic {
        let (done, rest) = q.split_at_mut(j * size);
        for b in (0..size).step_by(6) {
            let own = &mut rest[b..b + 6];
            let mut part: [Lane<S>; 6] = six!(i => Lane::new(simd, own[i]));
            for (k, q_k) in done.chunks_exact(size).enumerate() {
                let minus = Lane::new(simd, sum[k * elastic + j]);
                let q_k = &q_k[b..b + 6];
                for i in 0..6 {
                    part[i] = minus.mul_add(Lane::new(simd, q_k[i]), part[i]);
                }
            }
            for i in 0..6 {
                own[i] = part[i].value;
            }
        }
    }
    for j in (0..elastic).rev() {
        let (own, done) = q[j * size..].split_at_mut(size);
        let inverse = Lane::new(simd, sum[j * elastic + j]);
        for b in (0..size).step_by(6) {
            let own = &mut own[b..b + 6];
            let mut part: [Lane<S>; 6] = six!(i => Lane::new(simd, own[i]) * inverse);
            for (k, q_k) in (j + 1..elastic).zip(done.chunks_exact(size)) {
                let minus = Lane::new(simd, sum[j * elastic + k]);
                let q_k = &q_k[b..b + 6];
                for i in 0..6 {
                    part[i] = minus.mul_add(Lane::new(simd, q_k[i]), part[i]);
                }
            }
            for i in 0..6 {
                own[i] = part[i].value;
            }
        }
    }
}

/// Bending in one plane at this length: force per deflection, moment per deflection at both nodes,
/// moment per rotation at both nodes and across, by the elastic centre.
#[inline(always)]
fn bending<S: Simd>(
    plane: &PlaneFlexibility,
    length: Lane<S>,
    per_length: Lane<S>,
) -> [Lane<S>; 6] {
    let constant = |value: f64| length.constant(value);
    let deflection = (length * length).mul_add(constant(plane.bending), constant(plane.shear));
    let force = per_length / deflection;
    let turn = per_length * constant(1.0 / plane.turn);
    let [near, far] = [
        length * constant(plane.centre),
        length * constant(1.0 - plane.centre),
    ];
    let [at_near, at_far] = [force * near, force * far];
    [
        force,
        at_near,
        at_far,
        at_near.mul_add(near, turn),
        at_far.mul_add(far, turn),
        at_near.mul_add(far, -turn),
    ]
}

/// Blocks of a beam whose section changes along it.
#[inline(always)]
fn tapered<S: Simd>(simd: S, beam: &TaperedElement, inputs: &[S::f64s], blocks: &mut [S::f64s]) {
    let span = arm(simd, inputs, beam.ends);
    let square = dot(&span, &span);
    let per_length = square.sqrt().recip();
    let length = square * per_length;
    let axes = element_axes(
        &scaled(&span, per_length),
        &vector(simd, inputs, beam.y_axis),
    );
    let tension = per_length * Lane::splat(simd, 1.0 / beam.axial);
    let torsion = per_length * Lane::splat(simd, 1.0 / beam.torsional);
    let [along_y, y_near, y_far, z_at_near, z_at_far, z_across] =
        bending(&beam.planes[0], length, per_length);
    let [along_z, z_near, z_far, y_at_near, y_at_far, y_across] =
        bending(&beam.planes[1], length, per_length);
    let t = spectral(&axes, [tension, along_y, along_z]);
    let c_near = spectral(&axes, [torsion, y_at_near, z_at_near]);
    let c_far = spectral(&axes, [torsion, y_at_far, z_at_far]);
    let d = spectral(&axes, [-torsion, y_across, z_across]);
    let b_near = coupling(&axes, y_near, z_near);
    let b_far = coupling(&axes, y_far, z_far);
    let minus_b_far = negated(&b_far);
    write(
        blocks,
        place(0, 0),
        [&t, &b_near, &transposed(&b_near), &c_near],
    );
    let minus_b_near_t = transposed(&negated(&b_near));
    write(
        blocks,
        place(0, 1),
        [&negated(&t), &b_far, &minus_b_near_t, &d],
    );
    let minus_b_far_t = transposed(&minus_b_far);
    write(
        blocks,
        place(1, 1),
        [&t, &minus_b_far, &minus_b_far_t, &c_far],
    );
}

/// `m_y y zᵀ − m_z z yᵀ`.
#[inline(always)]
fn coupling<S: Simd>(axes: &Mat3<S>, along_y: Lane<S>, along_z: Lane<S>) -> Mat3<S> {
    let (y, z) = (scaled(&axes[1], along_y), scaled(&axes[2], along_z));
    three!(i => three!(j => y[i].mul_add(axes[2][j], -(z[i] * axes[1][j]))))
}
