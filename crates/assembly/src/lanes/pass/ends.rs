//! What wrenches of a chain do on the coordinates of its ends.

use pulp::Simd;

use super::assemble::Assembly;
use super::blocks::{Pair, vector};
use super::compliance::{Frame, Six};
use super::lane::{Lane, Mat3, Vec3, add, cross, dot, scaled, sub, three};
use crate::lanes::program::chain::Chain;
use crate::lanes::program::element::NodeMotion;

/// Works of `R` wrenches, about the frame's origin in global axes, on the coordinates of a chain's ends,
/// each its own (by ends), end 0 with the opposite sign: R a coordinate.
#[inline(always)]
pub(crate) fn works<S: Simd, const R: usize>(
    assembly: &Assembly<'_, S>,
    chain: &Chain,
    frame: &Frame<S>,
    nodes: &[NodeMotion],
    wrenches: [&[Pair<S>; R]; 2],
    out: &mut [S::f64s],
) {
    let simd = assembly.simd;
    let (out, _) = out.as_chunks_mut::<R>();
    let mut next = 0;
    for (end, node) in nodes.iter().enumerate() {
        if !node.moves() {
            continue;
        }
        let origin = vector(simd, assembly.inputs, chain.origins[end]);
        let arm = sub(&frame.origin, &origin);
        let mut own = *wrenches[end];
        for a in 0..R {
            let (force, moment) = own[a];
            let moment = add(&moment, &cross(&arm, &force));
            own[a] = if end == 0 {
                (three!(k => -force[k]), three!(k => -moment[k]))
            } else {
                (force, moment)
            };
        }
        if node.root.is_some() {
            let out = &mut out[next..next + 6];
            for a in 0..R {
                for k in 0..3 {
                    out[k][a] = own[a].0[k].value;
                    out[3 + k][a] = own[a].1[k].value;
                }
            }
            next += 6;
        }
        for screw in &node.screws {
            let (v, w) = assembly.screw(screw.screw);
            let out = &mut out[next];
            for a in 0..R {
                let (force, moment) = &own[a];
                out[a] = (dot(&v, force) + dot(&w, moment)).value;
            }
            next += 1;
        }
    }
}

/// What the work of a wrench on a coordinate is a sum of: where the sum is none, its rounding is
/// that of these terms.
pub(crate) struct Terms<S: Simd> {
    by_force: Lane<S>,
    by_moment: Lane<S>,
}

impl<S: Simd> Terms<S> {
    #[inline(always)]
    pub fn new(
        assembly: &Assembly<'_, S>,
        chain: &Chain,
        frame: &Frame<S>,
        end: usize,
        node: &NodeMotion,
        coordinate: usize,
    ) -> Self {
        let simd = assembly.simd;
        let (zero, one) = (Lane::splat(simd, 0.0), Lane::splat(simd, 1.0));
        let (mut linear, mut angular) = match node.root {
            Some(root) if (root..root + 3).contains(&coordinate) => (one, zero),
            Some(root) if (root..root + 6).contains(&coordinate) => (zero, one),
            _ => (zero, zero),
        };
        for own in &node.screws {
            if own.coordinate == coordinate {
                let (v, w) = assembly.screw(own.screw);
                (linear, angular) = (dot(&v, &v), dot(&w, &w));
            }
        }
        let arm = sub(
            &frame.origin,
            &vector(simd, assembly.inputs, chain.origins[end]),
        );
        Self {
            by_force: dot(&arm, &arm).mul_add(angular, linear),
            by_moment: angular * Lane::splat(simd, chain.size * chain.size),
        }
    }

    /// The sum of their squares, of those of a force and of a moment over the chain's size.
    #[inline(always)]
    pub fn by(&self, force: Lane<S>, moment: Lane<S>) -> Lane<S> {
        force.mul_add(self.by_force, moment * self.by_moment)
    }

    /// The sum of their squares for a wrench.
    #[inline(always)]
    pub fn of(&self, wrench: &Six<S>) -> Lane<S> {
        let force = dot(
            &[wrench[3], wrench[4], wrench[5]],
            &[wrench[3], wrench[4], wrench[5]],
        );
        let moment = dot(
            &[wrench[0], wrench[1], wrench[2]],
            &[wrench[0], wrench[1], wrench[2]],
        );
        self.by(force, moment)
    }
}

impl<S: Simd> Frame<S> {
    /// A wrench about the origin, in global axes.
    #[inline(always)]
    pub fn to_global(&self, simd: S, chain: &Chain, z: &Six<S>) -> Pair<S> {
        let size = Lane::splat(simd, chain.size);
        let force = to_global(&self.axes, &[z[5], z[3], z[4]]);
        let moment = to_global(&self.axes, &scaled(&[z[0], z[1], z[2]], size));
        (force, moment)
    }
}

/// A vector in axes given as rows, in global axes.
#[inline(always)]
fn to_global<S: Simd>(axes: &Mat3<S>, v: &Vec3<S>) -> Vec3<S> {
    three!(i => axes[0][i].mul_add(v[0], axes[1][i].mul_add(v[1], axes[2][i] * v[2])))
}
