//! What acts at a pose: wrenches, and the displacements that loads along beams, heat and misfits make
//! of what they act on.

use hyperstat_elements::PlaneLoadFlexibility;
use pulp::Simd;

use super::blocks::{Pair, element_axes, vector, write_pair};
use super::lane::{Lane, Vec3, add, cross, dot, scaled, sub, three};
use crate::lanes::program::acts::{Acts, Direction, FormedKind, LoadedBeam};
use crate::lanes::program::inputs::Point;

/// Forms all that acts, six numbers each, into `out`.
#[inline(always)]
pub(crate) fn form<S: Simd>(simd: S, acts: &Acts, inputs: &[S::f64s], out: &mut [S::f64s]) {
    let zero = Lane::splat(simd, 0.0);
    for formed in &acts.list {
        match &formed.kind {
            FormedKind::Constant(six) => {
                for k in 0..6 {
                    out[6 * formed.first + k] = simd.splat_f64s(six[k]);
                }
            }
            FormedKind::Turned(places) => {
                for (part, place) in places.iter().enumerate() {
                    let vector = match place {
                        Some(place) => vector(simd, inputs, *place),
                        None => [zero; 3],
                    };
                    for k in 0..3 {
                        out[6 * formed.first + 3 * part + k] = vector[k].value;
                    }
                }
            }
            FormedKind::Beam(beam) => {
                let [resultant, free_end] = loaded_beam(simd, beam, inputs);
                write_pair(out, formed.first, &resultant);
                write_pair(out, formed.first + 1, &free_end);
            }
        }
    }
}

/// The displacement of what moves as one with a point, at another point.
#[inline(always)]
pub(crate) fn carried<S: Simd>(
    simd: S,
    (linear, angular): &Pair<S>,
    from: Point,
    to: Point,
    inputs: &[S::f64s],
) -> Pair<S> {
    let arm = sub(&vector(simd, inputs, to), &vector(simd, inputs, from));
    (add(linear, &cross(angular, &arm)), *angular)
}

/// The resultant of what acts along a beam, about its first node, and the displacement of its second
/// node with the first held.
#[inline(always)]
fn loaded_beam<S: Simd>(simd: S, beam: &LoadedBeam, inputs: &[S::f64s]) -> [Pair<S>; 2] {
    let zero = Lane::splat(simd, 0.0);
    let [from, to] = [
        vector(simd, inputs, beam.ends[0]),
        vector(simd, inputs, beam.ends[1]),
    ];
    let span = sub(&to, &from);
    let square = dot(&span, &span);
    let length = square.sqrt();
    let x = scaled(&span, length.recip());
    let axes = match beam.y_axis {
        Some(place) => Some(element_axes(&x, &vector(simd, inputs, place))),
        None => None,
    };
    let cube = square * length;
    let (mut force, mut moment) = ([zero; 3], [zero; 3]);
    let mut linear = scaled(&span, Lane::splat(simd, beam.strain));
    let mut angular = [zero; 3];
    for part in &beam.parts {
        let give = &part.flexibility;
        let [in_y, in_z] = &give.planes;
        let whole = length.constant(give.total) * length;
        let f = direction(simd, &part.force, inputs);
        let turning = cross(&x, &f);
        force = add(&force, &scaled(&f, whole));
        moment = add(
            &moment,
            &scaled(&turning, square.constant(give.first_moment) * square),
        );
        let along = dot(&x, &f);
        linear = add(
            &linear,
            &scaled(&x, square.constant(give.axial) * square * along),
        );
        match &axes {
            None => {
                let across = sub(&f, &scaled(&x, along));
                linear = add(&linear, &scaled(&across, deflection(in_y, square)));
                angular = add(&angular, &scaled(&turning, cube.constant(in_y.turn) * cube));
            }
            Some([_, y, z]) => {
                let (fy, fz) = (dot(y, &f), dot(z, &f));
                linear = add(&linear, &scaled(y, deflection(in_y, square) * fy));
                linear = add(&linear, &scaled(z, deflection(in_z, square) * fz));
                angular = add(&angular, &scaled(z, cube.constant(in_y.turn) * cube * fy));
                angular = sub(&angular, &scaled(y, cube.constant(in_z.turn) * cube * fz));
            }
        }
        let Some(m) = &part.moment else { continue };
        let m = direction(simd, m, inputs);
        let about = dot(&x, &m);
        moment = add(&moment, &scaled(&m, whole));
        let twisted = square.constant(give.torsional) * square * about;
        angular = add(&angular, &scaled(&x, twisted));
        match &axes {
            None => {
                let moved = cross(&m, &x);
                let across = sub(&m, &scaled(&x, about));
                let turn = square.constant(in_y.turn_by_moment) * square;
                linear = add(
                    &linear,
                    &scaled(&moved, cube.constant(in_y.by_moment) * cube),
                );
                angular = add(&angular, &scaled(&across, turn));
            }
            Some([_, y, z]) => {
                let (my, mz) = (dot(y, &m), dot(z, &m));
                let (moved_y, moved_z) = (in_y.by_moment, in_z.by_moment);
                linear = add(&linear, &scaled(y, cube.constant(moved_y) * cube * mz));
                linear = sub(&linear, &scaled(z, cube.constant(moved_z) * cube * my));
                let turn_z = square.constant(in_y.turn_by_moment) * square * mz;
                let turn_y = square.constant(in_z.turn_by_moment) * square * my;
                angular = add(&angular, &scaled(z, turn_z));
                angular = add(&angular, &scaled(y, turn_y));
            }
        }
    }
    [(force, moment), (linear, angular)]
}

/// Deflection per force; `square` of the length.
#[inline(always)]
fn deflection<S: Simd>(plane: &PlaneLoadFlexibility, square: Lane<S>) -> Lane<S> {
    let bending = square.constant(plane.bending) * square;
    (bending + square.constant(plane.shear)) * square
}

#[inline(always)]
fn direction<S: Simd>(simd: S, direction: &Direction, inputs: &[S::f64s]) -> Vec3<S> {
    match direction {
        Direction::Constant(v) => three!(k => Lane::splat(simd, v[k])),
        Direction::Input(place) => vector(simd, inputs, *place),
    }
}
