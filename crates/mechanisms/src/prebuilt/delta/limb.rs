//! One limb at one pose: inverse kinematics in closed form, points, axes and joint frames.

use hyperstat_joints::frame_from_axis;
use nalgebra::{Point3, Rotation3, Vector3};

use super::topology::{JointRole, Part, Point};
use super::{Delta, Elbow, RodEnds};
use crate::prebuilt::PoseError;
use crate::prebuilt::error::shown;

/// How far, relative to the limb's length, a pose may miss the edge of the limb's reach and
/// still count as on it (arm and rods in one line). Loops then close to this, not to rounding.
const EDGE: f64 = 1e-12;

/// A limb in one configuration, in global axes.
#[derive(Debug, Clone)]
pub(super) struct Limb {
    points: [Point3<f64>; Point::COUNT],
    /// Along the joints A, B and C.
    axis: Vector3<f64>,
    /// Along the parallelogram's four joints.
    parallelogram_axis: Vector3<f64>,
    drive_frame: Rotation3<f64>,
    elbow_frame: Rotation3<f64>,
    rod_end_frame: Rotation3<f64>,
    wrist_frame: Rotation3<f64>,
}

impl Limb {
    /// Limb `index` (from 0) of `delta` with the platform's centre at `centre`.
    pub(super) fn new(
        delta: &Delta,
        index: usize,
        centre: &Point3<f64>,
    ) -> Result<Self, PoseError> {
        let (sin, cos) = (120.0 * index as f64).to_radians().sin_cos();
        let axis = Vector3::new(cos, sin, 0.0);
        let outward = Vector3::new(-sin, cos, 0.0);
        let a = outward * delta.base_radius;
        let c = centre.coords + outward * delta.platform_radius;

        // The wrist seen from the shoulder A: `side` along the joint axes, the rest in the
        // limb's plane (outward, up), where A, B and C make a triangle.
        let reach = c - a;
        let side = reach.dot(&axis);
        let wrist = [reach.dot(&outward), reach.z];
        let elbow = elbow(delta, index, side, wrist)?;
        let b = a + in_plane(&outward, elbow);

        // In the limb's plane the rods run along `lean`.
        let lean = [wrist[0] - elbow[0], wrist[1] - elbow[1]];
        let arm = in_plane(&outward, elbow).normalize();
        let rod = (axis * side + in_plane(&outward, lean)).normalize();
        let parallelogram_axis = in_plane(&outward, [lean[1], -lean[0]]).normalize();

        let half = axis * (0.5 * delta.rod_spacing);
        let frame = |y: &Vector3<f64>, x: &Vector3<f64>| frame_from_axis(Some(y), Some(x));
        Ok(Self {
            // In the order of `Point`.
            points: [a, b, b - half, b + half, c, c - half, c + half].map(Point3::from),
            axis,
            parallelogram_axis,
            drive_frame: frame(&axis, &outward)?,
            elbow_frame: frame(&axis, &arm)?,
            rod_end_frame: match delta.rod_ends {
                RodEnds::Revolute => frame(&parallelogram_axis, &rod)?,
                RodEnds::Spherical => Rotation3::identity(),
            },
            wrist_frame: frame(&axis, &rod)?,
        })
    }

    /// Position of a point (m).
    pub(super) fn point(&self, point: Point) -> Point3<f64> {
        self.points[point as usize]
    }

    /// Direction of a link's local y.
    pub(super) fn y_axis(&self, part: Part) -> Vector3<f64> {
        match part {
            Part::Arm => self.axis,
            Part::Bar | Part::Rod => self.parallelogram_axis,
        }
    }

    /// Frame of a joint.
    pub(super) fn frame(&self, role: JointRole) -> Rotation3<f64> {
        match role {
            JointRole::Drive => self.drive_frame,
            JointRole::Elbow => self.elbow_frame,
            JointRole::RodEnd => self.rod_end_frame,
            JointRole::Wrist => self.wrist_frame,
        }
    }
}

/// A vector of the limb's plane, given outward and up.
fn in_plane(outward: &Vector3<f64>, [out, up]: [f64; 2]) -> Vector3<f64> {
    outward * out + Vector3::z() * up
}

/// The elbow B seen from the shoulder A in the limb's plane (outward, up): where the circle of
/// the arm about A meets that of the rods about the wrist.
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
        return Err(PoseError::Unreachable {
            what: format!(
                "limb {limb}: point C{limb} lies {} m along the joint axes from A{limb}, \
                 too far for rods of {} m",
                shown(side.abs()),
                shown(rod),
            ),
        });
    }

    // The rods' length, and the wrist's distance from the shoulder, in the limb's plane.
    let flat = side.abs() >= rod - edge;
    let rod = ((rod - side) * (rod + side)).max(0.0).sqrt();
    let distance = out.hypot(up);
    let (sum, difference) = (arm + rod, arm - rod);
    if distance > sum + edge {
        return Err(PoseError::Unreachable {
            what: format!(
                "limb {limb}: point C{limb} is too far from A{limb}: {} m across the \
                 joint axes, where arm and rods reach {} m",
                shown(distance),
                shown(sum),
            ),
        });
    }
    if distance < difference.abs() - edge {
        return Err(PoseError::Unreachable {
            what: format!(
                "limb {limb}: point C{limb} is too close to A{limb}: {} m across the \
                 joint axes, where arm and rods reach no nearer than {} m",
                shown(distance),
                shown(difference.abs()),
            ),
        });
    }
    if flat {
        return Err(PoseError::Singular {
            what: format!(
                "limb {limb}: the rods lie along the joint axes, so the parallelogram has no plane"
            ),
        });
    }
    if distance <= edge {
        return Err(PoseError::Singular {
            what: format!(
                "limb {limb}: point C{limb} lies on the axis of A{limb}, so the arm may have any \
                 angle"
            ),
        });
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
    Ok([0, 1].map(|k| foot * along[k] + height * outer[k]))
}
