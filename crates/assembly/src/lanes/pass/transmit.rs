//! The stiffness of a chain at a pose, as the wrenches that it transmits with a stiffness each:
//! `K = Σ dₐ zₐ zₐᵀ`.
//!
//! The links' compliances C are added up in the axes and about the centre of the softest one. A
//! free motion s allows only wrenches with `sᵀ W = 0`: one Householder reflection a motion turns it
//! into a coordinate that is left out, of C and of the wrenches (`reflections.rs`). What is left of C
//! is regular, and `L D Lᵀ` of it gives the wrenches, columns of `Q L⁻ᵀ`, and their stiffnesses
//! `D⁻¹`. Nothing is chosen by a pose's sizes, so all poses in a register go the same way.

use pulp::Simd;

use super::assemble::Assembly;
use super::compliance::{Frame, Six, compliance, compliances};
use super::ends::{Terms, works};
use super::lane::{Lane, six};
use super::loaded::{Acting, Transmitted};
use super::reflections::{Reflection, ordered, ordered_matrix, put_back, squares};
use crate::lanes::program::chain::{Chain, DEPENDENT};
use crate::lanes::program::element::Element;

/// Of a free motion, what the others leave of it must be above this share (squared).
const INDEPENDENT: f64 = 1e-12;

/// Adds a chain to a front. `places` of its coordinates, and of the rows of what acts on it; `pairs`:
/// places of its coordinates' entries, column by column of the lower triangle; `wrenches`: seven
/// entries a coordinate; `links`: [`TRIANGLE`](super::lane::TRIANGLE) entries a link of a chain that
/// something acts on.
#[inline(always)]
pub(crate) fn add_chain<S: Simd>(
    assembly: &mut Assembly<'_, S>,
    (element, chain): (&Element, &Chain),
    (places, pairs): (&[usize], &[u32]),
    (wrenches, links): (&mut [S::f64s], &mut [S::f64s]),
) {
    let (simd, inputs) = (assembly.simd, assembly.inputs);
    let frame = Frame::new(simd, chain, inputs);
    let c = if element.columns.is_empty() {
        compliance(simd, chain, &frame, inputs)
    } else {
        compliances(simd, chain, &frame, inputs, links)
    };
    let (seen, to) = ((element, chain, &frame), (places, pairs));
    let room = (wrenches, &*links);
    match chain.releases.len() {
        0 => transmit::<S, 0, 6>(assembly, seen, c, to, room),
        1 => transmit::<S, 1, 5>(assembly, seen, c, to, room),
        2 => transmit::<S, 2, 4>(assembly, seen, c, to, room),
        3 => transmit::<S, 3, 3>(assembly, seen, c, to, room),
        4 => transmit::<S, 4, 2>(assembly, seen, c, to, room),
        _ => transmit::<S, 5, 1>(assembly, seen, c, to, room),
    }
}

/// The same with M free motions and R wrenches, six together.
#[inline(always)]
fn transmit<S: Simd, const M: usize, const R: usize>(
    assembly: &mut Assembly<'_, S>,
    (element, chain, frame): (&Element, &Chain, &Frame<S>),
    c: [Six<S>; 6],
    (places, pairs): (&[usize], &[u32]),
    (wrenches, links): (&mut [S::f64s], &[S::f64s]),
) {
    let (simd, inputs) = (assembly.simd, assembly.inputs);
    let nodes = &element.nodes;
    let zero = Lane::splat(simd, 0.0);
    let one = Lane::splat(simd, 1.0);
    let nan = Lane::splat(simd, f64::NAN);
    let mut c = ordered_matrix(&c, chain);
    let mut errors: Six<S> = six!(k => c[k][k]);

    // Free motions: reflection k turns motion k into coordinate k.
    let mut reflections = [Reflection::none(zero); M];
    let mut growth = one;
    let mut poison = zero;
    for k in 0..M {
        let mut s = ordered(&frame.twist(simd, &chain.releases[k], inputs), chain);
        let whole = squares(&s, 0);
        for p in 0..k {
            reflections[p].apply(&mut s, p);
        }
        let left = squares(&s, k);
        let share = left / whole;
        growth = growth * share.recip();
        poison += share.if_above(Lane::splat(simd, INDEPENDENT), zero, nan);
        reflections[k] = Reflection::of(s, left, k);
        let Reflection {
            normal: s, factor, ..
        } = reflections[k];
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
        if !element.columns.is_empty() {
            // What acts asks for the column that is left out.
            for i in k..6 {
                let first = (-s[i]).mul_add(w[k], c[i][k]);
                c[i][k] = (-w[i]).mul_add(s[k], first);
            }
        }
        for i in k + 1..6 {
            // What a reflection takes away of an entry leaves its rounding there.
            errors[i] = spread.mul_add(s[i] * s[i], errors[i]);
            for j in k + 1..=i {
                let first = (-s[i]).mul_add(w[j], c[i][j]);
                c[i][j] = (-w[i]).mul_add(s[j], first);
            }
        }
    }
    for idle in &chain.idle {
        // It must be contained in the free motions.
        let mut s = ordered(&frame.twist(simd, &idle.along, inputs), chain);
        let whole = squares(&s, 0);
        for p in 0..M {
            reflections[p].apply(&mut s, p);
        }
        let left = squares(&s, M);
        poison += left.if_above(whole * Lane::splat(simd, DEPENDENT), nan, zero);
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
        let inverse = pivot.if_above(zero, pivot.recip(), nan) + poison;
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
    for a in 0..R {
        for k in (0..M).rev() {
            reflections[k].apply(&mut directions[a], k);
        }
        directions[a] = put_back(&directions[a], chain);
        let wrenches = &mut wrenches[a..];
        works(
            assembly,
            chain,
            frame,
            nodes,
            [&directions[a]; 2],
            (wrenches, R),
        );
    }
    let count = places.len() - element.columns.len();
    // What moves both ends does the work of both.
    for [from, to] in &element.shared {
        for a in 0..R {
            let own = wrenches[from * R + a];
            wrenches[from * R + a] = zero.value;
            wrenches[to * R + a] = simd.add_f64s(wrenches[to * R + a], own);
        }
    }
    let mut next = 0;
    for (end, node) in nodes.iter().enumerate() {
        for coordinate in node.coordinates() {
            let place = places[next];
            next += 1;
            if assembly.idle[coordinate] {
                let terms = Terms::new(assembly, chain, frame, end, node, coordinate);
                let mut sum = Lane::new(simd, assembly.errors[place]);
                for a in 0..R {
                    sum = terms.of(&directions[a]).mul_add(stiffness[a], sum);
                }
                assembly.errors[place] = sum.value;
            }
        }
    }
    let mut pairs = pairs.iter();
    for (j, place) in places[..count].iter().enumerate() {
        let mut weighed = [zero; R];
        let mut error = Lane::new(simd, assembly.errors[*place]);
        for a in 0..R {
            let z = Lane::new(simd, wrenches[j * R + a]);
            weighed[a] = z * stiffness[a];
            error = (weighed[a] * z).mul_add(trust[a], error);
        }
        assembly.errors[*place] = error.value;
        for (z, pair) in wrenches[j * R..count * R].chunks_exact(R).zip(&mut pairs) {
            let entry = &mut assembly.entries[*pair as usize];
            let mut sum = *entry;
            for a in 0..R {
                sum = simd.mul_add_e_f64s(weighed[a].value, z[a], sum);
            }
            *entry = sum;
        }
    }
    if element.columns.is_empty() {
        return;
    }
    let transmitted = Transmitted {
        c,
        reflections,
        growth,
        directions,
        stiffness,
        trust,
    };
    let acting = Acting {
        simd,
        inputs,
        acts: assembly.acts,
        links,
    };
    for (k, column) in element.columns.iter().enumerate() {
        let row = places[count + k];
        let to = (&places[..count], row);
        acting.add_column(
            assembly,
            &transmitted,
            (element, chain, frame),
            *column,
            to,
            wrenches,
        );
    }
}
