//! The spherical 3-RRR: parameters, model and poses.

use std::f64::consts::{PI, TAU};

use hyperstat_joints::Revolute;
use hyperstat_model::{Geometry, Model, ValuePlace};
use nalgebra::{Point3, Rotation3, Vector3};

use super::construction::{BeamPart, Configuration, JointPart, Name, NamedPoint, PLATFORM, Parts};
use super::error::shown;
use super::frames::frame;
use super::limbs::{LIMBS, outward, per_limb};
use crate::prebuilt::{
    ElbowSide, Link, ParameterError, PoseCoordinate, PoseError, Prebuilt, ROTATION, construction,
    coordinates, parameter,
};

/// How far (rad) a pose may miss the edge of a limb's reach and still count as on it.
const EDGE: f64 = 1e-12;

/// Chords that the arc of a link is divided into.
const CHORDS: usize = 4;

/// The spherical 3-RRR: a platform that turns about a fixed point O, in which the axes of all
/// joints meet.
///
/// ```text
///             z
///       axis  │   C ╲     axis of C,      All joints are revolute. A1, A2 and A3 are
///             │  ╱   ╲    platform_angle  the drives, which are locked.
///    platform │ ╱     ╲   from z at home
///             │╱       │ distal,          A, B and C are at `radius` from O, and so
///    ─────────O        B  distal_angle    are the links, arcs of great circles that
///             │╲       │                  subtend proximal_angle and distal_angle.
///             │ ╲     ╱ proximal,
///             │  ╲   ╱  proximal_angle    Limb i is limb 1 turned by 120° (i − 1)
///             │   A ╱   axis of A,        about z. At home A1 and C1 stand over +y.
///                       base_angle from −z
/// ```
///
/// A pose is the rotation vector rx, ry, rz (rad) of the platform from home. The output is O, as
/// the platform's point P; its position is zero. The agile eye has all links of 90° and base and
/// platform angles of acos(1/√3), with which the axes of A and those of C are each normal to
/// each other.
///
/// | body | runs through | local y along |
/// |---|---|---|
/// | `proximal` | A, Aa, Ab, Ac, B | the normal of its arc, A × B |
/// | `distal` | B, Ba, Bb, Bc, C | the normal of its arc, B × C |
///
/// A link is the polygon of four equal chords of its arc. The rigid `platform` holds P, C1, C2
/// and C3. Joints are named as their points: `A` between the ground and `proximal`, `B` between
/// `proximal` and `distal`, `C` between `distal` and `platform`; y of their frames points away
/// from O, x along the arc: at A towards B, at B towards C, at C towards B. Names carry the
/// limb's number.
///
/// Seven bodies and nine revolute joints give −3 by Grübler's count: every limb holds O by itself,
/// so the mobility is 3 and the degree of over-constraint 6.
///
/// C. Gosselin and J. Angeles, *The optimum kinematic design of a spherical three-degree-of-freedom
/// parallel manipulator*, Journal of Mechanisms, Transmissions, and Automation in Design 111
/// (1989) 202–207; C. M. Gosselin and J.-F. Hamel, *The agile eye: a high-performance
/// three-degree-of-freedom camera-orienting device*, IEEE International Conference on Robotics and
/// Automation (1994) 781–786.
#[derive(Debug, Clone, PartialEq)]
pub struct SphericalThreeRrr {
    /// Distance of all joints from O (m).
    pub radius: f64,
    /// Angle of the axes of A from −z (rad).
    pub base_angle: f64,
    /// Angle of the axes of C from z at home (rad).
    pub platform_angle: f64,
    /// Angle between the axes of A and B (rad).
    pub proximal_angle: f64,
    /// Angle between the axes of B and C (rad).
    pub distal_angle: f64,
    /// On which side of the arc from A to C the elbows B stand.
    pub elbow: ElbowSide,
    /// Proximal links, A to B.
    pub proximal: Link,
    /// Distal links, B to C.
    pub distal: Link,
    /// Stiffness of every joint in its directions x y z (N/m), u w (N·m/rad): `None` is rigid,
    /// zero frees a direction. v, the axis, must be `None`.
    pub joint_stiffness: [Option<f64>; 6],
    /// Stiffness of the drives about their axes (N·m/rad); `None` or zero is locked rigidly.
    pub drive_stiffness: Option<f64>,
    /// Number of beam elements a chord is divided into.
    pub elements: usize,
}

impl SphericalThreeRrr {
    /// Looks whether every parameter is in its physical range.
    ///
    /// # Errors
    /// The first that is not: a radius that is not above zero, an angle that is not between 0 and
    /// π, a negative stiffness, a number that is not finite, a stiffness about the joints' axes,
    /// no element.
    pub fn check(&self) -> Result<(), ParameterError> {
        parameter::positive_length("radius", self.radius)?;
        parameter::angle("base_angle", self.base_angle)?;
        parameter::angle("platform_angle", self.platform_angle)?;
        parameter::angle("proximal_angle", self.proximal_angle)?;
        parameter::angle("distal_angle", self.distal_angle)?;
        parameter::joint_stiffness("joint_stiffness", &self.joint_stiffness)?;
        parameter::stiffness("drive_stiffness", self.drive_stiffness)?;
        parameter::elements("elements", self.elements)
    }

    /// The limbs with the platform turned as a pose says.
    #[inline]
    fn at(&self, pose: &[f64]) -> Result<Posed<'_>, PoseError> {
        self.check()?;
        let turn = coordinates::<3>(self.kind(), pose)?;
        let rotation = Rotation3::from_scaled_axis(Vector3::from(turn));
        let cone = |index, (sin, cos): (f64, f64)| outward(index) * sin + Vector3::z() * cos;
        let (base, platform) = (self.base_angle.sin_cos(), self.platform_angle.sin_cos());
        let cosines = [self.proximal_angle.cos(), self.distal_angle.cos()];
        let limbs = per_limb(|index| {
            let mut a = cone(index, base);
            a.z = -a.z;
            let c = rotation * cone(index, platform);
            let b = self.elbow_axis(index + 1, &a, &c, cosines)?;
            Ok(Limb {
                axes: [a, b, c],
                normals: [a.cross(&b), b.cross(&c)],
            })
        })?;
        Ok(Posed {
            spherical: self,
            turn,
            limbs,
        })
    }

    /// The axis of B, at `proximal_angle` from that of A and `distal_angle` from that of C, of
    /// which the cosines are given.
    #[inline]
    fn elbow_axis(
        &self,
        limb: usize,
        a: &Vector3<f64>,
        c: &Vector3<f64>,
        [proximal_cos, distal_cos]: [f64; 2],
    ) -> Result<Vector3<f64>, PoseError> {
        let (proximal, distal) = (self.proximal_angle, self.distal_angle);
        let normal = a.cross(c);
        let (sin, cos) = (normal.norm(), a.dot(c));
        let distance = sin.atan2(cos);
        let half = 0.5 * (proximal + distal + distance);
        let unreachable = |how: &str, limit: f64| {
            PoseError::unreachable(format!(
                "limb {limb}: the axis of C{limb} is too {how} that of A{limb}: {} rad, and the \
                 two links end at {} rad",
                shown(distance),
                shown(limit),
            ))
        };
        if half - distance < -EDGE {
            return Err(unreachable("far from", proximal + distal));
        }
        if half - proximal < -EDGE || half - distal < -EDGE {
            return Err(unreachable("close to", (proximal - distal).abs()));
        }
        if half > PI + EDGE {
            return Err(unreachable("far from", TAU - proximal - distal));
        }
        if sin <= EDGE {
            return Err(PoseError::singular(format!(
                "limb {limb}: the axes of A{limb} and C{limb} are in one line, so the links may \
                 have any angle"
            )));
        }

        // In the axes along A, along the arc from A to C, and across it: the half-angle formula for the
        // height of the spherical triangle keeps its digits where the links are nearly in line.
        let along = (c - a * cos) / sin;
        let forward = (distal_cos - cos * proximal_cos) / sin;
        let square =
            half.sin() * (half - proximal).sin() * (half - distal).sin() * (half - distance).sin();
        let height = self.elbow.sign() * 2.0 * square.max(0.0).sqrt() / sin;
        let axis = a * proximal_cos + along * forward + normal * (height / sin);
        Ok(axis.normalize())
    }
}

/// A limb at a pose.
struct Limb {
    /// Of A, B and C, away from O.
    axes: [Vector3<f64>; 3],
    /// Of the arcs of the proximal and the distal link.
    normals: [Vector3<f64>; 2],
}

/// A spherical 3-RRR at a pose.
struct Posed<'a> {
    spherical: &'a SphericalThreeRrr,
    /// The platform's rotation vector (rad).
    turn: [f64; 3],
    limbs: [Limb; LIMBS],
}

impl Configuration for Posed<'_> {
    #[inline]
    fn walk(&self, parts: &mut impl Parts) {
        for (index, limb) in self.limbs.iter().enumerate() {
            self.bodies(index, limb, parts);
        }
        let wrist = |index: usize| {
            let [_, _, c] = &self.limbs[index].axes;
            (Name::limb("C", index), self.point(c))
        };
        let centre = (Name::alone("P"), Point3::origin());
        parts.rigid(PLATFORM, [centre, wrist(0), wrist(1), wrist(2)]);
        for (index, limb) in self.limbs.iter().enumerate() {
            self.joints(index, limb, parts);
        }
    }

    fn pose(&self) -> [f64; 6] {
        let [rx, ry, rz] = self.turn;
        [0.0, 0.0, 0.0, rx, ry, rz]
    }
}

impl Posed<'_> {
    /// The point of the sphere in this direction from O.
    fn point(&self, direction: &Vector3<f64>) -> Point3<f64> {
        Point3::from(direction * self.spherical.radius)
    }

    #[inline]
    fn bodies(&self, index: usize, limb: &Limb, parts: &mut impl Parts) {
        let ([a, b, c], [ab, bc], spherical) = (&limb.axes, &limb.normals, self.spherical);
        let proximal = self.arc(["A", "Aa", "Ab", "Ac", "B"], index, [a, b]);
        let distal = self.arc(["B", "Ba", "Bb", "Bc", "C"], index, [b, c]);
        let link = |word, points, y_axis, link| BeamPart {
            name: Name::limb(word, index),
            points,
            link,
            y_axis,
            elements: spherical.elements,
        };
        parts.beam(link(
            "proximal",
            proximal,
            *ab,
            ("proximal", &spherical.proximal),
        ));
        parts.beam(link("distal", distal, *bc, ("distal", &spherical.distal)));
    }

    /// Points evenly along the arc between two directions, both included.
    #[inline]
    fn arc(
        &self,
        words: [&'static str; CHORDS + 1],
        index: usize,
        [from, to]: [&Vector3<f64>; 2],
    ) -> [NamedPoint; CHORDS + 1] {
        let middle = (from + to).normalize();
        let (before, after) = ((from + middle).normalize(), (middle + to).normalize());
        let point = |k: usize, at: &Vector3<f64>| (Name::limb(words[k], index), self.point(at));
        [
            point(0, from),
            point(1, &before),
            point(2, &middle),
            point(3, &after),
            point(4, to),
        ]
    }

    #[inline]
    fn joints(&self, index: usize, limb: &Limb, parts: &mut impl Parts) {
        let name = |word| Name::limb(word, index);
        let (proximal, distal) = (Some(name("proximal")), Some(name("distal")));
        let ([a, b, c], [ab, bc]) = (&limb.axes, &limb.normals);
        // x of the frames is normal to the joint's axis, in the plane of an arc.
        let joint = |word, between, axis: &Vector3<f64>, x_axis: Vector3<f64>| {
            let frame = frame(&x_axis.normalize(), axis);
            let stiffness = &self.spherical.joint_stiffness;
            JointPart::passive(&Revolute, name(word), between, frame, stiffness)
        };
        let drive = joint("A", [None, proximal], a, ab.cross(a));
        parts.joint(drive.driven(self.spherical.drive_stiffness));
        parts.joint(joint("B", [proximal, distal], b, bc.cross(b)));
        parts.joint(joint("C", [distal, Some(PLATFORM)], c, c.cross(bc)));
    }
}

impl Prebuilt for SphericalThreeRrr {
    fn kind(&self) -> &str {
        "SphericalThreeRrr"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        ROTATION
    }

    fn zero_coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::X, PoseCoordinate::Y, PoseCoordinate::Z]
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        construction::model("spherical 3-RRR", &self.at(pose)?)
    }

    fn origins(&self, pose: &[f64]) -> Result<Vec<(ValuePlace, String)>, PoseError> {
        Ok(construction::origins(&self.at(pose)?))
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        construction::place(geometry, &self.at(pose)?)
    }
}
