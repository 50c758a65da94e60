//! Motions relative to a stiff neighbour.
//!
//! Where a stiff element joins a component to another, eliminating the component in absolute
//! coordinates takes the difference of two large stiffnesses to find a small one: what is soft in
//! series with the stiff element loses its digits. So the component is made to *hang* on its
//! neighbour first: its six coordinates become those relative to the neighbour's rigid motion,
//! and the stiff element, added after that, acts on these alone.

use pulp::Simd;

use super::blocks::{arm, pair};
use super::factor::Matrix;
use super::lane::{Lane, Vec3, add, cross, six};
use crate::lanes::program::fronts::{Hang, HangPlaces};

/// An element is much stiffer than others below this share of its stiffness.
pub(crate) const DOMINATED: f64 = 0.3;

/// A chain with more free motions than this holds nothing along most directions: what hangs on it
/// would gain the neighbour's stiffness there and lose digits instead of keeping them.
pub(crate) const MOST_FREE: usize = 1;

/// Coordinates of a root.
const ROOT: usize = 6;

/// What the motion of a neighbour is made of.
pub(crate) struct Motion<'a, S: Simd> {
    pub inputs: &'a [S::f64s],
    pub screws: &'a [S::f64s],
}

/// Makes the coordinates of a component relative: `u = v + T w` with the neighbour's coordinates
/// w. Every column of w gains `A_P T`, every row likewise. `gains`: an entry for every row and
/// target.
#[inline(always)]
pub(crate) fn make_relative<S: Simd>(
    simd: S,
    matrix: &mut Matrix<'_, S>,
    hang: &Hang,
    places: &HangPlaces,
    motion: &Motion<'_, S>,
    gains: &mut [S::f64s],
) {
    let count = places.targets.len();
    let arm = match hang.arm {
        Some(points) => Some(arm(simd, motion.inputs, points)),
        None => None,
    };
    // Gains of every row and target: A_P T.
    for (own, gains) in places.own.iter().zip(gains.chunks_exact_mut(count)) {
        let row: Column<S> = six!(q => Lane::new(simd, matrix.entries[own[q] as usize]));
        let turned = turned(&row, &arm);
        let (root, screws) = gains.split_at_mut(6);
        for k in 0..3 {
            root[k] = row[k].value;
            root[3 + k] = turned[k].value;
        }
        for ((screw, _), gain) in hang.screws.iter().zip(screws) {
            *gain = work_of(&twist(simd, *screw, motion, &arm), &row).value;
        }
    }
    // Between targets: A_CP T and its transpose, and Tᵀ A_PP T.
    for (b, &column) in places.targets.iter().enumerate() {
        let inner: Column<S> = six!(q => Lane::new(simd, gains[hang.places[q] * count + b]));
        let turned = turned(&inner, &arm);
        for (a, &row) in places.targets.iter().enumerate().skip(b) {
            let energy = if a >= ROOT {
                let (screw, _) = hang.screws[a - ROOT];
                work_of(&twist(simd, screw, motion, &arm), &inner)
            } else if a < 3 {
                inner[a]
            } else {
                turned[a - 3]
            };
            let crossed = Lane::new(simd, gains[row * count + b])
                + Lane::new(simd, gains[column * count + a]);
            let entry = &mut matrix.entries[places.entries[row * count + b] as usize];
            *entry = simd.add_f64s(*entry, (energy + crossed).value);
        }
        // The entries' errors, as if the component's were the target's own.
        relative_error(simd, &mut *matrix.errors, column, b, hang, motion, &arm);
        for own in matrix.load_errors.chunks_exact_mut(matrix.size) {
            relative_error(simd, own, column, b, hang, motion, &arm);
        }
    }
    for &row in &places.others {
        let gains = &gains[row * count..(row + 1) * count];
        let entries = &places.entries[row * count..(row + 1) * count];
        for (gain, place) in gains.iter().zip(entries) {
            let entry = &mut matrix.entries[*place as usize];
            *entry = simd.add_f64s(*entry, *gain);
        }
    }
}

/// Adds the errors of a component's coordinates to that of target `b`.
#[inline(always)]
fn relative_error<S: Simd>(
    simd: S,
    errors: &mut [S::f64s],
    column: usize,
    b: usize,
    hang: &Hang,
    motion: &Motion<'_, S>,
    arm: &Option<Vec3<S>>,
) {
    let mut error = Lane::new(simd, errors[column]);
    let own: Column<S> = six!(q => Lane::new(simd, errors[hang.places[q]]));
    if b >= ROOT {
        let (screw, _) = hang.screws[b - ROOT];
        let twist = twist(simd, screw, motion, arm);
        for q in 0..6 {
            error = (twist[q] * twist[q]).mul_add(own[q], error);
        }
    } else {
        error += own[b];
        if let (Some(arm), Some(axis)) = (arm, b.checked_sub(3)) {
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            error = (arm[j] * arm[j]).mul_add(own[i], error);
            error = (arm[i] * arm[i]).mul_add(own[j], error);
        }
    }
    errors[column] = error.value;
}

/// Six numbers of one row, or of one twist.
type Column<S> = [Lane<S>; 6];

/// The angular part of a row, for turns about the neighbour's reference point.
#[inline(always)]
fn turned<S: Simd>(row: &Column<S>, arm: &Option<Vec3<S>>) -> Vec3<S> {
    let angular = [row[3], row[4], row[5]];
    match arm {
        Some(arm) => add(&angular, &cross(arm, &[row[0], row[1], row[2]])),
        None => angular,
    }
}

/// A screw of the neighbour at the component's reference point.
#[inline(always)]
fn twist<S: Simd>(
    simd: S,
    screw: usize,
    motion: &Motion<'_, S>,
    arm: &Option<Vec3<S>>,
) -> Column<S> {
    let (mut linear, angular) = pair(simd, motion.screws, screw);
    if let Some(arm) = arm {
        linear = add(&linear, &cross(&angular, arm));
    }
    six!(k => if k < 3 { linear[k] } else { angular[k - 3] })
}

#[inline(always)]
fn work_of<S: Simd>(twist: &Column<S>, row: &Column<S>) -> Lane<S> {
    let mut sum = twist[0] * row[0];
    for k in 1..6 {
        sum = twist[k].mul_add(row[k], sum);
    }
    sum
}
