//! The wrenches in all chains, and whether the coordinates are in balance with them.

use pulp::Simd;

use super::State;
use crate::lanes::pass::blocks::{Pair, pair, vector, write_pair};
use crate::lanes::pass::factor::ROUNDING;
use crate::lanes::pass::lane::{Lane, Vec3, add, cross, dot, scaled, sub};
use crate::lanes::program::chain::{Chain, Item};
use crate::lanes::program::element::{Kind, NodeMotion};
use crate::lanes::program::recovery::{AXES, KeptChain};

/// What coordinates may be out of balance by, beside the forces on them.
const BALANCED: f64 = 1e-11;
/// What a force may have lost, and coordinates be out of balance by, beside the largest force.
const LOST: f64 = 1e-12;
/// Wrenches that a chain transmits at most.
const MOST: usize = 6;

impl<S: Simd> State<'_, S> {
    /// Finds them; above zero, or no number, where they are not to be trusted.
    #[inline(always)]
    pub(super) fn transmit(&mut self) -> Lane<S> {
        let zero = self.zero();
        self.balance.fill(zero.value);
        let (mut largest, mut lost) = (zero, zero);
        for element in 0..self.recovery.chains.len() {
            let own = self.add_chain(element);
            largest = largest.max(own[0]);
            lost = lost.max(own[1]);
        }
        for k in 0..6 {
            let wrench = Lane::new(self.simd, self.asked[6 + k]);
            self.add(self.program.output + k, -wrench);
        }
        for spring in &self.program.springs {
            let [a, b] = spring.coordinates;
            let stiffness = Lane::splat(self.simd, spring.stiffness);
            let (at_a, at_b) = (self.moved[a], self.moved[b]);
            self.add(a, stiffness * Lane::new(self.simd, at_b));
            if a != b {
                self.add(b, stiffness * Lane::new(self.simd, at_a));
            }
        }
        for load in &self.program.loads {
            if self.is_acting(load.column) {
                let (force, moment) = pair(self.simd, self.acts, load.act);
                let moment = add(&moment, &cross(&self.arm(load.node.arm), &force));
                self.hold(&load.node, &force, &moment);
            }
        }
        let least = largest * Lane::splat(self.simd, LOST);
        let mut doubt = lost - least;
        let mut sound = zero;
        for k in 0..self.program.coordinates {
            let sum = Lane::new(self.simd, self.balance[2 * k]);
            let terms = Lane::new(self.simd, self.balance[2 * k + 1]);
            let by_size = match self.recovery.slides[k] {
                true => least,
                false => least * self.size,
            };
            let bound = terms.mul_add(Lane::splat(self.simd, BALANCED), by_size);
            doubt = doubt.max(sum.abs() - bound);
            // What is not a number stays so.
            sound = sum.mul_add(zero, sound);
        }
        doubt + sound + lost * zero + largest * zero
    }

    #[inline(always)]
    fn add(&mut self, coordinate: usize, force: Lane<S>) {
        let [sum, terms] = [2 * coordinate, 2 * coordinate + 1];
        self.balance[sum] = self.simd.add_f64s(self.balance[sum], force.value);
        self.balance[terms] = self.simd.add_f64s(self.balance[terms], force.abs().value);
    }

    /// Takes what a wrench at a node's reference point does on the node's coordinates.
    #[inline(always)]
    fn hold(&mut self, node: &NodeMotion, force: &Vec3<S>, moment: &Vec3<S>) {
        if let Some(root) = node.root {
            for k in 0..3 {
                self.add(root + k, -force[k]);
                self.add(root + 3 + k, -moment[k]);
            }
        }
        for own in &node.screws {
            let (linear, angular) = pair(self.simd, self.screws, own.screw);
            let work = dot(force, &linear) + dot(moment, &angular);
            self.add(own.coordinate, -work);
        }
    }

    /// Finds the wrenches of one chain; returns the largest, and what it may have lost \[N\].
    #[inline(always)]
    fn add_chain(&mut self, element: usize) -> [Lane<S>; 2] {
        let simd = self.simd;
        let zero = self.zero();
        let (program, recovery) = (self.program, self.recovery);
        let Kind::Chain(chain) = &program.elements[element].kind else {
            return [zero; 2];
        };
        let own = &recovery.chains[element];
        let layout = own.layout;
        let kept = &self.kept[recovery.range(element)];
        let columns = &program.elements[element].columns;
        let mut wrench = [zero; 6];
        for (number, column) in columns.iter().enumerate() {
            if self.is_acting(*column) {
                let at = layout.column(number);
                for k in 0..6 {
                    wrench[k] += Lane::new(simd, kept[at + k]);
                }
            }
        }
        let count = layout.wrenches;
        let works = layout.works();
        let mut most = zero;
        let mut transmitted = [zero; MOST];
        for a in 0..count {
            let (mut stretch, mut squares) = (zero, zero);
            for (n, coordinate) in own.coordinates.iter().enumerate() {
                let moved = match own.hang {
                    Some(_) => self.relative[*coordinate],
                    None => self.moved[*coordinate],
                };
                let term = Lane::new(simd, kept[works + n * count + a]) * Lane::new(simd, moved);
                stretch += term;
                squares = term.mul_add(term, squares);
            }
            let stiffness = Lane::new(simd, kept[layout.stiffness() + a]);
            let mut force = stiffness * stretch;
            let by_trust = Lane::new(simd, kept[layout.trust() + a]) * force;
            let mut lost = (stiffness * stiffness).mul_add(squares, by_trust * by_trust);
            for (number, column) in columns.iter().enumerate() {
                if self.is_acting(*column) {
                    let at = layout.column(number) + 6 + a;
                    force = force - Lane::new(simd, kept[at]);
                    lost += Lane::new(simd, kept[at + count]);
                }
            }
            transmitted[a] = force;
            most = most.max(lost);
            for k in 0..6 {
                let direction = Lane::new(simd, kept[layout.directions() + 6 * a + k]);
                wrench[k] = force.mul_add(direction, wrench[k]);
            }
        }
        let mut largest = zero;
        for k in 0..6 {
            largest = largest.max(wrench[k].abs());
        }
        for (n, coordinate) in own.coordinates.iter().enumerate() {
            let (mut sum, mut terms) = (zero, zero);
            for a in 0..count {
                let term = Lane::new(simd, kept[works + n * count + a]) * transmitted[a];
                sum += term;
                terms += term.abs();
            }
            for (number, column) in columns.iter().enumerate() {
                if self.is_acting(*column) {
                    let at = layout.column(number) + 6 + 2 * count + n;
                    let term = Lane::new(simd, kept[at]);
                    sum = sum - term;
                    terms += term.abs();
                }
            }
            let place = 2 * coordinate;
            self.balance[place] = simd.add_f64s(self.balance[place], sum.value);
            self.balance[place + 1] = simd.add_f64s(self.balance[place + 1], terms.value);
            if let Some(place) = own.hang {
                self.hand_on(place, *coordinate, sum);
            }
        }
        self.cut(element, chain, own, &wrench);
        // What is lost of a NaN is one, too, by the wrench.
        [
            largest + wrench[0] * zero,
            most.sqrt() * Lane::splat(simd, ROUNDING),
        ]
    }

    /// What a force on the coordinate of a component that hangs asks of its neighbour's.
    #[inline(always)]
    fn hand_on(&mut self, [front, hang]: [usize; 2], coordinate: usize, force: Lane<S>) {
        let front = &self.program.fronts.list[front];
        let hang = &front.hangs[hang];
        let mut own = 6;
        for (k, place) in hang.places.iter().enumerate() {
            if front.variables[*place] == coordinate {
                own = k;
            }
        }
        let zero = self.zero();
        let (mut linear, mut angular) = ([zero; 3], [zero; 3]);
        match own {
            0..3 => linear[own] = -force,
            3..6 => angular[own - 3] = -force,
            _ => return,
        }
        let angular = add(&angular, &cross(&self.arm(hang.arm), &linear));
        for k in 0..3 {
            self.add(front.variables[hang.root[k]], linear[k]);
            self.add(front.variables[hang.root[3 + k]], angular[k]);
        }
        for (screw, place) in &hang.screws {
            let (along, about) = pair(self.simd, self.screws, *screw);
            let work = dot(&linear, &along) + dot(&angular, &about);
            self.add(front.variables[*place], work);
        }
    }

    /// Finds the wrench at every place of a chain, from its end 1 on.
    #[inline(always)]
    fn cut(&mut self, element: usize, chain: &Chain, own: &KeptChain, wrench: &[Lane<S>; 6]) {
        let simd = self.simd;
        let kept = &self.kept[own.start..];
        let mut origin = [self.zero(); 3];
        let mut force = [self.zero(); 3];
        let mut moment = [self.zero(); 3];
        let size = Lane::splat(simd, chain.size);
        // In the chain's axes: the moments about them, y, z, x of the force.
        let [a, b, c, y, z, x] = *wrench;
        let axial = [x, y, z];
        let turning = scaled(&[a, b, c], size);
        for i in 0..3 {
            origin[i] = Lane::new(simd, kept[i]);
            self.origins[3 * element + i] = kept[i];
            for r in 0..3 {
                let axis = Lane::new(simd, kept[AXES + 3 * r + i]);
                force[i] = axis.mul_add(axial[r], force[i]);
                moment[i] = axis.mul_add(turning[r], moment[i]);
            }
        }
        let mut cut: Pair<S> = (force, moment);
        for k in (0..chain.order.len()).rev() {
            write_pair(self.cuts, own.first_cut + k, &cut);
            if let Item::Load(load) = chain.order[k] {
                let load = &chain.loads[load];
                if self.is_acting(load.column) {
                    let at = vector(simd, self.inputs, load.point);
                    let to_load = sub(&at, &origin);
                    let (force, moment) = pair(simd, self.acts, load.act);
                    let moment = add(&moment, &cross(&to_load, &force));
                    cut = (add(&cut.0, &force), add(&cut.1, &moment));
                }
            }
        }
    }
}
