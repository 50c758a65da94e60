//! Natural frequencies against figures of other programs and closed forms.
//!
//! The delta is that of the file format's page at (0, 0, 0.5): density 7850 kg/m³, a platform of
//! 1 kg and 1e-3 kg·m² about each axis through P, 8 elements a segment, drives locked, without rotary
//! inertia of bending and without masses of joints. The figures are OpenSees' and those of an
//! independent null-space program, which agree to all digits printed.

use std::path::Path;

use hyperstat_assembly::{BeamMass, ModalOptions, Model, Modes, modes};
use hyperstat_elements::{Elasticity, MassShape, Material, RigidMass};
use hyperstat_joints::Planar;
use hyperstat_mechanisms::{Registry, batch_from_str};
use hyperstat_tests::build::{
    connection, general, has_printed_digits, member, node, weld_to_ground,
};
use nalgebra::{Point3, Rotation3};

/// Frequencies agree to the digits that are printed.
fn assert_frequencies(found: &Modes, printed: &[&str]) {
    assert_eq!(found.modes.len(), printed.len());
    assert!(found.complete);
    for (mode, expected) in found.modes.iter().zip(printed) {
        let found = mode.frequency;
        assert!(has_printed_digits(found, expected), "{found} {expected}");
        assert!(mode.residual < 1e-9, "{:e}", mode.residual);
        assert!((mode.kinetic.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
}

fn delta(joint_stiffness: &str) -> Model {
    let text = format!(
        "(jobs: [(name: \"delta\", poses: List([(0.0, 0.0, 0.5)]), mechanism: Delta(
            base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60,
            rod_spacing: 0.12, elements: 8,
            arm: (section: Circle(diameter: 0.030),
                  material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),
            bar: (section: Circle(diameter: 0.020),
                  material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),
            rod: (section: Circle(diameter: 0.014),
                  material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),
            {joint_stiffness}
        ))])"
    );
    let batch = batch_from_str(&text, Path::new("delta.ron"), &Registry::builtin()).unwrap();
    let mut model = batch.jobs[0].model().unwrap();
    let platform = node(&model, "platform", "P");
    model.add_mass(platform, RigidMass::with_moments(1.0, [1e-3; 3]).unwrap());
    model
}

fn lumped(count: usize) -> ModalOptions {
    ModalOptions {
        mass: BeamMass::Lumped,
        ..ModalOptions::lowest(count)
    }
}

#[test]
fn delta_with_rigid_joints() {
    let model = delta("");
    let printed = [
        "60.93600", "60.93600", "64.73482", "73.04502", "77.29717", "77.29717",
    ];
    assert_frequencies(&modes(&model, &ModalOptions::lowest(6)).unwrap(), &printed);
    let printed = [
        "60.99230", "60.99230", "64.84352", "73.14589", "77.36782", "77.36782",
    ];
    assert_frequencies(&modes(&model, &lumped(6)).unwrap(), &printed);
}

#[test]
fn delta_with_elastic_joints() {
    let model = delta("joint_stiffness: (x: 1e8, y: 1e8, z: 1e8, u: 1e5, w: 1e5),");
    let printed = [
        "57.76133", "57.76133", "64.24403", "67.81478", "75.92299", "75.92299",
    ];
    assert_frequencies(&modes(&model, &ModalOptions::lowest(6)).unwrap(), &printed);
}

/// frame3dd's example B (Gavin, Duke University; N, mm, tonne), a pyramid of four beams: the figures
/// of that program without geometric stiffness, 0.1 t added at the top.
#[test]
fn pyramid_of_frame3dd_example_b() {
    let mut model = Model::new("frame3dd, example B");
    let points = [
        ("1", Point3::new(0.0, 0.0, 1000.0)),
        ("2", Point3::new(-1200.0, -900.0, 0.0)),
        ("3", Point3::new(1200.0, -900.0, 0.0)),
        ("4", Point3::new(1200.0, 900.0, 0.0)),
        ("5", Point3::new(-1200.0, 900.0, 0.0)),
    ];
    let steel = Material::new(200_000.0, Elasticity::Shear(79_300.0), Some(7.85e-9)).unwrap();
    let section = general(36.0, 492.0, 492.0, 1000.0, Some(20.0));
    let members = [[1, 0], [0, 2], [0, 3], [4, 0]].map(|ends| member(ends, &steel, &section));
    model.add_elastic("pyramid", &points, &members).unwrap();
    for point in ["2", "3", "4", "5"] {
        weld_to_ground(&mut model, "pyramid", point);
    }
    let top = node(&model, "pyramid", "1");
    model.set_output(top);
    model.add_mass(top, RigidMass::point(0.1).unwrap());
    let found = modes(&model, &ModalOptions::lowest(6)).unwrap();
    let printed = [
        "19.33742", "19.54486", "20.15552", "31.71370", "35.15949", "42.24975",
    ];
    assert_frequencies(&found, &printed);
    // One element a beam and one free node: there are six modes.
    let all = modes(&model, &ModalOptions::lowest(20)).unwrap();
    assert_frequencies(&all, &printed);
    // Slender beams hardly shear.
    let exact = ModalOptions {
        shape: MassShape::Exact,
        ..ModalOptions::lowest(6)
    };
    let exact = modes(&model, &exact).unwrap();
    for (exact, cubic) in exact.modes.iter().zip(&found.modes) {
        assert!((exact.frequency / cubic.frequency - 1.0).abs() < 1e-3);
    }
}

/// Bathe and Wilson, Large eigenvalue problems in dynamic analysis (ASCE J. Eng. Mech. 98, 1972),
/// the plane frame of 10 bays and 9 storeys (kip, ft): bays 20, storeys 10, A 3, I 1, E 432000, mass
/// per length 3 lumped in translation only, bases fixed. Published: λ = 0.589541, 5.52695, 16.5878.
/// Planar joints between the ground and every node keep it in its plane.
#[test]
fn plane_frame_of_bathe_and_wilson() {
    let (bays, storeys) = (10, 9);
    let names: Vec<String> = (0..(bays + 1) * (storeys + 1))
        .map(|k| k.to_string())
        .collect();
    let place = |k: usize| {
        let (bay, storey) = (k % (bays + 1), k / (bays + 1));
        Point3::new(20.0 * bay as f64, 0.0, 10.0 * storey as f64)
    };
    let points: Vec<_> = (names.iter().enumerate())
        .map(|(k, name)| (name.as_str(), place(k)))
        .collect();
    let material = Material::new(432_000.0, Elasticity::Poisson(0.3), Some(1.0)).unwrap();
    let section = general(3.0, 1.0, 1.0, 1.0, None);
    let mut members = Vec::new();
    for k in bays + 1..points.len() {
        members.push(member([k - bays - 1, k], &material, &section));
        if k % (bays + 1) > 0 {
            members.push(member([k - 1, k], &material, &section));
        }
    }
    let mut model = Model::new("Bathe and Wilson");
    model.add_elastic("frame", &points, &members).unwrap();
    for (k, name) in names.iter().enumerate() {
        if k <= bays {
            weld_to_ground(&mut model, "frame", name);
            continue;
        }
        let between = [None, Some(node(&model, "frame", name))];
        let in_plane = connection(&format!("plane {name}"), between, Planar);
        model.add_joint(in_plane, Rotation3::identity()).unwrap();
    }
    model.set_output(node(&model, "frame", &names[names.len() - 1]));
    let found = modes(&model, &lumped(3)).unwrap();
    assert!(found.complete);
    for (mode, expected) in found.modes.iter().zip([0.589541, 5.52695, 16.5878]) {
        let eigenvalue = (std::f64::consts::TAU * mode.frequency).powi(2);
        assert!(
            (eigenvalue / expected - 1.0).abs() < 5e-6,
            "{eigenvalue} {expected}"
        );
    }
}
