//! The Exechon tripod (2-UPR + SPR): parameters, model and poses.

use hyperstat_joints::{Joint, Prismatic, Revolute, Spherical, Universal};
use hyperstat_model::{Geometry, Model, ValuePlace};
use nalgebra::{Point3, Rotation3, Vector3, center};

use super::construction::{
    BeamPart, Configuration, JointPart, Name, NamedPoint, PLATFORM, Parts, RIGID,
};
use super::frames::frame;
use super::limbs::{LIMBS, per_limb};
use super::tilt::Tilt;
use crate::prebuilt::{
    Link, ParameterError, PoseCoordinate, PoseError, Prebuilt, construction, coordinates, parameter,
};

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

    /// The legs with the platform's centre at a pose.
    #[inline]
    fn at(&self, pose: &[f64]) -> Result<Posed<'_>, PoseError> {
        self.check()?;
        let [x, y, z] = coordinates::<3>(self.kind(), pose)?;
        let edge = EDGE * (self.base_width + self.base_depth);
        if z.abs() <= edge {
            return Err(PoseError::singular(
                "P lies in the plane of the base, into which the plane of legs 1 and 2 cannot \
                 turn"
                    .into(),
            ));
        }
        let height = y.hypot(z).copysign(z);
        let about_x = [-y / height, z / height];
        let lever = height + self.base_depth * about_x[0];
        if lever.abs() <= edge {
            return Err(PoseError::singular(
                "A3 lies abreast of P, so leg 3 does not say how the platform is turned in the \
                 plane of legs 1 and 2"
                    .into(),
            ));
        }
        let length = x.hypot(lever).copysign(lever);
        let tilt = Tilt {
            about_x,
            about_y: [x / length, lever / length],
        };
        let rotation = tilt.rotation();

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
        let legs = per_limb(|index| {
            let head = centre + rotation * heads[index];
            Leg::new(index, feet[index], head, rotation * axes[index])
        })?;
        Ok(Posed {
            exechon: self,
            centre,
            turn: tilt.rotation_vector(),
            legs,
        })
    }
}

/// A leg at a pose.
struct Leg {
    /// Number of the leg, from 0.
    index: usize,
    foot: Point3<f64>,
    head: Point3<f64>,
    /// Along the revolute joint R.
    axis: Vector3<f64>,
    /// From foot to head.
    along: Vector3<f64>,
}

impl Leg {
    #[inline]
    fn new(
        index: usize,
        foot: Point3<f64>,
        head: Point3<f64>,
        axis: Vector3<f64>,
    ) -> Result<Self, PoseError> {
        let span = head - foot;
        let length = span.norm();
        if length == 0.0 {
            let number = index + 1;
            return Err(PoseError::singular(format!(
                "B{number} lies on A{number}, so leg {number} has no direction"
            )));
        }
        let along = span / length;
        Ok(Self {
            index,
            foot,
            head,
            axis,
            along,
        })
    }

    fn name(&self, word: &'static str) -> Name {
        Name::limb(word, self.index)
    }

    /// A, M and B.
    #[inline]
    fn points(&self) -> [NamedPoint; 3] {
        [
            (self.name("A"), self.foot),
            (self.name("M"), center(&self.foot, &self.head)),
            (self.name("B"), self.head),
        ]
    }
}

/// An Exechon at a pose.
struct Posed<'a> {
    exechon: &'a Exechon,
    centre: Point3<f64>,
    /// The platform's rotation vector (rad).
    turn: Vector3<f64>,
    legs: [Leg; LIMBS],
}

impl Configuration for Posed<'_> {
    #[inline]
    fn walk(&self, parts: &mut impl Parts) {
        let exechon = self.exechon;
        for leg in &self.legs {
            let [foot, middle, head] = leg.points();
            let half = |word, points, link| BeamPart {
                name: leg.name(word),
                points,
                link,
                y_axis: leg.axis,
                elements: exechon.elements,
            };
            parts.beam(half(
                "housing",
                [foot, middle],
                ("housing", &exechon.housing),
            ));
            parts.beam(half("ram", [middle, head], ("ram", &exechon.ram)));
        }
        let b = |index: usize| self.legs[index].points()[2];
        let centre = (Name::alone("P"), self.centre);
        parts.rigid(PLATFORM, [centre, b(0), b(1), b(2)]);
        for leg in &self.legs {
            self.joints(leg, parts);
        }
    }

    fn pose(&self) -> [f64; 6] {
        let (at, turn) = (self.centre, self.turn);
        [at.x, at.y, at.z, turn.x, turn.y, turn.z]
    }
}

impl Posed<'_> {
    #[inline]
    fn joints(&self, leg: &Leg, parts: &mut impl Parts) {
        let (housing, ram) = (Some(leg.name("housing")), Some(leg.name("ram")));
        let joint = |joint: &'static dyn Joint, word, between, frame, stiffness| {
            JointPart::passive(joint, leg.name(word), between, frame, stiffness)
        };
        let given = &self.exechon.joint_stiffness;
        let (word, kind, foot): (_, &'static dyn Joint, _) = match leg.index {
            2 => ("S", &Spherical, Rotation3::identity()),
            _ => ("U", &Universal, frame(&Vector3::x(), &leg.axis)),
        };
        parts.joint(joint(kind, word, [None, housing], foot, given).at(leg.name("A")));
        let drive = frame(&leg.axis, &leg.along);
        let slide = joint(&Prismatic, "D", [housing, ram], drive, &RIGID);
        let slide = slide.at(leg.name("M"));
        parts.joint(slide.driven(self.exechon.drive_stiffness));
        let head = frame(&leg.along, &leg.axis);
        let turn = joint(&Revolute, "R", [ram, Some(PLATFORM)], head, given);
        parts.joint(turn.at(leg.name("B")));
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
        construction::model("exechon", &self.at(pose)?)
    }

    fn origins(&self, pose: &[f64]) -> Result<Vec<(ValuePlace, String)>, PoseError> {
        Ok(construction::origins(&self.at(pose)?))
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        construction::place(geometry, &self.at(pose)?)
    }
}
