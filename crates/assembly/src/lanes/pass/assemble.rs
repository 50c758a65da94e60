//! What elements, springs and loads add to a front.

use pulp::Simd;

use super::acts::carried;
use super::blocks::{arm, pair, place};
use super::lane::{Lane, Vec3, add, cross, dot, scaled, three};
use crate::lanes::program::element::{Element, NodeMotion};
use crate::lanes::program::fronts::Moves;
use crate::lanes::program::inputs::Point;

/// A front under assembly, with what belongs to it.
pub(crate) struct Assembly<'a, S: Simd> {
    pub simd: S,
    /// Lower triangle, column by column at `size` each.
    pub entries: &'a mut [S::f64s],
    pub size: usize,
    /// By variables: what was added to the diagonal, as a measure of its rounding.
    pub errors: &'a mut [S::f64s],
    /// Twists of the screws, six entries each.
    pub screws: &'a [S::f64s],
    pub inputs: &'a [S::f64s],
    /// By coordinates: whether it tells an idle motion.
    pub idle: &'a [bool],
    /// Variables before the rows of what acts.
    pub columns: usize,
    /// By rows and variables: the sum of squares that the entry in the row was made of.
    pub load_errors: &'a mut [S::f64s],
    /// What acts, six numbers each.
    pub acts: &'a [S::f64s],
}

/// Places of a node's coordinates among the front's variables.
struct Places<'a> {
    root: Option<&'a [usize]>,
    screws: &'a [usize],
}

impl<S: Simd> Assembly<'_, S> {
    /// Adds to entry (i, j), or twice to a diagonal one: (i, j) and (j, i) fall together there.
    #[inline(always)]
    fn add_pair(&mut self, i: usize, j: usize, value: Lane<S>) {
        let (row, column) = if i < j { (j, i) } else { (i, j) };
        let entry = &mut self.entries[column * self.size + row];
        let value = if i == j { value + value } else { value };
        *entry = self.simd.add_f64s(*entry, value.value);
    }

    /// Adds to an entry below or on the diagonal.
    #[inline(always)]
    pub fn add(&mut self, i: usize, j: usize, value: Lane<S>) {
        let (row, column) = if i < j { (j, i) } else { (i, j) };
        let entry = &mut self.entries[column * self.size + row];
        *entry = self.simd.add_f64s(*entry, value.value);
    }

    /// Adds to a diagonal entry, and to the measure of its rounding.
    #[inline(always)]
    pub fn add_diagonal(&mut self, i: usize, value: Lane<S>) {
        let entry = &mut self.entries[i * self.size + i];
        *entry = self.simd.add_f64s(*entry, value.value);
        let error = &mut self.errors[i];
        *error = self.simd.add_f64s(*error, value.value);
    }

    /// Adds to the measure of the rounding of a variable's entry in a row of what acts.
    #[inline(always)]
    pub fn add_load_error(&mut self, row: usize, i: usize, squares: Lane<S>) {
        let error = &mut self.load_errors[(row - self.columns) * self.size + i];
        *error = self.simd.add_f64s(*error, squares.value);
    }

    /// Adds a constant to entry (i, j).
    #[inline(always)]
    pub fn add_spring(&mut self, places: &[usize], stiffness: f64) {
        let value = Lane::splat(self.simd, stiffness);
        if places[0] == places[1] {
            self.add_diagonal(places[0], value);
        } else {
            self.add(places[0], places[1], value);
        }
    }

    #[inline(always)]
    pub fn screw(&self, screw: usize) -> (Vec3<S>, Vec3<S>) {
        pair(self.simd, self.screws, screw)
    }

    /// Adds an element: `blocks` over its nodes, which move as `nodes` say; `places` of all nodes'
    /// coordinates in order; `moves` of what acts between roots. The blocks are carried to the
    /// reference points in place.
    #[inline(always)]
    pub fn add_element(
        &mut self,
        nodes: &[NodeMotion],
        places: &[usize],
        blocks: &mut [S::f64s],
        moves: &Moves,
    ) {
        for (s, node_s) in nodes.iter().enumerate() {
            for (r, node_r) in nodes[..=s].iter().enumerate() {
                if node_r.moves() && node_s.moves() {
                    let block = &mut blocks[place(r, s)..place(r, s) + 36];
                    self.carry(block, node_r, node_s);
                }
            }
        }
        for [from, to] in &moves.stored {
            self.entries[*to as usize] = blocks[*from as usize];
        }
        let mut start_s = 0;
        for (s, node_s) in nodes.iter().enumerate() {
            let (places_s, end_s) = split(node_s, places, start_s);
            if !node_s.moves() {
                continue;
            }
            let mut start_r = 0;
            for (r, node_r) in nodes[..=s].iter().enumerate() {
                let (places_r, end_r) = split(node_r, places, start_r);
                start_r = end_r;
                if !node_r.moves() {
                    continue;
                }
                let block = &blocks[place(r, s)..place(r, s) + 36];
                if r == s {
                    self.add_own(block, node_s, &places_s);
                } else {
                    self.add_coupling(block, [node_r, node_s], [&places_r, &places_s]);
                }
            }
            start_s = end_s;
        }
        for [from, to] in &moves.added {
            let entry = &mut self.entries[*to as usize];
            *entry = self.simd.add_f64s(*entry, blocks[*from as usize]);
        }
        for [from, to] in &moves.diagonal {
            let error = &mut self.errors[*to as usize];
            *error = self.simd.add_f64s(*error, blocks[*from as usize]);
        }
    }

    /// `X_rᵀ K X_s`: from the nodes to the reference points.
    #[inline(always)]
    fn carry(&self, block: &mut [S::f64s], node_r: &NodeMotion, node_s: &NodeMotion) {
        if let Some(points) = node_s.arm {
            let arm = arm(self.simd, self.inputs, points);
            for i in 0..6 {
                carry_three(self.simd, &arm, block, 6 * i, 1);
            }
        }
        if let Some(points) = node_r.arm {
            let arm = arm(self.simd, self.inputs, points);
            for j in 0..6 {
                carry_three(self.simd, &arm, block, j, 6);
            }
        }
    }

    /// A block of one node with itself.
    #[inline(always)]
    fn add_own(&mut self, block: &[S::f64s], node: &NodeMotion, places: &Places<'_>) {
        for (b, own) in node.screws.iter().enumerate() {
            let (linear, angular) = self.times(block, own.screw, [6, 1]);
            if let Some(root) = places.root {
                for i in 0..3 {
                    self.add(root[i], places.screws[b], linear[i]);
                    self.add(root[3 + i], places.screws[b], angular[i]);
                }
            }
            for (a, other) in node.screws[..=b].iter().enumerate() {
                let (v, w) = self.screw(other.screw);
                let energy = dot(&v, &linear) + dot(&w, &angular);
                if a == b {
                    self.add_diagonal(places.screws[b], energy);
                } else {
                    self.add(places.screws[a], places.screws[b], energy);
                }
            }
        }
    }

    /// A block of two nodes.
    #[inline(always)]
    fn add_coupling(
        &mut self,
        block: &[S::f64s],
        nodes: [&NodeMotion; 2],
        places: [&Places<'_>; 2],
    ) {
        if let Some(root) = places[1].root {
            for (a, own) in nodes[0].screws.iter().enumerate() {
                let (linear, angular) = self.times(block, own.screw, [1, 6]);
                for j in 0..3 {
                    self.add_pair(places[0].screws[a], root[j], linear[j]);
                    self.add_pair(places[0].screws[a], root[3 + j], angular[j]);
                }
            }
        }
        for (b, own) in nodes[1].screws.iter().enumerate() {
            let (linear, angular) = self.times(block, own.screw, [6, 1]);
            if let Some(root) = places[0].root {
                for i in 0..3 {
                    self.add_pair(root[i], places[1].screws[b], linear[i]);
                    self.add_pair(root[3 + i], places[1].screws[b], angular[i]);
                }
            }
            for (a, other) in nodes[0].screws.iter().enumerate() {
                let (v, w) = self.screw(other.screw);
                let energy = dot(&v, &linear) + dot(&w, &angular);
                self.add_pair(places[0].screws[a], places[1].screws[b], energy);
            }
        }
    }

    /// A block, or its transpose (by the strides of its rows and columns), times a screw.
    #[inline(always)]
    fn times(
        &self,
        block: &[S::f64s],
        screw: usize,
        [rows, columns]: [usize; 2],
    ) -> (Vec3<S>, Vec3<S>) {
        let (v, w) = self.screw(screw);
        (
            three!(i => product_of_row(self.simd, &block[i * rows..], columns, &v, &w)),
            three!(i => product_of_row(self.simd, &block[(3 + i) * rows..], columns, &v, &w)),
        )
    }

    /// Adds what the shifts of an element do to the rows of what acts: the wrenches that hold it
    /// there, `blocks` times them. `points` of the nodes; `rows`: places of the rows of its columns.
    #[inline(always)]
    pub fn add_shifts(
        &mut self,
        element: &Element,
        places: &[usize],
        rows: &[usize],
        blocks: &[S::f64s],
        points: &[Point],
    ) {
        let simd = self.simd;
        for (column, &row) in element.columns.iter().zip(rows) {
            for shift in &element.shifts {
                if shift.column != *column {
                    continue;
                }
                // Points of a joint are one.
                let to = points[shift.node.min(points.len() - 1)];
                let own = pair(simd, self.acts, shift.act);
                let (linear, angular) = carried(simd, &own, shift.point, to, self.inputs);
                let sign = Lane::splat(simd, shift.sign);
                let (linear, angular) = (scaled(&linear, sign), scaled(&angular, sign));
                let mut start = 0;
                for (r, node) in element.nodes.iter().enumerate() {
                    let (_, end) = split(node, places, start);
                    let (from, [rows, columns]) = if r <= shift.node {
                        (place(r, shift.node), [6, 1])
                    } else {
                        (place(shift.node, r), [1, 6])
                    };
                    let block = &blocks[from..from + 36];
                    let force: Vec3<S> = three!(i => {
                        product_of_row(simd, &block[i * rows..], columns, &linear, &angular)
                    });
                    let moment: Vec3<S> = three!(i => {
                        product_of_row(simd, &block[(3 + i) * rows..], columns, &linear, &angular)
                    });
                    if r == shift.node {
                        let energy = dot(&force, &linear) + dot(&moment, &angular);
                        let error = &mut self.errors[row];
                        *error = simd.add_f64s(*error, energy.value);
                    }
                    if node.moves() {
                        self.add_load(node, &places[start..end], row, &force, &moment);
                    }
                    start = end;
                }
            }
        }
    }

    /// Adds a wrench on a node (linear and angular part, at the node) to a row of what acts.
    #[inline(always)]
    pub fn add_load(
        &mut self,
        node: &NodeMotion,
        places: &[usize],
        row: usize,
        force: &Vec3<S>,
        moment: &Vec3<S>,
    ) {
        let moment = match node.arm {
            Some(points) => add(moment, &cross(&arm(self.simd, self.inputs, points), force)),
            None => *moment,
        };
        let (places, _) = split(node, places, 0);
        if let Some(root) = places.root {
            for k in 0..3 {
                self.add(row, root[k], force[k]);
                self.add(row, root[3 + k], moment[k]);
                self.add_load_error(row, root[k], force[k] * force[k]);
                self.add_load_error(row, root[3 + k], dot(&moment, &moment));
            }
        }
        for (a, own) in node.screws.iter().enumerate() {
            let (v, w) = self.screw(own.screw);
            let place = places.screws[a];
            self.add(row, place, dot(&v, force) + dot(&w, &moment));
            let by_force = dot(&v, &v) * dot(force, force);
            let by_moment = dot(&w, &w) * dot(&moment, &moment);
            self.add_load_error(row, place, by_force + by_moment);
        }
    }
}

/// The places of one node's coordinates, and where the next node's start.
#[inline(always)]
fn split<'a>(node: &NodeMotion, places: &'a [usize], start: usize) -> (Places<'a>, usize) {
    let middle = if node.root.is_some() {
        start + 6
    } else {
        start
    };
    let end = middle + node.screws.len();
    let parts = Places {
        root: (middle > start).then(|| &places[start..middle]),
        screws: &places[middle..end],
    };
    (parts, end)
}

/// Adds `arm × linear` to the angular one of two threes that lie `stride` apart from `start`.
#[inline(always)]
fn carry_three<S: Simd>(
    simd: S,
    arm: &Vec3<S>,
    block: &mut [S::f64s],
    start: usize,
    stride: usize,
) {
    let linear: Vec3<S> = three!(k => Lane::new(simd, block[start + k * stride]));
    let moved = cross(arm, &linear);
    for k in 0..3 {
        let entry = &mut block[start + (3 + k) * stride];
        *entry = simd.add_f64s(*entry, moved[k].value);
    }
}

/// A row of a block, its entries `stride` apart, times a twist.
#[inline(always)]
fn product_of_row<S: Simd>(
    simd: S,
    row: &[S::f64s],
    stride: usize,
    linear: &Vec3<S>,
    angular: &Vec3<S>,
) -> Lane<S> {
    let first: Vec3<S> = three!(k => Lane::new(simd, row[k * stride]));
    let last: Vec3<S> = three!(k => Lane::new(simd, row[(3 + k) * stride]));
    dot(&first, linear) + dot(&last, angular)
}
