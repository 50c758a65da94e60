//! The 3-PRS: parameters, model and poses.

use hyperstat_assembly::{Geometry, Model};
use hyperstat_joints::{Joint, Prismatic, Revolute, Spherical, frame_from_axis};
use nalgebra::{Point3, Rotation3, Vector3};

use super::construction::{
    self, BeamPart, JointPart, Name, Parts, constrained_stiffness, prismatic_stiffness,
};
use super::limbs::{LIMBS, outward, per_limb};
use super::rail::Rails;
use super::zero_torsion::Platform;
use super::{Link, ParameterError, PoseCoordinate, PoseError, Prebuilt, coordinates, parameter};

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

    fn configuration(&self, pose: &[f64]) -> Result<Configuration, PoseError> {
        self.check()?;
        let given = coordinates::<3>(self.kind(), pose)?;
        let platform = Platform::new(self.platform_radius, given);
        let carriages = per_limb(|index| {
            let corner = &platform.corners[index];
            self.rails.carriage(index, self.rod_length, corner, "S")
        })?;
        Ok(Configuration {
            carriages,
            platform,
        })
    }

    fn walk(&self, configuration: &Configuration, parts: &mut dyn Parts) -> Result<(), PoseError> {
        let Configuration {
            carriages,
            platform,
        } = configuration;
        let point = |word, index, at: [Point3<f64>; LIMBS]| (Name::limb(word, index), at[index]);
        let a = |index| point("A", index, *carriages);
        let s = |index| point("S", index, platform.corners);
        for index in 0..LIMBS {
            parts.rigid(Name::limb("carriage", index), &[a(index)])?;
            parts.beam(&BeamPart {
                name: Name::limb("rod", index),
                points: &[a(index), s(index)],
                link: &self.rod,
                y_axis: hinge_axis(index),
                elements: self.elements,
            })?;
        }
        let centre = (Name::alone("P"), platform.centre);
        parts.rigid(PLATFORM, &[centre, s(0), s(1), s(2)])?;
        for index in 0..LIMBS {
            self.joints(index, &(s(index).1 - a(index).1), parts)?;
        }
        Ok(())
    }

    /// Adds the joints of a limb with its rod along `span`.
    fn joints(
        &self,
        index: usize,
        span: &Vector3<f64>,
        parts: &mut dyn Parts,
    ) -> Result<(), PoseError> {
        let name = |word| Name::limb(word, index);
        let [carriage, rod] = ["carriage", "rod"].map(name);
        let axis = hinge_axis(index);
        parts.joint(&JointPart {
            name: name("D"),
            at: name("A"),
            between: [None, Some(carriage)],
            joint: &Prismatic,
            frame: frame_from_axis(Some(&self.rails.direction(index)), Some(&axis))?,
            locked: true,
            stiffness: prismatic_stiffness(self.drive_stiffness),
        })?;
        let hinge = frame_from_axis(Some(&axis), Some(span))?;
        let passive: [(_, _, &dyn Joint, _); 2] = [
            ("A", [Some(carriage), Some(rod)], &Revolute, hinge),
            (
                "S",
                [Some(rod), Some(PLATFORM)],
                &Spherical,
                Rotation3::identity(),
            ),
        ];
        for (word, between, joint, frame) in passive {
            parts.joint(&JointPart {
                name: name(word),
                at: name(word),
                between,
                joint,
                frame,
                locked: false,
                stiffness: constrained_stiffness(joint, self.joint_stiffness),
            })?;
        }
        Ok(())
    }
}

const PLATFORM: Name = Name::alone("platform");

/// Axis of the revolute joint of limb `index`.
fn hinge_axis(index: usize) -> Vector3<f64> {
    Vector3::z().cross(&outward(index, 0.0))
}

/// The carriages' points A and the platform at a pose.
struct Configuration {
    carriages: [Point3<f64>; LIMBS],
    platform: Platform,
}

impl Prebuilt for ThreePrs {
    fn kind(&self) -> &str {
        "ThreePrs"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::Z, PoseCoordinate::Rx, PoseCoordinate::Ry]
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        let configuration = self.configuration(pose)?;
        construction::model("3-PRS", PLATFORM, |parts| self.walk(&configuration, parts))
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        let configuration = self.configuration(pose)?;
        construction::place(geometry, |parts| self.walk(&configuration, parts))?;
        Ok(configuration.platform.pose)
    }
}
