//! Natural frequencies against figures of other programs and closed forms.
//!
//! The delta is that of the file format's page at (0, 0, 0.5): density 7850 kg/m³, a platform of
//! 1 kg and 1e-3 kg·m² about each axis through P, 8 elements a segment, drives locked, without rotary
//! inertia of bending and without masses of joints. The figures are OpenSees' and those of an
//! independent null-space program, which agree to all digits printed.

use std::path::Path;

use hyperstat_assembly::{
    BodyKind, JointStiffness, ModalOptions, ModalPlan, Model, Modes, SegmentId, SolveError,
    analyse, modes,
};
use hyperstat_elements::{Elasticity, MassShape, Material, RigidMass};
use hyperstat_joints::{Fixed, Planar};
use hyperstat_mechanisms::{Disk, Registry, batch_from_str};
use hyperstat_reference::natural_frequencies;
use hyperstat_tests::build::{
    circle, connection, general, has_printed_digits, member, node, weld_to_ground,
};
use hyperstat_tests::random::check_random_mechanisms;
use nalgebra::{Point3, Rotation3};
use proptest::prelude::*;

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
    let batch = batch_from_str(&text, Path::new("delta.ron"), &Disk, &Registry::builtin()).unwrap();
    let mut model = batch.jobs[0].model().unwrap();
    let platform = node(&model, "platform", "P");
    model.add_mass(platform, RigidMass::with_moments(1.0, [1e-3; 3]).unwrap());
    model
}

#[test]
fn delta_with_rigid_joints() {
    let model = delta("");
    let printed = [
        "60.93600", "60.93600", "64.73482", "73.04502", "77.29717", "77.29717",
    ];
    assert_frequencies(
        &modes(&model, &ModalOptions::consistent(6)).unwrap(),
        &printed,
    );
    let printed = [
        "60.99230", "60.99230", "64.84352", "73.14589", "77.36782", "77.36782",
    ];
    assert_frequencies(&modes(&model, &ModalOptions::lumped(6)).unwrap(), &printed);
}

#[test]
fn delta_with_elastic_joints() {
    let model = delta("joint_stiffness: (x: 1e8, y: 1e8, z: 1e8, u: 1e5, w: 1e5),");
    let printed = [
        "57.76133", "57.76133", "64.24403", "67.81478", "75.92299", "75.92299",
    ];
    assert_frequencies(
        &modes(&model, &ModalOptions::consistent(6)).unwrap(),
        &printed,
    );
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
    let found = modes(&model, &ModalOptions::consistent(6)).unwrap();
    let printed = [
        "19.33742", "19.54486", "20.15552", "31.71370", "35.15949", "42.24975",
    ];
    assert_frequencies(&found, &printed);
    // One element a beam and one free node: there are six modes.
    let all = modes(&model, &ModalOptions::consistent(20)).unwrap();
    assert_frequencies(&all, &printed);
    // Slender beams hardly shear.
    let exact = ModalOptions {
        shape: MassShape::Exact,
        ..ModalOptions::consistent(6)
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
    let found = modes(&model, &ModalOptions::lumped(3)).unwrap();
    assert!(found.complete);
    for (mode, expected) in found.modes.iter().zip([0.589541, 5.52695, 16.5878]) {
        let eigenvalue = (std::f64::consts::TAU * mode.frequency).powi(2);
        assert!(
            (eigenvalue / expected - 1.0).abs() < 5e-6,
            "{eigenvalue} {expected}"
        );
    }
}

/// Random mechanisms, of rigid bodies with and without mass, against the independent dense solver in
/// the null space of all conditions. Motions without energy that have mass are zeros there.
#[test]
fn any_topology_agrees_with_the_null_space() {
    check_random_mechanisms(any::<bool>(), |model, lump| {
        let mut model = model.clone();
        let bodies = model.bodies().to_vec();
        for (k, body) in bodies.iter().enumerate() {
            if body.kind == BodyKind::Rigid && k % 3 != 1 {
                let inertia = [0.02, 0.03, 0.04, 0.005, -0.003, 0.004];
                let mass = RigidMass::with_inertia(1.0 + k as f64, inertia).unwrap();
                model.add_mass(body.nodes[body.nodes.len() - 1], mass);
            }
        }
        if analyse(&model).expect("a small model").doubtful.is_some() {
            return Ok(false);
        }
        let options = if lump {
            ModalOptions::lumped(8)
        } else {
            ModalOptions::consistent(8)
        };
        let found = match modes(&model, &options) {
            Ok(found) => found,
            Err(SolveError::NoMass | SolveError::Unheld { .. }) => return Ok(false),
            Err(error) => return Err(TestCaseError::fail(error.to_string())),
        };
        let Ok(Some(all)) = natural_frequencies(&model, lump) else {
            return Ok(false);
        };
        agree(&found, &all)?;
        Ok(true)
    });
}

/// The lowest modes found are the first of all ω², zeros included; below 0.02 Hz there is only
/// rounding of the dense matrices.
fn agree(found: &Modes, all: &[f64]) -> Result<(), TestCaseError> {
    let at_rest = all.iter().filter(|value| **value < 1e-2).count();
    let own: Vec<f64> = (found.modes.iter())
        .map(|mode| (std::f64::consts::TAU * mode.frequency).powi(2))
        .collect();
    let zeros = own.iter().filter(|value| **value < 1e-2).count();
    prop_assert!(found.complete);
    if own.len() == 8 && zeros == 8 {
        return Ok(());
    }
    prop_assert_eq!(zeros + found.idle, at_rest);
    let expected: Vec<f64> = all[at_rest..].iter().take(8 - zeros).copied().collect();
    prop_assert_eq!(own.len() - zeros, expected.len());
    // The dense problem loses the digits between its largest and its smallest eigenvalues; its
    // inverse ones, 1/(1000 + ω²), are right to rounding of their largest, a thousandth.
    let largest = all.last().copied().unwrap_or(0.0);
    for (own, expected) in own[zeros..].iter().zip(expected) {
        let tolerance = 1e-9 * expected + 1e-13 * largest + 1e-17 * expected * expected;
        prop_assert!((own - expected).abs() < tolerance, "{own} {expected}");
    }
    Ok(())
}

/// A cantilever from a file's worth of elements (Blevins, Table 8-1): λ = 1.87510407, 4.69409113,
/// 7.85475744, in two planes; consistent masses bound ω² from above, by (λ h)⁴/720 of itself (Strang
/// and Fix, §6.2).
#[test]
fn cantilever_of_blevins() {
    let material = Material::new(2.1e11, Elasticity::Poisson(0.3), Some(7850.0)).unwrap();
    let section = circle(0.02);
    let (length, count) = (0.8_f64, 16);
    let points = [
        ("A", Point3::origin()),
        ("B", Point3::new(length, 0.0, 0.0)),
    ];
    let mut model = Model::new("cantilever");
    model
        .add_beam("bar", &points, &material, &section, None, count)
        .unwrap();
    weld_to_ground(&mut model, "bar", "A");
    model.set_output(node(&model, "bar", "B"));
    let found = modes(&model, &ModalOptions::consistent(6)).unwrap();
    assert!(found.complete);
    let mass = 7850.0 * section.area() * length;
    assert!((found.mass / mass - 1.0).abs() < 1e-12);
    let unit = 2.1e11 * section.iz() / (7850.0 * section.area() * length.powi(4));
    let exact = [1.875_104_069, 4.694_091_133, 7.854_757_438_f64];
    for (k, mode) in found.modes.iter().enumerate() {
        let lambda = exact[k / 2];
        let eigenvalue = (std::f64::consts::TAU * mode.frequency).powi(2);
        let error = eigenvalue / (unit * lambda.powi(4)) - 1.0;
        let expected = (lambda / count as f64).powi(4) / 720.0;
        assert!(
            (error - expected).abs() < 0.1 * expected + 1e-9,
            "{error:e} {expected:e}"
        );
        assert_eq!(mode.inner[0].len(), count - 1);
    }
    // Its shape between the nodes (the same table): cosh λx − cos λx − σ (sinh λx − sin λx). A cubic
    // through its nodes is off by h⁴/384 of the fourth derivative, (λ h)⁴/384 = 5e-7 of the tip, and
    // the nodes by about (λ h)⁴/720. Lines between the nodes would be 1e-3 off.
    let (lambda, mode) = (exact[0], &found.modes[0]);
    let sigma = 0.734_095_514;
    let shape = |xi: f64| {
        let x = lambda * xi;
        x.cosh() - x.cos() - sigma * (x.sinh() - x.sin())
    };
    let at = |xi| mode.segment_displacement(&model, SegmentId(0), xi).unwrap();
    let tip = at(1.0);
    for k in 0..=200 {
        let xi = k as f64 / 200.0;
        let (found, part) = (at(xi), shape(xi) / shape(1.0));
        for axis in 1..3 {
            assert!(
                (found[axis] - part * tip[axis]).abs() < 2e-6 * tip.norm(),
                "{xi}"
            );
        }
    }
    // The first mode of a cantilever has 61.3 % of the mass (Blevins), here in two planes.
    let first: f64 = (found.modes[..2].iter())
        .map(|m| m.effective_mass[1] + m.effective_mass[2])
        .sum();
    assert!(
        (first / (2.0 * mass) - 0.613).abs() < 5e-4,
        "{}",
        first / mass
    );
}

/// A rigid body on three springs through its centre of mass, and three against turning; with one
/// spring less it moves freely, at frequency zero.
#[test]
fn rigid_body_on_springs() {
    let (mass, inertia) = (3.0, [0.1, 0.2, 0.5]);
    let springs = [1e5, 2e6, 3e4, 40.0, 7e3, 900.0];
    let build = |springs: [Option<f64>; 6]| {
        let mut model = Model::new("body");
        model
            .add_rigid("body", &[("C", Point3::new(0.3, -0.1, 0.2))])
            .unwrap();
        let centre = node(&model, "body", "C");
        model.add_mass(centre, RigidMass::with_moments(mass, inertia).unwrap());
        model.set_output(centre);
        let mut mount = connection("mount", [None, Some(centre)], Fixed);
        mount.stiffness = JointStiffness::Directions(springs);
        model.add_joint(mount, Rotation3::identity()).unwrap();
        model
    };
    let masses = [mass, mass, mass, inertia[0], inertia[1], inertia[2]];
    let mut expected: Vec<f64> = (springs.iter().zip(masses))
        .map(|(k, m)| (k / m).sqrt() / std::f64::consts::TAU)
        .collect();
    let check = |model: &Model, expected: &mut Vec<f64>| {
        expected.sort_by(f64::total_cmp);
        let found = modes(model, &ModalOptions::lowest(10)).unwrap();
        assert_eq!(found.modes.len(), 6);
        for (mode, expected) in found.modes.iter().zip(expected) {
            assert!((mode.frequency - *expected).abs() <= 1e-13 * *expected);
        }
        // All of the mass is in three modes.
        for axis in 0..3 {
            let sum: f64 = found.modes.iter().map(|m| m.effective_mass[axis]).sum();
            assert!((sum - mass).abs() < 1e-12);
        }
    };
    check(&build(springs.map(Some)), &mut expected);
    let mut fewer = springs.map(Some);
    fewer[1] = Some(0.0);
    expected.retain(|f| (f - (2e6_f64 / mass).sqrt() / std::f64::consts::TAU).abs() > 1e-9);
    expected.push(0.0);
    check(&build(fewer), &mut expected);
}

/// An inertia turns with its body: the frequencies of a body on a spherical bushing do not change
/// when everything is turned.
#[test]
fn inertia_turns_with_its_body() {
    let points = [
        ("A", Point3::origin()),
        ("B", Point3::new(0.4, 0.0, 0.0)),
        ("C", Point3::new(0.0, 0.3, 0.1)),
    ];
    let mut model = Model::new("body");
    model.add_rigid("body", &points).unwrap();
    let centre = node(&model, "body", "B");
    let mass = RigidMass::with_inertia(2.0, [0.1, 0.2, 0.25, 0.03, 0.01, -0.02]).unwrap();
    model.add_mass(centre, mass);
    model.set_output(centre);
    let mut mount = connection("mount", [None, model.node("body", "A")], Fixed);
    mount.stiffness = JointStiffness::Directions([1e5, 2e5, 3e5, 4e3, 5e3, 6e3].map(Some));
    model.add_joint(mount, Rotation3::identity()).unwrap();
    let options = ModalOptions::lowest(6);
    let own = modes(&model, &options).unwrap();

    let turn = Rotation3::from_euler_angles(0.7, -1.2, 2.1);
    let mut geometry = model.geometry().clone();
    for position in &mut geometry.positions {
        *position = turn * *position;
    }
    for frame in &mut geometry.frames {
        *frame = turn * *frame;
    }
    let plan = ModalPlan::new(&model, &options).unwrap();
    let swept = plan.frequencies(&geometry).unwrap();
    model
        .set_geometry(geometry)
        .expect("a geometry of this model");
    let moved = modes(&model, &options).unwrap();
    for (k, mode) in own.modes.iter().enumerate() {
        for other in [swept[k], moved.modes[k].frequency] {
            assert!((other / mode.frequency - 1.0).abs() < 1e-12);
        }
    }
}

/// Equal frequencies, more of them than vectors of a block: eleven equal bodies, each on springs
/// that are the same in all directions.
#[test]
fn many_equal_frequencies() {
    let bodies = 11;
    let mut model = Model::new("equal");
    for k in 0..bodies {
        let name = format!("body{k}");
        let at = Point3::new(k as f64, 0.0, 0.0);
        model.add_rigid(&name, &[("C", at)]).unwrap();
        let centre = node(&model, &name, "C");
        model.add_mass(centre, RigidMass::with_moments(2.0, [0.1; 3]).unwrap());
        let mut mount = connection(&format!("mount{k}"), [None, Some(centre)], Fixed);
        mount.stiffness = JointStiffness::Directions([2e4, 2e4, 2e4, 4e3, 4e3, 4e3].map(Some));
        model.add_joint(mount, Rotation3::identity()).unwrap();
        model.set_output(centre);
    }
    let found = modes(&model, &ModalOptions::lowest(40)).unwrap();
    assert!(found.complete);
    assert_eq!(found.modes.len(), 40);
    for (k, mode) in found.modes.iter().enumerate() {
        let eigenvalue: f64 = if k < 3 * bodies { 1e4 } else { 4e4 };
        let expected = eigenvalue.sqrt() / std::f64::consts::TAU;
        assert!(
            (mode.frequency / expected - 1.0).abs() < 1e-12,
            "{k}: {}",
            mode.frequency
        );
    }
}

/// No digits are lost to many elements: a cantilever of 400 has the first frequency of the closed
/// form to 1e-9, where the stiffness is conditioned as 400⁴ = 3e10.
#[test]
fn many_elements() {
    let material = Material::new(2.1e11, Elasticity::Poisson(0.3), Some(7850.0)).unwrap();
    let section = circle(0.02);
    let points = [("A", Point3::origin()), ("B", Point3::new(0.0, 0.5, 0.0))];
    let mut model = Model::new("cantilever");
    model
        .add_beam("bar", &points, &material, &section, None, 400)
        .unwrap();
    weld_to_ground(&mut model, "bar", "A");
    model.set_output(node(&model, "bar", "B"));
    let found = modes(&model, &ModalOptions::consistent(2)).unwrap();
    let unit = 2.1e11 * section.iz() / (7850.0 * section.area() * 0.5_f64.powi(4));
    let expected = unit.sqrt() * 1.875_104_068_711_961_f64.powi(2) / std::f64::consts::TAU;
    assert!(found.complete);
    for mode in &found.modes {
        let error = mode.frequency / expected - 1.0;
        assert!(error.abs() < 1e-9, "{error:e}");
    }
}
