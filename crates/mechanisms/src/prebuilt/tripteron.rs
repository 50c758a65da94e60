//! The Tripteron (3-PRRR): parameters, model and poses.

use hyperstat_joints::{Prismatic, Revolute};
use hyperstat_model::{Geometry, Model, ValuePlace};
use nalgebra::{Point3, Vector3};

use super::construction::{BeamPart, Configuration, JointPart, Name, PLATFORM, Parts, RIGID};
use super::frames::frame;
use super::limbs::{LIMBS, per_limb};
use super::two_links::{TwoLinks, joints_of};
use crate::prebuilt::{
    ElbowSide, Link, ParameterError, PoseCoordinate, PoseError, Prebuilt, ROTATION, construction,
    coordinates, parameter,
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

    /// The limbs with the platform's centre at a pose.
    #[inline]
    fn at(&self, pose: &[f64]) -> Result<Posed<'_>, PoseError> {
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
            let axis = Vector3::ith(along, 1.0);
            Ok(Limb {
                points: [Point3::from(a), Point3::from(b), Point3::from(c)],
                axis,
                beside: Vector3::ith(first, 1.0),
                proximal: (b - a).normalize(),
                distal: (c - b).normalize(),
            })
        })?;
        Ok(Posed {
            tripteron: self,
            centre: Point3::from(centre),
            limbs,
        })
    }
}

/// A limb at a pose.
struct Limb {
    /// A, B and C.
    points: [Point3<f64>; 3],
    /// Along all joints.
    axis: Vector3<f64>,
    /// Along the first axis of the limb's plane.
    beside: Vector3<f64>,
    /// Along the links.
    proximal: Vector3<f64>,
    distal: Vector3<f64>,
}

/// A Tripteron at a pose.
struct Posed<'a> {
    tripteron: &'a Tripteron,
    centre: Point3<f64>,
    limbs: [Limb; LIMBS],
}

impl Configuration for Posed<'_> {
    #[inline]
    fn walk(&self, parts: &mut impl Parts) {
        let tripteron = self.tripteron;
        for (index, limb) in self.limbs.iter().enumerate() {
            let [a, b, c] = joints_of(limb.points, index);
            parts.rigid(Name::limb("carriage", index), [a]);
            let link = |word, points, link| BeamPart {
                name: Name::limb(word, index),
                points,
                link,
                y_axis: limb.axis,
                elements: tripteron.elements,
            };
            parts.beam(link("proximal", [a, b], ("proximal", &tripteron.proximal)));
            parts.beam(link("distal", [b, c], ("distal", &tripteron.distal)));
        }
        let centre = (Name::alone("P"), self.centre);
        let c = |index: usize| joints_of(self.limbs[index].points, index)[2];
        parts.rigid(PLATFORM, [centre, c(0), c(1), c(2)]);
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
        let (proximal, distal) = (Some(name("proximal")), Some(name("distal")));
        let carriage = Some(name("carriage"));
        let rail = frame(&limb.beside, &limb.axis);
        let along = frame(&limb.proximal, &limb.axis);
        let beyond = frame(&limb.distal, &limb.axis);
        let slide = JointPart::passive(&Prismatic, name("D"), [None, carriage], rail, &RIGID);
        let slide = slide.at(name("A"));
        parts.joint(slide.driven(self.tripteron.drive_stiffness));
        let given = &self.tripteron.joint_stiffness;
        let joint =
            |word, between, frame| JointPart::passive(&Revolute, name(word), between, frame, given);
        parts.joint(joint("A", [carriage, proximal], along));
        parts.joint(joint("B", [proximal, distal], along));
        parts.joint(joint("C", [distal, Some(PLATFORM)], beyond));
    }
}

impl Prebuilt for Tripteron {
    fn kind(&self) -> &str {
        "Tripteron"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::X, PoseCoordinate::Y, PoseCoordinate::Z]
    }

    fn zero_coordinates(&self) -> &'static [PoseCoordinate] {
        ROTATION
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        construction::model("tripteron", &self.at(pose)?)
    }

    fn origins(&self, pose: &[f64]) -> Result<Vec<(ValuePlace, String)>, PoseError> {
        Ok(construction::origins(&self.at(pose)?))
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        construction::place(geometry, &self.at(pose)?)
    }
}
