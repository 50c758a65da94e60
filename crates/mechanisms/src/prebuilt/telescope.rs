//! Telescopic legs: a cylinder, a piston and the drive between them.

use hyperstat_joints::{
    Joint, Prismatic, Revolute, Spherical, Universal, frame_from_axes, frame_from_axis,
};
use nalgebra::{Point3, Rotation3, Vector3};
use serde::Deserialize;

use super::construction::{
    BeamPart, JointPart, Name, NamedPoint, Parts, constrained_stiffness, prismatic_stiffness,
};
use super::{Link, ParameterError, PoseError, parameter};

/// How far, relative to its length, a leg may miss its shortest and longest length and still
/// count as having it.
const EDGE: f64 = 1e-12;

/// Smallest sine of the angle between a leg and the first axis of its universal joint.
const ALIGNED: f64 = 1e-9;

/// A leg that changes its length: a cylinder from the base joint B to its mouth M, where the
/// locked drive is, and from M to the platform joint S a piston, as far as it is out.
#[derive(Debug, Clone, PartialEq)]
pub struct TelescopicLeg {
    /// Cylinder, B to M.
    pub cylinder: Link,
    /// Piston, M to S.
    pub piston: Link,
    /// Length of the cylinder (m).
    pub cylinder_length: f64,
    /// Shortest and longest length of the leg, B to S (m). A pose that needs another is out of
    /// reach.
    pub lengths: (f64, f64),
}

/// The joint by which a leg or rod stands on the base or carriage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
pub enum FootJoint {
    /// A universal joint.
    #[default]
    Universal,
    /// A ball joint; the leg or rod may then spin about itself.
    Spherical,
}

impl TelescopicLeg {
    /// Looks whether every parameter is in its physical range.
    ///
    /// # Errors
    /// The first that is not: a length that is not above zero, a shortest length that leaves no
    /// piston, a longest length below the shortest.
    pub fn check(&self) -> Result<(), ParameterError> {
        parameter::positive_length("cylinder_length", self.cylinder_length)?;
        let (shortest, longest) = self.lengths;
        parameter::positive_length("lengths", shortest)?;
        parameter::positive_length("lengths", longest)?;
        if shortest <= self.cylinder_length {
            return Err(ParameterError {
                field: "lengths",
                message: format!(
                    "the shortest length, {shortest} m, is not above the cylinder's, {} m",
                    self.cylinder_length
                ),
                help: Some(
                    "a leg is its cylinder and the part of the piston that stands out".into(),
                ),
            });
        }
        if longest < shortest {
            return Err(ParameterError {
                field: "lengths",
                message: format!(
                    "the longest length, {longest} m, is below the shortest, {shortest} m"
                ),
                help: Some("give the shortest length first, `(shortest, longest)`".into()),
            });
        }
        Ok(())
    }
}

/// How a leg stands on the base.
#[derive(Debug, Clone, Copy)]
pub(super) enum Foot {
    /// By a universal joint with this first axis, fixed in the base.
    Universal(Vector3<f64>),
    /// By a revolute joint with this axis, normal to the leg.
    Revolute(Vector3<f64>),
    /// By a ball joint; the direction, and the leg, fix local y as those of a universal joint.
    Spherical(Vector3<f64>),
}

impl Foot {
    /// What `kind` is with this first axis.
    pub(super) fn new(kind: FootJoint, first_axis: Vector3<f64>) -> Self {
        match kind {
            FootJoint::Universal => Self::Universal(first_axis),
            FootJoint::Spherical => Self::Spherical(first_axis),
        }
    }

    pub(super) fn joint(&self) -> &'static dyn Joint {
        match self {
            Self::Universal(_) => &Universal,
            Self::Revolute(_) => &Revolute,
            Self::Spherical(_) => &Spherical,
        }
    }

    /// The joint's frame, and the direction of local y of what stands on it along `span`: the
    /// universal joint's second axis, or the revolute joint's. `what` names it in messages.
    pub(super) fn orient(
        &self,
        span: &Vector3<f64>,
        what: Name,
    ) -> Result<(Rotation3<f64>, Vector3<f64>), PoseError> {
        match self {
            Self::Universal(first) => {
                let second = second_axis(span, first, what)?;
                Ok((frame_from_axes(first, &second)?, second))
            }
            Self::Revolute(axis) => Ok((frame_from_axis(Some(axis), Some(span))?, *axis)),
            Self::Spherical(first) => Ok((Rotation3::identity(), second_axis(span, first, what)?)),
        }
    }
}

/// The second axis of a universal joint: along `span` × `first`, of unit length.
pub(super) fn second_axis(
    span: &Vector3<f64>,
    first: &Vector3<f64>,
    what: Name,
) -> Result<Vector3<f64>, PoseError> {
    let across = span.cross(first);
    if across.norm() <= ALIGNED * span.norm() * first.norm() {
        return Err(PoseError::Singular {
            what: format!("{what}: in line with the first axis of the universal joint"),
        });
    }
    Ok(across.normalize())
}

/// A telescopic leg at one pose: points `B`, `M`, `S`, bodies `cylinder` and `piston`, and
/// joints named as their points, all with the leg's number.
pub(super) struct Leg<'a> {
    index: usize,
    parameters: &'a TelescopicLeg,
    points: [Point3<f64>; 3],
    foot: Foot,
    foot_frame: Rotation3<f64>,
    y_axis: Vector3<f64>,
}

impl<'a> Leg<'a> {
    /// Leg `index` (from 0) from `base` to `platform`.
    pub(super) fn new(
        parameters: &'a TelescopicLeg,
        index: usize,
        foot: Foot,
        base: Point3<f64>,
        platform: Point3<f64>,
    ) -> Result<Self, PoseError> {
        let span = platform - base;
        let length = span.norm();
        let (shortest, longest) = parameters.lengths;
        let number = index + 1;
        if length.is_nan() || length > longest * (1.0 + EDGE) {
            return Err(PoseError::Unreachable {
                what: format!(
                    "leg {number}: S{number} is {length:.6} m from B{number}, where the leg \
                     reaches {longest:.6} m"
                ),
            });
        }
        if length < shortest * (1.0 - EDGE) {
            return Err(PoseError::Unreachable {
                what: format!(
                    "leg {number}: S{number} is {length:.6} m from B{number}, where the leg is \
                     no shorter than {shortest:.6} m"
                ),
            });
        }
        let mouth = base + span * (parameters.cylinder_length / length);
        let (foot_frame, y_axis) = foot.orient(&span, Name::limb("leg ", index))?;
        Ok(Self {
            index,
            parameters,
            points: [base, mouth, platform],
            foot,
            foot_frame,
            y_axis,
        })
    }

    fn name(&self, word: &'static str) -> Name {
        Name::limb(word, self.index)
    }

    fn points(&self) -> [NamedPoint; 3] {
        let [base, mouth, platform] = self.points;
        [
            (self.name("B"), base),
            (self.name("M"), mouth),
            (self.name("S"), platform),
        ]
    }

    /// The point that the platform has too.
    pub(super) fn platform_point(&self) -> NamedPoint {
        self.points()[2]
    }

    /// Adds cylinder and piston.
    pub(super) fn bodies(&self, parts: &mut dyn Parts, elements: usize) -> Result<(), PoseError> {
        let [base, mouth, platform] = self.points();
        for (word, points, link) in [
            ("cylinder", [base, mouth], &self.parameters.cylinder),
            ("piston", [mouth, platform], &self.parameters.piston),
        ] {
            parts.beam(&BeamPart {
                name: self.name(word),
                points: &points,
                link,
                y_axis: self.y_axis,
                elements,
            })?;
        }
        Ok(())
    }

    /// Adds the joints: B and S of `joint_stiffness` where they constrain, M of
    /// `drive_stiffness` along the leg.
    pub(super) fn joints(
        &self,
        parts: &mut dyn Parts,
        platform: Name,
        joint_stiffness: [Option<f64>; 6],
        drive_stiffness: Option<f64>,
    ) -> Result<(), PoseError> {
        let [cylinder, piston] = ["cylinder", "piston"].map(|word| self.name(word));
        let [base, mouth, _] = self.points;
        let foot = self.foot.joint();
        parts.joint(&JointPart {
            name: self.name("B"),
            at: self.name("B"),
            between: [None, Some(cylinder)],
            joint: foot,
            frame: self.foot_frame,
            locked: false,
            stiffness: constrained_stiffness(foot, joint_stiffness),
        })?;
        parts.joint(&JointPart {
            name: self.name("M"),
            at: self.name("M"),
            between: [Some(cylinder), Some(piston)],
            joint: &Prismatic,
            frame: frame_from_axis(Some(&(mouth - base)), Some(&self.y_axis))?,
            locked: true,
            stiffness: prismatic_stiffness(drive_stiffness),
        })?;
        parts.joint(&JointPart {
            name: self.name("S"),
            at: self.name("S"),
            between: [Some(piston), Some(platform)],
            joint: &Spherical,
            frame: Rotation3::identity(),
            locked: false,
            stiffness: constrained_stiffness(&Spherical, joint_stiffness),
        })
    }
}
