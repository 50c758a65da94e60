//! Telescopic legs: a cylinder, a piston and the drive between them.

use hyperstat_joints::{Joint, Prismatic, Revolute, Spherical, Universal};
use nalgebra::{Point3, Rotation3, Vector3};
use serde::Deserialize;

use super::construction::{BeamPart, JointPart, Name, NamedPoint, PLATFORM, Parts, RIGID};
use super::error::shown;
use super::frames::frame;
use crate::prebuilt::{Link, ParameterError, PoseError, parameter};

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

/// How a leg or rod stands on the base or carriage.
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
    /// What `kind` is with this first axis, a unit vector.
    #[inline]
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

    /// The direction of local y of what stands on it along the unit vector `along`: the universal joint's
    /// second axis, or the revolute joint's. `what` names it in messages.
    #[inline(always)]
    pub(super) fn y_axis(
        &self,
        along: &Vector3<f64>,
        what: Name,
    ) -> Result<Vector3<f64>, PoseError> {
        match self {
            Self::Universal(first) | Self::Spherical(first) => second_axis(along, first, what),
            Self::Revolute(axis) => Ok(*axis),
        }
    }

    /// The joint's frame, of what stands on it along `along` with this local y.
    #[inline]
    pub(super) fn frame(&self, along: &Vector3<f64>, y_axis: &Vector3<f64>) -> Rotation3<f64> {
        match self {
            Self::Universal(first) => frame(first, y_axis),
            Self::Revolute(axis) => frame(along, axis),
            Self::Spherical(_) => Rotation3::identity(),
        }
    }
}

/// The second axis of a universal joint: the unit vector along `along` × `first`, both of which
/// are unit vectors.
#[inline(always)]
pub(super) fn second_axis(
    along: &Vector3<f64>,
    first: &Vector3<f64>,
    what: Name,
) -> Result<Vector3<f64>, PoseError> {
    let across = along.cross(first);
    if across.norm_squared() <= ALIGNED * ALIGNED {
        return Err(PoseError::singular(format!(
            "{what}: in line with the first axis of the universal joint"
        )));
    }
    // Normal to the first axis to rounding, however near the two are.
    let across = across - first * first.dot(&across);
    Ok(across.normalize())
}

/// A telescopic leg at one pose: points `B`, `M`, `S`, bodies `cylinder` and `piston`, and
/// joints named as their points, all with the leg's number.
pub(super) struct Leg {
    index: usize,
    /// B, M and S.
    points: [Point3<f64>; 3],
    foot: Foot,
    along: Vector3<f64>,
    y_axis: Vector3<f64>,
}

impl Leg {
    /// Leg `index` (from 0) from `base` to `platform`.
    #[inline(always)]
    pub(super) fn new(
        parameters: &TelescopicLeg,
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
            return Err(PoseError::unreachable(format!(
                "leg {number}: S{number} is {} m from B{number}, where the leg reaches {} m",
                shown(length),
                shown(longest),
            )));
        }
        if length < shortest * (1.0 - EDGE) {
            return Err(PoseError::unreachable(format!(
                "leg {number}: S{number} is {} m from B{number}, where the leg is no shorter \
                 than {} m",
                shown(length),
                shown(shortest),
            )));
        }
        let along = span / length;
        let y_axis = foot.y_axis(&along, Name::limb("leg ", index))?;
        Ok(Self {
            index,
            points: [base, base + along * parameters.cylinder_length, platform],
            foot,
            along,
            y_axis,
        })
    }

    #[inline]
    fn name(&self, word: &'static str) -> Name {
        Name::limb(word, self.index)
    }

    /// The point that the platform has too.
    #[inline]
    pub(super) fn platform_point(&self) -> NamedPoint {
        let [_, _, platform] = self.points;
        (self.name("S"), platform)
    }

    /// Adds cylinder and piston.
    #[inline]
    pub(super) fn bodies(
        &self,
        parts: &mut impl Parts,
        parameters: &TelescopicLeg,
        elements: usize,
    ) {
        let [base, mouth, _] = self.points;
        let mouth = (self.name("M"), mouth);
        parts.beam(BeamPart {
            name: self.name("cylinder"),
            points: [(self.name("B"), base), mouth],
            link: ("leg.cylinder", &parameters.cylinder),
            y_axis: self.y_axis,
            elements,
        });
        parts.beam(BeamPart {
            name: self.name("piston"),
            points: [mouth, self.platform_point()],
            link: ("leg.piston", &parameters.piston),
            y_axis: self.y_axis,
            elements,
        });
    }

    /// Adds the joints: B and S of `given` stiffness, M of `drive` along the leg.
    #[inline]
    pub(super) fn joints(
        &self,
        parts: &mut impl Parts,
        given: &[Option<f64>; 6],
        drive: Option<f64>,
    ) {
        let (cylinder, piston) = (Some(self.name("cylinder")), Some(self.name("piston")));
        let ball = Rotation3::identity();
        let joint = |joint: &'static dyn Joint, word, between, frame, stiffness| {
            JointPart::passive(joint, self.name(word), between, frame, stiffness)
        };
        parts.joint(joint(
            self.foot.joint(),
            "B",
            [None, cylinder],
            self.foot.frame(&self.along, &self.y_axis),
            given,
        ));
        let slide = joint(
            &Prismatic,
            "M",
            [cylinder, piston],
            frame(&self.y_axis, &self.along),
            &RIGID,
        );
        parts.joint(slide.driven(drive));
        parts.joint(joint(
            &Spherical,
            "S",
            [piston, Some(PLATFORM)],
            ball,
            given,
        ));
    }
}
