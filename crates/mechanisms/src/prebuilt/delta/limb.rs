//! One limb at one pose: inverse kinematics in closed form, points, axes and joint frames.

use nalgebra::{Point3, Rotation3, Vector3};

use super::topology::{JointRole, Link, Point};
use crate::prebuilt::PoseError;
use crate::prebuilt::delta::{Delta, Elbow, RodEnds};
use crate::prebuilt::error::shown;
use crate::prebuilt::frames::frame;
use crate::prebuilt::limbs::{outward, tangent};

/// How far, relative to the limb's length, a pose may miss the edge of the limb's reach and
/// still count as on it (arm and rods in one line). Loops then close to this, not to rounding.
const EDGE: f64 = 1e-12;

/// A limb in one configuration, in global axes.
#[derive(Debug, Clone)]
pub(super) struct Limb {
    rod_ends: RodEnds,
    outward: Vector3<f64>,
    /// Along the joints A, B and C.
    axis: Vector3<f64>,
    a: Point3<f64>,
    b: Point3<f64>,
    c: Point3<f64>,
    /// From the a side to the middle.
    half_spacing: Vector3<f64>,
    /// Directions in the limb's plane (outward, up): of the arm, and of the rods as seen there.
    arm: [f64; 2],
    lean: [f64; 2],
    /// Direction of the rods.
    rod: Vector3<f64>,
}

impl Limb {
    /// Limb `index` (from 0) of `delta` with the platform's centre at `centre`.
    #[inline(always)]
    pub(super) fn new(
        delta: &Delta,
        index: usize,
        centre: &Point3<f64>,
    ) -> Result<Self, PoseError> {
        let outward = outward(index);
        let axis = -tangent(index);
        let a = Point3::from(outward * delta.base_radius);
        let c = centre + outward * delta.platform_radius;

        // The wrist seen from the shoulder A: `side` along the joint axes, the rest in the
        // limb's plane (outward, up), where A, B and C make a triangle.
        let reach = c - a;
        let side = reach.dot(&axis);
        let wrist = [reach.dot(&outward), reach.z];
        let elbow = elbow(delta, index, side, wrist)?;

        // In the limb's plane the rods run along `lean`.
        let lean = [wrist[0] - elbow[0], wrist[1] - elbow[1]];
        Ok(Self {
            rod_ends: delta.rod_ends,
            outward,
            axis,
            a,
            b: a + in_plane(&outward, elbow),
            c,
            half_spacing: axis * (0.5 * delta.rod_spacing),
            arm: unit(elbow),
            lean: unit(lean),
            rod: (axis * side + in_plane(&outward, lean)).normalize(),
        })
    }

    /// Position of a point (m).
    #[inline]
    pub(super) fn point(&self, point: Point) -> Point3<f64> {
        let half = self.half_spacing;
        match point {
            Point::A => self.a,
            Point::B => self.b,
            Point::Ba => self.b - half,
            Point::Bb => self.b + half,
            Point::C => self.c,
            Point::Ca => self.c - half,
            Point::Cb => self.c + half,
        }
    }

    /// Along the parallelogram's four joints.
    #[inline]
    fn parallelogram_axis(&self) -> Vector3<f64> {
        let [out, up] = self.lean;
        in_plane(&self.outward, [up, -out])
    }

    /// Direction of a link's local y.
    #[inline]
    pub(super) fn y_axis(&self, part: Link) -> Vector3<f64> {
        match part {
            Link::Arm => self.axis,
            Link::Bar | Link::Rod => self.parallelogram_axis(),
        }
    }

    /// Frame of a joint.
    #[inline]
    pub(super) fn frame(&self, role: JointRole) -> Rotation3<f64> {
        match (role, self.rod_ends) {
            (JointRole::Drive, _) => frame(&self.outward, &self.axis),
            (JointRole::Elbow, _) => frame(&in_plane(&self.outward, self.arm), &self.axis),
            (JointRole::RodEnd, RodEnds::Revolute) => frame(&self.rod, &self.parallelogram_axis()),
            (JointRole::RodEnd, RodEnds::Spherical) => Rotation3::identity(),
            (JointRole::Wrist, _) => frame(&in_plane(&self.outward, self.lean), &self.axis),
        }
    }
}

/// Length of a vector of the limb's plane.
fn norm([out, up]: [f64; 2]) -> f64 {
    (out * out + up * up).sqrt()
}

/// The unit vector along a vector of the limb's plane.
fn unit(vector: [f64; 2]) -> [f64; 2] {
    let norm = norm(vector);
    [vector[0] / norm, vector[1] / norm]
}

/// A vector of the limb's plane, given outward and up.
fn in_plane(outward: &Vector3<f64>, [out, up]: [f64; 2]) -> Vector3<f64> {
    outward * out + Vector3::z() * up
}

/// The elbow B seen from the shoulder A in the limb's plane (outward, up): where the circle of
/// the arm about A meets that of the rods about the wrist.
#[inline(always)]
fn elbow(
    delta: &Delta,
    index: usize,
    side: f64,
    [out, up]: [f64; 2],
) -> Result<[f64; 2], PoseError> {
    let (arm, rod) = (delta.arm_length, delta.rod_length);
    let edge = EDGE * (arm + rod);
    let limb = index + 1;

    if side.abs() > rod + edge {
        return Err(PoseError::unreachable(format!(
            "limb {limb}: point C{limb} lies {} m along the joint axes from A{limb}, \
                 too far for rods of {} m",
            shown(side.abs()),
            shown(rod),
        )));
    }

    // The rods' length, and the wrist's distance from the shoulder, in the limb's plane.
    let flat = side.abs() >= rod - edge;
    let rod = ((rod - side) * (rod + side)).max(0.0).sqrt();
    let distance = norm([out, up]);
    let (sum, difference) = (arm + rod, arm - rod);
    if distance > sum + edge {
        return Err(PoseError::unreachable(format!(
            "limb {limb}: point C{limb} is too far from A{limb}: {} m across the \
                 joint axes, where arm and rods reach {} m",
            shown(distance),
            shown(sum),
        )));
    }
    if distance < difference.abs() - edge {
        return Err(PoseError::unreachable(format!(
            "limb {limb}: point C{limb} is too close to A{limb}: {} m across the \
                 joint axes, where arm and rods reach no nearer than {} m",
            shown(distance),
            shown(difference.abs()),
        )));
    }
    if flat {
        return Err(PoseError::singular(format!(
            "limb {limb}: the rods lie along the joint axes, so the parallelogram has no plane"
        )));
    }
    if distance <= edge {
        return Err(PoseError::singular(format!(
            "limb {limb}: point C{limb} lies on the axis of A{limb}, so the arm may have any \
                 angle"
        )));
    }

    // Foot of the elbow's height over the line from shoulder to wrist, and that height by
    // Heron's formula, which keeps its digits where arm and rods are nearly in line.
    let foot = (distance * distance + sum * difference) / (2.0 * distance);
    let square =
        (sum - distance) * (sum + distance) * (distance - difference) * (distance + difference);
    let height = square.max(0.0).sqrt() / (2.0 * distance);
    let along = [out / distance, up / distance];

    // The normal of that line that points outward; for a wrist at the base's height, the one
    // that a wrist just above it has.
    let outer = if up >= 0.0 {
        [along[1], -along[0]]
    } else {
        [-along[1], along[0]]
    };
    let height = match delta.elbow {
        Elbow::Out => height,
        Elbow::In => -height,
    };
    Ok([
        foot * along[0] + height * outer[0],
        foot * along[1] + height * outer[1],
    ])
}
