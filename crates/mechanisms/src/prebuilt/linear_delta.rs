//! The linear delta: parameters, model and poses.

use hyperstat_joints::{Joint, Prismatic, Spherical};
use hyperstat_model::{Geometry, Model, ValuePlace};
use nalgebra::{Point3, Rotation3, Vector3};

use super::construction::{
    BeamPart, Configuration, JointPart, Name, NamedPoint, PLATFORM, Parts, RIGID,
};
use super::frames::frame;
use super::limbs::{LIMBS, outward, per_limb, tangent};
use super::rail::Rails;
use super::telescope::{Foot, FootJoint};
use crate::prebuilt::{
    Link, ParameterError, PoseCoordinate, PoseError, Prebuilt, ROTATION, construction, coordinates,
    parameter,
};

/// The linear delta: a platform that keeps its orientation on three pairs of parallel rods, each
/// pair standing on a driven carriage.
///
/// ```text
///   z        C ── P ── C     platform      a pair of rods:
///   │       ╱           ╲                     Ca ─── C ─── Cb   platform
///   │ ║   ╱   rods        ╲   ║               │             │
///   │ ╠═ A                 A ═╣  carriage     │ roda   rodb │   rod_length
///   │ ║        drive ◄─►      ║               │             │
///   └─║───────── O ───────────║               Aa ─── A ─── Ab   carriage
///    O–rail is rails.radius, P–C platform_radius, Aa–Ab rod_spacing.
/// ```
///
/// Limb i is limb 1 turned by 120° (i − 1) about z, limb 1 over +y; a is its side towards
/// z × outward (−x in limb 1).
///
/// A pose is the position x, y, z (m) of P, which is the output. The orientation is constant.
///
/// | body | runs through | local y along |
/// |---|---|---|
/// | `carriage` (rigid) | A, Aa, Ab | |
/// | `roda`, `rodb` | Aa, Ca; Ab, Cb | normal to the rod and to Aa–Ab |
///
/// | joint | between | kind |
/// |---|---|---|
/// | `D` at A | ground, `carriage` | prismatic along the rail, the locked drive; x of its frame along Aa–Ab |
/// | `Aa`, `Ab` | `carriage`, `roda` or `rodb` | universal: the first axis along Aa–Ab, the second the rod's local y; or spherical |
/// | `Ca`, `Cb` | `roda` or `rodb`, `platform` | spherical |
///
/// Every name carries the limb's number. The rigid `platform` holds P and Ca and Cb of every
/// limb. With universal joints at the carriages the mobility is 3, with spherical ones 9, of
/// which six are the rods' spins about themselves (they stay idle with the drives locked); the
/// degree of over-constraint is 0.
///
/// O. Company and F. Pierrot, *Modelling and preliminary design issues of a 3-axis parallel
/// machine-tool*, Mechanism and Machine Theory 37 (2002) 1325–1345, after R. Clavel's delta.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearDelta {
    /// The rails of the carriages.
    pub rails: Rails,
    /// Distance of the middles C of the pairs' upper ends from P (m).
    pub platform_radius: f64,
    /// Length of the rods (m).
    pub rod_length: f64,
    /// Distance between the two rods of a limb (m).
    pub rod_spacing: f64,
    /// The joints of the rods at the carriages.
    pub carriage_joints: FootJoint,
    /// Rods.
    pub rod: Link,
    /// Stiffness of every joint at the rods' ends in its directions x y z (N/m), u w (N·m/rad),
    /// as far as the joint constrains them: `None` is rigid, zero frees a direction. v must be
    /// `None`.
    pub joint_stiffness: [Option<f64>; 6],
    /// Stiffness of the drives along their rails (N/m); `None` or zero is locked rigidly. The
    /// rails are rigid in all other directions.
    pub drive_stiffness: Option<f64>,
    /// Number of beam elements a rod is divided into.
    pub elements: usize,
}

impl LinearDelta {
    /// Looks whether every parameter is in its physical range.
    ///
    /// # Errors
    /// The first that is not: a length that is not above zero, a negative radius or stiffness, a
    /// number that is not finite, a stiffness of v, no element, and those of [`Rails::check`].
    pub fn check(&self) -> Result<(), ParameterError> {
        self.rails.check()?;
        parameter::radius("platform_radius", self.platform_radius)?;
        parameter::positive_length("rod_length", self.rod_length)?;
        parameter::positive_length("rod_spacing", self.rod_spacing)?;
        parameter::passive_stiffness("joint_stiffness", &self.joint_stiffness)?;
        parameter::stiffness("drive_stiffness", self.drive_stiffness)?;
        parameter::elements("elements", self.elements)
    }

    /// The limbs with the platform's centre at a pose.
    #[inline]
    fn at(&self, pose: &[f64]) -> Result<Posed<'_>, PoseError> {
        self.check()?;
        let centre = Point3::from(coordinates::<3>(self.kind(), pose)?);
        let rails = self.rails.directions();
        let limbs = per_limb(|index| {
            let (rail, axis) = (&rails[index], tangent(index));
            let wrist = centre + outward(index) * self.platform_radius;
            let carriage = self
                .rails
                .carriage(index, rail, self.rod_length, &wrist, "C")?;
            let foot = Foot::new(self.carriage_joints, axis);
            let along = (wrist - carriage).normalize();
            let rods = Name::limb("the rods of limb ", index);
            let y_axis = foot.y_axis(&along, rods)?;
            Ok(Limb {
                carriage,
                wrist,
                half_spacing: axis * (0.5 * self.rod_spacing),
                rail: *rail,
                axis,
                foot,
                along,
                y_axis,
            })
        })?;
        Ok(Posed {
            linear_delta: self,
            centre,
            limbs,
        })
    }
}

/// A limb at a pose.
struct Limb {
    /// A.
    carriage: Point3<f64>,
    /// C.
    wrist: Point3<f64>,
    /// From the middle to side a.
    half_spacing: Vector3<f64>,
    /// Along the rail, and along Aa–Ab.
    rail: Vector3<f64>,
    axis: Vector3<f64>,
    foot: Foot,
    /// Along the rods.
    along: Vector3<f64>,
    y_axis: Vector3<f64>,
}

impl Limb {
    /// Aa, Ab, Ca and Cb of limb `index`.
    #[inline]
    fn ends(&self, index: usize) -> [NamedPoint; 4] {
        let half = self.half_spacing;
        [
            (Name::limb("Aa", index), self.carriage + half),
            (Name::limb("Ab", index), self.carriage - half),
            (Name::limb("Ca", index), self.wrist + half),
            (Name::limb("Cb", index), self.wrist - half),
        ]
    }
}

/// A linear delta at a pose.
struct Posed<'a> {
    linear_delta: &'a LinearDelta,
    centre: Point3<f64>,
    limbs: [Limb; LIMBS],
}

impl Configuration for Posed<'_> {
    #[inline]
    fn walk(&self, parts: &mut impl Parts) {
        for (index, limb) in self.limbs.iter().enumerate() {
            let name = |word| Name::limb(word, index);
            let [aa, ab, ca, cb] = limb.ends(index);
            parts.rigid(name("carriage"), [(name("A"), limb.carriage), aa, ab]);
            let rod = |word, points| BeamPart {
                name: name(word),
                points,
                link: ("rod", &self.linear_delta.rod),
                y_axis: limb.y_axis,
                elements: self.linear_delta.elements,
            };
            parts.beam(rod("roda", [aa, ca]));
            parts.beam(rod("rodb", [ab, cb]));
        }
        let centre = (Name::alone("P"), self.centre);
        let ends = |index: usize| self.limbs[index].ends(index);
        let [_, _, ca1, cb1] = ends(0);
        let [_, _, ca2, cb2] = ends(1);
        let [_, _, ca3, cb3] = ends(2);
        parts.rigid(PLATFORM, [centre, ca1, cb1, ca2, cb2, ca3, cb3]);
        for (index, limb) in self.limbs.iter().enumerate() {
            self.joints(index, limb, parts);
        }
    }

    fn pose(&self) -> [f64; 6] {
        let [x, y, z] = self.centre.into();
        [x, y, z, 0.0, 0.0, 0.0]
    }
}

impl Posed<'_> {
    #[inline]
    fn joints(&self, index: usize, limb: &Limb, parts: &mut impl Parts) {
        let name = |word| Name::limb(word, index);
        let carriage = Some(name("carriage"));
        let (roda, rodb, platform) = (Some(name("roda")), Some(name("rodb")), Some(PLATFORM));
        let given = &self.linear_delta.joint_stiffness;
        let joint = |joint: &'static dyn Joint, word, between, frame, stiffness| {
            JointPart::passive(joint, name(word), between, frame, stiffness)
        };
        let rail_frame = frame(&limb.axis, &limb.rail);
        let slide = joint(&Prismatic, "D", [None, carriage], rail_frame, &RIGID);
        let slide = slide.at(name("A"));
        parts.joint(slide.driven(self.linear_delta.drive_stiffness));
        let (foot, ball) = (limb.foot.joint(), Rotation3::identity());
        let foot_frame = limb.foot.frame(&limb.along, &limb.y_axis);
        parts.joint(joint(foot, "Aa", [carriage, roda], foot_frame, given));
        parts.joint(joint(&Spherical, "Ca", [roda, platform], ball, given));
        parts.joint(joint(foot, "Ab", [carriage, rodb], foot_frame, given));
        parts.joint(joint(&Spherical, "Cb", [rodb, platform], ball, given));
    }
}

impl Prebuilt for LinearDelta {
    fn kind(&self) -> &str {
        "LinearDelta"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::X, PoseCoordinate::Y, PoseCoordinate::Z]
    }

    fn zero_coordinates(&self) -> &'static [PoseCoordinate] {
        ROTATION
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        construction::model("linear delta", &self.at(pose)?)
    }

    fn origins(&self, pose: &[f64]) -> Result<Vec<(ValuePlace, String)>, PoseError> {
        Ok(construction::origins(&self.at(pose)?))
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        construction::place(geometry, &self.at(pose)?)
    }
}
