//! One limb at several poses: inverse kinematics in closed form, points, axes and joint frames.

use nalgebra::{Point3, Rotation3, Vector3};

use super::topology::{JointRole, Link, Point};
use crate::prebuilt::PoseError;
use crate::prebuilt::delta::{Delta, Elbow, RodEnds};
use crate::prebuilt::error::shown;
use crate::prebuilt::frames as alone;
use crate::prebuilt::limbs::{outward, tangent};
use crate::prebuilt::wide::{
    Wide, WideFrame, WideVector, dot, frame, frame_at, minus, plus, point_at, same, scaled, unit,
    vector_at,
};

/// How far, relative to the limb's length, a pose may miss the edge of the limb's reach and
/// still count as on it (arm and rods in one line). Loops then close to this, not to rounding.
const EDGE: f64 = 1e-12;

/// A limb in `N` configurations, in global axes.
#[derive(Debug, Clone)]
pub(super) struct Limb<const N: usize> {
    index: usize,
    rod_ends: RodEnds,
    /// Along the joints A, B and C.
    axis: Vector3<f64>,
    a: Point3<f64>,
    b: WideVector<N>,
    c: WideVector<N>,
    /// From the a side to the middle.
    half_spacing: Vector3<f64>,
    /// Along the parallelogram's four joints.
    parallelogram: WideVector<N>,
    drive: Rotation3<f64>,
    elbow: WideFrame<N>,
    rod_end: WideFrame<N>,
    wrist: WideFrame<N>,
    reach: Reach<N>,
}

/// What the limb's reach is judged by.
#[derive(Debug, Clone)]
struct Reach<const N: usize> {
    /// Of the wrist from the shoulder, along the joint axes and across them.
    side: Wide<N>,
    distance: Wide<N>,
    /// The rods' length across the joint axes.
    rod: Wide<N>,
}

impl<const N: usize> Limb<N> {
    /// Limb `index` (from 0) of `delta` with the platform's centre at each of these points; where
    /// [`Limb::fault`] finds one, its numbers mean nothing.
    #[inline(always)]
    pub(super) fn new(delta: &Delta, index: usize, centre: &WideVector<N>) -> Self {
        let (out, axis) = (outward(index), -tangent(index));
        let a = out * delta.base_radius;
        let wide_a = same(&a);
        let c = plus(centre, &same(&(out * delta.platform_radius)));
        let (outward, wide_axis) = (same(&out), same(&axis));

        // The wrist seen from the shoulder A: `side` along the joint axes, the rest in the
        // limb's plane (outward, up), where A, B and C make a triangle.
        let from_a = minus(&c, &wide_a);
        let side = dot(&from_a, &wide_axis);
        let wrist = [dot(&from_a, &outward), from_a[2]];
        let (elbow, reach) = elbow(delta, side, wrist);

        // In the limb's plane the rods run along `lean`.
        let lean = [wrist[0] - elbow[0], wrist[1] - elbow[1]];
        let rod = plus(&scaled(&wide_axis, side), &in_plane(&outward, lean));
        let b = plus(&wide_a, &in_plane(&outward, elbow));
        let arm = unit_in_plane(elbow);
        let lean = unit_in_plane(lean);
        let parallelogram = in_plane(&outward, [lean[1], -lean[0]]);
        Self {
            index,
            rod_ends: delta.rod_ends,
            axis,
            a: Point3::from(a),
            b,
            c,
            half_spacing: axis * (0.5 * delta.rod_spacing),
            parallelogram,
            drive: alone::frame(&out, &axis),
            elbow: frame(&in_plane(&outward, arm), &wide_axis),
            rod_end: frame(&unit(&rod), &parallelogram),
            wrist: frame(&in_plane(&outward, lean), &wide_axis),
            reach,
        }
    }

    /// One of its configurations.
    #[inline(always)]
    pub(super) fn at(&self, pose: usize) -> LimbAt<'_, N> {
        LimbAt { limb: self, pose }
    }

    /// Why it cannot take one of its configurations.
    #[inline(always)]
    pub(super) fn fault(&self, delta: &Delta, pose: usize) -> Option<PoseError> {
        let Reach {
            side,
            distance,
            rod,
        } = &self.reach;
        fault(
            delta,
            self.index,
            [side.0[pose], distance.0[pose], rod.0[pose]],
        )
    }
}

/// A limb in one configuration.
#[derive(Debug, Clone, Copy)]
pub(super) struct LimbAt<'a, const N: usize> {
    limb: &'a Limb<N>,
    pose: usize,
}

impl<const N: usize> LimbAt<'_, N> {
    /// Position of a point (m).
    #[inline(always)]
    pub(super) fn point(&self, point: Point) -> Point3<f64> {
        let limb = self.limb;
        let (b, c) = (point_at(&limb.b, self.pose), point_at(&limb.c, self.pose));
        let half = limb.half_spacing;
        match point {
            Point::A => limb.a,
            Point::B => b,
            Point::Ba => b - half,
            Point::Bb => b + half,
            Point::C => c,
            Point::Ca => c - half,
            Point::Cb => c + half,
        }
    }

    /// Direction of a link's local y.
    #[inline(always)]
    pub(super) fn y_axis(&self, part: Link) -> Vector3<f64> {
        match part {
            Link::Arm => self.limb.axis,
            Link::Bar | Link::Rod => vector_at(&self.limb.parallelogram, self.pose),
        }
    }

    /// Frame of a joint.
    #[inline(always)]
    pub(super) fn frame(&self, role: JointRole) -> Rotation3<f64> {
        let limb = self.limb;
        let axis = &limb.axis;
        match (role, limb.rod_ends) {
            (JointRole::Drive, _) => limb.drive,
            (JointRole::Elbow, _) => frame_at(&limb.elbow, axis, self.pose),
            (JointRole::RodEnd, RodEnds::Revolute) => {
                frame_at(&limb.rod_end, &self.y_axis(Link::Rod), self.pose)
            }
            (JointRole::RodEnd, RodEnds::Spherical) => Rotation3::identity(),
            (JointRole::Wrist, _) => frame_at(&limb.wrist, axis, self.pose),
        }
    }
}

/// Length of a vector of the limb's plane.
#[inline(always)]
fn norm<const N: usize>([out, up]: [Wide<N>; 2]) -> Wide<N> {
    (out * out + up * up).sqrt()
}

/// The unit vector along a vector of the limb's plane.
#[inline(always)]
fn unit_in_plane<const N: usize>(vector: [Wide<N>; 2]) -> [Wide<N>; 2] {
    let norm = norm(vector);
    [vector[0] / norm, vector[1] / norm]
}

/// A vector of the limb's plane, given outward and up.
#[inline(always)]
fn in_plane<const N: usize>(outward: &WideVector<N>, [out, up]: [Wide<N>; 2]) -> WideVector<N> {
    plus(&scaled(outward, out), &scaled(&same(&Vector3::z()), up))
}

/// How far a limb may miss its edge (m).
#[inline(always)]
fn edge(delta: &Delta) -> f64 {
    EDGE * (delta.arm_length + delta.rod_length)
}

/// Why a limb does not reach, by the `side` and `distance` of its wrist from the shoulder along and across
/// the joint axes, and the length of its rods across them.
#[inline(always)]
fn fault(delta: &Delta, index: usize, [side, distance, across]: [f64; 3]) -> Option<PoseError> {
    let (arm, rod, edge) = (delta.arm_length, delta.rod_length, edge(delta));
    let (sum, difference) = (arm + across, arm - across);
    let fits = side.abs() < rod - edge
        && distance <= sum + edge
        && distance >= difference.abs() - edge
        && distance > edge;
    if fits {
        return None;
    }
    let limb = index + 1;
    if side.abs() > rod + edge {
        return Some(PoseError::unreachable(format!(
            "limb {limb}: point C{limb} lies {} m along the joint axes from A{limb}, \
                 too far for rods of {} m",
            shown(side.abs()),
            shown(rod),
        )));
    }
    if distance > sum + edge {
        return Some(PoseError::unreachable(format!(
            "limb {limb}: point C{limb} is too far from A{limb}: {} m across the \
                 joint axes, where arm and rods reach {} m",
            shown(distance),
            shown(sum),
        )));
    }
    if distance < difference.abs() - edge {
        return Some(PoseError::unreachable(format!(
            "limb {limb}: point C{limb} is too close to A{limb}: {} m across the \
                 joint axes, where arm and rods reach no nearer than {} m",
            shown(distance),
            shown(difference.abs()),
        )));
    }
    if side.abs() >= rod - edge {
        return Some(PoseError::singular(format!(
            "limb {limb}: the rods lie along the joint axes, so the parallelogram has no plane"
        )));
    }
    (distance <= edge).then(|| {
        PoseError::singular(format!(
            "limb {limb}: point C{limb} lies on the axis of A{limb}, so the arm may have any \
                 angle"
        ))
    })
}

/// The elbow B seen from the shoulder A in the limb's plane (outward, up): where the circle of
/// the arm about A meets that of the rods about the wrist.
#[inline(always)]
fn elbow<const N: usize>(
    delta: &Delta,
    side: Wide<N>,
    [out, up]: [Wide<N>; 2],
) -> ([Wide<N>; 2], Reach<N>) {
    let arm = Wide::of(delta.arm_length);
    let rod = Wide::of(delta.rod_length);
    // The rods' length, and the wrist's distance from the shoulder, in the limb's plane.
    let rod = ((rod - side) * (rod + side)).not_negative().sqrt();
    let distance = norm([out, up]);
    let (sum, difference) = (arm + rod, arm - rod);

    // Foot of the elbow's height over the line from shoulder to wrist, and that height by
    // Heron's formula, which keeps its digits where arm and rods are nearly in line.
    let double = distance * 2.0;
    let foot = (distance * distance + sum * difference) / double;
    let square =
        (sum - distance) * (sum + distance) * (distance - difference) * (distance + difference);
    let height = square.not_negative().sqrt() / double;
    let along = [out / distance, up / distance];

    // The normal of that line that points outward; for a wrist at the base's height, the one
    // that a wrist just above it has.
    let outer = [along[1].signed_as(up), (-along[0]).signed_as(up)];
    let height = match delta.elbow {
        Elbow::Out => height,
        Elbow::In => -height,
    };
    let elbow = [
        foot * along[0] + height * outer[0],
        foot * along[1] + height * outer[1],
    ];
    let reach = Reach {
        side,
        distance,
        rod,
    };
    (elbow, reach)
}
