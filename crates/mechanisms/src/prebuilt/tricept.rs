//! The Tricept (3-UPS + UP): parameters, model and poses.

use hyperstat_joints::{Fixed, Joint, Prismatic, Universal};
use hyperstat_model::{Geometry, Model, ValuePlace};
use nalgebra::{Point3, Rotation3, Vector3};

use super::construction::{BeamPart, Configuration, JointPart, Name, PLATFORM, Parts, RIGID};
use super::error::shown;
use super::frames::frame;
use super::limbs::{LIMBS, outward, per_limb, tangent};
use super::telescope::{Foot, Leg, TelescopicLeg, second_axis};
use super::tilt::Tilt;
use crate::prebuilt::{
    Link, ParameterError, PoseCoordinate, PoseError, Prebuilt, construction, coordinates, parameter,
};

/// The Tricept (3-UPS + UP): a platform on three telescopic legs, its orientation held by a
/// passive telescopic leg in the middle.
///
/// ```text
///   z      S ─────── P ─────── S   platform, welded to the spline
///   │       ╲        ║        ╱
///   │  piston ╲      ║ spline           The middle leg stands on a universal joint
///   │          M     ║      M           at O. Its first axis is x, fixed in the base;
///   │           ╲    M    ╱  drive      the second is the platform's local y.
///   │   cylinder ╲   ║ tube
///   │             ╲  ║  ╱               O–B is base_radius, P–S platform_radius,
///   └─ ▒ B ▒▒▒▒▒▒▒▒▒ O ▒▒▒▒▒▒▒▒▒ B ▒    O–M tube_length.
/// ```
///
/// Leg i is leg 1 turned by 120° (i − 1) about z, leg 1 over +y. The platform is normal to the
/// middle leg.
///
/// A pose is the position x, y, z (m) of P, which is the output. The orientation follows: with the
/// middle leg's direction (sin β, −sin α cos β, cos α cos β) it is the turn by α about x after
/// the one by β about y; its rotation vector is returned in the full pose.
///
/// | body | runs through | local y along |
/// |---|---|---|
/// | `cylinder` | B, M | the second axis of B, normal to the leg |
/// | `piston` | M, S | the same |
/// | `tube` | O, M | the second axis of O |
/// | `spline` | M, P | the same |
///
/// | joint | between | kind |
/// |---|---|---|
/// | `B` | ground, `cylinder` | universal: the first axis is fixed in the base along the tangent of its circle, the second normal to it and to the leg |
/// | `M` | `cylinder`, `piston` | prismatic along the leg, the locked drive; x of its frame along local y |
/// | `S` | `piston`, `platform` | spherical |
/// | `O` | ground, `tube` | universal, the first axis along x |
/// | `M` | `tube`, `spline` | prismatic along the middle leg, free; x of its frame along local y |
/// | `P` | `spline`, `platform` | fixed |
///
/// The names of a leg carry its number (`M1`), those of the middle leg none. The rigid
/// `platform` holds P, S1, S2 and S3. The mobility is 3, the degree of over-constraint 0.
///
/// K.-E. Neumann, *Robot*, US patent 4 732 525 (1988). B. Siciliano, *The Tricept robot: inverse
/// kinematics, manipulability analysis and closed-loop direct kinematics algorithm*, Robotica 17
/// (1999) 437–445.
#[derive(Debug, Clone, PartialEq)]
pub struct Tricept {
    /// Distance of the base joints B from O (m).
    pub base_radius: f64,
    /// Distance of the platform joints S from P (m).
    pub platform_radius: f64,
    /// The three driven legs.
    pub leg: TelescopicLeg,
    /// Tube of the middle leg, O to M.
    pub tube: Link,
    /// Spline of the middle leg, M to P, as far as it is out of the tube.
    pub spline: Link,
    /// Length of the tube (m).
    pub tube_length: f64,
    /// Stiffness of every joint B, S and O in its directions x y z (N/m), u w (N·m/rad), as far
    /// as the joint constrains them: `None` is rigid, zero frees a direction. v must be `None`.
    pub joint_stiffness: [Option<f64>; 6],
    /// Stiffness of the drives along the legs (N/m); `None` or zero is locked rigidly. They are
    /// rigid in all other directions.
    pub drive_stiffness: Option<f64>,
    /// Number of beam elements a link is divided into.
    pub elements: usize,
}

impl Tricept {
    /// Looks whether every parameter is in its physical range.
    ///
    /// # Errors
    /// The first that is not: a length that is not above zero, a negative stiffness, a number
    /// that is not finite, a stiffness of v, no element, and those of [`TelescopicLeg::check`].
    pub fn check(&self) -> Result<(), ParameterError> {
        parameter::positive_length("base_radius", self.base_radius)?;
        parameter::positive_length("platform_radius", self.platform_radius)?;
        self.leg.check()?;
        parameter::positive_length("tube_length", self.tube_length)?;
        parameter::passive_stiffness("joint_stiffness", &self.joint_stiffness)?;
        parameter::stiffness("drive_stiffness", self.drive_stiffness)?;
        parameter::elements("elements", self.elements)
    }

    /// The legs with the platform's centre at a pose.
    #[inline]
    fn at(&self, pose: &[f64]) -> Result<Posed<'_>, PoseError> {
        self.check()?;
        let centre = Point3::from(coordinates::<3>(self.kind(), pose)?);
        let length = centre.coords.norm();
        if length <= self.tube_length {
            return Err(PoseError::unreachable(format!(
                "the middle leg: P is {} m from O, where the tube alone is {} m",
                shown(length),
                shown(self.tube_length),
            )));
        }
        let along = centre.coords / length;
        let second_axis = second_axis(&along, &FIRST_AXIS, Name::alone("the middle leg"))?;
        let height = along.y.hypot(along.z);
        let tilt = Tilt {
            about_x: [-along.y / height, along.z / height],
            about_y: [along.x, height],
        };
        let rotation = tilt.rotation();
        let legs = per_limb(|index| {
            let base = Point3::from(outward(index) * self.base_radius);
            let platform = centre + rotation * outward(index) * self.platform_radius;
            let foot = Foot::Universal(tangent(index));
            Leg::new(&self.leg, index, foot, base, platform)
        })?;
        Ok(Posed {
            tricept: self,
            legs,
            centre,
            turn: tilt.rotation_vector(),
            mouth: Point3::from(along * self.tube_length),
            foot_frame: frame(&FIRST_AXIS, &second_axis),
            slide_frame: frame(&second_axis, &along),
            second_axis,
        })
    }
}

/// First axis of the middle leg's universal joint.
const FIRST_AXIS: Vector3<f64> = Vector3::new(1.0, 0.0, 0.0);

const TUBE: Name = Name::alone("tube");
const SPLINE: Name = Name::alone("spline");

/// A Tricept at a pose.
struct Posed<'a> {
    tricept: &'a Tricept,
    legs: [Leg; LIMBS],
    centre: Point3<f64>,
    /// The platform's rotation vector (rad).
    turn: Vector3<f64>,
    /// M of the middle leg.
    mouth: Point3<f64>,
    /// Frames of the middle leg's universal and sliding joint.
    foot_frame: Rotation3<f64>,
    slide_frame: Rotation3<f64>,
    /// Of the middle leg's universal joint.
    second_axis: Vector3<f64>,
}

impl Configuration for Posed<'_> {
    #[inline]
    fn walk(&self, parts: &mut impl Parts) {
        let tricept = self.tricept;
        let foot = (Name::alone("O"), Point3::origin());
        let mouth = (Name::alone("M"), self.mouth);
        let centre = (Name::alone("P"), self.centre);
        parts.beam(BeamPart {
            name: TUBE,
            points: [foot, mouth],
            link: ("tube", &tricept.tube),
            y_axis: self.second_axis,
            elements: tricept.elements,
        });
        parts.beam(BeamPart {
            name: SPLINE,
            points: [mouth, centre],
            link: ("spline", &tricept.spline),
            y_axis: self.second_axis,
            elements: tricept.elements,
        });
        for leg in &self.legs {
            leg.bodies(parts, &tricept.leg, tricept.elements);
        }
        let s = |index: usize| self.legs[index].platform_point();
        parts.rigid(PLATFORM, [centre, s(0), s(1), s(2)]);
        self.middle_joints(parts);
        for leg in &self.legs {
            leg.joints(parts, &tricept.joint_stiffness, tricept.drive_stiffness);
        }
    }

    fn pose(&self) -> [f64; 6] {
        let (at, turn) = (self.centre, self.turn);
        [at.x, at.y, at.z, turn.x, turn.y, turn.z]
    }
}

impl Posed<'_> {
    /// Adds the joints of the middle leg.
    #[inline]
    fn middle_joints(&self, parts: &mut impl Parts) {
        let joint = |joint: &'static dyn Joint, word, between, frame, stiffness| {
            JointPart::passive(joint, Name::alone(word), between, frame, stiffness)
        };
        let given = &self.tricept.joint_stiffness;
        let (tube, spline, platform) = (Some(TUBE), Some(SPLINE), Some(PLATFORM));
        parts.joint(joint(&Universal, "O", [None, tube], self.foot_frame, given));
        parts.joint(joint(
            &Prismatic,
            "M",
            [tube, spline],
            self.slide_frame,
            &RIGID,
        ));
        let weld = Rotation3::identity();
        parts.joint(joint(&Fixed, "P", [spline, platform], weld, &RIGID));
    }
}

impl Prebuilt for Tricept {
    fn kind(&self) -> &str {
        "Tricept"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::X, PoseCoordinate::Y, PoseCoordinate::Z]
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        construction::model("tricept", &self.at(pose)?)
    }

    fn origins(&self, pose: &[f64]) -> Result<Vec<(ValuePlace, String)>, PoseError> {
        Ok(construction::origins(&self.at(pose)?))
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        construction::place(geometry, &self.at(pose)?)
    }
}
