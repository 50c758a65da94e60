//! The independent solver against closed forms.

use crate::common;

use common::{JointSpec, assert_close, circle, node, point, steel, stiffness_error};
use hyperstat_elements::{Material, Section, SectionShape};
use hyperstat_joints::{Fixed, Revolute};
use hyperstat_model::Model;
use hyperstat_reference::{ReferenceError, solve};
use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3, Vector6};

const YOUNG: f64 = 2.1e11;
const SHEAR: f64 = 2.1e11 / 2.6;

fn cantilever(section: &Section, material: &Material, length: f64, elements: usize) -> Model {
    let mut model = Model::new("cantilever");
    let points = [("A", point(0.0, 0.0, 0.0)), ("B", point(length, 0.0, 0.0))];
    model
        .add_beam("beam", &points, material, section, None, elements)
        .unwrap();
    JointSpec::new("wall", "A", ["ground", "beam"], Fixed).add(&mut model);
    model.set_output(node(&model, "beam", "B"));
    model
}

/// Tip of a cantilever along x, where local axes are global ones: bending flexibilities
/// `l³/3EI + l/κGA`, `l²/2EI`, `l/EI`, whatever the number of elements.
#[test]
fn timoshenko_cantilever() {
    let (length, area, iy, iz, torsion) = (0.7, 6e-4, 3e-8, 8e-8, 5e-8);
    let shape = SectionShape::General {
        area,
        iy,
        iz,
        torsion,
        y_max: None,
        z_max: None,
        torsion_modulus: None,
    };
    let (shear_y, shear_z) = (4e-4, 2e-4);
    for (shear, elements) in [(false, 1), (false, 7), (true, 1), (true, 7)] {
        let areas = [shear_y, shear_z].map(|a| shear.then_some(a));
        let section = Section::new(shape, areas[0], areas[1]).unwrap();
        let solution = solve(&cantilever(&section, &steel(), length, elements)).unwrap();
        let give = |area: f64| if shear { length / (SHEAR * area) } else { 0.0 };
        let mut expected = Matrix6::zeros();
        expected[(0, 0)] = length / (YOUNG * area);
        expected[(3, 3)] = length / (SHEAR * torsion);
        expected[(1, 1)] = length.powi(3) / (3.0 * YOUNG * iz) + give(shear_y);
        expected[(5, 5)] = length / (YOUNG * iz);
        expected[(1, 5)] = length.powi(2) / (2.0 * YOUNG * iz);
        expected[(2, 2)] = length.powi(3) / (3.0 * YOUNG * iy) + give(shear_z);
        expected[(4, 4)] = length / (YOUNG * iy);
        expected[(2, 4)] = -length.powi(2) / (2.0 * YOUNG * iy);
        expected.fill_lower_triangle_with_upper_triangle();
        let compliance = solution.compliance.unwrap();
        assert!(
            stiffness_error(&compliance, &expected) < 1e-14,
            "{compliance}"
        );
        let product = solution.stiffness.unwrap() * compliance;
        assert!((product - Matrix6::identity()).amax() < 1e-12);
    }
}

#[test]
fn cantilever_under_tip_load() {
    let (length, diameter) = (0.5, 0.02);
    let mut model = cantilever(&circle(diameter), &steel(), length, 3);
    let tip = node(&model, "beam", "B");
    model
        .add_load(tip, Vector6::new(0.0, 0.0, -100.0, 5.0, 0.0, 0.0))
        .unwrap();
    let solution = solve(&model).unwrap();
    let i = std::f64::consts::PI * diameter.powi(4) / 64.0;
    let expected = Vector6::new(
        0.0,
        0.0,
        -100.0 * length.powi(3) / (3.0 * YOUNG * i),
        5.0 * length / (SHEAR * 2.0 * i),
        100.0 * length.powi(2) / (2.0 * YOUNG * i),
        0.0,
    );
    assert_close(&solution.displacement.unwrap(), &expected, 1e-14);
    assert_eq!(
        solution.displacements[tip.0],
        solution.displacement.unwrap()
    );
    // The wall carries the load and its moment: 100 N down at 0.5 m is +50 N·m about y.
    let wall = Vector6::new(0.0, 0.0, 100.0, -5.0, -50.0, 0.0);
    assert_close(&solution.joint_wrenches[0].unwrap(), &wall, 1e-14);
    assert_eq!((solution.mobility, solution.overconstraint), (0, 0));
    assert!(solution.last_change < 1e-14);
}

/// Case study 1 of the paper, Eq. 53, from soft joints to joints far stiffer than the beams.
#[test]
fn single_freedom_structure() {
    let (l1, l2) = (0.4, 0.3);
    let (area1, area2) = (circle(0.02).area(), circle(0.025).area());
    let (k1, k2) = (YOUNG * area1 / l1, YOUNG * area2 / l2);
    let stiffness = |spring: Option<f64>| {
        let mut model = Model::new("single freedom");
        let (a, b) = (point(0.0, 0.0, 0.0), point(l1, 0.0, 0.0));
        let (o, c, d) = (
            point(0.45, 0.0, 0.0),
            point(0.5, 0.0, 0.0),
            point(0.8, 0.0, 0.0),
        );
        let ab = [("A", a), ("B", b)];
        model
            .add_beam("AB", &ab, &steel(), &circle(0.02), None, 1)
            .unwrap();
        model
            .add_rigid("BC", &[("B", b), ("O", o), ("C", c)])
            .unwrap();
        let cd = [("C", c), ("D", d)];
        model
            .add_beam("CD", &cd, &steel(), &circle(0.025), None, 1)
            .unwrap();
        JointSpec::new("A", "A", ["ground", "AB"], Fixed).add(&mut model);
        JointSpec::new("D", "D", ["CD", "ground"], Fixed).add(&mut model);
        for (name, between, ratio) in [("B", ["AB", "BC"], 1.0), ("C", ["BC", "CD"], 1.5)] {
            let joint = JointSpec::new(name, name, between, Fixed);
            match spring {
                Some(k) => joint.springs(&[(0, k * ratio)]).add(&mut model),
                None => joint.add(&mut model),
            }
        }
        model.set_output(node(&model, "BC", "O"));
        solve(&model).unwrap().stiffness.unwrap()[(0, 0)]
    };
    for exponent in -3..=18 {
        let k = 10_f64.powi(exponent);
        let series = |beam: f64, joint: f64| 1.0 / (1.0 / beam + 1.0 / joint);
        let expected = series(k1, k) + series(k2, 1.5 * k);
        let found = stiffness(Some(k));
        assert!(
            (found / expected - 1.0).abs() < 1e-14,
            "k = {k:e}: {found} for {expected}"
        );
    }
    assert!((stiffness(None) / (k1 + k2) - 1.0).abs() < 1e-14);
}

/// Two rigid joints' worth of stiffness side by side: they share a load as their stiffness says.
#[test]
fn very_stiff_springs_share_a_load() {
    let mut model = cantilever(&circle(0.02), &steel(), 0.5, 1);
    let tip = point(0.5, 0.0, 0.0);
    model.add_rigid("tip", &[("B", tip)]).unwrap();
    JointSpec::new("first", "B", ["beam", "tip"], Fixed)
        .matrix(Matrix6::identity() * 1e18)
        .add(&mut model);
    JointSpec::new("second", "B", ["beam", "tip"], Fixed)
        .matrix(Matrix6::identity() * 3e18)
        .add(&mut model);
    let load = Vector6::new(4.0, 8.0, -4.0, 2.0, 0.0, 1.0);
    model.add_load(node(&model, "tip", "B"), load).unwrap();
    model.set_output(node(&model, "tip", "B"));
    let solution = solve(&model).unwrap();
    assert_close(&solution.joint_wrenches[1].unwrap(), &(load * -0.25), 1e-9);
    assert_close(&solution.joint_wrenches[2].unwrap(), &(load * -0.75), 1e-9);
}

/// A rigid slab on three bushings: `K = Σ Dᵀ T K_J Tᵀ D`.
#[test]
fn rigid_body_on_bushings() {
    let output = point(0.1, 0.1, 0.2);
    let feet = [
        ("A", point(0.0, 0.0, 0.0)),
        ("B", point(0.3, 0.0, 0.0)),
        ("C", point(0.0, 0.3, 0.0)),
    ];
    let mut model = Model::new("slab");
    let mut points = vec![("T", output)];
    points.extend(feet);
    model.add_rigid("slab", &points).unwrap();
    let frame = Rotation3::from_euler_angles(0.3, -0.8, 1.9);
    let springs = [1e6, 2e6, 3e6, 1e3, 2e3, 3e3];
    let mut expected = Matrix6::zeros();
    for (name, at) in feet {
        let pairs: Vec<_> = springs.into_iter().enumerate().collect();
        JointSpec::new(name, name, ["ground", "slab"], Fixed)
            .frame(frame)
            .springs(&pairs)
            .add(&mut model);
        // Displacement of the foot from the output's: Δ + φ × r.
        let mut to_foot = Matrix6::identity();
        let arm: Vector3<f64> = at - output;
        to_foot
            .fixed_view_mut::<3, 3>(0, 3)
            .copy_from(&-arm.cross_matrix());
        let block = |k: usize| {
            let local = Matrix3::from_diagonal(&Vector3::from_row_slice(&springs[k..k + 3]));
            frame.matrix() * local * frame.matrix().transpose()
        };
        let mut spring = Matrix6::zeros();
        spring.fixed_view_mut::<3, 3>(0, 0).copy_from(&block(0));
        spring.fixed_view_mut::<3, 3>(3, 3).copy_from(&block(3));
        expected += to_foot.transpose() * spring * to_foot;
    }
    model.set_output(node(&model, "slab", "T"));
    let solution = solve(&model).unwrap();
    assert!(stiffness_error(&solution.stiffness.unwrap(), &expected) < 1e-14);
    assert_eq!((solution.mobility, solution.overconstraint), (0, 12));
    assert!(
        solution
            .joint_wrenches
            .iter()
            .all(|w| *w == Some(Vector6::zeros()))
    );
}

fn parallelogram(length: f64, width: f64, diameter: f64) -> Model {
    let mut model = Model::new("parallelogram");
    let half = width / 2.0;
    let (a, b) = (point(-half, 0.0, 0.0), point(half, 0.0, 0.0));
    let (d, c) = (point(-half, 0.0, length), point(half, 0.0, length));
    let section = circle(diameter);
    model
        .add_beam("left", &[("A", a), ("D", d)], &steel(), &section, None, 1)
        .unwrap();
    model
        .add_beam("right", &[("B", b), ("C", c)], &steel(), &section, None, 1)
        .unwrap();
    let top = [("D", d), ("O", point(0.0, 0.0, length)), ("C", c)];
    model.add_rigid("top", &top).unwrap();
    JointSpec::new("a", "A", ["ground", "left"], Revolute).add(&mut model);
    JointSpec::new("b", "B", ["ground", "right"], Revolute).add(&mut model);
    JointSpec::new("d", "D", ["left", "top"], Revolute).add(&mut model);
    JointSpec::new("c", "C", ["right", "top"], Revolute).add(&mut model);
    model.set_output(node(&model, "top", "O"));
    model
}

/// A parallelogram of two elastic rods along z and revolute joints along y: over-constrained by
/// three, free along x, and otherwise as stiff as two rods that bend only out of its plane.
#[test]
fn over_constrained_parallelogram() {
    let (l, w, diameter) = (0.6, 0.12, 0.014);
    let mut model = parallelogram(l, w, diameter);
    let solution = solve(&model).unwrap();
    let area = std::f64::consts::PI * diameter.powi(2) / 4.0;
    let i = std::f64::consts::PI * diameter.powi(4) / 64.0;
    let (axial, bend) = (YOUNG * area / l, YOUNG * i / l);
    let mut expected = Matrix6::zeros();
    expected[(1, 1)] = 24.0 * bend / l.powi(2);
    expected[(1, 3)] = 12.0 * bend / l;
    expected[(2, 2)] = 2.0 * axial;
    expected[(3, 3)] = 8.0 * bend;
    expected[(4, 4)] = axial * w * w / 2.0;
    expected[(5, 5)] = 2.0 * SHEAR * 2.0 * i / l + 6.0 * bend * (w / l).powi(2);
    expected.fill_lower_triangle_with_upper_triangle();
    let found = solution.stiffness.unwrap();
    for r in 0..6 {
        for c in 0..6 {
            let unit = |k: usize| {
                if k == 0 {
                    bend / l.powi(2)
                } else {
                    expected[(k, k)]
                }
            };
            let scale = (unit(r) * unit(c)).sqrt();
            let error = (found[(r, c)] - expected[(r, c)]).abs() / scale;
            assert!(error < 1e-13, "{r} {c}: {found} for {expected}");
        }
    }
    assert_eq!((solution.mobility, solution.overconstraint), (1, 3));
    assert_eq!((solution.idle_modes, solution.free_motions.len()), (0, 1));
    assert!((solution.free_motions[0].abs() - Vector6::ith(0, 1.0)).amax() < 1e-14);
    assert_eq!((solution.compliance, solution.displacement), (None, None));

    let output = node(&model, "top", "O");
    model
        .add_load(output, Vector6::new(0.0, 0.0, 7.0, 0.0, 0.0, 0.0))
        .unwrap();
    let solution = solve(&model).unwrap();
    let stretched = Vector6::new(0.0, 0.0, 7.0 / (2.0 * axial), 0.0, 0.0, 0.0);
    assert_close(&solution.displacements[output.0], &stretched, 1e-13);

    model
        .add_load(output, Vector6::new(1e-3, 0.0, 0.0, 0.0, 0.0, 0.0))
        .unwrap();
    assert!(matches!(
        solve(&model),
        Err(ReferenceError::Unrestrained { .. })
    ));
}
