//! The stiffness of a chain at a pose, as the wrenches that it transmits with a stiffness each:
//! `K = Σ dₐ zₐ zₐᵀ`.
//!
//! The links' compliances C are added up in the axes and about the centre of the softest one. A
//! free motion s allows only wrenches with `sᵀ W = 0`: one Householder reflection a motion turns it
//! into a coordinate that is left out, of C and of the wrenches (`reflections.rs`). What is left of C
//! is regular, and `L D Lᵀ` of it gives the wrenches, columns of `Q L⁻ᵀ`, and their stiffnesses
//! `D⁻¹`. Nothing is chosen by a pose's sizes, so all poses in a register go the same way.
//!
//! With loads L on what lies between the ends, the wrench in a part is `W + L`, L the sum of the
//! loads beyond it. They move end 1 by `Σ C L`, and where a free motion is, `sᵀ (W + L) = 0`: in the
//! reflected coordinates that gives the components of W that are left out, one after the other, and
//! what is left of the displacement gives the others. The wrench with both ends held goes to the
//! loads' row.

use pulp::Simd;

use super::assemble::Assembly;
use super::compliance::{Frame, Loaded, Six, compliance, loaded_compliance};
use super::ends::{Terms, works};
use super::factor::{IDLE, ROUNDING};
use super::lane::{Lane, six};
use super::reflections::{Reflection, ordered, ordered_matrix, put_back, squares};
use crate::lanes::program::chain::{Chain, DEPENDENT};
use crate::lanes::program::element::NodeMotion;

/// Of a free motion, what the others leave of it must be above this share (squared).
const INDEPENDENT: f64 = 1e-12;

/// Adds a chain to a front. `places` of its coordinates, and of the loads' row where loads act on
/// it; `pairs`: places of its coordinates' entries, column by column of the lower triangle;
/// `wrenches`: seven entries a coordinate.
#[inline(always)]
pub(crate) fn add_chain<S: Simd>(
    assembly: &mut Assembly<'_, S>,
    chain: &Chain,
    nodes: &[NodeMotion],
    places: &[usize],
    pairs: &[u32],
    wrenches: &mut [S::f64s],
) {
    let (simd, inputs) = (assembly.simd, assembly.inputs);
    let frame = Frame::new(simd, chain, inputs);
    let (c, loaded) = if chain.loads.is_empty() {
        (compliance(simd, chain, &frame, inputs), None)
    } else {
        let (c, loaded) = loaded_compliance(simd, chain, &frame, inputs);
        (c, Some(loaded))
    };
    let (seen, to) = ((chain, &frame, nodes), (places, pairs, wrenches));
    match chain.releases.len() {
        0 => transmit::<S, 0, 6>(assembly, seen, c, loaded, to),
        1 => transmit::<S, 1, 5>(assembly, seen, c, loaded, to),
        2 => transmit::<S, 2, 4>(assembly, seen, c, loaded, to),
        3 => transmit::<S, 3, 3>(assembly, seen, c, loaded, to),
        4 => transmit::<S, 4, 2>(assembly, seen, c, loaded, to),
        _ => transmit::<S, 5, 1>(assembly, seen, c, loaded, to),
    }
}

/// The same with M free motions and R wrenches, six together.
#[inline(always)]
fn transmit<S: Simd, const M: usize, const R: usize>(
    assembly: &mut Assembly<'_, S>,
    (chain, frame, nodes): (&Chain, &Frame<S>, &[NodeMotion]),
    c: [Six<S>; 6],
    mut loaded: Option<Loaded<S>>,
    (places, pairs, wrenches): (&[usize], &[u32], &mut [S::f64s]),
) {
    let (simd, inputs) = (assembly.simd, assembly.inputs);
    let zero = Lane::splat(simd, 0.0);
    let one = Lane::splat(simd, 1.0);
    let nan = Lane::splat(simd, f64::NAN);
    let mut c = ordered_matrix(&c, chain);
    let mut errors: Six<S> = six!(k => c[k][k]);
    if let Some(loaded) = &mut loaded {
        loaded.moved = ordered(&loaded.moved, chain);
    }

    // Free motions: reflection k turns motion k into coordinate k.
    let mut reflections = [Reflection::none(zero); M];
    let mut growth = one;
    let mut poison = zero;
    // The wrench that loads within make with both ends held: of it, what free motions ask for.
    let mut held = [zero; 6];
    let mut doubts = [zero; M];
    // The energy that these loads put into the chain.
    let mut energy = match &loaded {
        Some(loaded) => loaded.energy,
        None => zero,
    };
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
            normal: s,
            factor,
            turned,
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
        if let Some(loaded) = &mut loaded {
            // No work on motion k: that is one component of the wrench.
            let [mut missing, mut terms] = loaded.works[k];
            for i in 0..k {
                missing = (-s[i]).mul_add(held[i], missing);
                terms = (s[i] * s[i]).mul_add(held[i].mul_add(held[i], doubts[i]), terms);
            }
            let inverse = turned.recip();
            held[k] = missing * inverse;
            doubts[k] = terms * inverse * inverse;
            reflections[k].apply(&mut loaded.moved, k);
            for i in k + 1..6 {
                let first = (-s[i]).mul_add(w[k], c[i][k]);
                let entry = (-w[i]).mul_add(s[k], first);
                loaded.moved[i] = entry.mul_add(held[k], loaded.moved[i]);
            }
            let twice = w[k] * s[k];
            let own = c[k][k] - twice - twice;
            energy = (own * held[k]).mul_add(held[k], energy);
        }
        let spread = spread * factor * factor;
        for i in k + 1..6 {
            // What a reflection takes away of an entry leaves its rounding there.
            errors[i] = spread.mul_add(s[i] * s[i], errors[i]);
            for j in k + 1..=i {
                let first = (-s[i]).mul_add(w[j], c[i][j]);
                c[i][j] = (-w[i]).mul_add(s[j], first);
            }
        }
    }
    for (k, idle) in chain.idle.iter().enumerate() {
        // It must be contained in the free motions, and what acts must do no work on it.
        let mut s = ordered(&frame.twist(simd, &idle.along, inputs), chain);
        let whole = squares(&s, 0);
        for p in 0..M {
            reflections[p].apply(&mut s, p);
        }
        let left = squares(&s, M);
        poison += left.if_above(whole * Lane::splat(simd, DEPENDENT), nan, zero);
        if let Some(loaded) = &loaded {
            let [mut work, mut terms] = loaded.idle_works[k];
            for i in 0..M {
                work = (-s[i]).mul_add(held[i], work);
                terms = (s[i] * s[i]).mul_add(held[i].mul_add(held[i], doubts[i]), terms);
            }
            let bound = terms * Lane::splat(simd, (IDLE * ROUNDING) * (IDLE * ROUNDING));
            poison += (work * work).if_above(bound, nan, zero);
        }
    }

    // L D Lᵀ of what is left; the wrenches are the columns of Q L⁻ᵀ.
    let mut stiffness = [zero; R];
    let mut trust = [zero; R];
    let mut directions = [[zero; 6]; R];
    // By wrenches: the force that loads within make with both ends held, reversed.
    let mut forces = [zero; R];
    for a in 0..R {
        directions[a][M + a] = one;
    }
    for a in 0..R {
        let pivot = c[M + a][M + a];
        let inverse = pivot.if_above(zero, pivot.recip(), nan) + poison;
        stiffness[a] = inverse;
        trust[a] = errors[M + a] * inverse * growth;
        if let Some(loaded) = &mut loaded {
            forces[a] = loaded.moved[M + a] * inverse;
        }
        for b in a + 1..R {
            let l = c[M + b][M + a] * inverse;
            errors[M + b] = (l * l).mul_add(errors[M + a], errors[M + b]);
            if let Some(loaded) = &mut loaded {
                loaded.moved[M + b] = (-l).mul_add(loaded.moved[M + a], loaded.moved[M + b]);
            }
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
    let count = places.len() - usize::from(loaded.is_some());
    // By ends: what loads within do there with both held, but for the wrenches' forces.
    let mut ends = [[zero; 6]; 2];
    if let Some(loaded) = &loaded {
        for k in (0..M).rev() {
            reflections[k].apply(&mut held, k);
        }
        let held = put_back(&held, chain);
        ends = [six!(k => -(held[k] + loaded.total[k])), six!(k => -held[k])];
        let own = &mut wrenches[R * count..];
        works(
            assembly,
            chain,
            frame,
            nodes,
            [&ends[0], &ends[1]],
            (own, 1),
        );
        let error = &mut assembly.errors[places[count]];
        *error = energy.mul_add(growth, Lane::new(simd, *error)).value;
    }
    let mut doubt = zero;
    for k in 0..M {
        doubt += doubts[k];
    }
    let mut next = 0;
    for (end, node) in nodes.iter().enumerate() {
        for coordinate in node.coordinates() {
            let place = places[next];
            next += 1;
            let is_idle = assembly.idle[coordinate];
            if !is_idle && loaded.is_none() {
                continue;
            }
            let terms = Terms::new(assembly, chain, frame, end, node.root, coordinate);
            if is_idle {
                let mut sum = Lane::new(simd, assembly.errors[place]);
                for a in 0..R {
                    sum = terms.of(&directions[a]).mul_add(stiffness[a], sum);
                }
                assembly.errors[place] = sum.value;
            }
            if loaded.is_some() {
                let mut sum = terms.of(&ends[end]) + terms.by(doubt, doubt);
                if is_idle {
                    for a in 0..R {
                        let squared = forces[a] * forces[a];
                        sum = terms.of(&directions[a]).mul_add(squared, sum);
                    }
                }
                assembly.add_load_error(place, sum);
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
        if loaded.is_some() {
            let mut force = Lane::new(simd, wrenches[R * count + j]);
            for a in 0..R {
                force = Lane::new(simd, wrenches[j * R + a]).mul_add(forces[a], force);
            }
            assembly.add(places[count], *place, force);
        }
    }
}
