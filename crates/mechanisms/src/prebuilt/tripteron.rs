//! The Tripteron (3-PRRR): parameters, model and poses.

use hyperstat_assembly::{Geometry, Model};
use hyperstat_joints::{Joint, Prismatic, Revolute, frame_from_axis};
use nalgebra::{Point3, Vector3};

use super::construction::{self, BeamPart, JointPart, Name, NamedPoint, Parts};
use super::limbs::{LIMBS, per_limb};
use super::two_links::TwoLinks;
use super::{
    ElbowSide, Link, ParameterError, PoseCoordinate, PoseError, Prebuilt, coordinates, parameter,
};

/// The Tripteron (3-PRRR): a platform that keeps its orientation, each of its coordinates moved
/// by one drive alone.
///
/// ```text
///   limb 1, seen against x              limb 1, seen against z
///
///   z        B                          y   ▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒  rail of limb 1, along x
///   │      ╱   ╲  distal                │         ┌─A─┐  carriage ◄─► the drive
///   │    ╱       ╲                      │           ║
///   │  A          C ─ platform          │           B
///   │ proximal                          │           ║
///   └─────────── y                      │   P ───── C
///                                       └─────────────── x
/// ```
///
/// Limb i belongs to axis i of x, y, z: its rail, a prismatic joint with a locked drive, and its
/// three revolute joints A, B and C are all along that axis, so it moves in a plane that the
/// carriage takes along. In that plane, with the next two axes in cyclic order as its own (y, z
/// for limb 1, z, x for limb 2, x, y for limb 3), the rail stands at `rail`. C lies at
/// `platform_radius` from the platform's centre P, against the limb's axis.
///
/// A pose is the position x, y, z (m) of P, which is the output. The orientation is constant.
///
/// | body | runs through | local y along |
/// |---|---|---|
/// | `proximal` | A, B | the limb's axis |
/// | `distal` | B, C | the limb's axis |
///
/// The rigid `carriage` holds A alone, the rigid `platform` P, C1, C2 and C3. The prismatic joint
/// is named `D` and sits at A, between the ground and `carriage`, x of its frame along the next
/// axis; the revolute joints are named as their points: `A` between `carriage` and `proximal`,
/// `B` between `proximal` and `distal`, `C` between `distal` and `platform`, x of their frames
/// along the link that ends there (at A, that begins). Names carry the limb's number.
///
/// Ten bodies and twelve joints give 0 by Grübler's count; the three limbs hold the three
/// rotations twice, so the mobility is 3 and the degree of over-constraint 3.
///
/// C. M. Gosselin, X. Kong, S. Foucault and I. A. Bonev, *A fully decoupled 3-dof translational
/// parallel mechanism*, 4th Chemnitz Parallel Kinematics Seminar (2004) 595–610.
#[derive(Debug, Clone, PartialEq)]
pub struct Tripteron {
    /// Place of a limb's rail in the plane normal to it (m).
    pub rail: (f64, f64),
    /// Distance of C from the platform's centre P against the limb's axis (m).
    pub platform_radius: f64,
    /// Length of the proximal links, A to B (m).
    pub proximal_length: f64,
    /// Length of the distal links, B to C (m).
    pub distal_length: f64,
    /// On which side of the line from A to C the elbows B stand.
    pub elbow: ElbowSide,
    /// Proximal links, A to B.
    pub proximal: Link,
    /// Distal links, B to C.
    pub distal: Link,
    /// Stiffness of every revolute joint in its directions x y z (N/m), u w (N·m/rad): `None` is
    /// rigid, zero frees a direction. v, the axis, must be `None`.
    pub joint_stiffness: [Option<f64>; 6],
    /// Stiffness of the drives along their rails (N/m); `None` or zero is locked rigidly. The
    /// rails are rigid in all other directions.
    pub drive_stiffness: Option<f64>,
    /// Number of beam elements a link is divided into.
    pub elements: usize,
}

impl Tripteron {
    /// Looks whether every parameter is in its physical range.
    ///
    /// # Errors
    /// The first that is not: a length that is not above zero, a negative radius or stiffness,
    /// a number that is not finite, a stiffness about the joints' axes, no element.
    pub fn check(&self) -> Result<(), ParameterError> {
        parameter::coordinate("rail", self.rail.0)?;
        parameter::coordinate("rail", self.rail.1)?;
        parameter::radius("platform_radius", self.platform_radius)?;
        parameter::positive_length("proximal_length", self.proximal_length)?;
        parameter::positive_length("distal_length", self.distal_length)?;
        parameter::joint_stiffness("joint_stiffness", &self.joint_stiffness)?;
        parameter::stiffness("drive_stiffness", self.drive_stiffness)?;
        parameter::elements("elements", self.elements)
    }

    fn configuration(&self, pose: &[f64]) -> Result<Configuration, PoseError> {
        self.check()?;
        let centre = coordinates::<3>(self.kind(), pose)?;
        let limbs = per_limb(|index| {
            // The limb's axis, and the two of its plane.
            let [along, first, second] = [0, 1, 2].map(|k| (index + k) % 3);
            let mut c = Vector3::from(centre);
            c[along] -= self.platform_radius;
            let mut a = Vector3::zeros();
            a[along] = c[along];
            a[first] = self.rail.0;
            a[second] = self.rail.1;
            let links = TwoLinks {
                limb: index + 1,
                proximal: self.proximal_length,
                distal: self.distal_length,
                side: self.elbow,
            };
            let elbow = links.elbow([c[first] - a[first], c[second] - a[second]])?;
            let mut b = a;
            b[first] += elbow[0];
            b[second] += elbow[1];
            Ok([a, b, c].map(Point3::from))
        })?;
        Ok(Configuration {
            centre: Point3::from(centre),
            limbs,
        })
    }

    fn walk(&self, configuration: &Configuration, parts: &mut dyn Parts) -> Result<(), PoseError> {
        for (index, limb) in configuration.limbs.iter().enumerate() {
            let name = |word| Name::limb(word, index);
            let [a, b, c] = named(index, limb);
            parts.rigid(name("carriage"), &[a])?;
            for (word, points, link) in [
                ("proximal", [a, b], &self.proximal),
                ("distal", [b, c], &self.distal),
            ] {
                parts.beam(&BeamPart {
                    name: name(word),
                    points: &points,
                    link,
                    y_axis: Vector3::ith(index, 1.0),
                    elements: self.elements,
                })?;
            }
        }
        let wrist = |index: usize| named(index, &configuration.limbs[index])[2];
        let centre = (Name::alone("P"), configuration.centre);
        parts.rigid(PLATFORM, &[centre, wrist(0), wrist(1), wrist(2)])?;
        for (index, limb) in configuration.limbs.iter().enumerate() {
            let name = |word| Name::limb(word, index);
            let axis = Vector3::ith(index, 1.0);
            let [a, b, c] = limb;
            let next = Vector3::ith((index + 1) % LIMBS, 1.0);
            let [carriage, proximal, distal] = ["carriage", "proximal", "distal"].map(name);
            let joints: [(_, &dyn Joint, _, _, _); 4] = [
                ("D", &Prismatic, "A", [None, Some(carriage)], next),
                ("A", &Revolute, "A", [Some(carriage), Some(proximal)], b - a),
                ("B", &Revolute, "B", [Some(proximal), Some(distal)], b - a),
                ("C", &Revolute, "C", [Some(distal), Some(PLATFORM)], c - b),
            ];
            for (word, joint, at, between, x_axis) in joints {
                let drive = word == "D";
                parts.joint(&JointPart {
                    name: name(word),
                    at: name(at),
                    between,
                    joint,
                    frame: frame_from_axis(Some(&axis), Some(&x_axis))?,
                    locked: drive,
                    stiffness: if drive {
                        construction::prismatic_stiffness(self.drive_stiffness)
                    } else {
                        self.joint_stiffness
                    },
                })?;
            }
        }
        Ok(())
    }
}

const PLATFORM: Name = Name::alone("platform");

/// The platform's centre, and A, B and C of every limb.
struct Configuration {
    centre: Point3<f64>,
    limbs: [[Point3<f64>; 3]; LIMBS],
}

fn named(index: usize, [a, b, c]: &[Point3<f64>; 3]) -> [NamedPoint; 3] {
    let name = |word| Name::limb(word, index);
    [(name("A"), *a), (name("B"), *b), (name("C"), *c)]
}

impl Prebuilt for Tripteron {
    fn kind(&self) -> &str {
        "Tripteron"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::X, PoseCoordinate::Y, PoseCoordinate::Z]
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        let configuration = self.configuration(pose)?;
        construction::model("tripteron", PLATFORM, |parts| {
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
