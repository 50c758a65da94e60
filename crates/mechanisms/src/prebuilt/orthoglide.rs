//! The Orthoglide (3-PRPaR): parameters, model and poses.

use hyperstat_joints::{Prismatic, Revolute};
use hyperstat_model::{Geometry, Model, ValuePlace};
use nalgebra::{Point3, Vector3};

use super::construction::{
    BeamPart, Configuration, JointPart, Name, NamedPoint, PLATFORM, Parts, RIGID,
};
use super::error::shown;
use super::frames::frame;
use super::limbs::{LIMBS, per_limb};
use crate::prebuilt::{
    Link, ParameterError, PoseCoordinate, PoseError, Prebuilt, ROTATION, construction, coordinates,
    parameter,
};

/// How far, relative to the rods' length, a pose may miss the edge of a limb's reach and still
/// count as on it (rods normal to the rail). Loops then close to this, not to rounding.
const EDGE: f64 = 1e-12;

/// The Orthoglide (3-PRPaR): a platform that keeps its orientation, on three parallelograms whose
/// drives slide along x, y and z.
///
/// ```text
///   y                        Limb 1 seen against z, with the platform on the rail's line:
///   │     Ab ═══ rodb ═══ Cb
///   │     ║               ║      D, the drive, slides along x and is locked; A and C
///   │ ─►D A               C ─ P  are revolute joints along y, Aa, Ab, Ca and Cb along
///   │     ║               ║      the normal of the parallelogram.
///   │     Aa ═══ roda ═══ Ca     Aa–Ab is rod_spacing, Aa–Ca rod_length, C–P
///   │                            platform_radius.
///   └────────────────── x
/// ```
///
/// Limb i belongs to axis i of x, y, z: its rail is that axis, and its revolute joints A and C
/// are along the next one in cyclic order (y for limb 1, z for limb 2, x for limb 3). The rods
/// run from the carriage towards the axis' positive side.
///
/// A pose is the position x, y, z (m) of the platform's centre P, which is the output. The
/// orientation is constant. With P at the origin the rods are along the rails, every drive moves
/// its own coordinate alone, and all limbs are alike.
///
/// | body | runs through | local y along |
/// |---|---|---|
/// | `shoulder` | Aa, A, Ab | the parallelogram's axes |
/// | `wrist` | Ca, C, Cb | the parallelogram's axes |
/// | `roda` | Aa, Ca | the parallelogram's axes |
/// | `rodb` | Ab, Cb | the parallelogram's axes |
///
/// | joint | between | axis (y of its frame) | x of its frame |
/// |---|---|---|---|
/// | `D`, prismatic | ground, `carriage` | the rail | the axis of A |
/// | `A` | `carriage`, `shoulder` | the next axis | along the rods, made normal to it |
/// | `Aa`, `Ca` | `shoulder` or `wrist`, `roda` | the parallelogram's | along the rods |
/// | `Ab`, `Cb` | `shoulder` or `wrist`, `rodb` | the parallelogram's | along the rods |
/// | `C` | `wrist`, `platform` | the next axis | along the rods, made normal to it |
///
/// The rigid `carriage` holds A alone (D sits there too), the rigid `platform` P, C1, C2 and C3;
/// a is the side against the next axis, b the other. Names carry the limb's number.
///
/// Sixteen bodies and 21 joints give −9 by Grübler's count: the mobility is 3 and the degree of
/// over-constraint 12, three in each parallelogram and three between the limbs.
///
/// P. Wenger and D. Chablat, *Kinematic analysis of a new parallel machine tool: the Orthoglide*,
/// Advances in Robot Kinematics (2000) 305–314; D. Chablat and P. Wenger, *Architecture
/// optimization of a 3-DOF translational parallel mechanism for machining applications, the
/// Orthoglide*, IEEE Transactions on Robotics and Automation 19 (2003) 403–410.
#[derive(Debug, Clone, PartialEq)]
pub struct Orthoglide {
    /// Distance of the wrists C from the platform's centre P, against the limb's axis (m).
    pub platform_radius: f64,
    /// Length of the rods (m).
    pub rod_length: f64,
    /// Distance between the two rods of a limb (m).
    pub rod_spacing: f64,
    /// Cross links, Aa to Ab and Ca to Cb.
    pub bar: Link,
    /// Rods, Aa to Ca and Ab to Cb.
    pub rod: Link,
    /// Stiffness of every revolute joint in its directions x y z (N/m), u w (N·m/rad): `None` is
    /// rigid, zero frees a direction. v, the axis, must be `None`.
    pub joint_stiffness: [Option<f64>; 6],
    /// Stiffness of the drives along their rails (N/m); `None` or zero is locked rigidly. The
    /// rails are rigid in all other directions.
    pub drive_stiffness: Option<f64>,
    /// Number of beam elements a segment is divided into.
    pub elements: usize,
}

impl Orthoglide {
    /// Looks whether every parameter is in its physical range.
    ///
    /// # Errors
    /// The first that is not: a length that is not above zero, a negative radius or stiffness,
    /// a number that is not finite, a stiffness about the joints' axes, no element.
    pub fn check(&self) -> Result<(), ParameterError> {
        parameter::radius("platform_radius", self.platform_radius)?;
        parameter::positive_length("rod_length", self.rod_length)?;
        parameter::positive_length("rod_spacing", self.rod_spacing)?;
        parameter::joint_stiffness("joint_stiffness", &self.joint_stiffness)?;
        parameter::stiffness("drive_stiffness", self.drive_stiffness)?;
        parameter::elements("elements", self.elements)
    }

    /// The limbs with the platform's centre at a pose.
    #[inline]
    fn at(&self, pose: &[f64]) -> Result<Posed<'_>, PoseError> {
        self.check()?;
        let centre = Vector3::from(coordinates::<3>(self.kind(), pose)?);
        Ok(Posed {
            orthoglide: self,
            centre: Point3::from(centre),
            limbs: per_limb(|index| self.limb(index, &centre))?,
        })
    }

    #[inline]
    fn limb(&self, index: usize, centre: &Vector3<f64>) -> Result<Limb, PoseError> {
        let (rail, axis) = (
            Vector3::ith(index, 1.0),
            Vector3::ith((index + 1) % LIMBS, 1.0),
        );
        let number = index + 1;
        let c = centre - rail * self.platform_radius;
        let lateral = c - rail * c.dot(&rail);
        let distance = lateral.norm();
        let length = self.rod_length;
        let edge = EDGE * length;
        if distance > length + edge {
            return Err(PoseError::unreachable(format!(
                "limb {number}: point C{number} lies {} m beside the rail, too far for rods of \
                 {} m",
                shown(distance),
                shown(length),
            )));
        }
        let advance = ((length - distance) * (length + distance)).max(0.0).sqrt();
        let rod = lateral + rail * advance;
        let across = rod - axis * rod.dot(&axis);
        let across_length = across.norm();
        if across_length <= edge {
            return Err(PoseError::singular(format!(
                "limb {number}: the rods lie along the axes of A{number} and C{number}, so the \
                 parallelogram has no plane"
            )));
        }
        let across = across / across_length;
        let parallelogram_axis = across.cross(&axis);
        let (a, c) = (Point3::from(c - rod), Point3::from(c));
        let half = axis * (0.5 * self.rod_spacing);
        Ok(Limb {
            shoulder: [a - half, a, a + half],
            wrist: [c - half, c, c + half],
            parallelogram_axis,
            rail,
            axis,
            across,
            rod: rod.normalize(),
        })
    }
}

/// A limb at a pose.
struct Limb {
    /// Aa, A and Ab.
    shoulder: [Point3<f64>; 3],
    /// Ca, C and Cb.
    wrist: [Point3<f64>; 3],
    /// Along the joints at the ends of the rods.
    parallelogram_axis: Vector3<f64>,
    /// Along the rail, and along the joints A and C.
    rail: Vector3<f64>,
    axis: Vector3<f64>,
    /// Along the rods as seen along that axis.
    across: Vector3<f64>,
    /// Along the rods.
    rod: Vector3<f64>,
}

/// An Orthoglide at a pose.
struct Posed<'a> {
    orthoglide: &'a Orthoglide,
    centre: Point3<f64>,
    limbs: [Limb; LIMBS],
}

impl Configuration for Posed<'_> {
    #[inline]
    fn walk(&self, parts: &mut impl Parts) {
        for (index, limb) in self.limbs.iter().enumerate() {
            self.bodies(index, limb, parts);
        }
        let centre = (Name::alone("P"), self.centre);
        let wrist = |index| (Name::limb("C", index), self.limbs[index].wrist[1]);
        parts.rigid(PLATFORM, [centre, wrist(0), wrist(1), wrist(2)]);
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
    fn bodies(&self, index: usize, limb: &Limb, parts: &mut impl Parts) {
        let name = |word| Name::limb(word, index);
        let [aa, a, ab] = limb.shoulder;
        let shoulder = [(name("Aa"), aa), (name("A"), a), (name("Ab"), ab)];
        let [ca, c, cb] = limb.wrist;
        let wrist = [(name("Ca"), ca), (name("C"), c), (name("Cb"), cb)];
        self.beam("shoulder", shoulder, index, limb, parts);
        self.beam("wrist", wrist, index, limb, parts);
        self.beam("roda", [shoulder[0], wrist[0]], index, limb, parts);
        self.beam("rodb", [shoulder[2], wrist[2]], index, limb, parts);
        parts.rigid(name("carriage"), [shoulder[1]]);
    }

    /// Adds a rod between two points, a bar through three.
    #[inline]
    fn beam<const N: usize>(
        &self,
        word: &'static str,
        points: [NamedPoint; N],
        index: usize,
        limb: &Limb,
        parts: &mut impl Parts,
    ) {
        parts.beam(BeamPart {
            name: Name::limb(word, index),
            points,
            link: match N {
                2 => ("rod", &self.orthoglide.rod),
                _ => ("bar", &self.orthoglide.bar),
            },
            y_axis: limb.parallelogram_axis,
            elements: self.orthoglide.elements,
        });
    }

    #[inline]
    fn joints(&self, index: usize, limb: &Limb, parts: &mut impl Parts) {
        let name = |word| Name::limb(word, index);
        let body = |word| Some(name(word));
        let (shoulder, wrist) = (body("shoulder"), body("wrist"));
        let (roda, rodb, carriage) = (body("roda"), body("rodb"), body("carriage"));
        let slide = frame(&limb.axis, &limb.rail);
        let turn = frame(&limb.across, &limb.axis);
        let rod_end = frame(&limb.rod, &limb.parallelogram_axis);
        let slide = JointPart::passive(&Prismatic, name("D"), [None, carriage], slide, &RIGID);
        let slide = slide.at(name("A"));
        parts.joint(slide.driven(self.orthoglide.drive_stiffness));
        let given = &self.orthoglide.joint_stiffness;
        let joint =
            |word, between, frame| JointPart::passive(&Revolute, name(word), between, frame, given);
        parts.joint(joint("A", [carriage, shoulder], turn));
        parts.joint(joint("Aa", [shoulder, roda], rod_end));
        parts.joint(joint("Ca", [wrist, roda], rod_end));
        parts.joint(joint("Ab", [shoulder, rodb], rod_end));
        parts.joint(joint("Cb", [wrist, rodb], rod_end));
        parts.joint(joint("C", [wrist, Some(PLATFORM)], turn));
    }
}

impl Prebuilt for Orthoglide {
    fn kind(&self) -> &str {
        "Orthoglide"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::X, PoseCoordinate::Y, PoseCoordinate::Z]
    }

    fn zero_coordinates(&self) -> &'static [PoseCoordinate] {
        ROTATION
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        construction::model("orthoglide", &self.at(pose)?)
    }

    fn origins(&self, pose: &[f64]) -> Result<Vec<(ValuePlace, String)>, PoseError> {
        Ok(construction::origins(&self.at(pose)?))
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        construction::place(geometry, &self.at(pose)?)
    }
}
