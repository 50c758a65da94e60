//! What all segments and joints carry, in their own axes.

use pulp::{Simd, WithSimd};

use super::room::{ENDS, OF_SEGMENT};
use super::{Place, State};
use crate::lanes::pass::blocks::{Pair, both, element_axes, pair, vector, write_pair};
use crate::lanes::pass::lane::{Lane, Mat3, Vec3, add, apply, cross, dot, scaled, sub, three};

impl WithSimd for Place<'_> {
    type Output = ();

    /// Axes and lengths of all segments.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let inputs = S::as_simd_f64s(&self.buffers.inputs).0;
        let out = S::as_mut_simd_f64s(&mut self.room.segments).0;
        for (k, own) in self.recovery.segments.iter().enumerate() {
            let [from, to] = both(simd, inputs, own.points);
            let span = sub(&to, &from);
            let length = dot(&span, &span).sqrt();
            let x = scaled(&span, length.recip());
            let axes = element_axes(&x, &vector(simd, inputs, own.y_axis));
            let out = &mut out[OF_SEGMENT * k..][..OF_SEGMENT];
            for r in 0..3 {
                for c in 0..3 {
                    out[3 * r + c] = axes[r][c].value;
                }
            }
            out[9] = length.value;
        }
    }
}

impl<S: Simd> State<'_, S> {
    /// Finds it.
    #[inline(always)]
    pub(super) fn gather(&mut self) {
        let simd = self.simd;
        let recovery = self.recovery;
        for (k, own) in recovery.segments.iter().enumerate() {
            let axes = &self.segments[OF_SEGMENT * k..];
            let axes: Mat3<S> = three!(r => three!(c => Lane::new(simd, axes[3 * r + c])));
            let (force, moment) = pair(simd, self.cuts, own.cut);
            let origin = vector(simd, self.origins, own.element);
            let points = both(simd, self.inputs, own.points);
            for end in 0..2 {
                // The wrench at its first node is what is on it from before.
                let sign = if (end == 0) == own.flipped { 1.0 } else { -1.0 };
                let sign = Lane::splat(simd, sign);
                let to_origin = sub(&origin, &points[end]);
                let about = add(&moment, &cross(&to_origin, &force));
                let here = (
                    scaled(&apply(&axes, &force), sign),
                    scaled(&apply(&axes, &about), sign),
                );
                write_pair(self.carried, 2 * k + end, &here);
            }
        }
        let first = ENDS / 6 * recovery.segments.len();
        for (k, own) in recovery.joints.iter().enumerate() {
            let zero = self.zero();
            let mut sum: Pair<S> = ([zero; 3], [zero; 3]);
            let point = vector(simd, self.inputs, own.point);
            for (element, cut, sign) in &own.cuts {
                let arm = sub(&vector(simd, self.origins, *element), &point);
                let wrench = pair(simd, self.cuts, *cut);
                add_at(&mut sum, &wrench, &arm, Lane::splat(simd, *sign));
            }
            for (load, sign) in &own.loads {
                let load = &recovery.loads[*load];
                if self.is_acting(load.column) {
                    let arm = sub(&vector(simd, self.inputs, load.point), &point);
                    let wrench = pair(simd, self.acts, load.act);
                    add_at(&mut sum, &wrench, &arm, Lane::splat(simd, *sign));
                }
            }
            // Columns of the frame are the axes.
            let axes: Mat3<S> = three!(c => vector(simd, self.inputs, own.frame[c]));
            let own = (apply(&axes, &sum.0), apply(&axes, &sum.1));
            write_pair(self.carried, first + k, &own);
        }
    }
}

/// Adds a wrench about a point at `arm` from here.
#[inline(always)]
fn add_at<S: Simd>(sum: &mut Pair<S>, (force, moment): &Pair<S>, arm: &Vec3<S>, sign: Lane<S>) {
    let about = add(moment, &cross(arm, force));
    sum.0 = add(&sum.0, &scaled(force, sign));
    sum.1 = add(&sum.1, &scaled(&about, sign));
}
