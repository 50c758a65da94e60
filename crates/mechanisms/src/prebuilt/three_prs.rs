//! The 3-PRS: parameters, model and poses.

use hyperstat_joints::{Joint, Prismatic, Revolute, Spherical};
use hyperstat_model::{Geometry, Model, ValuePlace};
use nalgebra::{Point3, Rotation3, Vector3};

use super::construction::{
    BeamPart, Configuration, JointPart, Name, NamedPoint, PLATFORM, Parts, RIGID,
};
use super::frames::frame;
use super::limbs::{LIMBS, per_limb, tangent};
use super::rail::Rails;
use super::zero_torsion::Platform;
use crate::prebuilt::{
    Link, ParameterError, PoseCoordinate, PoseError, Prebuilt, construction, coordinates, parameter,
};

/// The 3-PRS: a platform on three rods of fixed length that swing about hinges on driven
/// carriages.
///
/// ```text
///   z        S ── P ── S     platform
///   │       ╱           ╲          Rod i swings in its own plane, which holds z and the
///   │ ║   ╱   rods        ╲   ║    rail; the axis of its hinge is normal to that plane.
///   │ ╠═ A                 A ═╣    carriage, drive ◄─► along the rail
///   │ ║                       ║    O–rail is rails.radius, P–S platform_radius,
///   └─║───────── O ───────────║    A–S rod_length.
/// ```
///
/// Limb i is limb 1 turned by 120° (i − 1) about z, limb 1 over +y.
///
/// A pose is the height z (m) of P, which is the output, and the components rx, ry (rad) of its
/// rotation vector. The rods' planes fix the others: rz is zero at every pose, and x and y, zero
/// for a level platform, follow in closed form (a sideways motion that the drives cannot
/// prevent); all six are returned in the full pose.
///
/// | body | runs through | local y along |
/// |---|---|---|
/// | `carriage` (rigid) | A | |
/// | `rod` | A, S | the axis of A |
///
/// | joint | between | kind |
/// |---|---|---|
/// | `D` at A | ground, `carriage` | prismatic along the rail, the locked drive; x of its frame along the axis of A |
/// | `A` | `carriage`, `rod` | revolute, its axis z × outward; x of its frame along the rod |
/// | `S` | `rod`, `platform` | spherical |
///
/// Every name carries the limb's number. The rigid `platform` holds P, S1, S2 and S3. The
/// mobility is 3, the degree of over-constraint 0.
///
/// J. A. Carretero, R. P. Podhorodeski, M. A. Nahon and C. M. Gosselin, *Kinematic analysis and
/// optimization of a new three degree-of-freedom spatial parallel manipulator*, J. Mechanical
/// Design 122 (2000) 17–24.
#[derive(Debug, Clone, PartialEq)]
pub struct ThreePrs {
    /// The rails of the carriages.
    pub rails: Rails,
    /// Distance of the platform joints S from P (m).
    pub platform_radius: f64,
    /// Length of the rods, A to S (m).
    pub rod_length: f64,
    /// Rods, A to S.
    pub rod: Link,
    /// Stiffness of every joint A and S in its directions x y z (N/m), u w (N·m/rad), as far as
    /// the joint constrains them: `None` is rigid, zero frees a direction. v must be `None`.
    pub joint_stiffness: [Option<f64>; 6],
    /// Stiffness of the drives along their rails (N/m); `None` or zero is locked rigidly. The
    /// rails are rigid in all other directions.
    pub drive_stiffness: Option<f64>,
    /// Number of beam elements a rod is divided into.
    pub elements: usize,
}

impl ThreePrs {
    /// Looks whether every parameter is in its physical range.
    ///
    /// # Errors
    /// The first that is not: a length that is not above zero, a negative stiffness, a number
    /// that is not finite, a stiffness of v, no element, and those of [`Rails::check`].
    pub fn check(&self) -> Result<(), ParameterError> {
        self.rails.check()?;
        parameter::positive_length("platform_radius", self.platform_radius)?;
        parameter::positive_length("rod_length", self.rod_length)?;
        parameter::passive_stiffness("joint_stiffness", &self.joint_stiffness)?;
        parameter::stiffness("drive_stiffness", self.drive_stiffness)?;
        parameter::elements("elements", self.elements)
    }

    /// The carriages and the platform at a pose.
    #[inline]
    fn at(&self, pose: &[f64]) -> Result<Posed<'_>, PoseError> {
        self.check()?;
        let given = coordinates::<3>(self.kind(), pose)?;
        let platform = Platform::new(self.platform_radius, given);
        let rails = self.rails.directions();
        let carriages = per_limb(|index| {
            let (rail, corner) = (&rails[index], &platform.corners[index]);
            self.rails
                .carriage(index, rail, self.rod_length, corner, "S")
        })?;
        Ok(Posed {
            three_prs: self,
            rails,
            carriages,
            platform,
        })
    }
}

/// A 3-PRS at a pose.
struct Posed<'a> {
    three_prs: &'a ThreePrs,
    /// Directions of the rails.
    rails: [Vector3<f64>; LIMBS],
    /// The carriages' points A.
    carriages: [Point3<f64>; LIMBS],
    platform: Platform,
}

impl Configuration for Posed<'_> {
    #[inline]
    fn walk(&self, parts: &mut impl Parts) {
        for index in 0..LIMBS {
            parts.rigid(Name::limb("carriage", index), [self.carriage(index)]);
            parts.beam(BeamPart {
                name: Name::limb("rod", index),
                points: [self.carriage(index), self.corner(index)],
                link: ("rod", &self.three_prs.rod),
                // The axis of the hinge.
                y_axis: tangent(index),
                elements: self.three_prs.elements,
            });
        }
        let centre = (Name::alone("P"), self.platform.centre);
        let s = |index| self.corner(index);
        parts.rigid(PLATFORM, [centre, s(0), s(1), s(2)]);
        for index in 0..LIMBS {
            self.joints(index, parts);
        }
    }

    fn pose(&self) -> [f64; 6] {
        self.platform.pose
    }
}

impl Posed<'_> {
    #[inline]
    fn carriage(&self, index: usize) -> NamedPoint {
        (Name::limb("A", index), self.carriages[index])
    }

    #[inline]
    fn corner(&self, index: usize) -> NamedPoint {
        (Name::limb("S", index), self.platform.corners[index])
    }

    #[inline]
    fn joints(&self, index: usize, parts: &mut impl Parts) {
        let name = |word| Name::limb(word, index);
        let (carriage, rod) = (Some(name("carriage")), Some(name("rod")));
        let axis = tangent(index);
        let along = (self.platform.corners[index] - self.carriages[index]).normalize();
        let given = &self.three_prs.joint_stiffness;
        let joint = |joint: &'static dyn Joint, word, between, frame, stiffness| {
            JointPart::passive(joint, name(word), between, frame, stiffness)
        };
        let slide = frame(&axis, &self.rails[index]);
        let slide = joint(&Prismatic, "D", [None, carriage], slide, &RIGID).at(name("A"));
        parts.joint(slide.driven(self.three_prs.drive_stiffness));
        let hinge = frame(&along, &axis);
        parts.joint(joint(&Revolute, "A", [carriage, rod], hinge, given));
        let ball = Rotation3::identity();
        parts.joint(joint(&Spherical, "S", [rod, Some(PLATFORM)], ball, given));
    }
}

impl Prebuilt for ThreePrs {
    fn kind(&self) -> &str {
        "ThreePrs"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::Z, PoseCoordinate::Rx, PoseCoordinate::Ry]
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        construction::model("3-PRS", &self.at(pose)?)
    }

    fn origins(&self, pose: &[f64]) -> Result<Vec<(ValuePlace, String)>, PoseError> {
        Ok(construction::origins(&self.at(pose)?))
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        construction::place(geometry, &self.at(pose)?)
    }
}
