//! The hexapod (Stewart–Gough platform): parameters, model and poses.

use std::f64::consts::FRAC_PI_3;

use hyperstat_model::{Geometry, Model, ValuePlace};
use nalgebra::{Point3, Rotation3, Vector3};

use super::construction::{Configuration, Name, PLATFORM, Parts};
use super::limbs::turned_outward;
use super::telescope::{Foot, FootJoint, Leg, TelescopicLeg};
use crate::prebuilt::{
    ParameterError, PoseCoordinate, PoseError, Prebuilt, construction, coordinates, parameter,
};

/// The hexapod: a platform on six telescopic legs, 6-UPS or 6-SPS.
///
/// ```text
///   S ── P ── S    platform             seen against z: base ○, platform ●
///    ╲       ╱
///     ║     ║      piston                    1 ○   ○ 2
///     M     M      drive ◄─► along          ●    y    ●       joints of a pair are
///     ║     ║      the leg                       │            2·base_angle and
///     ║     ║      cylinder           4 ○ ●      └── x  ● ○ 5 2·platform_angle apart
///   B ○     ○ B                        3 ○  ●         ●  ○ 6
///   ▒▒▒▒▒▒▒▒▒▒▒▒   base
/// ```
///
/// The legs come in pairs: legs 1 and 2 about +y, 3 and 4 about the direction 120° on about z,
/// 5 and 6 about that at 240°. Of a pair's base joints the first stands `base_angle` on about z
/// (leg 1 towards −x), the second as far the other way; its platform joints likewise by
/// `platform_angle`. Base joints B lie at `base_radius` about the
/// origin, platform joints S at `platform_radius` about the platform's centre P.
///
/// A pose is all of x, y, z (m) and rx, ry, rz (rad) of P, which is the output; at zero rotation
/// base and platform are parallel.
///
/// | body | runs through | local y along |
/// |---|---|---|
/// | `cylinder` | B, M | the second axis of B, normal to the leg |
/// | `piston` | M, S | the same |
///
/// | joint | between | kind |
/// |---|---|---|
/// | `B` | ground, `cylinder` | universal: the first axis is fixed in the base along the tangent of its circle, the second normal to it and to the leg; or spherical |
/// | `M` | `cylinder`, `piston` | prismatic along the leg, the locked drive; x of its frame along local y |
/// | `S` | `piston`, `platform` | spherical |
///
/// Every name carries the leg's number. The rigid `platform` holds P and S1 … S6.
///
/// With universal base joints the mobility is 6, with spherical ones 12, of which six are the
/// legs' spins about themselves (they stay idle with the drives locked); the degree of
/// over-constraint is 0. Loads reach the base by forces along the legs alone, so that the
/// stiffness is JᵀkJ with the legs' axial stiffnesses k and their unit wrenches J.
///
/// V. E. Gough and S. G. Whitehall, *Universal tyre test machine*, Proc. 9th FISITA Congress
/// (1962) 117–137. D. Stewart, *A platform with six degrees of freedom*, Proc. Inst. Mech. Eng.
/// 180 (1965) 371–386. The cubic one: Z. J. Geng and L. S. Haynes, *Six degree-of-freedom active
/// vibration control using the Stewart platforms*, IEEE Trans. Control Systems Technology 2
/// (1994) 45–53.
#[derive(Debug, Clone, PartialEq)]
pub struct Hexapod {
    /// Radius of the circle of the base joints B (m).
    pub base_radius: f64,
    /// Half the angle between the base joints of a pair (rad), 0 to π/3.
    pub base_angle: f64,
    /// Radius of the circle of the platform joints S (m).
    pub platform_radius: f64,
    /// Half the angle between the platform joints of a pair (rad), 0 to π/3.
    pub platform_angle: f64,
    /// The joints B.
    pub base_joints: FootJoint,
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

impl Hexapod {
    /// The cubic 6-SPS: at home, with P at the height `edge`/√3, the legs are six edges of a cube
    /// that stands on a corner, and each is normal to its neighbours. Its joints are rigid.
    ///
    /// # Errors
    /// An edge that is not a length above zero.
    pub fn cubic(edge: f64, leg: TelescopicLeg) -> Result<Self, ParameterError> {
        parameter::positive_length("edge", edge)?;
        // The corners next to the lowest and next to the highest one.
        let radius = edge * (2.0_f64 / 3.0).sqrt();
        Ok(Self {
            base_radius: radius,
            base_angle: 0.0,
            platform_radius: radius,
            platform_angle: FRAC_PI_3,
            base_joints: FootJoint::Spherical,
            leg,
            joint_stiffness: [None; 6],
            drive_stiffness: None,
            elements: 1,
        })
    }

    /// Looks whether every parameter is in its physical range.
    ///
    /// # Errors
    /// The first that is not: a radius that is not above zero, an angle out of 0 to π/3, a
    /// negative stiffness, a number that is not finite, a stiffness of v, no element, and those
    /// of [`TelescopicLeg::check`].
    pub fn check(&self) -> Result<(), ParameterError> {
        parameter::positive_length("base_radius", self.base_radius)?;
        parameter::half_angle_of_pair("base_angle", self.base_angle)?;
        parameter::positive_length("platform_radius", self.platform_radius)?;
        parameter::half_angle_of_pair("platform_angle", self.platform_angle)?;
        self.leg.check()?;
        parameter::passive_stiffness("joint_stiffness", &self.joint_stiffness)?;
        parameter::stiffness("drive_stiffness", self.drive_stiffness)?;
        parameter::elements("elements", self.elements)
    }

    /// The legs with the platform at a pose.
    #[inline]
    fn at(&self, pose: &[f64]) -> Result<Posed<'_>, PoseError> {
        self.check()?;
        let pose = coordinates::<6>(self.kind(), pose)?;
        let [x, y, z, rx, ry, rz] = pose;
        let centre = Point3::new(x, y, z);
        let rotation = Rotation3::new(Vector3::new(rx, ry, rz));
        let (base, platform) = (self.base_angle.sin_cos(), self.platform_angle.sin_cos());
        let leg = |index: usize| {
            // The first of a pair stands the angle on about z, the second as far the other way.
            let pair = index / 2;
            let side = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
            let out = |(sin, cos)| turned_outward(pair, (side * sin, cos));
            let foot = Foot::new(self.base_joints, Vector3::z().cross(&out(base)));
            let b = Point3::from(out(base) * self.base_radius);
            let s = centre + rotation * out(platform) * self.platform_radius;
            Leg::new(&self.leg, index, foot, b, s)
        };
        Ok(Posed {
            hexapod: self,
            pose,
            legs: [leg(0)?, leg(1)?, leg(2)?, leg(3)?, leg(4)?, leg(5)?],
        })
    }
}

/// Number of legs.
const LEGS: usize = 6;

/// A hexapod at a pose.
struct Posed<'a> {
    hexapod: &'a Hexapod,
    pose: [f64; 6],
    legs: [Leg; LEGS],
}

impl Configuration for Posed<'_> {
    #[inline]
    fn walk(&self, parts: &mut impl Parts) {
        let hexapod = self.hexapod;
        for leg in &self.legs {
            leg.bodies(parts, &hexapod.leg, hexapod.elements);
        }
        let s = |index: usize| self.legs[index].platform_point();
        let [x, y, z, ..] = self.pose;
        let centre = (Name::alone("P"), Point3::new(x, y, z));
        parts.rigid(PLATFORM, [centre, s(0), s(1), s(2), s(3), s(4), s(5)]);
        for leg in &self.legs {
            leg.joints(parts, &hexapod.joint_stiffness, hexapod.drive_stiffness);
        }
    }

    fn pose(&self) -> [f64; 6] {
        self.pose
    }
}

impl Prebuilt for Hexapod {
    fn kind(&self) -> &str {
        "Hexapod"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        use PoseCoordinate::{Rx, Ry, Rz, X, Y, Z};
        &[X, Y, Z, Rx, Ry, Rz]
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        construction::model("hexapod", &self.at(pose)?)
    }

    fn origins(&self, pose: &[f64]) -> Result<Vec<(ValuePlace, String)>, PoseError> {
        Ok(construction::origins(&self.at(pose)?))
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        construction::place(geometry, &self.at(pose)?)
    }
}
