//! The Exechon tripod (2-UPR + SPR): parameters, model and poses.

use hyperstat_assembly::{Geometry, Model};
use hyperstat_joints::{
    Joint, Prismatic, Revolute, Spherical, Universal, frame_from_axes, frame_from_axis,
};
use nalgebra::{Point3, Rotation3, UnitQuaternion, Vector3, center};

use super::construction::{self, BeamPart, JointPart, Name, NamedPoint, Parts};
use super::limbs::LIMBS;
use super::{Link, ParameterError, PoseCoordinate, PoseError, Prebuilt, coordinates, parameter};

/// How near, relative to the base's size, a place may come to one where a direction is not
/// defined.
const EDGE: f64 = 1e-12;

/// The Exechon tripod (2-UPR + SPR): two legs in a plane that turns about the line of their base
/// joints, and a third that turns the platform within that plane.
///
/// ```text
///      A1 ───── base_width ───── A2       A1 and A2 on the line of x, half of base_width
///       ╲         O ─► x        ╱         from O; A3 base_depth from O along y.
///        ╲        │            ╱
///      M1 ◌       A3          ◌ M2        U1, U2, S3  joints at A1, A2, A3
///          ╲       │         ╱            D1, D2, D3  drives, locked, at the middle M of
///           ╲      ◌ M3     ╱                         each leg
///            B1 ── P ──── B2              R1, R2, R3  revolute joints at B1, B2, B3
///              platform_width             B3 is platform_depth from P along the
///                  │                      platform's y.
///                  B3
/// ```
///
/// At home the platform's axes are the global ones; it may stand over the base (z > 0) or hang
/// under it. The universal joints' first axes are both on the line A1–A2, along x; their second
/// axes and the revolute joints R1 and R2 are along the platform's y, the normal of the plane of
/// legs 1 and 2. R3 is along the platform's x, to which leg 3 is normal.
///
/// A pose is the position x, y, z (m) of P, the middle of B1–B2, which is the output. The
/// platform's orientation follows: it is turned by α about x, which brings the plane of legs 1
/// and 2 through P, and by β about its own y, which makes leg 3 normal to R3:
///
/// ```text
/// h = √(y² + z²) with the sign of z     tan α = −y/z     tan β = x/(h + base_depth·sin α)
/// ```
///
/// | body | runs through | local y along |
/// |---|---|---|
/// | `housing` | A, M | the leg's revolute joint R |
/// | `ram` | M, B | the leg's revolute joint R |
///
/// | joint | between | frame |
/// |---|---|---|
/// | `U1`, `U2`, universal | ground, `housing` | x along x, y along R |
/// | `S3`, spherical | ground, `housing` | global |
/// | `D`, prismatic, locked | `housing`, `ram` | y along the leg, x along R |
/// | `R`, revolute | `ram`, `platform` | y along the axis, x along the leg |
///
/// The rigid `platform` holds P, B1, B2 and B3. Names carry the leg's number.
///
/// Seven bodies and nine joints give 1 by Grübler's count, yet the mobility is 3 and the degree of
/// over-constraint 2: legs 1 and 2 each hold the platform by a force along the normal of their
/// plane and by a couple in it normal to x, four constraints of which two are independent.
///
/// M. Zoppi, D. Zlatanov and R. Molfino, *Kinematics analysis of the Exechon tripod*, ASME
/// International Design Engineering Technical Conferences (2010); Z. M. Bi and Y. Jin, *Kinematic
/// modeling of Exechon parallel kinematic machine*, Robotics and Computer-Integrated
/// Manufacturing 27 (2011) 186–193.
#[derive(Debug, Clone, PartialEq)]
pub struct Exechon {
    /// Distance between A1 and A2 (m).
    pub base_width: f64,
    /// Distance of A3 from the line A1–A2 (m).
    pub base_depth: f64,
    /// Distance between B1 and B2 (m).
    pub platform_width: f64,
    /// Distance of B3 from the line B1–B2 (m).
    pub platform_depth: f64,
    /// The half of a leg at the base, A to M.
    pub housing: Link,
    /// The half of a leg at the platform, M to B.
    pub ram: Link,
    /// Stiffness of every universal, spherical and revolute joint in its directions x y z (N/m),
    /// u w (N·m/rad), where the joint holds them: `None` is rigid, zero frees a direction. v,
    /// which is free in all of them, must be `None`.
    pub joint_stiffness: [Option<f64>; 6],
    /// Stiffness of the drives along the legs (N/m); `None` or zero is locked rigidly. The
    /// sliding joints are rigid in all other directions.
    pub drive_stiffness: Option<f64>,
    /// Number of beam elements each half of a leg is divided into.
    pub elements: usize,
}

impl Exechon {
    /// Looks whether every parameter is in its physical range.
    ///
    /// # Errors
    /// The first that is not: a length that is not above zero, a negative stiffness, a number
    /// that is not finite, a stiffness about the joints' axes, no element.
    pub fn check(&self) -> Result<(), ParameterError> {
        parameter::positive_length("base_width", self.base_width)?;
        parameter::positive_length("base_depth", self.base_depth)?;
        parameter::positive_length("platform_width", self.platform_width)?;
        parameter::positive_length("platform_depth", self.platform_depth)?;
        parameter::joint_stiffness("joint_stiffness", &self.joint_stiffness)?;
        parameter::stiffness("drive_stiffness", self.drive_stiffness)?;
        parameter::elements("elements", self.elements)
    }

    fn configuration(&self, pose: &[f64]) -> Result<Configuration, PoseError> {
        self.check()?;
        let [x, y, z] = coordinates::<3>(self.kind(), pose)?;
        let edge = EDGE * (self.base_width + self.base_depth);
        if z.abs() <= edge {
            return Err(PoseError::Singular {
                what: "P lies in the plane of the base, into which the plane of legs 1 and 2 \
                       cannot turn"
                    .into(),
            });
        }
        let tilt = (-y / z).atan();
        let height = y.hypot(z).copysign(z);
        let lever = height + self.base_depth * tilt.sin();
        if lever.abs() <= edge {
            return Err(PoseError::Singular {
                what: "A3 lies abreast of P, so leg 3 does not say how the platform is turned in \
                       the plane of legs 1 and 2"
                    .into(),
            });
        }
        let swing = (x / lever).atan();
        let about = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
        let turn = about(Vector3::x_axis(), tilt) * about(Vector3::y_axis(), swing);
        let rotation = turn.to_rotation_matrix();

        let centre = Point3::new(x, y, z);
        let (base, platform) = (0.5 * self.base_width, 0.5 * self.platform_width);
        let feet = [
            Point3::new(-base, 0.0, 0.0),
            Point3::new(base, 0.0, 0.0),
            Point3::new(0.0, self.base_depth, 0.0),
        ];
        let heads = [
            Vector3::new(-platform, 0.0, 0.0),
            Vector3::new(platform, 0.0, 0.0),
            Vector3::new(0.0, self.platform_depth, 0.0),
        ];
        let axes = [Vector3::y(), Vector3::y(), Vector3::x()];
        Ok(Configuration {
            centre,
            turn: turn.scaled_axis(),
            legs: [0, 1, 2].map(|index| Leg {
                index,
                foot: feet[index],
                head: centre + rotation * heads[index],
                axis: rotation * axes[index],
            }),
        })
    }

    fn walk(&self, configuration: &Configuration, parts: &mut dyn Parts) -> Result<(), PoseError> {
        for leg in &configuration.legs {
            let [foot, middle, head] = leg.points();
            for (word, points, link) in [
                ("housing", [foot, middle], &self.housing),
                ("ram", [middle, head], &self.ram),
            ] {
                parts.beam(&BeamPart {
                    name: leg.name(word),
                    points: &points,
                    link,
                    y_axis: leg.axis,
                    elements: self.elements,
                })?;
            }
        }
        let [first, second, third] = configuration.legs.each_ref().map(|leg| leg.points()[2]);
        let centre = (Name::alone("P"), configuration.centre);
        parts.rigid(PLATFORM, &[centre, first, second, third])?;
        for leg in &configuration.legs {
            self.joints(leg, parts)?;
        }
        Ok(())
    }

    fn joints(&self, leg: &Leg, parts: &mut dyn Parts) -> Result<(), PoseError> {
        let along = leg.head - leg.foot;
        let [housing, ram] = ["housing", "ram"].map(|word| Some(leg.name(word)));
        let base: (_, &dyn Joint, _) = match leg.index {
            2 => ("S", &Spherical, Rotation3::identity()),
            _ => ("U", &Universal, frame_from_axes(&Vector3::x(), &leg.axis)?),
        };
        let slide = frame_from_axis(Some(&along), Some(&leg.axis))?;
        let turn = frame_from_axis(Some(&leg.axis), Some(&along))?;
        let joints: [(_, _, _, &dyn Joint, _); 3] = [
            (base.0, "A", [None, housing], base.1, base.2),
            ("D", "M", [housing, ram], &Prismatic, slide),
            ("R", "B", [ram, Some(PLATFORM)], &Revolute, turn),
        ];
        for (word, at, between, joint, frame) in joints {
            let drive = word == "D";
            parts.joint(&JointPart {
                name: leg.name(word),
                at: leg.name(at),
                between,
                joint,
                frame,
                locked: drive,
                stiffness: if drive {
                    construction::prismatic_stiffness(self.drive_stiffness)
                } else {
                    construction::constrained_stiffness(joint, self.joint_stiffness)
                },
            })?;
        }
        Ok(())
    }
}

const PLATFORM: Name = Name::alone("platform");

struct Configuration {
    centre: Point3<f64>,
    /// The platform's rotation vector (rad).
    turn: Vector3<f64>,
    legs: [Leg; LIMBS],
}

struct Leg {
    /// Number of the leg, from 0.
    index: usize,
    foot: Point3<f64>,
    head: Point3<f64>,
    /// Along the revolute joint R.
    axis: Vector3<f64>,
}

impl Leg {
    fn name(&self, word: &'static str) -> Name {
        Name::limb(word, self.index)
    }

    /// A, M and B.
    fn points(&self) -> [NamedPoint; 3] {
        [
            (self.name("A"), self.foot),
            (self.name("M"), center(&self.foot, &self.head)),
            (self.name("B"), self.head),
        ]
    }
}

impl Prebuilt for Exechon {
    fn kind(&self) -> &str {
        "Exechon"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::X, PoseCoordinate::Y, PoseCoordinate::Z]
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        let configuration = self.configuration(pose)?;
        construction::model("exechon", PLATFORM, |parts| {
            self.walk(&configuration, parts)
        })
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        let configuration = self.configuration(pose)?;
        construction::place(geometry, |parts| self.walk(&configuration, parts))?;
        let (at, turn) = (configuration.centre, configuration.turn);
        Ok([at.x, at.y, at.z, turn.x, turn.y, turn.z])
    }
}
