//! Exact masses: frequencies of the mechanism itself, whatever its number of elements.
//!
//! The delta is that of the file format's page, of density 7850 kg/m³ with a platform of 1 kg and
//! 1e-3 kg·m² about each axis through P. Its frequencies are those of the exact dynamic stiffness of
//! all members, by a count of Wittrick and Williams and Newton's way from there in doubles; consistent
//! masses of 16, 32 and 64 elements, extrapolated in h² and h⁴, agree to 6e-11. The bars' are roots of
//! closed frequency equations.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use hyperstat_assembly::{ModalOptions, ModalPlan, Model, Modes, Tapering, modes};
use hyperstat_elements::{Elasticity, Material, RigidMass, RotaryInertia, Section};
use hyperstat_mechanisms::{Disk, Registry, batch_from_str};
use hyperstat_tests::build::{circle, general, has_printed_digits, member, node, weld_to_ground};
use nalgebra::Point3;

/// What exact results are held to, relative.
const RIGHT: f64 = 1e-9;

fn delta(at: [f64; 3], elements: usize, more: &str) -> Model {
    let part = |name: &str, diameter: f64| {
        format!(
            "{name}: (section: Circle(diameter: {diameter:?}), \
             material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),"
        )
    };
    let [x, y, z] = at;
    let text = format!(
        "(jobs: [(name: \"delta\", poses: List([({x:?}, {y:?}, {z:?})]), mechanism: Delta(
            base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60,
            rod_spacing: 0.12, elements: {elements}, {} {} {} {more}
        ))])",
        part("arm", 0.030),
        part("bar", 0.020),
        part("rod", 0.014),
    );
    let batch = batch_from_str(&text, Path::new("delta.ron"), &Disk, &Registry::builtin()).unwrap();
    let mut model = batch.jobs[0].model().unwrap();
    let platform = node(&model, "platform", "P");
    model.add_mass(platform, RigidMass::with_moments(1.0, [1e-3; 3]).unwrap());
    model
}

fn assert_right(found: &Modes, expected: &[f64]) {
    assert_eq!(found.modes.len(), expected.len());
    assert!(found.complete);
    for (mode, expected) in found.modes.iter().zip(expected) {
        let error = mode.frequency / expected - 1.0;
        assert!(error.abs() < RIGHT, "{expected}: {error:e}");
        assert!((mode.kinetic.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
}

const CENTRE: [f64; 12] = [
    60.935623683,
    60.935623683,
    64.734315442,
    73.044019846,
    77.295965790,
    77.295965790,
    78.985240713,
    78.985240713,
    78.985240713,
    88.918161220,
    88.918161220,
    101.364497848,
];
const CORNER: [f64; 6] = [
    49.010101077,
    55.679255001,
    69.009557280,
    73.583490106,
    76.391416679,
    78.637409039,
];
const LOW: [f64; 3] = [62.298746468, 62.639764314, 65.369757105];

#[test]
fn delta_at_any_number_of_elements() {
    for (at, expected) in [
        ([0.0, 0.0, 0.5], &CENTRE[..]),
        ([-0.2, -0.2, 0.5], &CORNER),
        ([0.1, 0.05, 0.45], &LOW),
    ] {
        for elements in [1, 3, 8] {
            let model = delta(at, elements, "");
            for count in [1, 3, expected.len()] {
                let found = modes(&model, &ModalOptions::lowest(count)).unwrap();
                assert_right(&found, &expected[..count]);
                assert_eq!(found.idle, 0);
                let counted = found.counted.unwrap();
                let below = (CENTRE.iter()).filter(|f| **f < counted.below).count();
                assert!(at[0] != 0.0 || counted.modes == below, "{counted:?}");
            }
        }
    }
}

/// One plan for all poses: that of the centre, of which other poses' frequencies are up to a fifth lower.
#[test]
fn a_plan_serves_every_pose() {
    for count in [1, 3] {
        let model = delta([0.0, 0.0, 0.5], 1, "");
        let plan = ModalPlan::new(&model, &ModalOptions::lowest(count)).unwrap();
        for (at, expected) in [([-0.2, -0.2, 0.5], &CORNER[..]), ([0.1, 0.05, 0.45], &LOW)] {
            let there = delta(at, 1, "");
            let found = plan.frequencies(there.geometry()).unwrap();
            assert_eq!(found.len(), count);
            for (found, expected) in found.iter().zip(expected) {
                assert!((found / expected - 1.0).abs() < RIGHT, "{found} {expected}");
            }
        }
    }
}

/// What a sweep finds, by its own way, beside the modes of each pose by theirs.
#[test]
fn a_sweep_finds_what_single_poses_have() {
    const ELASTIC: &str = "joint_stiffness: (x: 1e8, y: 1e8, z: 1e8, u: 1e5, w: 1e5),";
    for more in ["", ELASTIC] {
        let model = delta([0.0, 0.0, 0.5], 1, more);
        for count in [1, 2, 3, 4] {
            let plan = ModalPlan::new(&model, &ModalOptions::lowest(count)).unwrap();
            for k in 0..8 {
                let at =
                    [0, 1, 2].map(|axis| f64::from((7 * k + 3 * axis + k * axis) % 9) / 4.0 - 1.0);
                let there = delta([0.2 * at[0], 0.2 * at[1], 0.5 + 0.05 * at[2]], 1, more);
                let found = plan.frequencies(there.geometry()).unwrap();
                let modes = plan.modes(there.geometry()).unwrap();
                assert!(modes.complete);
                assert_eq!(found.len(), count);
                for (found, mode) in found.iter().zip(&modes.modes) {
                    let error = found / mode.frequency - 1.0;
                    assert!(error.abs() < 1e-11, "{at:?}: {found}, {error:e}");
                }
            }
        }
    }
}

/// An Exechon whose drives are soft beside all else: small changes of a mode have much energy in what is stiff.
fn exechon(at: [f64; 3], drive: f64) -> Model {
    let link = |name: &str| {
        format!(
            "{name}: (section: Rectangle(width: 0.08, height: 0.06), \
             material: (young: 2.1e11, poisson: 0.3, density: 7850.0)),"
        )
    };
    let [x, y, z] = at;
    let text = format!(
        "(jobs: [(name: \"exechon\", poses: List([({x:?}, {y:?}, {z:?})]), mechanism: Exechon(
            base_width: 0.9, base_depth: 0.5, platform_width: 0.3, platform_depth: 0.18, {} {}
            joint_stiffness: (x: 2e8, y: 2e8, z: 2e8, u: 2e5, w: 2e5), drive_stiffness: {drive:?},
        ))])",
        link("housing"),
        link("ram"),
    );
    let batch = batch_from_str(&text, Path::new("exechon.ron"), &Disk, &Registry::builtin());
    batch.unwrap().jobs[0].model().unwrap()
}

#[test]
fn a_sweep_beside_soft_drives_finds_what_single_poses_have() {
    let mut largest = 0.0_f64;
    for drive in [60.0, 600.0, 6e4] {
        for count in [1, 3, 4] {
            let model = exechon([0.0, 0.0, 0.9], drive);
            let plan = ModalPlan::new(&model, &ModalOptions::lowest(count)).unwrap();
            for k in 0..12 {
                let [x, y, z] =
                    [0, 1, 2].map(|axis| f64::from((7 * k + 3 * axis + k * axis) % 9) / 4.0 - 1.0);
                let there = exechon([0.2 * x, 0.2 * y, 0.9 + 0.1 * z], drive);
                let found = plan.frequencies(there.geometry()).unwrap();
                let modes = plan.modes(there.geometry()).unwrap();
                for (found, mode) in found.iter().zip(&modes.modes) {
                    largest = largest.max((found / mode.frequency - 1.0).abs());
                }
            }
        }
    }
    assert!(largest < 1e-10, "{largest:e}");
}

/// Each of the six rods turns about itself, and so does each pair's bars with it: twelve idle motions,
/// known from the kinematics.
#[test]
fn delta_with_ball_jointed_rods() {
    for elements in [1, 4] {
        let model = delta([0.0, 0.0, 0.5], elements, "rod_ends: Spherical,");
        let found = modes(&model, &ModalOptions::lowest(3)).unwrap();
        assert_right(&found, &[60.33074384, 60.33074384, 64.74543709]);
        assert_eq!(found.idle, 12);
    }
}

fn bar(section: &Section, taper: Option<Section>, length: f64, elements: usize) -> Model {
    let material = Material::new(2.1e11, Elasticity::Poisson(0.3), Some(7850.0)).unwrap();
    let points = [
        ("A", Point3::origin()),
        ("B", Point3::new(length, 0.0, 0.0)),
    ];
    let mut member = member([0, 1], &material, section);
    member.elements = elements;
    member.taper = taper.map(|to| Tapering {
        to,
        part: [0.0, 1.0],
    });
    let mut model = Model::new("bar");
    model.add_elastic("bar", &points, &[member]).unwrap();
    weld_to_ground(&mut model, "bar", "A");
    model.set_output(node(&model, "bar", "B"));
    model
}

/// Zeros of cos λ cosh λ = −1 (Blevins, Table 8-1), by Newton.
fn clamped_free(k: usize) -> f64 {
    let mut x = if k == 0 { 1.875 } else { (k as f64 + 0.5) * PI };
    for _ in 0..50 {
        let value = x.cos() + 1.0 / x.cosh();
        x -= value / (-x.sin() - x.tanh() / x.cosh());
    }
    x
}

/// All kinds of motions of a clamped bar: bending in two planes, tension and torsion, many waves long.
#[test]
fn clamped_bar() {
    let (section, length) = (circle(0.02), 0.5_f64);
    let bending = (2.1e11 * section.iz() / (7850.0 * section.area())).sqrt() / length.powi(2) / TAU;
    let mut expected: Vec<f64> = (0..40)
        .flat_map(|k| [bending * clamped_free(k).powi(2); 2])
        .collect();
    let shear = 2.1e11 / 2.6;
    for modulus in [2.1e11_f64, shear] {
        let speed = (modulus / 7850.0).sqrt();
        expected.extend((0..20).map(|k| (f64::from(k) + 0.5) * speed / (2.0 * length)));
    }
    expected.sort_by(f64::total_cmp);
    for elements in [1, 5] {
        let model = bar(&section, None, length, elements);
        for count in [1, 2, 3, 10, 60] {
            let found = modes(&model, &ModalOptions::lowest(count)).unwrap();
            assert_right(&found, &expected[..count]);
            assert_eq!(found.modes[0].inner[0].len(), elements - 1);
        }
    }
    // Its first shape, and the mass that moves with the ground: 0.613076090 of it.
    let model = bar(&section, None, length, 1);
    let found = modes(&model, &ModalOptions::lowest(2)).unwrap();
    let (lambda, mode) = (clamped_free(0), &found.modes[0]);
    let sigma = (lambda.sinh() - lambda.sin()) / (lambda.cosh() + lambda.cos());
    let shape = |xi: f64| {
        let x = lambda * xi;
        x.cosh() - x.cos() - (x.sinh() - x.sin()) * sigma
    };
    let at = |xi| {
        let segment = hyperstat_assembly::SegmentId(0);
        mode.segment_displacement(&model, segment, xi).unwrap()
    };
    let tip = at(1.0);
    for k in 0..=50 {
        let xi = f64::from(k) / 50.0;
        let off = (at(xi) - tip * (shape(xi) / shape(1.0)))
            .fixed_rows::<3>(0)
            .norm();
        assert!(off < 1e-9 * tip.norm(), "{xi}: {off:e}");
    }
    let first = found
        .modes
        .iter()
        .map(|m| m.effective_mass[1] + m.effective_mass[2]);
    let share = first.sum::<f64>() / (2.0 * found.mass);
    assert!((share - 0.613_076_090).abs() < 1e-9, "{share}");
    // Of the two equal ones the first has all that goes along y, the second all along z.
    for (k, mode) in found.modes.iter().enumerate() {
        let [along, across] = [mode.effective_mass[1 + k], mode.effective_mass[2 - k]];
        assert!((along / found.mass - 0.613_076_090).abs() < 1e-9, "{along}");
        assert!(across < 1e-15 * found.mass, "{across}");
    }
    // The same where only one of them is asked for.
    let alone = modes(&model, &ModalOptions::lowest(1)).unwrap();
    assert_eq!(alone.modes.len(), 1);
    let share = alone.modes[0].effective_mass[1] / found.mass;
    assert!((share - 0.613_076_090).abs() < 1e-9, "{share}");
}

/// A clamped bar of ten diameters with κ = 0.9, by Timoshenko's frequency equation.
#[test]
fn clamped_timoshenko_bar() {
    let area = PI * 0.01 * 0.01;
    let inertia = PI * 0.02_f64.powi(4) / 64.0;
    let section = general(area, inertia, inertia, 2.0 * inertia, Some(0.9 * area));
    for (rotary_inertia, printed) in [
        (
            RotaryInertia::Included,
            ["359.76633806", "2183.22252", "5833.61855"],
        ),
        (
            RotaryInertia::Left,
            ["360.27986667", "2203.61552", "5947.23770"],
        ),
    ] {
        for elements in [1, 3] {
            let model = bar(&section, None, 0.2, elements);
            let options = ModalOptions {
                rotary_inertia,
                ..ModalOptions::lowest(12)
            };
            let found = modes(&model, &options).unwrap();
            assert!(found.complete);
            for printed in printed {
                let modes = found.modes.iter();
                let both = modes.filter(|mode| has_printed_digits(mode.frequency, printed));
                assert_eq!(both.count(), 2, "{printed}");
            }
        }
    }
}

/// A cone clamped at its thick end, (EI w″)″ = ρA ω² w with s from the apex: w of J₂, Y₂, I₂, K₂ of √s over
/// s (Kirchhoff 1879), the first root of their determinant to 40 digits. Any division gives the same.
#[test]
fn cone_at_any_number_of_elements() {
    let (thick, thin) = (circle(0.03), circle(0.01));
    let one = modes(
        &bar(&thick, Some(thin.clone()), 0.5, 1),
        &ModalOptions::lowest(20),
    )
    .unwrap();
    let many = modes(&bar(&thick, Some(thin), 0.5, 7), &ModalOptions::lowest(20)).unwrap();
    assert!((one.modes[0].frequency / 131.531_592_780_629_6 - 1.0).abs() < RIGHT);
    let expected: Vec<f64> = many.modes.iter().map(|mode| mode.frequency).collect();
    assert_right(&one, &expected);
}
