//! Loops of rigid bodies at a pose: the screws by which their bodies move along the independent
//! coordinates.

use pulp::Simd;

use super::blocks::{Pair, pair, vector, write_pair};
use super::lane::{Lane, Vec3, add, cross, dot, scaled, sub};
use crate::lanes::program::loops::{Condition, Loop, NOTHING, PIVOT};

/// Forms the combined screws of a loop, six entries each. `matrix`: an entry for every condition and
/// coordinate; `scales`: one for every condition. They are not numbers where the order of elimination
/// does not serve the pose.
#[inline(always)]
pub(crate) fn close<S: Simd>(
    simd: S,
    own: &Loop,
    inputs: &[S::f64s],
    screws: &mut [S::f64s],
    (matrix, scales): (&mut [S::f64s], &mut [S::f64s]),
) {
    let (zero, nan) = (Lane::splat(simd, 0.0), Lane::splat(simd, f64::NAN));
    let columns = own.coordinates.len();
    let reference = vector(simd, inputs, own.reference);
    for (row, condition) in own.conditions.iter().enumerate() {
        let entries = &mut matrix[row * columns..(row + 1) * columns];
        entries.fill(zero.value);
        let (force, moment) = wrench(simd, condition, &reference, inputs);
        let (by_force, by_moment) = (dot(&force, &force), dot(&moment, &moment));
        let mut scale = zero;
        for (column, sign) in &condition.terms {
            let (v, w) = pair(simd, screws, own.coordinates[*column]);
            let work = dot(&force, &v) + dot(&moment, &w);
            entries[*column] = (work * Lane::splat(simd, *sign)).value;
            scale += by_force * dot(&v, &v) + by_moment * dot(&w, &w);
        }
        scales[row] = scale.value;
    }
    let mut poison = zero;
    for [row, column] in &own.pivots {
        let pivot = Lane::new(simd, matrix[row * columns + column]);
        let least = Lane::new(simd, scales[*row]) * Lane::splat(simd, PIVOT * PIVOT);
        poison += (pivot * pivot).if_above(least, zero, nan);
        let inverse = pivot.recip();
        for c in 0..columns {
            let entry = &mut matrix[row * columns + c];
            *entry = simd.mul_f64s(*entry, inverse.value);
        }
        for other in 0..own.conditions.len() {
            if other == *row {
                continue;
            }
            let factor = -Lane::new(simd, matrix[other * columns + column]);
            for c in 0..columns {
                let from = Lane::new(simd, matrix[row * columns + c]);
                let entry = &mut matrix[other * columns + c];
                *entry = factor.mul_add(from, Lane::new(simd, *entry)).value;
            }
        }
    }
    // What is left of the others must be nothing.
    let mut redundant = zero;
    for row in 0..own.conditions.len() {
        let mut is_met = false;
        for [own, _] in &own.pivots {
            is_met |= *own == row;
        }
        if is_met {
            continue;
        }
        let most = Lane::new(simd, scales[row]) * Lane::splat(simd, NOTHING * NOTHING);
        for column in &own.independent {
            let entry = Lane::new(simd, matrix[row * columns + column]);
            redundant += (entry * entry).if_above(most, nan, zero);
        }
    }
    poison += redundant;
    for combined in &own.combined {
        let (mut linear, mut angular) = ([poison; 3], [poison; 3]);
        if combined.own {
            let (v, w) = pair(simd, screws, own.coordinates[combined.column]);
            (linear, angular) = (add(&linear, &v), add(&angular, &w));
        }
        for step in &combined.steps {
            let [row, column] = own.pivots[*step];
            let share = -Lane::new(simd, matrix[row * columns + combined.column]);
            let (v, w) = pair(simd, screws, own.coordinates[column]);
            linear = add(&linear, &scaled(&v, share));
            angular = add(&angular, &scaled(&w, share));
        }
        write_pair(screws, combined.screw, &(linear, angular));
    }
}

/// The wrench at the reference point whose work on a twist must be none.
#[inline(always)]
fn wrench<S: Simd>(
    simd: S,
    condition: &Condition,
    reference: &Vec3<S>,
    inputs: &[S::f64s],
) -> Pair<S> {
    let zero = Lane::splat(simd, 0.0);
    let (mut force, mut moment) = ([zero; 3], [zero; 3]);
    for k in 0..3 {
        let axis = vector(simd, inputs, condition.axes[k]);
        if condition.dual[k] != 0.0 {
            force = add(&force, &scaled(&axis, Lane::splat(simd, condition.dual[k])));
        }
        if condition.dual[3 + k] != 0.0 {
            let dual = Lane::splat(simd, condition.dual[3 + k]);
            moment = add(&moment, &scaled(&axis, dual));
        }
    }
    let arm = sub(&vector(simd, inputs, condition.point), reference);
    (force, add(&moment, &cross(&arm, &force)))
}
