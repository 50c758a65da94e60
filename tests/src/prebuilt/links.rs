//! Mechanisms of links of fixed length: planar and spherical 3-RRR, Tripteron, Orthoglide and
//! Exechon.

use hyperstat_mechanisms::prebuilt::{
    ElbowSide, Exechon, Orthoglide, PlanarThreeRrr, Prebuilt, SphericalThreeRrr, Tripteron,
};

use super::{BEARINGS, Case, flat, round};

/// A planar 3-RRR.
pub fn planar() -> PlanarThreeRrr {
    PlanarThreeRrr {
        base_radius: 0.30,
        platform_radius: 0.08,
        proximal_length: 0.22,
        distal_length: 0.25,
        elbow: ElbowSide::Left,
        proximal: flat(0.03, 0.02),
        distal: round(0.018),
        joint_stiffness: [None; 6],
        drive_stiffness: None,
        elements: 1,
    }
}

/// A spherical 3-RRR.
pub fn spherical() -> SphericalThreeRrr {
    SphericalThreeRrr {
        radius: 0.12,
        base_angle: 0.9,
        platform_angle: 1.1,
        proximal_angle: 1.4,
        distal_angle: 1.5,
        elbow: ElbowSide::Left,
        proximal: flat(0.02, 0.012),
        distal: round(0.014),
        joint_stiffness: [None; 6],
        drive_stiffness: None,
        elements: 1,
    }
}

/// The agile eye of Gosselin and Hamel.
pub fn agile_eye() -> SphericalThreeRrr {
    let cone = (1.0 / 3.0_f64.sqrt()).acos();
    let right = std::f64::consts::FRAC_PI_2;
    SphericalThreeRrr {
        base_angle: cone,
        platform_angle: cone,
        proximal_angle: right,
        distal_angle: right,
        elbow: ElbowSide::Right,
        ..spherical()
    }
}

/// A Tripteron.
pub fn tripteron() -> Tripteron {
    Tripteron {
        rail: (0.5, 0.3),
        platform_radius: 0.06,
        proximal_length: 0.35,
        distal_length: 0.40,
        elbow: ElbowSide::Left,
        proximal: flat(0.03, 0.05),
        distal: round(0.03),
        joint_stiffness: [None; 6],
        drive_stiffness: None,
        elements: 1,
    }
}

/// An Orthoglide.
pub fn orthoglide() -> Orthoglide {
    Orthoglide {
        platform_radius: 0.05,
        rod_length: 0.31,
        rod_spacing: 0.08,
        bar: flat(0.02, 0.03),
        rod: round(0.014),
        joint_stiffness: [None; 6],
        drive_stiffness: None,
        elements: 1,
    }
}

/// An Exechon.
pub fn exechon() -> Exechon {
    Exechon {
        base_width: 0.9,
        base_depth: 0.5,
        platform_width: 0.3,
        platform_depth: 0.18,
        housing: flat(0.08, 0.06),
        ram: round(0.05),
        joint_stiffness: [None; 6],
        drive_stiffness: None,
        elements: 1,
    }
}

/// The mechanisms, rigid and elastic, with poses and counts.
pub fn cases() -> Vec<Case> {
    let case = |mechanism: Box<dyn Prebuilt>, poses: &[[f64; 3]; 3], counts: [usize; 2]| {
        let (middle, span) = match mechanism.kind() {
            "PlanarThreeRrr" => ([0.0; 3], [0.06, 0.06, 0.4]),
            "SphericalThreeRrr" => ([0.0, 0.0, 0.4], [0.3; 3]),
            "Exechon" => ([0.0, 0.0, poses[0][2]], [0.3; 3]),
            _ => ([0.0; 3], [0.1; 3]),
        };
        Case {
            mechanism,
            poses: poses.iter().map(|pose| pose.to_vec()).collect(),
            middle: middle.to_vec(),
            span: span.to_vec(),
            counts: [counts[0], counts[1], 0],
        }
    };
    let in_plane = [[0.0, 0.0, 0.0], [0.03, -0.02, 0.3], [-0.05, 0.04, -0.25]];
    let turns = [[0.0, 0.0, 0.5], [0.2, -0.1, 0.3], [-0.3, 0.25, 0.6]];
    let places = [[0.0, 0.0, 0.0], [0.06, -0.04, 0.08], [-0.05, 0.07, -0.02]];
    let under = [[0.0, 0.0, 0.9], [0.15, -0.2, 1.0], [-0.3, 0.25, 0.8]];
    let above = under.map(|[x, y, z]| [x, y, -z]);
    vec![
        case(Box::new(planar()), &in_plane, [3, 6]),
        case(
            Box::new(PlanarThreeRrr {
                elbow: ElbowSide::Right,
                joint_stiffness: BEARINGS,
                drive_stiffness: Some(2e4),
                elements: 2,
                ..planar()
            }),
            &in_plane,
            [3, 6],
        ),
        case(Box::new(spherical()), &turns, [3, 6]),
        case(Box::new(agile_eye()), &turns, [3, 6]),
        case(
            Box::new(SphericalThreeRrr {
                elbow: ElbowSide::Right,
                joint_stiffness: BEARINGS,
                drive_stiffness: Some(3e3),
                ..spherical()
            }),
            &turns,
            [3, 6],
        ),
        case(Box::new(tripteron()), &places, [3, 3]),
        case(
            Box::new(Tripteron {
                elbow: ElbowSide::Right,
                joint_stiffness: BEARINGS,
                drive_stiffness: Some(1e7),
                elements: 2,
                ..tripteron()
            }),
            &places,
            [3, 3],
        ),
        case(Box::new(orthoglide()), &places, [3, 12]),
        case(
            Box::new(Orthoglide {
                joint_stiffness: BEARINGS,
                drive_stiffness: Some(1e7),
                ..orthoglide()
            }),
            &places,
            [3, 12],
        ),
        case(Box::new(exechon()), &under, [3, 2]),
        case(
            Box::new(Exechon {
                joint_stiffness: BEARINGS,
                drive_stiffness: Some(1e8),
                elements: 2,
                ..exechon()
            }),
            &above,
            [3, 2],
        ),
    ]
}
