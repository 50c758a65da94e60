//! Which bodies and joints a limb has, in the order of the model: the one table from which the
//! model is built and by which a pose is written into its geometry.

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
    /// Number of points of a limb.
    pub(super) const COUNT: usize = 7;

    /// Its name, without the limb's number.
    pub(super) fn name(self) -> &'static str {
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
pub(super) enum Part {
    Arm,
    Bar,
    Rod,
}

/// An elastic body of a limb.
#[derive(Debug)]
pub(super) struct LimbBody {
    /// Its name, without the limb's number.
    pub(super) name: &'static str,
    /// The points it runs through.
    pub(super) points: &'static [Point],
    /// What it is made of.
    pub(super) part: Part,
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

/// A body that a joint joins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Ground,
    /// Index in [`BODIES`].
    Limb(usize),
    Platform,
}

/// A joint of a limb, named after its point.
#[derive(Debug)]
pub(super) struct LimbJoint {
    pub(super) point: Point,
    pub(super) between: [Side; 2],
    pub(super) role: JointRole,
}

/// Number of limbs.
pub(super) const LIMBS: usize = 3;

const ARM: usize = 0;
const ELBOW: usize = 1;
const WRIST: usize = 2;
const ROD_A: usize = 3;
const ROD_B: usize = 4;

/// The bodies of a limb; all limbs' come first, then the platform.
pub(super) const BODIES: [LimbBody; 5] = [
    body("arm", &[Point::A, Point::B], Part::Arm),
    body("elbow", &[Point::Ba, Point::B, Point::Bb], Part::Bar),
    body("wrist", &[Point::Ca, Point::C, Point::Cb], Part::Bar),
    body("roda", &[Point::Ba, Point::Ca], Part::Rod),
    body("rodb", &[Point::Bb, Point::Cb], Part::Rod),
];

/// The joints of a limb.
pub(super) const JOINTS: [LimbJoint; 7] = [
    joint(Point::A, Side::Ground, Side::Limb(ARM), JointRole::Drive),
    joint(
        Point::B,
        Side::Limb(ARM),
        Side::Limb(ELBOW),
        JointRole::Elbow,
    ),
    joint(
        Point::Ba,
        Side::Limb(ELBOW),
        Side::Limb(ROD_A),
        JointRole::RodEnd,
    ),
    joint(
        Point::Ca,
        Side::Limb(WRIST),
        Side::Limb(ROD_A),
        JointRole::RodEnd,
    ),
    joint(
        Point::Bb,
        Side::Limb(ELBOW),
        Side::Limb(ROD_B),
        JointRole::RodEnd,
    ),
    joint(
        Point::Cb,
        Side::Limb(WRIST),
        Side::Limb(ROD_B),
        JointRole::RodEnd,
    ),
    joint(
        Point::C,
        Side::Limb(WRIST),
        Side::Platform,
        JointRole::Wrist,
    ),
];

/// Nodes of the platform: P and every limb's C.
const PLATFORM_NODES: usize = 1 + LIMBS;

/// Numbers of nodes, segments and joints of the whole mechanism.
pub(super) const COUNTS: [usize; 3] = {
    let (mut nodes, mut segments, mut k) = (0, 0, 0);
    while k < BODIES.len() {
        nodes += BODIES[k].points.len();
        segments += BODIES[k].points.len() - 1;
        k += 1;
    }
    [
        LIMBS * nodes + PLATFORM_NODES,
        LIMBS * segments,
        LIMBS * JOINTS.len(),
    ]
};

const fn body(name: &'static str, points: &'static [Point], part: Part) -> LimbBody {
    LimbBody { name, points, part }
}

const fn joint(point: Point, first: Side, second: Side, role: JointRole) -> LimbJoint {
    LimbJoint {
        point,
        between: [first, second],
        role,
    }
}
