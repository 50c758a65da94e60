//! Householder reflections that turn a chain's free motions into coordinates, and the order of the
//! coordinates that they take.
//!
//! A reflection that turns a motion into a coordinate which the motion hardly has nearly swaps it
//! with one that it has. Where a soft direction lies there, what is left of its compliance is the
//! rounding of a large difference. So each motion is turned into its own largest coordinate, as it is
//! in the plan's configuration: the order is the same for all poses.

use pulp::{Scalar, Simd};

use super::compliance::{Frame, Six};
use super::lane::{Lane, six};
use crate::lanes::program::Program;
use crate::lanes::program::chain::{Chain, Sequence};
use crate::lanes::program::element::Kind;

/// A reflection `x − f v (vᵀ x)` of the coordinates from k on.
#[derive(Clone, Copy)]
pub(crate) struct Reflection<S: Simd> {
    pub normal: Six<S>,
    pub factor: Lane<S>,
    /// What the motion becomes: its component k, the only one.
    pub turned: Lane<S>,
}

impl<S: Simd> Reflection<S> {
    /// None: all as it is.
    #[inline(always)]
    pub fn none(zero: Lane<S>) -> Self {
        Self {
            normal: [zero; 6],
            factor: zero,
            turned: zero,
        }
    }

    /// That which turns `motion` into its coordinate k; `left`: the sum of the squares of its
    /// components from k on.
    #[inline(always)]
    pub fn of(mut motion: Six<S>, left: Lane<S>, k: usize) -> Self {
        let zero = left.constant(0.0);
        let size = left.sqrt();
        let first = motion[k];
        let longer = first.abs() + size;
        motion[k] = first.if_above(zero, longer, -longer);
        Self {
            normal: motion,
            factor: (size * longer).recip(),
            turned: first.if_above(zero, -size, size),
        }
    }

    #[inline(always)]
    pub fn apply(&self, x: &mut Six<S>, k: usize) {
        let normal = &self.normal;
        let mut work = x[k] * normal[k];
        for i in k + 1..6 {
            work = x[i].mul_add(normal[i], work);
        }
        let minus = -(work * self.factor);
        for i in k..6 {
            x[i] = minus.mul_add(normal[i], x[i]);
        }
    }

    /// The same of six numbers that are zero but for `count` of them from k + 1 on.
    #[inline(always)]
    pub fn apply_first(&self, x: &mut Six<S>, k: usize, count: usize) {
        let normal = &self.normal;
        let mut work = x[k + 1] * normal[k + 1];
        for i in k + 2..k + 1 + count {
            work = x[i].mul_add(normal[i], work);
        }
        let minus = -(work * self.factor);
        for i in k..6 {
            x[i] = minus.mul_add(normal[i], x[i]);
        }
    }
}

/// The sum of the squares of the components from k on.
#[inline(always)]
pub(crate) fn squares<S: Simd>(x: &Six<S>, k: usize) -> Lane<S> {
    let mut sum = x[k] * x[k];
    for i in k + 1..6 {
        sum = x[i].mul_add(x[i], sum);
    }
    sum
}

/// Six numbers in a chain's order.
#[inline(always)]
pub(crate) fn ordered<S: Simd>(x: &Six<S>, chain: &Chain) -> Six<S> {
    six!(k => x[chain.sequence.coordinates[k]])
}

/// Six numbers in a chain's order, in the frame's own again.
#[inline(always)]
pub(crate) fn put_back<S: Simd>(x: &Six<S>, chain: &Chain) -> Six<S> {
    six!(k => x[usize::from(chain.sequence.places[k])])
}

/// The same of several.
#[inline(always)]
pub(crate) fn all_put_back<S: Simd, const R: usize>(x: &[Six<S>; R], chain: &Chain) -> [Six<S>; R] {
    // Each place is looked up once.
    let mut rows = [[x[0][0]; R]; 6];
    for k in 0..6 {
        for a in 0..R {
            rows[k][a] = x[a][k];
        }
    }
    let mut out = *x;
    for k in 0..6 {
        let row = &rows[usize::from(chain.sequence.places[k])];
        for a in 0..R {
            out[a][k] = row[a];
        }
    }
    out
}

/// A symmetric matrix, its lower triangle, in a chain's order.
#[inline(always)]
pub(crate) fn ordered_matrix<S: Simd>(c: &[Six<S>; 6], chain: &Chain) -> [Six<S>; 6] {
    let flat = c.as_flattened();
    let mut out = *c;
    let mut next = 0;
    for i in 0..6 {
        for j in 0..=i {
            out[i][j] = flat[usize::from(chain.sequence.entries[next])];
            next += 1;
        }
    }
    out
}

/// Orders the coordinates of all chains; `inputs` of the plan's configuration.
pub(crate) fn order_chains(program: &mut Program, inputs: &[f64]) {
    for element in &mut program.elements {
        if let Kind::Chain(chain) = &mut element.kind {
            chain.sequence = Sequence::new(coordinates(chain, inputs));
        }
    }
}

/// Each free motion's largest coordinate, as the motions before leave it, then the others as they
/// follow each other.
fn coordinates(chain: &Chain, inputs: &[f64]) -> [usize; 6] {
    let simd = Scalar::new();
    let frame = Frame::new(simd, chain, inputs);
    let mut order = [0, 1, 2, 3, 4, 5];
    let mut reflections: Vec<Reflection<Scalar>> = Vec::new();
    for (k, release) in chain.releases.iter().enumerate() {
        let twist = frame.twist(simd, release, inputs);
        let mut motion = order.map(|place| twist[place]);
        for (p, reflection) in reflections.iter().enumerate() {
            reflection.apply(&mut motion, p);
        }
        let size = |i: usize| motion[i].value.abs();
        let largest = (k..6).fold(k, |most, i| if size(i) > size(most) { i } else { most });
        order[k..=largest].rotate_right(1);
        motion[k..=largest].rotate_right(1);
        for reflection in &mut reflections {
            reflection.normal[k..=largest].rotate_right(1);
        }
        let left = squares(&motion, k);
        reflections.push(Reflection::of(motion, left, k));
    }
    order
}
