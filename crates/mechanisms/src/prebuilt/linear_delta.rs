//! The linear delta: parameters, model and poses.

use hyperstat_assembly::{Geometry, Model};
use hyperstat_joints::{Prismatic, Spherical, frame_from_axis};
use nalgebra::{Point3, Rotation3, Vector3};

use super::construction::{
    self, BeamPart, JointPart, Name, NamedPoint, Parts, constrained_stiffness, prismatic_stiffness,
};
use super::limbs::{LIMBS, outward, per_limb};
use super::rail::Rails;
use super::telescope::{Foot, FootJoint};
use super::{Link, ParameterError, PoseCoordinate, PoseError, Prebuilt, coordinates, parameter};

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

    fn configuration(&self, pose: &[f64]) -> Result<Configuration, PoseError> {
        self.check()?;
        let centre = Point3::from(coordinates::<3>(self.kind(), pose)?);
        let limbs = per_limb(|index| {
            let out = outward(index, 0.0);
            let axis = Vector3::z().cross(&out);
            let wrist = centre + out * self.platform_radius;
            let carriage = self.rails.carriage(index, self.rod_length, &wrist, "C")?;
            let foot = Foot::new(self.carriage_joints, axis);
            let rods = Name::limb("the rods of limb ", index);
            let (frame, y_axis) = foot.orient(&(wrist - carriage), rods)?;
            Ok(Limb {
                index,
                carriage,
                wrist,
                half_spacing: axis * (0.5 * self.rod_spacing),
                rail_frame: frame_from_axis(Some(&self.rails.direction(index)), Some(&axis))?,
                foot,
                foot_frame: frame,
                y_axis,
            })
        })?;
        Ok(Configuration { centre, limbs })
    }

    fn walk(&self, configuration: &Configuration, parts: &mut dyn Parts) -> Result<(), PoseError> {
        let mut platform = [(Name::alone("P"), configuration.centre); 1 + 2 * LIMBS];
        for (limb, ends) in configuration
            .limbs
            .iter()
            .zip(platform[1..].chunks_exact_mut(2))
        {
            let name = |word| Name::limb(word, limb.index);
            let [aa, ab, ca, cb] = limb.ends();
            parts.rigid(name("carriage"), &[(name("A"), limb.carriage), aa, ab])?;
            for (word, points) in [("roda", [aa, ca]), ("rodb", [ab, cb])] {
                parts.beam(&BeamPart {
                    name: name(word),
                    points: &points,
                    link: &self.rod,
                    y_axis: limb.y_axis,
                    elements: self.elements,
                })?;
            }
            ends.copy_from_slice(&[ca, cb]);
        }
        parts.rigid(PLATFORM, &platform)?;
        for limb in &configuration.limbs {
            self.joints(limb, parts)?;
        }
        Ok(())
    }

    fn joints(&self, limb: &Limb, parts: &mut dyn Parts) -> Result<(), PoseError> {
        let name = |word| Name::limb(word, limb.index);
        let carriage = name("carriage");
        parts.joint(&JointPart {
            name: name("D"),
            at: name("A"),
            between: [None, Some(carriage)],
            joint: &Prismatic,
            frame: limb.rail_frame,
            locked: true,
            stiffness: prismatic_stiffness(self.drive_stiffness),
        })?;
        for (rod, lower, upper) in [("roda", "Aa", "Ca"), ("rodb", "Ab", "Cb")] {
            let rod = name(rod);
            let foot = limb.foot.joint();
            parts.joint(&JointPart {
                name: name(lower),
                at: name(lower),
                between: [Some(carriage), Some(rod)],
                joint: foot,
                frame: limb.foot_frame,
                locked: false,
                stiffness: constrained_stiffness(foot, self.joint_stiffness),
            })?;
            parts.joint(&JointPart {
                name: name(upper),
                at: name(upper),
                between: [Some(rod), Some(PLATFORM)],
                joint: &Spherical,
                frame: Rotation3::identity(),
                locked: false,
                stiffness: constrained_stiffness(&Spherical, self.joint_stiffness),
            })?;
        }
        Ok(())
    }
}

const PLATFORM: Name = Name::alone("platform");

/// A limb at a pose.
struct Limb {
    index: usize,
    /// A.
    carriage: Point3<f64>,
    /// C.
    wrist: Point3<f64>,
    /// From the middle to side a.
    half_spacing: Vector3<f64>,
    rail_frame: Rotation3<f64>,
    foot: Foot,
    foot_frame: Rotation3<f64>,
    y_axis: Vector3<f64>,
}

impl Limb {
    /// Aa, Ab, Ca and Cb.
    fn ends(&self) -> [NamedPoint; 4] {
        let half = self.half_spacing;
        [
            ("Aa", self.carriage + half),
            ("Ab", self.carriage - half),
            ("Ca", self.wrist + half),
            ("Cb", self.wrist - half),
        ]
        .map(|(word, at)| (Name::limb(word, self.index), at))
    }
}

/// The platform's centre and the limbs at a pose.
struct Configuration {
    centre: Point3<f64>,
    limbs: [Limb; LIMBS],
}

impl Prebuilt for LinearDelta {
    fn kind(&self) -> &str {
        "LinearDelta"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::X, PoseCoordinate::Y, PoseCoordinate::Z]
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        let configuration = self.configuration(pose)?;
        construction::model("linear delta", PLATFORM, |parts| {
            self.walk(&configuration, parts)
        })
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        let configuration = self.configuration(pose)?;
        construction::place(geometry, |parts| self.walk(&configuration, parts))?;
        let [x, y, z] = configuration.centre.into();
        Ok([x, y, z, 0.0, 0.0, 0.0])
    }
}
