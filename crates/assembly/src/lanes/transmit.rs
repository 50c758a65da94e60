//! The stiffness of a chain at a pose, as the wrenches that it transmits with a stiffness each:
//! `K = Σ dₐ zₐ zₐᵀ`.
//!
//! The links' compliances C are added up in the axes and about the centre of the softest one. A
//! free motion s allows only wrenches with `sᵀ W = 0`: one Householder reflection a motion turns it
//! into a coordinate that is left out, of C and of the wrenches. What is left of C is regular, and
//! `L D Lᵀ` of it gives the wrenches, columns of `Q L⁻ᵀ`, and their stiffnesses `D⁻¹`. Nothing is
//! chosen by size, so all poses in a register go the same way.

use pulp::Simd;

use super::assemble::Assembly;
use super::blocks::vector;
use super::chain::Chain;
use super::compliance::{Frame, Six, compliance};
use super::lane::{Lane, Mat3, Vec3, add, cross, scaled, six, sub, three};
use super::program::NodeMotion;

/// Of a free motion, what the others leave of it must be above this share (squared).
const INDEPENDENT: f64 = 1e-12;

/// Adds a chain to a front. `pairs`: places of its coordinates' entries, column by column of the
/// lower triangle; `wrenches`: twelve entries a coordinate.
#[inline(always)]
pub(super) fn add_chain<S: Simd>(
    assembly: &mut Assembly<'_, S>,
    chain: &Chain,
    nodes: &[NodeMotion],
    places: &[usize],
    pairs: &[u32],
    wrenches: &mut [S::f64s],
) {
    let to = (places, pairs, wrenches);
    match chain.releases.len() {
        0 => transmit::<S, 0, 6>(assembly, chain, nodes, to),
        1 => transmit::<S, 1, 5>(assembly, chain, nodes, to),
        2 => transmit::<S, 2, 4>(assembly, chain, nodes, to),
        3 => transmit::<S, 3, 3>(assembly, chain, nodes, to),
        4 => transmit::<S, 4, 2>(assembly, chain, nodes, to),
        _ => transmit::<S, 5, 1>(assembly, chain, nodes, to),
    }
}

/// The same with M free motions and R wrenches, six together.
#[inline(always)]
fn transmit<S: Simd, const M: usize, const R: usize>(
    assembly: &mut Assembly<'_, S>,
    chain: &Chain,
    nodes: &[NodeMotion],
    (places, pairs, wrenches): (&[usize], &[u32], &mut [S::f64s]),
) {
    let (simd, inputs) = (assembly.simd, assembly.inputs);
    let zero = Lane::splat(simd, 0.0);
    let one = Lane::splat(simd, 1.0);
    let nan = Lane::splat(simd, f64::NAN);
    let frame = Frame::new(simd, chain, inputs);
    let mut c = compliance(simd, chain, &frame, inputs);
    let mut errors: Six<S> = six!(k => c[k][k]);

    // Free motions: reflection k turns motion k into coordinate k.
    let mut normals = [[zero; 6]; M];
    let mut factors = [zero; M];
    let mut growth = one;
    for k in 0..M {
        let mut s = frame.twist(simd, &chain.releases[k], inputs);
        let mut whole = zero;
        for i in 0..6 {
            whole = s[i].mul_add(s[i], whole);
        }
        for p in 0..k {
            reflect(&mut s, &normals[p], factors[p], p);
        }
        let mut left = zero;
        for i in k..6 {
            left = s[i].mul_add(s[i], left);
        }
        let share = left / whole;
        growth = growth * share.if_above(Lane::splat(simd, INDEPENDENT), share.recip(), nan);
        let size = left.sqrt();
        let first = s[k];
        let longer = first.abs() + size;
        s[k] = first.if_above(zero, longer, -longer);
        let factor = (size * longer).recip();
        // C ← C − v wᵀ − w vᵀ with p = f C v, w = p − (f pᵀv / 2) v.
        let mut w = [zero; 6];
        let mut work = zero;
        for i in k..6 {
            let mut entry = zero;
            for j in k..6 {
                let c_ij = if i >= j { c[i][j] } else { c[j][i] };
                entry = c_ij.mul_add(s[j], entry);
            }
            w[i] = entry * factor;
            work = w[i].mul_add(s[i], work);
        }
        let half = work * factor * Lane::splat(simd, -0.5);
        let mut spread = zero;
        for i in k..6 {
            w[i] = half.mul_add(s[i], w[i]);
            let weighed = s[i] * s[i];
            spread = weighed.mul_add(errors[i], spread);
        }
        let spread = spread * factor * factor;
        let twice = factor * Lane::splat(simd, -2.0);
        for i in k + 1..6 {
            let weighed = s[i] * s[i];
            let kept = errors[i] * twice.mul_add(weighed, one);
            errors[i] = spread.mul_add(weighed, kept);
            for j in k + 1..=i {
                let first = (-s[i]).mul_add(w[j], c[i][j]);
                c[i][j] = (-w[i]).mul_add(s[j], first);
            }
        }
        (normals[k], factors[k]) = (s, factor);
    }

    // L D Lᵀ of what is left; the wrenches are the columns of Q L⁻ᵀ.
    let mut stiffness = [zero; R];
    let mut trust = [zero; R];
    let mut directions = [[zero; 6]; R];
    for a in 0..R {
        directions[a][M + a] = one;
    }
    for a in 0..R {
        let pivot = c[M + a][M + a];
        let inverse = pivot.if_above(zero, pivot.recip(), nan);
        stiffness[a] = inverse;
        trust[a] = errors[M + a] * inverse * growth;
        for b in a + 1..R {
            let l = c[M + b][M + a] * inverse;
            errors[M + b] = (l * l).mul_add(errors[M + a], errors[M + b]);
            for d in a + 1..=b {
                c[M + b][M + d] = (-l).mul_add(c[M + d][M + a], c[M + b][M + d]);
            }
            for d in 0..=a {
                let from = directions[a][M + d];
                directions[b][M + d] = (-l).mul_add(from, directions[b][M + d]);
            }
        }
    }
    let size = Lane::splat(simd, chain.size);
    for a in 0..R {
        let mut z = directions[a];
        for k in (0..M).rev() {
            reflect(&mut z, &normals[k], factors[k], k);
        }
        let force = to_global(&frame.axes, &[z[5], z[3], z[4]]);
        let moment = to_global(&frame.axes, &scaled(&[z[0], z[1], z[2]], size));
        let mut next = a;
        for (end, node) in nodes.iter().enumerate() {
            if !node.moves() {
                continue;
            }
            let origin = vector(simd, inputs, chain.origins[end]);
            let arm = sub(&frame.origin, &origin);
            let moment = add(&moment, &cross(&arm, &force));
            let (force, moment) = if end == 0 {
                (three!(k => -force[k]), three!(k => -moment[k]))
            } else {
                (force, moment)
            };
            if node.root.is_some() {
                for k in 0..3 {
                    wrenches[next + k * R] = force[k].value;
                    wrenches[next + (3 + k) * R] = moment[k].value;
                }
                next += 6 * R;
            }
            for screw in &node.screws {
                let at = &assembly.screws[6 * screw..6 * screw + 6];
                let v: Vec3<S> = three!(k => Lane::new(simd, at[k]));
                let w: Vec3<S> = three!(k => Lane::new(simd, at[3 + k]));
                let parts: Six<S> =
                    six!(k => if k < 3 { v[k] * force[k] } else { w[k - 3] * moment[k - 3] });
                let (mut work, mut terms) = (parts[0], parts[0] * parts[0]);
                for k in 1..6 {
                    work += parts[k];
                    terms = parts[k].mul_add(parts[k], terms);
                }
                wrenches[next] = work.value;
                // Where no work is done on it, what is left is the rounding of the terms.
                let error = &mut assembly.errors[places[next / R]];
                let terms = terms * stiffness[a];
                *error = terms.mul_add(trust[a], Lane::new(simd, *error)).value;
                next += R;
            }
        }
    }
    let mut pairs = pairs.iter();
    for (j, place) in places.iter().enumerate() {
        let mut weighed = [zero; R];
        let mut error = Lane::new(simd, assembly.errors[*place]);
        for a in 0..R {
            let z = Lane::new(simd, wrenches[j * R + a]);
            weighed[a] = z * stiffness[a];
            error = (weighed[a] * z).mul_add(trust[a], error);
        }
        assembly.errors[*place] = error.value;
        for (z, pair) in wrenches[j * R..places.len() * R]
            .chunks_exact(R)
            .zip(&mut pairs)
        {
            let entry = &mut assembly.entries[*pair as usize];
            let mut sum = *entry;
            for a in 0..R {
                sum = simd.mul_add_e_f64s(weighed[a].value, z[a], sum);
            }
            *entry = sum;
        }
    }
}

/// `x ← x − f v (vᵀ x)`, where v is zero before its entry k.
#[inline(always)]
fn reflect<S: Simd>(x: &mut Six<S>, normal: &Six<S>, factor: Lane<S>, k: usize) {
    let mut work = x[k] * normal[k];
    for i in k + 1..6 {
        work = x[i].mul_add(normal[i], work);
    }
    let minus = -(work * factor);
    for i in k..6 {
        x[i] = minus.mul_add(normal[i], x[i]);
    }
}

/// A vector in axes given as rows, in global axes.
#[inline(always)]
fn to_global<S: Simd>(axes: &Mat3<S>, v: &Vec3<S>) -> Vec3<S> {
    three!(i => axes[0][i].mul_add(v[0], axes[1][i].mul_add(v[1], axes[2][i] * v[2])))
}
