//! The mechanisms under test, with some of their poses.

use hyperstat_assembly::{Model, Solution, solve};
use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
use hyperstat_mechanisms::prebuilt::{
    CarriageSide, FootJoint, Hexapod, LinearDelta, Link, Prebuilt, Rails, TelescopicLeg, ThreePrs,
    ThreeRps, Tricept,
};
use nalgebra::{Point3, Vector6};

/// Elastic joints, each direction with another stiffness.
pub const BEARINGS: [Option<f64>; 6] =
    [Some(1e8), Some(2e8), Some(3e8), Some(1e5), None, Some(2e5)];

fn link(shape: SectionShape) -> Link {
    Link {
        section: Section::new(shape, None, None).expect("a valid section"),
        material: Material::new(2.1e11, Elasticity::Poisson(0.3), None).expect("steel"),
    }
}

pub fn round(diameter: f64) -> Link {
    link(SectionShape::Circle { diameter })
}

pub fn tube(outer: f64, inner: f64) -> Link {
    link(SectionShape::Tube { outer, inner })
}

/// A section that is not alike in all directions, so that a wrong local y shows.
pub fn flat(width: f64, height: f64) -> Link {
    link(SectionShape::Rectangle { width, height })
}

pub fn leg() -> TelescopicLeg {
    TelescopicLeg {
        cylinder: flat(0.03, 0.05),
        piston: round(0.018),
        cylinder_length: 0.36,
        lengths: (0.5, 1.3),
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
        joint_stiffness: [None; 6],
        drive_stiffness: None,
        elements: 1,
    }
}

pub const EDGE: f64 = 0.6;

pub fn cubic() -> Hexapod {
    let leg = TelescopicLeg {
        cylinder_length: 0.3,
        lengths: (0.4, 0.9),
        ..leg()
    };
    Hexapod::cubic(EDGE, leg).expect("a cube")
}

pub fn linear_delta() -> LinearDelta {
    LinearDelta {
        rails: Rails {
            radius: 0.3,
            tilt: 0.0,
            travel: 0.8,
            carriage: CarriageSide::Near,
        },
        platform_radius: 0.05,
        rod_length: 0.45,
        rod_spacing: 0.08,
        carriage_joints: FootJoint::Universal,
        rod: flat(0.012, 0.02),
        joint_stiffness: [None; 6],
        drive_stiffness: None,
        elements: 1,
    }
}

/// The Tricept of `tests/reference`, turned by 90° about z.
pub fn tricept() -> Tricept {
    Tricept {
        base_radius: 0.4,
        platform_radius: 0.18,
        leg: TelescopicLeg {
            cylinder: round(0.03),
            piston: round(0.03),
            ..leg()
        },
        tube: tube(0.08, 0.06),
        spline: tube(0.08, 0.06),
        tube_length: 0.45,
        joint_stiffness: [None; 6],
        drive_stiffness: None,
        elements: 1,
    }
}

pub fn three_rps() -> ThreeRps {
    ThreeRps {
        base_radius: 0.4,
        platform_radius: 0.25,
        leg: leg(),
        joint_stiffness: [None; 6],
        drive_stiffness: None,
        elements: 1,
    }
}

pub fn three_prs() -> ThreePrs {
    ThreePrs {
        rails: Rails {
            radius: 0.4,
            ..linear_delta().rails
        },
        platform_radius: 0.25,
        rod_length: 0.5,
        rod: flat(0.03, 0.05),
        joint_stiffness: [None; 6],
        drive_stiffness: None,
        elements: 1,
    }
}

/// A mechanism with some of its poses and the counts that the literature gives it.
pub struct Case {
    pub mechanism: Box<dyn Prebuilt>,
    pub poses: Vec<Vec<f64>>,
    /// How far from the first pose others are in reach.
    pub span: f64,
    /// Mobility, degree of over-constraint and idle motions.
    pub counts: [usize; 3],
}

fn case<const N: usize>(
    mechanism: impl Prebuilt + 'static,
    poses: &[[f64; N]],
    span: f64,
    counts: [usize; 3],
) -> Case {
    Case {
        mechanism: Box::new(mechanism),
        poses: poses.iter().map(|pose| pose.to_vec()).collect(),
        span,
        counts,
    }
}

pub fn cases() -> Vec<Case> {
    let full = [
        [0.0, 0.0, 0.8, 0.0, 0.0, 0.0],
        [0.05, -0.03, 0.8, 0.0, 0.0, 0.0],
        [0.1, 0.05, 0.75, 0.2, -0.15, 0.3],
        [-0.08, 0.1, 0.9, -0.3, 0.1, -0.2],
    ];
    let corner = [
        [0.0, 0.0, EDGE / 3.0_f64.sqrt(), 0.0, 0.0, 0.0],
        [0.03, -0.02, 0.36, 0.1, -0.1, 0.15],
    ];
    let above = [[0.0, 0.0, 0.7], [0.08, -0.05, 0.8], [-0.06, 0.1, 0.6]];
    let leaning = [[0.0, 0.0, 0.1], [0.05, -0.04, 0.15], [-0.06, 0.05, 0.05]];
    let around = [[0.0, 0.0, 0.9], [-0.05, 0.1, 0.9], [0.25, 0.2, 0.95]];
    let tilts = [[0.7, 0.0, 0.0], [0.7, 0.2, -0.1], [0.65, -0.3, 0.25]];
    let high = tilts.map(|[z, rx, ry]| [z + 0.2, rx, ry]);
    let low = tilts.map(|[z, rx, ry]| [z - 0.5, 0.5 * rx, 0.5 * ry]);
    let hanging = Rails {
        radius: 0.5,
        tilt: 0.5,
        travel: 1.2,
        carriage: CarriageSide::Far,
    };
    vec![
        case(hexapod(), &full, 0.15, [6, 0, 0]),
        case(
            Hexapod {
                joint_stiffness: BEARINGS,
                drive_stiffness: Some(1e7),
                elements: 2,
                ..hexapod()
            },
            &full,
            0.15,
            [6, 0, 0],
        ),
        case(cubic(), &corner, 0.05, [12, 0, 6]),
        case(linear_delta(), &above, 0.08, [3, 0, 0]),
        case(
            LinearDelta {
                rails: hanging.clone(),
                rod_length: 0.6,
                joint_stiffness: BEARINGS,
                drive_stiffness: Some(1e7),
                elements: 2,
                ..linear_delta()
            },
            &leaning,
            0.08,
            [3, 0, 0],
        ),
        case(
            LinearDelta {
                carriage_joints: FootJoint::Spherical,
                ..linear_delta()
            },
            &above,
            0.08,
            [9, 0, 6],
        ),
        case(tricept(), &around, 0.2, [3, 0, 0]),
        case(
            Tricept {
                leg: leg(),
                tube: flat(0.08, 0.06),
                joint_stiffness: BEARINGS,
                drive_stiffness: Some(1e8),
                elements: 2,
                ..tricept()
            },
            &around,
            0.2,
            [3, 0, 0],
        ),
        case(three_rps(), &tilts, 0.15, [3, 0, 0]),
        case(
            ThreeRps {
                joint_stiffness: BEARINGS,
                drive_stiffness: Some(1e8),
                elements: 2,
                ..three_rps()
            },
            &tilts,
            0.15,
            [3, 0, 0],
        ),
        case(three_prs(), &high, 0.15, [3, 0, 0]),
        case(
            ThreePrs {
                rails: hanging,
                rod_length: 0.6,
                joint_stiffness: BEARINGS,
                drive_stiffness: Some(1e8),
                elements: 2,
                ..three_prs()
            },
            &low,
            0.1,
            [3, 0, 0],
        ),
    ]
}

pub fn loaded(mechanism: &dyn Prebuilt, pose: &[f64]) -> Model {
    let mut model = mechanism
        .model(pose)
        .unwrap_or_else(|error| panic!("{} {pose:?}: {error}", mechanism.kind()));
    let output = model.output().expect("an output");
    let wrench = Vector6::new(-20.0, 10.0, 100.0, 5.0, 5.0, 8.0);
    model.add_load(output, wrench).expect("a finite load");
    model
}

pub fn solved(mechanism: &dyn Prebuilt, pose: &[f64]) -> Solution {
    let model = loaded(mechanism, pose);
    solve(&model).unwrap_or_else(|error| panic!("{} {pose:?}: {error}", mechanism.kind()))
}

/// Position of a point of a body (m).
pub fn position(model: &Model, body: &str, point: &str) -> Point3<f64> {
    let node = model.node(body, point).expect("a node");
    model.geometry().positions[node.0]
}
