//! The stiffness of a chain at a pose, as the wrenches that it transmits with a stiffness each:
//! `K = Σ dₐ zₐ zₐᵀ`.
//!
//! The links' compliances C are added up in the axes and about the centre of the softest one. A
//! free motion s allows only wrenches with `sᵀ W = 0`: one Householder reflection a motion turns it
//! into a coordinate that is left out, of C and of the wrenches (`reflections.rs`). What is left of C
//! is regular, and `L D Lᵀ` of it gives the wrenches, columns of `Q L⁻ᵀ`, and their stiffnesses
//! `D⁻¹`. Nothing is chosen by a pose's sizes, so all poses in a register go the same way.

// Of the constants that `unrolled!` goes through, some are beyond what a number of motions asks for.
#![allow(clippy::absurd_extreme_comparisons, clippy::reversed_empty_ranges)]

use pulp::Simd;

use super::assemble::Assembly;
use super::compliance::{Frame, Six, compliance, compliances};
use super::ends::{Terms, works};
use super::lane::{Lane, six, unrolled};
use super::loaded::{Acting, Transmitted};
use super::reflections::{Reflection, all_put_back, ordered, ordered_matrix, squares};
use crate::lanes::program::chain::{Chain, DEPENDENT};
use crate::lanes::program::element::Element;
use crate::lanes::program::recovery::{AXES, Layout};

/// Of a free motion, what the others leave of it must be above this share (squared).
const INDEPENDENT: f64 = 1e-12;

/// A chain's room.
pub(crate) struct ChainRoom<'a, S: Simd> {
    /// Seven entries a coordinate.
    pub wrenches: &'a mut [S::f64s],
    /// [`TRIANGLE`](super::lane::TRIANGLE) entries a link of a chain that something acts on.
    pub links: &'a mut [S::f64s],
    /// What forces are found from, where they are asked for.
    pub kept: &'a mut [S::f64s],
}

/// Adds a chain to a front. `places` of its coordinates, and of the rows of what acts on it; `pairs`:
/// places of its coordinates' entries, column by column of the lower triangle.
#[inline(always)]
pub(crate) fn add_chain<S: Simd>(
    assembly: &mut Assembly<'_, S>,
    (element, chain): (&Element, &Chain),
    (places, pairs): (&[usize], &[u32]),
    room: ChainRoom<'_, S>,
) {
    let (simd, inputs) = (assembly.simd, assembly.inputs);
    let frame = Frame::new(simd, chain, inputs);
    let c = if element.columns.is_empty() {
        compliance(simd, chain, &frame, inputs)
    } else {
        compliances(simd, chain, &frame, inputs, room.links)
    };
    let (seen, to) = ((element, chain, &frame), (places, pairs));
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
    room: ChainRoom<'_, S>,
) {
    let ChainRoom {
        wrenches,
        links,
        kept,
    } = room;
    let (simd, inputs) = (assembly.simd, assembly.inputs);
    let nodes = &element.nodes;
    let zero = Lane::splat(simd, 0.0);
    let one = Lane::splat(simd, 1.0);
    let nan = Lane::splat(simd, f64::NAN);
    // Without free motions there is no order.
    let mut c = if M > 0 { ordered_matrix(&c, chain) } else { c };
    let mut errors: Six<S> = six!(k => c[k][k]);

    // Free motions: reflection k turns motion k into coordinate k.
    let mut motions = [[zero; 6]; M];
    for k in 0..M {
        motions[k] = ordered(&frame.twist(simd, &chain.releases[k], inputs), chain);
    }
    let mut reflections = [Reflection::none(zero); M];
    let mut growth = one;
    let mut poison = zero;
    unrolled!(K < M => {
        let mut s = motions[K];
        let whole = squares(&s, 0);
        unrolled!(P < K => {
            reflections[P].apply(&mut s, P);
        });
        let left = squares(&s, K);
        let share = left / whole;
        growth = growth * share.recip();
        poison += share.if_above(Lane::splat(simd, INDEPENDENT), zero, nan);
        reflections[K] = Reflection::of(s, left, K);
        // What acts asks for the column that is left out.
        let all = !element.columns.is_empty();
        reflect::<S, K>(&mut c, &mut errors, &reflections[K], all);
    });
    for idle in &chain.idle {
        // It must be contained in the free motions.
        let mut s = ordered(&frame.twist(simd, &idle.along, inputs), chain);
        let whole = squares(&s, 0);
        unrolled!(P < M => {
            reflections[P].apply(&mut s, P);
        });
        let left = squares(&s, M);
        poison += left.if_above(whole * Lane::splat(simd, DEPENDENT), nan, zero);
    }

    let Left {
        mut directions,
        stiffness,
        trust,
    } = left::<S, M, R>(&mut c, &mut errors, [growth, poison]);
    unrolled!(A < R => {
        unrolled!(K < M => {
            let k = M - 1 - K;
            if K == 0 {
                reflections[k].apply_first(&mut directions[A], k, A + 1);
            } else {
                reflections[k].apply(&mut directions[A], k);
            }
        });
    });
    if M > 0 {
        directions = all_put_back(&directions, chain);
    }
    let mut acting = [([zero; 3], [zero; 3]); R];
    unrolled!(A < R => {
        acting[A] = frame.to_global(simd, chain, &directions[A]);
    });
    works(assembly, chain, frame, nodes, [&acting; 2], wrenches);
    let count = places.len() - element.columns.len();
    // What moves both ends does the work of both.
    for [from, to] in &element.shared {
        for a in 0..R {
            let own = wrenches[from * R + a];
            wrenches[from * R + a] = zero.value;
            wrenches[to * R + a] = simd.add_f64s(wrenches[to * R + a], own);
        }
    }
    let layout = Layout {
        wrenches: R,
        coordinates: count,
    };
    if !kept.is_empty() {
        keep(kept, layout, frame, &directions, (&stiffness, &trust));
        for k in 0..R * count {
            kept[layout.works() + k] = wrenches[k];
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
                unrolled!(A < R => {
                    sum = terms.of(&directions[A]).mul_add(stiffness[A], sum);
                });
                assembly.errors[place] = sum.value;
            }
        }
    }
    add_squares(
        assembly,
        (&places[..count], pairs),
        wrenches,
        (&stiffness, &trust),
    );
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
        let kept = if kept.is_empty() {
            &mut []
        } else {
            &mut kept[layout.column(k)..][..layout.of_column()]
        };
        acting.add_column(
            assembly,
            &transmitted,
            (element, chain, frame),
            *column,
            to,
            (wrenches, kept),
        );
    }
}

/// Keeps what a chain transmits.
#[inline(always)]
fn keep<S: Simd, const R: usize>(
    kept: &mut [S::f64s],
    layout: Layout,
    frame: &Frame<S>,
    directions: &[Six<S>; R],
    (stiffness, trust): (&[Lane<S>; R], &[Lane<S>; R]),
) {
    for k in 0..3 {
        kept[k] = frame.origin[k].value;
        for c in 0..3 {
            kept[AXES + 3 * k + c] = frame.axes[k][c].value;
        }
    }
    for a in 0..R {
        for k in 0..6 {
            kept[layout.directions() + 6 * a + k] = directions[a][k].value;
        }
        kept[layout.stiffness() + a] = stiffness[a].value;
        kept[layout.trust() + a] = trust[a].value;
    }
}

/// What transmits R wrenches: their directions, columns of `L⁻ᵀ`, with a stiffness each and its error.
struct Left<S: Simd, const R: usize> {
    directions: [Six<S>; R],
    stiffness: [Lane<S>; R],
    trust: [Lane<S>; R],
}

/// `L D Lᵀ` of what M free motions leave of a compliance; `errors`: the measure of its diagonal's rounding.
#[inline(always)]
fn left<S: Simd, const M: usize, const R: usize>(
    c: &mut [Six<S>; 6],
    errors: &mut Six<S>,
    [growth, poison]: [Lane<S>; 2],
) -> Left<S, R> {
    let (zero, one) = (growth.constant(0.0), growth.constant(1.0));
    let nan = growth.constant(f64::NAN);
    let mut stiffness = [zero; R];
    let mut trust = [zero; R];
    let mut directions = [[zero; 6]; R];
    for a in 0..R {
        directions[a][M + a] = one;
    }
    unrolled!(A < R => {
        let pivot = c[M + A][M + A];
        let inverse = pivot.if_above(zero, pivot.recip(), nan) + poison;
        stiffness[A] = inverse;
        trust[A] = errors[M + A] * inverse * growth;
        unrolled!(B < R => {
            if B > A {
                let l = c[M + B][M + A] * inverse;
                errors[M + B] = (l * l).mul_add(errors[M + A], errors[M + B]);
                for d in A + 1..=B {
                    c[M + B][M + d] = (-l).mul_add(c[M + d][M + A], c[M + B][M + d]);
                }
                for d in 0..=A {
                    let from = directions[A][M + d];
                    directions[B][M + d] = (-l).mul_add(from, directions[B][M + d]);
                }
            }
        });
    });
    Left {
        directions,
        stiffness,
        trust,
    }
}

/// Reflects a compliance, its lower triangle, from coordinate K on, without its column K unless `all` is
/// asked for; and the measure of its diagonal's rounding.
#[inline(always)]
fn reflect<S: Simd, const K: usize>(
    c: &mut [Six<S>; 6],
    errors: &mut Six<S>,
    reflection: &Reflection<S>,
    all: bool,
) {
    let Reflection {
        normal: s, factor, ..
    } = *reflection;
    let zero = factor.constant(0.0);
    // C ← C − v wᵀ − w vᵀ with p = f C v, w = p − (f pᵀv / 2) v.
    let mut w = [zero; 6];
    let mut work = zero;
    unrolled!(I < 6_usize => {
        if I >= K {
            let mut entry = zero;
            for j in K..I {
                entry = c[I][j].mul_add(s[j], entry);
            }
            for j in I..6 {
                entry = c[j][I].mul_add(s[j], entry);
            }
            w[I] = entry * factor;
            work = w[I].mul_add(s[I], work);
        }
    });
    let half = work * factor * factor.constant(-0.5);
    let mut spread = zero;
    for i in K..6 {
        w[i] = half.mul_add(s[i], w[i]);
        let weighed = s[i] * s[i];
        spread = weighed.mul_add(errors[i], spread);
    }
    let spread = spread * factor * factor;
    if all {
        for i in K..6 {
            let first = (-s[i]).mul_add(w[K], c[i][K]);
            c[i][K] = (-w[i]).mul_add(s[K], first);
        }
    }
    unrolled!(I < 6_usize => {
        if I > K {
            // What a reflection takes away of an entry leaves its rounding there.
            errors[I] = spread.mul_add(s[I] * s[I], errors[I]);
            for j in K + 1..=I {
                let first = (-s[I]).mul_add(w[j], c[I][j]);
                c[I][j] = (-w[I]).mul_add(s[j], first);
            }
        }
    });
}

/// Adds `Σ dₐ zₐ zₐᵀ` over R wrenches of these stiffnesses: their works, R a coordinate.
#[inline(always)]
fn add_squares<S: Simd, const R: usize>(
    assembly: &mut Assembly<'_, S>,
    (places, pairs): (&[usize], &[u32]),
    works: &[S::f64s],
    (stiffness, trust): (&[Lane<S>; R], &[Lane<S>; R]),
) {
    let simd = assembly.simd;
    let count = places.len();
    let (works, _) = works.as_chunks::<R>();
    let works = &works[..count];
    let mut pairs = pairs;
    let mut j = 0;
    // Two columns together: what is read of the others is read once.
    while j + 1 < count {
        let (first, rest) = pairs.split_at(count - j);
        let (second, rest) = rest.split_at(count - j - 1);
        pairs = rest;
        let a = weighed(assembly, places[j], &works[j], (stiffness, trust));
        let b = weighed(assembly, places[j + 1], &works[j + 1], (stiffness, trust));
        add_product(assembly, first[0], &a, &works[j]);
        for ((z, first), second) in works[j + 1..].iter().zip(&first[1..]).zip(second) {
            let entry = &mut assembly.entries[*first as usize];
            let mut sum = *entry;
            for k in 0..R {
                sum = simd.mul_add_e_f64s(a[k], z[k], sum);
            }
            *entry = sum;
            let entry = &mut assembly.entries[*second as usize];
            let mut sum = *entry;
            for k in 0..R {
                sum = simd.mul_add_e_f64s(b[k], z[k], sum);
            }
            *entry = sum;
        }
        j += 2;
    }
    if let (true, Some(last)) = (j < count, pairs.first()) {
        let a = weighed(assembly, places[j], &works[j], (stiffness, trust));
        add_product(assembly, *last, &a, &works[j]);
    }
}

/// The works on one coordinate by their stiffnesses; notes the rounding of its diagonal entry.
#[inline(always)]
fn weighed<S: Simd, const R: usize>(
    assembly: &mut Assembly<'_, S>,
    place: usize,
    works: &[S::f64s; R],
    (stiffness, trust): (&[Lane<S>; R], &[Lane<S>; R]),
) -> [S::f64s; R] {
    let simd = assembly.simd;
    let mut weighed = *works;
    let mut error = Lane::new(simd, assembly.errors[place]);
    for k in 0..R {
        let z = Lane::new(simd, works[k]);
        let own = z * stiffness[k];
        error = (own * z).mul_add(trust[k], error);
        weighed[k] = own.value;
    }
    assembly.errors[place] = error.value;
    weighed
}

/// Adds a sum of products to one entry.
#[inline(always)]
fn add_product<S: Simd, const R: usize>(
    assembly: &mut Assembly<'_, S>,
    place: u32,
    a: &[S::f64s; R],
    b: &[S::f64s; R],
) {
    let simd = assembly.simd;
    let entry = &mut assembly.entries[place as usize];
    let mut sum = *entry;
    for k in 0..R {
        sum = simd.mul_add_e_f64s(a[k], b[k], sum);
    }
    *entry = sum;
}
