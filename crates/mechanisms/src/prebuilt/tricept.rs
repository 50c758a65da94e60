//! The Tricept (3-UPS + UP): parameters, model and poses.

use hyperstat_assembly::{Geometry, Model};
use hyperstat_joints::{Fixed, Joint, Prismatic, Universal, frame_from_axes, frame_from_axis};
use nalgebra::{Point3, Rotation3, UnitQuaternion, Vector3};

use super::construction::{self, BeamPart, JointPart, Name, Parts, constrained_stiffness};
use super::limbs::{LIMBS, outward, per_limb};
use super::telescope::{Foot, Leg, TelescopicLeg, second_axis};
use super::{Link, ParameterError, PoseCoordinate, PoseError, Prebuilt, coordinates, parameter};

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

    fn configuration(&self, pose: &[f64]) -> Result<Configuration<'_>, PoseError> {
        self.check()?;
        let [x, y, z] = coordinates::<3>(self.kind(), pose)?;
        let centre = Point3::new(x, y, z);
        let length = centre.coords.norm();
        if length <= self.tube_length {
            return Err(PoseError::Unreachable {
                what: format!(
                    "the middle leg: P is {length:.6} m from O, where the tube alone is {:.6} m",
                    self.tube_length
                ),
            });
        }
        let second_axis = second_axis(&centre.coords, &FIRST_AXIS, Name::alone("the middle leg"))?;
        let about_x = (-y).atan2(z);
        let about_y = x.atan2(y.hypot(z));
        let rotation = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), about_x)
            * UnitQuaternion::from_axis_angle(&Vector3::y_axis(), about_y);
        let legs = per_limb(|index| {
            let out = outward(index, 0.0);
            let foot = Foot::Universal(Vector3::z().cross(&out));
            let base = Point3::from(out * self.base_radius);
            let platform = centre + rotation * out * self.platform_radius;
            Leg::new(&self.leg, index, foot, base, platform)
        })?;
        Ok(Configuration {
            legs,
            centre,
            mouth: Point3::from(centre.coords * (self.tube_length / length)),
            second_axis,
            rotation,
        })
    }

    fn walk(
        &self,
        configuration: &Configuration<'_>,
        parts: &mut dyn Parts,
    ) -> Result<(), PoseError> {
        let Configuration {
            legs,
            centre,
            mouth,
            second_axis,
            ..
        } = configuration;
        let foot = (Name::alone("O"), Point3::origin());
        let mouth = (Name::alone("M"), *mouth);
        let centre = (Name::alone("P"), *centre);
        for (name, points, link) in [
            (TUBE, [foot, mouth], &self.tube),
            (SPLINE, [mouth, centre], &self.spline),
        ] {
            parts.beam(&BeamPart {
                name,
                points: &points,
                link,
                y_axis: *second_axis,
                elements: self.elements,
            })?;
        }
        for leg in legs {
            leg.bodies(parts, self.elements)?;
        }
        let [s1, s2, s3] = [0, 1, 2].map(|index: usize| legs[index].platform_point());
        parts.rigid(PLATFORM, &[centre, s1, s2, s3])?;

        let along = frame_from_axis(Some(&centre.1.coords), Some(second_axis))?;
        let middle: [(_, _, &dyn Joint, _); 3] = [
            (
                foot,
                [None, Some(TUBE)],
                &Universal,
                frame_from_axes(&FIRST_AXIS, second_axis)?,
            ),
            (mouth, [Some(TUBE), Some(SPLINE)], &Prismatic, along),
            (
                centre,
                [Some(SPLINE), Some(PLATFORM)],
                &Fixed,
                Rotation3::identity(),
            ),
        ];
        for ((name, _), between, joint, frame) in middle {
            let stiffness = match name == foot.0 {
                true => constrained_stiffness(joint, self.joint_stiffness),
                false => [None; 6],
            };
            parts.joint(&JointPart {
                name,
                at: name,
                between,
                joint,
                frame,
                locked: false,
                stiffness,
            })?;
        }
        for leg in legs {
            leg.joints(parts, PLATFORM, self.joint_stiffness, self.drive_stiffness)?;
        }
        Ok(())
    }
}

/// First axis of the middle leg's universal joint.
const FIRST_AXIS: Vector3<f64> = Vector3::new(1.0, 0.0, 0.0);

const TUBE: Name = Name::alone("tube");
const SPLINE: Name = Name::alone("spline");
const PLATFORM: Name = Name::alone("platform");

/// The legs and the platform at a pose.
struct Configuration<'a> {
    legs: [Leg<'a>; LIMBS],
    centre: Point3<f64>,
    /// M of the middle leg.
    mouth: Point3<f64>,
    /// Of the middle leg's universal joint.
    second_axis: Vector3<f64>,
    rotation: UnitQuaternion<f64>,
}

impl Prebuilt for Tricept {
    fn kind(&self) -> &str {
        "Tricept"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::X, PoseCoordinate::Y, PoseCoordinate::Z]
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        let configuration = self.configuration(pose)?;
        construction::model("tricept", PLATFORM, |parts| {
            self.walk(&configuration, parts)
        })
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        let configuration = self.configuration(pose)?;
        construction::place(geometry, |parts| self.walk(&configuration, parts))?;
        let [x, y, z] = configuration.centre.into();
        let [rx, ry, rz] = configuration.rotation.scaled_axis().into();
        Ok([x, y, z, rx, ry, rz])
    }
}
