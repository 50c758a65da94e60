//! The 3-RPS: parameters, model and poses.

use hyperstat_model::{Geometry, Model, ValuePlace};
use nalgebra::Point3;

use super::construction::{Configuration, Name, PLATFORM, Parts};
use super::limbs::{LIMBS, outward, per_limb, tangent};
use super::telescope::{Foot, Leg, TelescopicLeg};
use super::zero_torsion::Platform;
use crate::prebuilt::{
    ParameterError, PoseCoordinate, PoseError, Prebuilt, construction, coordinates, parameter,
};

/// The 3-RPS: a platform on three telescopic legs that swing about hinges on the base.
///
/// ```text
///   z    S ───── P ───── S   platform
///   │     ╲             ╱          Leg i swings in its own plane, which holds z; the
///   │      ║ piston    ║           axis of its hinge is normal to that plane.
///   │      M   drive   M
///   │      ║ cylinder  ║           O–B is base_radius, P–S platform_radius.
///   └─ ▒▒▒ B ▒▒▒ O ▒▒▒ B ▒▒▒
/// ```
///
/// Leg i is leg 1 turned by 120° (i − 1) about z, leg 1 over +y.
///
/// A pose is the height z (m) of P, which is the output, and the components rx, ry (rad) of its
/// rotation vector. The legs' planes fix the others: rz is zero at every pose, and x and y, zero
/// for a level platform, follow in closed form (a sideways motion that the drives cannot
/// prevent); all six are returned in the full pose.
///
/// | body | runs through | local y along |
/// |---|---|---|
/// | `cylinder` | B, M | the axis of B |
/// | `piston` | M, S | the axis of B |
///
/// | joint | between | kind |
/// |---|---|---|
/// | `B` | ground, `cylinder` | revolute, its axis z × outward; x of its frame along the leg |
/// | `M` | `cylinder`, `piston` | prismatic along the leg, the locked drive; x of its frame along the axis of B |
/// | `S` | `piston`, `platform` | spherical |
///
/// Every name carries the leg's number. The rigid `platform` holds P, S1, S2 and S3. The
/// mobility is 3, the degree of over-constraint 0.
///
/// K. H. Hunt, *Structural kinematics of in-parallel-actuated robot-arms*, J. Mechanisms,
/// Transmissions and Automation in Design 105 (1983) 705–712. K.-M. Lee and D. K. Shah,
/// *Kinematic analysis of a three-degrees-of-freedom in-parallel actuated manipulator*, IEEE J.
/// Robotics and Automation 4 (1988) 354–360. That it never twists: I. A. Bonev, *Direct
/// kinematics of zero-torsion parallel mechanisms*, IEEE Int. Conf. Robotics and Automation
/// (2008) 3851–3856.
#[derive(Debug, Clone, PartialEq)]
pub struct ThreeRps {
    /// Distance of the hinges B from z (m).
    pub base_radius: f64,
    /// Distance of the platform joints S from P (m).
    pub platform_radius: f64,
    /// The legs.
    pub leg: TelescopicLeg,
    /// Stiffness of every joint B and S in its directions x y z (N/m), u w (N·m/rad), as far as
    /// the joint constrains them: `None` is rigid, zero frees a direction. v must be `None`.
    pub joint_stiffness: [Option<f64>; 6],
    /// Stiffness of the drives along the legs (N/m); `None` or zero is locked rigidly. They are
    /// rigid in all other directions.
    pub drive_stiffness: Option<f64>,
    /// Number of beam elements a link is divided into.
    pub elements: usize,
}

impl ThreeRps {
    /// Looks whether every parameter is in its physical range.
    ///
    /// # Errors
    /// The first that is not: a radius that is negative or, the platform's, zero, a negative
    /// stiffness, a number that is not finite, a stiffness of v, no element, and those of
    /// [`TelescopicLeg::check`].
    pub fn check(&self) -> Result<(), ParameterError> {
        parameter::radius("base_radius", self.base_radius)?;
        parameter::positive_length("platform_radius", self.platform_radius)?;
        self.leg.check()?;
        parameter::passive_stiffness("joint_stiffness", &self.joint_stiffness)?;
        parameter::stiffness("drive_stiffness", self.drive_stiffness)?;
        parameter::elements("elements", self.elements)
    }

    /// The legs and the platform at a pose.
    #[inline]
    fn at(&self, pose: &[f64]) -> Result<Posed<'_>, PoseError> {
        self.check()?;
        let given = coordinates::<3>(self.kind(), pose)?;
        let platform = Platform::new(self.platform_radius, given);
        let legs = per_limb(|index| {
            let foot = Foot::Revolute(tangent(index));
            let base = Point3::from(outward(index) * self.base_radius);
            Leg::new(&self.leg, index, foot, base, platform.corners[index])
        })?;
        Ok(Posed {
            three_rps: self,
            legs,
            platform,
        })
    }
}

/// A 3-RPS at a pose.
struct Posed<'a> {
    three_rps: &'a ThreeRps,
    legs: [Leg; LIMBS],
    platform: Platform,
}

impl Configuration for Posed<'_> {
    #[inline]
    fn walk(&self, parts: &mut impl Parts) {
        let three_rps = self.three_rps;
        for leg in &self.legs {
            leg.bodies(parts, &three_rps.leg, three_rps.elements);
        }
        let s = |index: usize| self.legs[index].platform_point();
        let centre = (Name::alone("P"), self.platform.centre);
        parts.rigid(PLATFORM, [centre, s(0), s(1), s(2)]);
        for leg in &self.legs {
            leg.joints(parts, &three_rps.joint_stiffness, three_rps.drive_stiffness);
        }
    }

    fn pose(&self) -> [f64; 6] {
        self.platform.pose
    }
}

impl Prebuilt for ThreeRps {
    fn kind(&self) -> &str {
        "ThreeRps"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::Z, PoseCoordinate::Rx, PoseCoordinate::Ry]
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        construction::model("3-RPS", &self.at(pose)?)
    }

    fn origins(&self, pose: &[f64]) -> Result<Vec<(ValuePlace, String)>, PoseError> {
        Ok(construction::origins(&self.at(pose)?))
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        construction::place(geometry, &self.at(pose)?)
    }
}
