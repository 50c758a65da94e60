//! Which bodies and joints a limb has, in the order of the model.

use hyperstat_joints::{Joint, Revolute, Spherical};
use nalgebra::Point3;

use super::limb::{Limb, LimbAt};
use crate::prebuilt::PoseError;
use crate::prebuilt::construction::{
    BeamPart, Configuration, JointPart, Name, NamedPoint, PLATFORM, Parts, RIGID,
};
use crate::prebuilt::delta::{Delta, RodEnds};
use crate::prebuilt::limbs::LIMBS;
use crate::prebuilt::wide::{WideVector, point_at};

/// A point of a limb.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Point {
    A,
    B,
    Ba,
    Bb,
    C,
    Ca,
    Cb,
}

impl Point {
    /// Its name, without the limb's number.
    #[inline]
    fn name(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
            Self::Ba => "Ba",
            Self::Bb => "Bb",
            Self::C => "C",
            Self::Ca => "Ca",
            Self::Cb => "Cb",
        }
    }
}

/// Which of the parameters describes a link. An arm's local y is along the limb's axis, a bar's
/// and a rod's along the parallelogram's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Link {
    Arm,
    Bar,
    Rod,
}

/// Where a joint belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum JointRole {
    /// Ground to arm: locked, axis along the limb's, x outward.
    Drive,
    /// Arm to cross link: axis along the limb's, x along the arm.
    Elbow,
    /// Cross link to rod: axis along the parallelogram's, x along the rod.
    RodEnd,
    /// Cross link to platform: axis along the limb's, x along the rods.
    Wrist,
}

/// A delta with its platform's centre at `N` places.
pub(super) struct Posed<'a, const N: usize> {
    delta: &'a Delta,
    centre: WideVector<N>,
    limbs: [Limb<N>; LIMBS],
}

impl<'a, const N: usize> Posed<'a, N> {
    #[inline(always)]
    pub(super) fn new(delta: &'a Delta, centre: WideVector<N>) -> Self {
        let limbs = [
            Limb::new(delta, 0, &centre),
            Limb::new(delta, 1, &centre),
            Limb::new(delta, 2, &centre),
        ];
        Self {
            delta,
            centre,
            limbs,
        }
    }

    /// One of them.
    ///
    /// # Errors
    /// It cannot reach that place.
    #[inline(always)]
    pub(super) fn at(&self, pose: usize) -> Result<PosedAt<'_, N>, PoseError> {
        for limb in &self.limbs {
            if let Some(fault) = limb.fault(self.delta, pose) {
                return Err(fault);
            }
        }
        Ok(PosedAt {
            delta: self.delta,
            centre: point_at(&self.centre, pose),
            limbs: self.limbs.each_ref().map(|limb| limb.at(pose)),
        })
    }
}

/// A delta with its platform's centre at a place that it can reach.
pub(super) struct PosedAt<'a, const N: usize> {
    delta: &'a Delta,
    centre: Point3<f64>,
    limbs: [LimbAt<'a, N>; LIMBS],
}

impl<const N: usize> Configuration for PosedAt<'_, N> {
    #[inline]
    fn walk(&self, parts: &mut impl Parts) {
        for (index, limb) in self.limbs.iter().enumerate() {
            self.bodies(index, limb, parts);
        }
        let wrist = |index: usize| named(Point::C, index, &self.limbs[index]);
        let centre = (Name::alone("P"), self.centre);
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

impl<const N: usize> PosedAt<'_, N> {
    #[inline]
    fn bodies(&self, index: usize, limb: &LimbAt<'_, N>, parts: &mut impl Parts) {
        let point = |point| named(point, index, limb);
        let [a, b, c] = [point(Point::A), point(Point::B), point(Point::C)];
        let [ba, bb] = [point(Point::Ba), point(Point::Bb)];
        let [ca, cb] = [point(Point::Ca), point(Point::Cb)];
        parts.beam(self.beam("arm", [a, b], Link::Arm, index, limb));
        parts.beam(self.beam("elbow", [ba, b, bb], Link::Bar, index, limb));
        parts.beam(self.beam("wrist", [ca, c, cb], Link::Bar, index, limb));
        parts.beam(self.beam("roda", [ba, ca], Link::Rod, index, limb));
        parts.beam(self.beam("rodb", [bb, cb], Link::Rod, index, limb));
    }

    #[inline]
    fn beam<const M: usize>(
        &self,
        word: &'static str,
        points: [NamedPoint; M],
        part: Link,
        index: usize,
        limb: &LimbAt<'_, N>,
    ) -> BeamPart<'_, M> {
        BeamPart {
            name: Name::limb(word, index),
            points,
            link: match part {
                Link::Arm => ("arm", &self.delta.arm),
                Link::Bar => ("bar", &self.delta.bar),
                Link::Rod => ("rod", &self.delta.rod),
            },
            y_axis: limb.y_axis(part),
            elements: self.delta.elements,
        }
    }

    #[inline]
    fn joints(&self, index: usize, limb: &LimbAt<'_, N>, parts: &mut impl Parts) {
        let body = |word| Some(Name::limb(word, index));
        let (arm, elbow, wrist) = (body("arm"), body("elbow"), body("wrist"));
        let (roda, rodb) = (body("roda"), body("rodb"));
        let joint = |point, between, role| self.joint(point, between, role, index, limb);
        let drive = joint(Point::A, [None, arm], JointRole::Drive);
        parts.joint(drive.driven(self.delta.drive_stiffness));
        parts.joint(joint(Point::B, [arm, elbow], JointRole::Elbow));
        parts.joint(joint(Point::Ba, [elbow, roda], JointRole::RodEnd));
        parts.joint(joint(Point::Ca, [wrist, roda], JointRole::RodEnd));
        parts.joint(joint(Point::Bb, [elbow, rodb], JointRole::RodEnd));
        parts.joint(joint(Point::Cb, [wrist, rodb], JointRole::RodEnd));
        parts.joint(joint(Point::C, [wrist, Some(PLATFORM)], JointRole::Wrist));
    }

    #[inline]
    fn joint(
        &self,
        point: Point,
        between: [Option<Name>; 2],
        role: JointRole,
        index: usize,
        limb: &LimbAt<'_, N>,
    ) -> JointPart<'_> {
        let (joint, stiffness): (&'static dyn Joint, _) = match (role, self.delta.rod_ends) {
            (JointRole::RodEnd, RodEnds::Spherical) => (&Spherical, &RIGID),
            _ => (&Revolute, &self.delta.joint_stiffness),
        };
        let name = Name::limb(point.name(), index);
        JointPart::passive(joint, name, between, limb.frame(role), stiffness)
    }
}

#[inline]
fn named<const N: usize>(point: Point, index: usize, limb: &LimbAt<'_, N>) -> NamedPoint {
    (Name::limb(point.name(), index), limb.point(point))
}
