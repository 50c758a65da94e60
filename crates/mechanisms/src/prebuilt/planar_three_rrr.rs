//! The planar 3-RRR: parameters, model and poses.

use hyperstat_joints::Revolute;
use hyperstat_model::{Geometry, Model, ValuePlace};
use nalgebra::{Point3, Vector3};

use super::construction::{BeamPart, Configuration, JointPart, Name, PLATFORM, Parts};
use super::frames::frame;
use super::limbs::{LIMBS, outward, per_limb, turned_outward};
use super::two_links::{TwoLinks, joints_of};
use crate::prebuilt::{
    ElbowSide, Link, ParameterError, PoseCoordinate, PoseError, Prebuilt, construction,
    coordinates, parameter,
};

/// The planar 3-RRR: a platform that moves in the plane z = 0 on three limbs of two links each.
///
/// ```text
///   y        A1 ▒              All joints are revolute, their axes along z. A1, A2 and A3
///   │       ╱                  are the drives, which are locked.
///   │   B1 ●  proximal
///   │       ╲  distal          O–A is base_radius, P–C platform_radius, A–B
///   │        ● C1              proximal_length, B–C distal_length.
///   │       ╱ ╲
///   │      ╱ P ╲               Limb i is limb 1 turned by 120° (i − 1) about z; A1 stands
///   │  C2 ●─────● C3           over +y. At home (rz = 0) so does C1, seen from P.
///   │
///   O ───────── x
/// ```
///
/// A pose is x, y (m) and rz (rad): the platform's centre P, which is the output, and its turn
/// about z. The other coordinates are zero.
///
/// | body | runs through | local y along |
/// |---|---|---|
/// | `proximal` | A, B | z |
/// | `distal` | B, C | z |
///
/// The rigid `platform` holds P, C1, C2 and C3. Joints are named as their points: `A` between the
/// ground and `proximal`, `B` between `proximal` and `distal`, `C` between `distal` and
/// `platform`; y of their frames is z, x along the link that ends there (at A, that begins).
/// Names carry the limb's number.
///
/// Seven bodies and nine revolute joints give −3 by Grübler's count in space: every limb keeps
/// the platform in the plane by itself, so the mobility is 3 and the degree of over-constraint 6.
///
/// C. Gosselin and J. Angeles, *The optimum kinematic design of a planar three-degree-of-freedom
/// parallel manipulator*, Journal of Mechanisms, Transmissions, and Automation in Design 110
/// (1988) 35–41.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanarThreeRrr {
    /// Distance of the drives A from z (m).
    pub base_radius: f64,
    /// Distance of the joints C from the platform's centre P (m).
    pub platform_radius: f64,
    /// Length of the proximal links, A to B (m).
    pub proximal_length: f64,
    /// Length of the distal links, B to C (m).
    pub distal_length: f64,
    /// On which side of the line from A to C the elbows B stand.
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
    /// Number of beam elements a link is divided into.
    pub elements: usize,
}

impl PlanarThreeRrr {
    /// Looks whether every parameter is in its physical range.
    ///
    /// # Errors
    /// The first that is not: a length that is not above zero, a negative radius or stiffness,
    /// a number that is not finite, a stiffness about the joints' axes, no element.
    pub fn check(&self) -> Result<(), ParameterError> {
        parameter::radius("base_radius", self.base_radius)?;
        parameter::radius("platform_radius", self.platform_radius)?;
        parameter::positive_length("proximal_length", self.proximal_length)?;
        parameter::positive_length("distal_length", self.distal_length)?;
        parameter::joint_stiffness("joint_stiffness", &self.joint_stiffness)?;
        parameter::stiffness("drive_stiffness", self.drive_stiffness)?;
        parameter::elements("elements", self.elements)
    }

    /// The limbs with the platform at a pose.
    #[inline]
    fn at(&self, pose: &[f64]) -> Result<Posed<'_>, PoseError> {
        self.check()?;
        let [x, y, turn] = coordinates::<3>(self.kind(), pose)?;
        let centre = Point3::new(x, y, 0.0);
        let (sin, cos) = turn.sin_cos();
        let limbs = per_limb(|index| {
            let a = Point3::from(outward(index) * self.base_radius);
            let c = centre + turned_outward(index, (sin, cos)) * self.platform_radius;
            let links = TwoLinks {
                limb: index + 1,
                proximal: self.proximal_length,
                distal: self.distal_length,
                side: self.elbow,
            };
            let [x, y] = links.elbow([c.x - a.x, c.y - a.y])?;
            let b = a + Vector3::new(x, y, 0.0);
            Ok(Limb {
                points: [a, b, c],
                proximal: (b - a).normalize(),
                distal: (c - b).normalize(),
            })
        })?;
        Ok(Posed {
            planar: self,
            pose: [x, y, 0.0, 0.0, 0.0, turn],
            limbs,
        })
    }
}

/// A limb at a pose.
struct Limb {
    /// A, B and C.
    points: [Point3<f64>; 3],
    /// Along the links.
    proximal: Vector3<f64>,
    distal: Vector3<f64>,
}

/// A planar 3-RRR at a pose.
struct Posed<'a> {
    planar: &'a PlanarThreeRrr,
    pose: [f64; 6],
    limbs: [Limb; LIMBS],
}

impl Configuration for Posed<'_> {
    #[inline]
    fn walk(&self, parts: &mut impl Parts) {
        let planar = self.planar;
        for (index, limb) in self.limbs.iter().enumerate() {
            let [a, b, c] = joints_of(limb.points, index);
            let link = |word, points, link| BeamPart {
                name: Name::limb(word, index),
                points,
                link,
                y_axis: Vector3::z(),
                elements: planar.elements,
            };
            parts.beam(link("proximal", [a, b], ("proximal", &planar.proximal)));
            parts.beam(link("distal", [b, c], ("distal", &planar.distal)));
        }
        let [x, y, ..] = self.pose;
        let centre = (Name::alone("P"), Point3::new(x, y, 0.0));
        let c = |index: usize| joints_of(self.limbs[index].points, index)[2];
        parts.rigid(PLATFORM, [centre, c(0), c(1), c(2)]);
        for (index, limb) in self.limbs.iter().enumerate() {
            let name = |word| Name::limb(word, index);
            let (proximal, distal) = (Some(name("proximal")), Some(name("distal")));
            let joint = |word, between, frame| {
                JointPart::passive(
                    &Revolute,
                    name(word),
                    between,
                    frame,
                    &planar.joint_stiffness,
                )
            };
            let along = frame(&limb.proximal, &Vector3::z());
            let beyond = frame(&limb.distal, &Vector3::z());
            let drive = joint("A", [None, proximal], along);
            parts.joint(drive.driven(planar.drive_stiffness));
            parts.joint(joint("B", [proximal, distal], along));
            parts.joint(joint("C", [distal, Some(PLATFORM)], beyond));
        }
    }

    fn pose(&self) -> [f64; 6] {
        self.pose
    }
}

impl Prebuilt for PlanarThreeRrr {
    fn kind(&self) -> &str {
        "PlanarThreeRrr"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::X, PoseCoordinate::Y, PoseCoordinate::Rz]
    }

    fn zero_coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::Z, PoseCoordinate::Rx, PoseCoordinate::Ry]
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        construction::model("planar 3-RRR", &self.at(pose)?)
    }

    fn origins(&self, pose: &[f64]) -> Result<Vec<(ValuePlace, String)>, PoseError> {
        Ok(construction::origins(&self.at(pose)?))
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        construction::place(geometry, &self.at(pose)?)
    }
}
