//! Mechanisms with telescopic legs and driven carriages: hexapods, linear deltas, Tricepts, 3-RPS
//! and 3-PRS.

use hyperstat_mechanisms::prebuilt::{
    CarriageSide, FootJoint, Hexapod, LinearDelta, Prebuilt, Rails, TelescopicLeg, ThreePrs,
    ThreeRps, Tricept,
};

use super::{BEARINGS, Case, flat, round, tube};

/// A leg of 0.5 m to 1.3 m.
pub fn leg() -> TelescopicLeg {
    TelescopicLeg {
        cylinder: flat(0.03, 0.05),
        piston: round(0.018),
        cylinder_length: 0.36,
        lengths: (0.5, 1.3),
    }
}

/// A hexapod with universal base joints.
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

/// Edge of the cube of [`cubic`] (m).
pub const EDGE: f64 = 0.6;

/// The cubic hexapod with legs of [`EDGE`] at home.
///
/// # Panics
/// Never.
pub fn cubic() -> Hexapod {
    let leg = TelescopicLeg {
        cylinder_length: 0.3,
        lengths: (0.4, 0.9),
        ..leg()
    };
    Hexapod::cubic(EDGE, leg).expect("a cube")
}

/// A linear delta on upright rails.
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

/// A 3-RPS.
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

/// A 3-PRS on upright rails.
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

fn case<const N: usize>(
    mechanism: impl Prebuilt + 'static,
    poses: &[[f64; N]],
    span: f64,
    counts: [usize; 3],
) -> Case {
    Case {
        mechanism: Box::new(mechanism),
        poses: poses.iter().map(|pose| pose.to_vec()).collect(),
        middle: poses[0].to_vec(),
        span: vec![span; N],
        counts,
    }
}

/// The mechanisms, rigid and elastic, with poses and counts.
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
