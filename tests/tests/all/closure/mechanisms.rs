//! The prebuilt mechanisms, each with a home pose and the range of its others.

use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
use hyperstat_mechanisms::prebuilt::{
    CarriageSide, Delta, ElbowSide, Exechon, FootJoint, Hexapod, LinearDelta, Link, Orthoglide,
    PlanarThreeRrr, Prebuilt, Rails, RodEnds, SphericalThreeRrr, TelescopicLeg, ThreePrs, ThreeRps,
    Tricept, Tripteron,
};

/// Bearings alike in all directions across their axis: the frames of a prebuilt and of its file
/// may be turned about it.
const BEARINGS: [Option<f64>; 6] = [Some(2e8), Some(2e8), Some(2e8), Some(2e5), None, Some(2e5)];
const BEARINGS_OF_DELTA: [Option<f64>; 6] =
    [Some(2e8), Some(3e8), Some(2e8), Some(2e5), None, Some(2e5)];

fn link(shape: SectionShape) -> Link {
    Link {
        section: Section::new(shape, None, None).expect("a valid section"),
        material: Material::new(2.1e11, Elasticity::Poisson(0.3), None).expect("steel"),
    }
}

fn round(diameter: f64) -> Link {
    link(SectionShape::Circle { diameter })
}

/// A section that is not alike in all directions, so that a wrong local y shows.
fn flat(width: f64, height: f64) -> Link {
    link(SectionShape::Rectangle { width, height })
}

/// A prebuilt mechanism under test.
pub struct Case {
    pub mechanism: Box<dyn Prebuilt>,
    /// The pose in which it is written out.
    pub home: Vec<f64>,
    /// How far other poses are from it, by coordinates.
    pub spans: Vec<f64>,
    /// Whether bodies can spin about themselves: their sections are then round.
    pub idle: bool,
    /// A point whose place on its line is another than the prebuilt's: where a housing ends.
    pub moved: Option<&'static str>,
}

fn case<const N: usize>(
    mechanism: impl Prebuilt + 'static,
    home: [f64; N],
    spans: [f64; N],
) -> Case {
    Case {
        mechanism: Box::new(mechanism),
        home: home.to_vec(),
        spans: spans.to_vec(),
        idle: false,
        moved: None,
    }
}

fn leg() -> TelescopicLeg {
    TelescopicLeg {
        cylinder: flat(0.03, 0.05),
        piston: flat(0.02, 0.03),
        cylinder_length: 0.36,
        lengths: (0.5, 1.3),
    }
}

fn rails() -> Rails {
    Rails {
        radius: 0.3,
        tilt: 0.0,
        travel: 0.8,
        carriage: CarriageSide::Near,
    }
}

pub fn delta() -> Delta {
    Delta {
        arm: flat(0.03, 0.04),
        bar: flat(0.02, 0.03),
        rod: flat(0.014, 0.02),
        joint_stiffness: BEARINGS_OF_DELTA,
        drive_stiffness: Some(1e5),
        ..Delta::paper()
    }
}

pub fn hexapod() -> Hexapod {
    Hexapod {
        base_radius: 0.5,
        base_angle: 0.125,
        platform_radius: 0.3,
        platform_angle: 0.45,
        base_joints: FootJoint::Universal,
        leg: leg(),
        joint_stiffness: BEARINGS,
        drive_stiffness: Some(1e7),
        elements: 1,
    }
}

pub fn tripteron() -> Tripteron {
    Tripteron {
        rail: (0.5, 0.3),
        platform_radius: 0.06,
        proximal_length: 0.35,
        distal_length: 0.40,
        elbow: ElbowSide::Left,
        proximal: flat(0.03, 0.05),
        distal: flat(0.03, 0.02),
        joint_stiffness: BEARINGS,
        drive_stiffness: Some(1e7),
        elements: 1,
    }
}

pub fn planar() -> PlanarThreeRrr {
    PlanarThreeRrr {
        base_radius: 0.30,
        platform_radius: 0.08,
        proximal_length: 0.22,
        distal_length: 0.25,
        elbow: ElbowSide::Left,
        proximal: flat(0.03, 0.02),
        distal: flat(0.02, 0.03),
        joint_stiffness: BEARINGS,
        drive_stiffness: Some(2e4),
        elements: 1,
    }
}

fn linear_delta() -> LinearDelta {
    LinearDelta {
        rails: rails(),
        platform_radius: 0.05,
        rod_length: 0.45,
        rod_spacing: 0.08,
        carriage_joints: FootJoint::Universal,
        rod: flat(0.012, 0.02),
        joint_stiffness: BEARINGS,
        drive_stiffness: Some(1e7),
        elements: 1,
    }
}

/// All prebuilt mechanisms that move.
pub fn cases() -> Vec<Case> {
    let idle = |case: Case| Case { idle: true, ..case };
    let high = [0.0, 0.0, 0.8, 0.0, 0.0, 0.0];
    let around = [0.12, 0.12, 0.1, 0.25, 0.25, 0.25];
    let cube = Hexapod {
        joint_stiffness: BEARINGS,
        ..Hexapod::cubic(
            0.6,
            TelescopicLeg {
                cylinder: round(0.04),
                piston: round(0.03),
                cylinder_length: 0.3,
                lengths: (0.4, 0.9),
            },
        )
        .expect("a cube")
    };
    let spherical = SphericalThreeRrr {
        radius: 0.1,
        base_angle: 1.0,
        platform_angle: 0.9,
        proximal_angle: 1.0,
        distal_angle: 1.1,
        elbow: ElbowSide::Left,
        proximal: flat(0.012, 0.010),
        distal: flat(0.010, 0.008),
        joint_stiffness: BEARINGS,
        drive_stiffness: Some(3e3),
        elements: 1,
    };
    vec![
        case(delta(), [0.0, 0.0, 0.5], [0.15, 0.15, 0.08]),
        idle(case(
            Delta {
                rod_ends: RodEnds::Spherical,
                rod: round(0.014),
                // The cross links turn about the line of their joints, too.
                bar: round(0.02),
                ..delta()
            },
            [0.0, 0.0, 0.5],
            [0.15, 0.15, 0.08],
        )),
        case(hexapod(), high, around),
        idle(case(
            cube,
            [0.0, 0.0, 0.6 / 3.0_f64.sqrt(), 0.0, 0.0, 0.0],
            [0.05, 0.05, 0.05, 0.2, 0.2, 0.2],
        )),
        case(linear_delta(), [0.0, 0.0, 0.7], [0.1, 0.1, 0.15]),
        idle(case(
            LinearDelta {
                carriage_joints: FootJoint::Spherical,
                rod: round(0.014),
                ..linear_delta()
            },
            [0.0, 0.0, 0.7],
            [0.1, 0.1, 0.15],
        )),
        case(
            Tricept {
                base_radius: 0.4,
                platform_radius: 0.18,
                leg: leg(),
                tube: flat(0.08, 0.06),
                spline: flat(0.07, 0.05),
                tube_length: 0.45,
                joint_stiffness: BEARINGS,
                drive_stiffness: Some(1e8),
                elements: 1,
            },
            [0.0, 0.0, 0.9],
            [0.3, 0.3, 0.15],
        ),
        case(
            ThreeRps {
                base_radius: 0.4,
                platform_radius: 0.25,
                leg: leg(),
                joint_stiffness: BEARINGS,
                drive_stiffness: Some(1e8),
                elements: 1,
            },
            [0.7, 0.0, 0.0],
            [0.12, 0.4, 0.4],
        ),
        case(
            ThreePrs {
                rails: Rails {
                    radius: 0.4,
                    ..rails()
                },
                platform_radius: 0.25,
                rod_length: 0.5,
                rod: flat(0.03, 0.05),
                joint_stiffness: BEARINGS,
                drive_stiffness: Some(1e8),
                elements: 1,
            },
            [0.85, 0.0, 0.0],
            [0.1, 0.3, 0.3],
        ),
        case(planar(), [0.0, 0.0, 0.0], [0.08, 0.08, 0.4]),
        case(spherical, [0.0, 0.0, 0.5], [0.3, 0.3, 0.3]),
        case(tripteron(), [0.0, 0.0, 0.0], [0.12, 0.12, 0.12]),
        case(
            Orthoglide {
                platform_radius: 0.05,
                rod_length: 0.31,
                rod_spacing: 0.08,
                bar: flat(0.02, 0.03),
                rod: flat(0.014, 0.02),
                joint_stiffness: BEARINGS_OF_DELTA,
                drive_stiffness: Some(1e7),
                elements: 1,
            },
            [0.0, 0.0, 0.0],
            [0.1, 0.1, 0.1],
        ),
        Case {
            moved: Some("M"),
            ..case(
                Exechon {
                    base_width: 0.9,
                    base_depth: 0.5,
                    platform_width: 0.3,
                    platform_depth: 0.18,
                    housing: flat(0.08, 0.06),
                    ram: flat(0.08, 0.06),
                    joint_stiffness: BEARINGS,
                    drive_stiffness: Some(1e8),
                    elements: 1,
                },
                [0.0, 0.0, 0.9],
                [0.3, 0.3, 0.2],
            )
        },
    ]
}
