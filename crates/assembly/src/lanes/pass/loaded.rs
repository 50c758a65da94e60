//! What acts on a chain, column by column.
//!
//! With loads L on what lies between the ends, the wrench in a part is `W + L`, L the sum of the
//! loads beyond it. They move end 1 by `Σ C L`, end 0 held; what acts along beams, heat and misfits
//! move it by what they are. Where a free motion is, `sᵀ (W + L) = 0`: in the reflected coordinates
//! that gives the components of W that are left out, one after the other, and what is left of the
//! displacement gives the others. The wrench with both ends held goes to the column's row.

use pulp::Simd;

use super::assemble::Assembly;
use super::blocks::{pair, vector};
use super::compliance::{Frame, LINEAR, Six};
use super::ends::{Terms, works};
use super::factor::{IDLE, ROUNDING};
use super::lane::{Lane, TRIANGLE, add, apply, cross, scaled, six};
use super::reflections::{Reflection, ordered, put_back};
use crate::lanes::program::chain::{Chain, Item, MOST_IDLE, MOST_RELEASES};
use crate::lanes::program::element::{Element, Shift};

/// What a chain with M free motions transmits: R wrenches, six together.
pub(crate) struct Transmitted<S: Simd, const M: usize, const R: usize> {
    /// The compliance with the free motions reflected out: of its lower triangle, columns that were
    /// left out or eliminated are as they were then.
    pub c: [Six<S>; 6],
    pub reflections: [Reflection<S>; M],
    /// What dependence of the free motions makes of errors.
    pub growth: Lane<S>,
    /// The wrenches, with the stiffness that each is transmitted with.
    pub directions: [Six<S>; R],
    pub stiffness: [Lane<S>; R],
    /// Relative errors of these, as multiples of [`ROUNDING`](super::factor::ROUNDING).
    pub trust: [Lane<S>; R],
}

/// What loads and shifts do in one column, with end 1 free and end 0 held.
struct Loaded<S: Simd> {
    /// Wrench of all loads.
    total: Six<S>,
    /// What end 1 moves, free motions apart.
    moved: Six<S>,
    /// Squares of what shifts move it by, and of all terms of what moves it.
    shifted: Six<S>,
    squares: Six<S>,
    /// A measure of the loads' energy.
    energy: Lane<S>,
    /// Work that is missing along free and along idle motions, with the squares of its terms.
    works: [[Lane<S>; 2]; MOST_RELEASES],
    idle_works: [[Lane<S>; 2]; MOST_IDLE],
}

/// What acts on a chain.
pub(crate) struct Acting<'a, S: Simd> {
    pub simd: S,
    pub inputs: &'a [S::f64s],
    pub acts: &'a [S::f64s],
    /// Compliances of its links, as [`compliances`](super::compliance::compliances) keeps them.
    pub links: &'a [S::f64s],
}

impl<S: Simd> Acting<'_, S> {
    /// Adds what a column does to a row of a front: `places` of the chain's coordinates, and that of
    /// the row; `wrenches`: the transmitted ones' works, R a coordinate, and one more entry each; `kept`:
    /// what forces are found from, where they are asked for.
    #[inline(always)]
    pub fn add_column<const M: usize, const R: usize>(
        &self,
        assembly: &mut Assembly<'_, S>,
        transmitted: &Transmitted<S, M, R>,
        (element, chain, frame): (&Element, &Chain, &Frame<S>),
        column: usize,
        (places, row): (&[usize], usize),
        (wrenches, kept): (&mut [S::f64s], &mut [S::f64s]),
    ) {
        let (simd, inputs) = (self.simd, self.inputs);
        let (zero, nan) = (Lane::splat(simd, 0.0), Lane::splat(simd, f64::NAN));
        let Transmitted {
            c,
            reflections,
            growth,
            directions,
            stiffness,
            trust,
        } = transmitted;
        let loaded = self.of_column(element, chain, frame, column);
        let mut moved = ordered(&loaded.moved, chain);
        let mut shifted = ordered(&loaded.shifted, chain);
        let mut squares = ordered(&loaded.squares, chain);
        // The energy that loads put into the chain.
        let mut energy = loaded.energy;
        // The wrench with both ends held: of it, what free motions ask for.
        let mut held = [zero; 6];
        let mut doubts = [zero; M];
        for k in 0..M {
            let Reflection {
                normal: s,
                factor,
                turned,
            } = reflections[k];
            // No work on motion k: that is one component of the wrench.
            let [mut missing, mut terms] = loaded.works[k];
            for i in 0..k {
                missing = (-s[i]).mul_add(held[i], missing);
                terms = (s[i] * s[i]).mul_add(held[i].mul_add(held[i], doubts[i]), terms);
            }
            let inverse = turned.recip();
            held[k] = missing * inverse;
            doubts[k] = terms * inverse * inverse;
            reflections[k].apply(&mut moved, k);
            let (mut spread, mut spread_squares) = (zero, zero);
            for i in k..6 {
                spread = (s[i] * s[i]).mul_add(shifted[i], spread);
                spread_squares = (s[i] * s[i]).mul_add(squares[i], spread_squares);
            }
            let spread = spread * factor * factor;
            let spread_squares = spread_squares * factor * factor;
            for i in k + 1..6 {
                let asked = c[i][k] * held[k];
                moved[i] += asked;
                shifted[i] = spread.mul_add(s[i] * s[i], shifted[i]);
                squares[i] = spread_squares.mul_add(s[i] * s[i], squares[i]);
                squares[i] = asked.mul_add(asked, squares[i]);
            }
            energy = (c[k][k] * held[k]).mul_add(held[k], energy);
        }
        for (k, idle) in chain.idle.iter().enumerate() {
            // What acts must do no work on it.
            let mut s = ordered(&frame.twist(simd, &idle.along, inputs), chain);
            for p in 0..M {
                reflections[p].apply(&mut s, p);
            }
            let [mut work, mut terms] = loaded.idle_works[k];
            for i in 0..M {
                work = (-s[i]).mul_add(held[i], work);
                terms = (s[i] * s[i]).mul_add(held[i].mul_add(held[i], doubts[i]), terms);
            }
            let bound = terms * Lane::splat(simd, (IDLE * ROUNDING) * (IDLE * ROUNDING));
            energy += (work * work).if_above(bound, nan, zero);
        }

        // By wrenches: the force with both ends held, reversed.
        let mut forces = [zero; R];
        // Squares of their errors: by what cancels in the displacement, and by the stiffness itself.
        let mut lost = [zero; R];
        for a in 0..R {
            forces[a] = moved[M + a] * stiffness[a];
            let by_stiffness = trust[a] * forces[a];
            lost[a] = squares[M + a] * stiffness[a] * stiffness[a];
            lost[a] = by_stiffness.mul_add(by_stiffness, lost[a]);
            energy = shifted[M + a].mul_add(stiffness[a], energy);
            for b in a + 1..R {
                let l = c[M + b][M + a] * stiffness[a];
                moved[M + b] = (-l).mul_add(moved[M + a], moved[M + b]);
                shifted[M + b] = (l * l).mul_add(shifted[M + a], shifted[M + b]);
                squares[M + b] = (l * l).mul_add(squares[M + a], squares[M + b]);
            }
        }
        for k in (0..M).rev() {
            reflections[k].apply(&mut held, k);
        }
        let held = put_back(&held, chain);
        // By ends: what acts does there with both held, but for the wrenches' forces.
        let ends = [six!(k => -(held[k] + loaded.total[k])), six!(k => -held[k])];
        let count = places.len();
        let (transmitted, own) = wrenches.split_at_mut(R * count);
        let wrenches = [
            [frame.to_global(simd, chain, &ends[0])],
            [frame.to_global(simd, chain, &ends[1])],
        ];
        let [first, second] = &wrenches;
        works(assembly, chain, frame, &element.nodes, [first, second], own);
        if !kept.is_empty() {
            for k in 0..6 {
                kept[k] = held[k].value;
            }
            for a in 0..R {
                kept[6 + a] = forces[a].value;
                kept[6 + R + a] = lost[a].value;
            }
            for k in 0..count {
                kept[6 + 2 * R + k] = own[k];
            }
        }
        let error = &mut assembly.errors[row];
        *error = energy.mul_add(*growth, Lane::new(simd, *error)).value;
        let mut doubt = zero;
        for k in 0..M {
            doubt += doubts[k];
        }
        let mut next = 0;
        for (end, node) in element.nodes.iter().enumerate() {
            for coordinate in node.coordinates() {
                let place = places[next];
                let terms = Terms::new(assembly, chain, frame, end, node, coordinate);
                let mut sum = terms.of(&ends[end]) + terms.by(doubt, doubt);
                if assembly.idle[coordinate] {
                    for a in 0..R {
                        let squared = forces[a] * forces[a];
                        sum = terms.of(&directions[a]).mul_add(squared, sum);
                    }
                }
                let mut force = Lane::new(simd, own[next]);
                for a in 0..R {
                    let z = Lane::new(simd, transmitted[next * R + a]);
                    force = z.mul_add(forces[a], force);
                    sum = (z * z).mul_add(lost[a], sum);
                }
                assembly.add_load_error(row, place, sum);
                assembly.add(row, place, force);
                next += 1;
            }
        }
    }

    /// What a column does.
    #[inline(always)]
    fn of_column(
        &self,
        element: &Element,
        chain: &Chain,
        frame: &Frame<S>,
        column: usize,
    ) -> Loaded<S> {
        let (simd, inputs) = (self.simd, self.inputs);
        let zero = Lane::splat(simd, 0.0);
        let mut loaded = Loaded {
            total: [zero; 6],
            moved: [zero; 6],
            shifted: [zero; 6],
            squares: [zero; 6],
            energy: zero,
            works: [[zero; 2]; MOST_RELEASES],
            idle_works: [[zero; 2]; MOST_IDLE],
        };
        let mut is_loaded = false;
        for item in chain.order.iter().rev() {
            match *item {
                Item::Load(k) if chain.loads[k].column == column => {
                    is_loaded = true;
                    let load = &chain.loads[k];
                    let (force, moment) = pair(simd, self.acts, load.act);
                    let force = apply(&frame.axes, &force);
                    let moment = scaled(&apply(&frame.axes, &moment), frame.per_size);
                    let arm = frame.arm_to(&vector(simd, inputs, load.point));
                    let moment = add(&moment, &cross(&arm, &force));
                    for i in 0..3 {
                        loaded.total[i] += moment[i];
                        loaded.total[LINEAR[i]] += force[i];
                    }
                }
                _ if !is_loaded => {}
                Item::Load(_) => {}
                Item::Link(k) => {
                    let own = &self.links[TRIANGLE * k..TRIANGLE * (k + 1)];
                    for i in 0..6 {
                        let mut moved = loaded.moved[i];
                        for j in 0..6 {
                            let (row, column) = if i >= j { (i, j) } else { (j, i) };
                            let entry = Lane::new(simd, own[row * (row + 1) / 2 + column]);
                            let term = entry * loaded.total[j];
                            moved += term;
                            loaded.squares[i] = term.mul_add(term, loaded.squares[i]);
                        }
                        loaded.moved[i] = moved;
                        let diagonal = Lane::new(simd, own[i * (i + 3) / 2]);
                        let by = diagonal * loaded.total[i];
                        loaded.energy = by.mul_add(loaded.total[i], loaded.energy);
                    }
                }
                Item::Release(k) => {
                    let [work, terms] = frame.work(simd, &chain.releases[k], &loaded.total, inputs);
                    loaded.works[k] = [-work, terms];
                }
                Item::Idle(k) => {
                    let idle = &chain.idle[k].along;
                    let [work, terms] = frame.work(simd, idle, &loaded.total, inputs);
                    loaded.idle_works[k] = [-work, terms];
                }
            }
        }
        for shift in &element.shifts {
            if shift.column == column {
                self.add_shift(shift, chain, frame, &mut loaded);
            }
        }
        loaded
    }

    #[inline(always)]
    fn add_shift(&self, shift: &Shift, chain: &Chain, frame: &Frame<S>, loaded: &mut Loaded<S>) {
        let simd = self.simd;
        let own = pair(simd, self.acts, shift.act);
        let at = vector(simd, self.inputs, shift.point);
        // Of end 1 from end 0.
        let sign = if shift.node == 1 {
            shift.sign
        } else {
            -shift.sign
        };
        let turns = Lane::splat(simd, sign * chain.size);
        let angular = scaled(&apply(&frame.axes, &own.1), turns);
        let linear = scaled(&apply(&frame.axes, &own.0), Lane::splat(simd, sign));
        let carried = cross(&frame.arm_to(&at), &angular);
        for i in 0..3 {
            loaded.moved[i] += angular[i];
            let own = angular[i] * angular[i];
            loaded.shifted[i] += own;
            loaded.squares[i] += own;
            // At the origin, what turns about the point.
            let k = LINEAR[i];
            loaded.moved[k] += linear[i] + carried[i];
            let squares = linear[i].mul_add(linear[i], carried[i] * carried[i]);
            loaded.shifted[k] += squares;
            loaded.squares[k] += squares;
        }
    }
}
