//! The mechanisms under test.

use hyperstat_assembly::Model;
use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
use hyperstat_mechanisms::prebuilt::{
    ElbowSide, Exechon, Link, Orthoglide, PlanarThreeRrr, Prebuilt, SphericalThreeRrr, Tripteron,
};
use nalgebra::Vector6;

pub(crate) fn steel(diameter: f64) -> Link {
    link(SectionShape::Circle { diameter })
}

/// A section that is not alike in all directions, so that a wrong local y shows.
pub(crate) fn flat(width: f64, height: f64) -> Link {
    link(SectionShape::Rectangle { width, height })
}

pub(crate) fn link(shape: SectionShape) -> Link {
    Link {
        section: Section::new(shape, None, None).expect("a valid section"),
        material: Material::new(2.1e11, Elasticity::Poisson(0.3), None).expect("steel"),
    }
}

/// Elastic joints, each direction with another stiffness.
pub(crate) const BEARINGS: [Option<f64>; 6] =
    [Some(1e8), Some(2e8), Some(3e8), Some(1e5), None, Some(2e5)];

pub(crate) fn planar() -> PlanarThreeRrr {
    PlanarThreeRrr {
        base_radius: 0.30,
        platform_radius: 0.08,
        proximal_length: 0.22,
        distal_length: 0.25,
        elbow: ElbowSide::Left,
        proximal: flat(0.03, 0.02),
        distal: steel(0.018),
        joint_stiffness: [None; 6],
        drive_stiffness: None,
        elements: 1,
    }
}

pub(crate) fn spherical() -> SphericalThreeRrr {
    SphericalThreeRrr {
        radius: 0.12,
        base_angle: 0.9,
        platform_angle: 1.1,
        proximal_angle: 1.4,
        distal_angle: 1.5,
        elbow: ElbowSide::Left,
        proximal: flat(0.02, 0.012),
        distal: steel(0.014),
        joint_stiffness: [None; 6],
        drive_stiffness: None,
        elements: 1,
    }
}

pub(crate) fn agile_eye() -> SphericalThreeRrr {
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

pub(crate) fn tripteron() -> Tripteron {
    Tripteron {
        rail: (0.5, 0.3),
        platform_radius: 0.06,
        proximal_length: 0.35,
        distal_length: 0.40,
        elbow: ElbowSide::Left,
        proximal: flat(0.03, 0.05),
        distal: steel(0.03),
        joint_stiffness: [None; 6],
        drive_stiffness: None,
        elements: 1,
    }
}

pub(crate) fn orthoglide() -> Orthoglide {
    Orthoglide {
        platform_radius: 0.05,
        rod_length: 0.31,
        rod_spacing: 0.08,
        bar: flat(0.02, 0.03),
        rod: steel(0.014),
        joint_stiffness: [None; 6],
        drive_stiffness: None,
        elements: 1,
    }
}

pub(crate) fn exechon() -> Exechon {
    Exechon {
        base_width: 0.9,
        base_depth: 0.5,
        platform_width: 0.3,
        platform_depth: 0.18,
        housing: flat(0.08, 0.06),
        ram: steel(0.05),
        joint_stiffness: [None; 6],
        drive_stiffness: None,
        elements: 1,
    }
}

/// A mechanism with some of its poses and the counts that the literature gives it.
pub(crate) struct Case {
    pub(crate) mechanism: Box<dyn Prebuilt>,
    pub(crate) poses: Vec<[f64; 3]>,
    /// Mobility and degree of over-constraint.
    pub(crate) counts: [usize; 2],
}

pub(crate) fn cases() -> Vec<Case> {
    let case = |mechanism: Box<dyn Prebuilt>, poses: &[[f64; 3]], counts| Case {
        mechanism,
        poses: poses.to_vec(),
        counts,
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

/// The mechanism in a pose, with a load on its output.
pub(crate) fn loaded(mechanism: &dyn Prebuilt, pose: &[f64]) -> Model {
    let mut model = mechanism
        .model(pose)
        .unwrap_or_else(|error| panic!("{} {pose:?}: {error}", mechanism.kind()));
    let output = model.output().expect("an output");
    let wrench = Vector6::new(-20.0, 10.0, 100.0, 5.0, 5.0, 8.0);
    model.add_load(output, wrench).expect("a finite load");
    model
}
