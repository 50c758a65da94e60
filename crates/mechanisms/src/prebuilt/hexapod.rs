//! The hexapod (Stewart–Gough platform): parameters, model and poses.

use std::f64::consts::FRAC_PI_3;

use hyperstat_assembly::{Geometry, Model};
use nalgebra::{Point3, Rotation3, Vector3};

use super::construction::{self, Name, Parts};
use super::limbs::outward;
use super::telescope::{Foot, FootJoint, Leg, TelescopicLeg};
use super::{ParameterError, PoseCoordinate, PoseError, Prebuilt, coordinates, parameter};

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

    /// Leg `index` (from 0) with the platform's centre at `centre`.
    fn leg(
        &self,
        index: usize,
        centre: &Point3<f64>,
        rotation: &Rotation3<f64>,
    ) -> Result<Leg<'_>, PoseError> {
        let side = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
        let out = |angle: f64| outward(index / 2, side * angle);
        let base = Point3::from(out(self.base_angle) * self.base_radius);
        let platform = centre + rotation * out(self.platform_angle) * self.platform_radius;
        let tangent = Vector3::z().cross(&out(self.base_angle));
        let foot = Foot::new(self.base_joints, tangent);
        Leg::new(&self.leg, index, foot, base, platform)
    }

    fn configuration(&self, pose: &[f64]) -> Result<Configuration<'_>, PoseError> {
        self.check()?;
        let [x, y, z, rx, ry, rz] = coordinates::<6>(self.kind(), pose)?;
        let centre = Point3::new(x, y, z);
        let rotation = Rotation3::new(Vector3::new(rx, ry, rz));
        let leg = |index| self.leg(index, &centre, &rotation);
        Ok(Configuration {
            legs: [leg(0)?, leg(1)?, leg(2)?, leg(3)?, leg(4)?, leg(5)?],
            centre,
        })
    }

    fn walk(
        &self,
        configuration: &Configuration<'_>,
        parts: &mut dyn Parts,
    ) -> Result<(), PoseError> {
        let Configuration { legs, centre } = configuration;
        let mut points = [(Name::alone("P"), *centre); 1 + LEGS];
        for (leg, point) in legs.iter().zip(&mut points[1..]) {
            leg.bodies(parts, self.elements)?;
            *point = leg.platform_point();
        }
        parts.rigid(PLATFORM, &points)?;
        for leg in legs {
            leg.joints(parts, PLATFORM, self.joint_stiffness, self.drive_stiffness)?;
        }
        Ok(())
    }
}

/// Number of legs.
const LEGS: usize = 6;

const PLATFORM: Name = Name::alone("platform");

/// The legs and the platform's centre at a pose.
struct Configuration<'a> {
    legs: [Leg<'a>; LEGS],
    centre: Point3<f64>,
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
        let configuration = self.configuration(pose)?;
        construction::model("hexapod", PLATFORM, |parts| {
            self.walk(&configuration, parts)
        })
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        let configuration = self.configuration(pose)?;
        construction::place(geometry, |parts| self.walk(&configuration, parts))?;
        coordinates::<6>(self.kind(), pose)
    }
}
