//! The traditional method (Eqs. 48–50, 66) on both case studies beside this one: what the book's
//! page says of them, as inequalities that hold on any machine.

use hyperstat_assembly::{Connection, JointStiffness, Model, solve};
use hyperstat_mechanisms::prebuilt::{Delta, Prebuilt, SingleFreedom};
use hyperstat_reference::{ReferenceError, TraditionalForm, TraditionalOptions, traditional};
use hyperstat_tests::{rebuilt, stiffness, stiffness_difference};
use nalgebra::{Matrix5, Matrix6, Vector5};

/// Where the delta is looked at [m].
const POSE: [f64; 3] = [-0.2, -0.2, 0.5];

/// Stiffness of the beams AB and CD of case study 1 along x [N/m].
fn beams(structure: &SingleFreedom) -> [f64; 2] {
    let young = structure.material.young();
    [
        young * structure.sections.0.area() / structure.lengths.0,
        young * structure.sections.1.area() / structure.lengths.1,
    ]
}

/// Case study 1 with every joint, those at A and D too, a spring `k` along x.
fn single_freedom(k: f64) -> Model {
    let model = SingleFreedom::paper().model(&[]).expect("a structure");
    rebuilt(&model, |_, joint| Connection {
        stiffness: JointStiffness::Directions([Some(k), None, None, None, None, None]),
        ..joint.clone()
    })
}

/// The delta with every direction that a joint holds, those of the drives too, a spring `k`.
fn delta(k: f64) -> Model {
    let delta = Delta {
        joint_stiffness: [Some(k), Some(k), Some(k), Some(k), None, Some(k)],
        drive_stiffness: Some(k),
        ..Delta::paper()
    };
    delta.model(&POSE).expect("a reachable pose")
}

/// The output's stiffness by the traditional method with springs `k`.
fn by_springs(model: &Model, k: f64, free_stiffness: f64) -> Matrix6<f64> {
    in_form(TraditionalForm::Penalty, model, k, free_stiffness)
}

/// The same in a form of the method.
fn in_form(form: TraditionalForm, model: &Model, k: f64, free_stiffness: f64) -> Matrix6<f64> {
    let options = TraditionalOptions {
        form,
        joint_stiffness: k,
        angular_stiffness: k,
        free_stiffness,
    };
    let solution = traditional(model, &options).expect("a held mechanism");
    solution.stiffness
}

fn exact(model: &Model) -> Matrix6<f64> {
    let solution = hyperstat_reference::solve(model).expect("a held mechanism");
    solution.stiffness.expect("an output that can move")
}

#[test]
fn single_freedom_with_springs_of_any_stiffness() {
    let beams = beams(&SingleFreedom::paper());
    let (mut soft, mut hard) = (0.0_f64, 0.0_f64);
    for exponent in 0..=18 {
        let k = 10.0_f64.powi(exponent);
        let model = single_freedom(k);
        let expected: f64 = beams.iter().map(|beam| 1.0 / (1.0 / beam + 2.0 / k)).sum();
        let error = |found: &Matrix6<f64>| (found[(0, 0)] / expected - 1.0).abs();
        let ours = error(&stiffness(&solve(&model).expect("a solution")));
        assert!(ours < 1e-13, "1e{exponent}: {ours:e}");
        let theirs = error(&by_springs(&model, k, 0.0));
        match exponent {
            7..=9 => soft = soft.max(theirs),
            17..=18 => hard = hard.max(theirs),
            _ => {}
        }
    }
    assert!(soft < 1e-13, "springs like the beams: {soft:e}");
    assert!(hard > 1e-10, "springs far above the beams: {hard:e}");
}

/// Eqs. 48, 49 and 52 as they stand, the joints' forces unknowns of their own.
#[test]
fn the_joints_forces_as_unknowns_keep_the_digits() {
    let [k1, k2] = beams(&SingleFreedom::paper());
    for exponent in 0..=18 {
        let k = 10.0_f64.powi(exponent);
        let (a, b) = (k, 3.0 * k);
        // Unknowns Δo, ΔB, ΔC, fB, fC.
        #[rustfmt::skip]
        let matrix = Matrix5::new(
            -a,   a, 0.0, 1.0, 0.0,
            -b, 0.0,   b, 0.0, 1.0,
            0.0, -k1, 0.0, 1.0, 0.0,
            0.0, 0.0, -k2, 0.0, 1.0,
            0.0, 0.0, 0.0, 1.0, 1.0,
        );
        let load = Vector5::new(0.0, 0.0, 0.0, 0.0, 1.0);
        let solution = matrix.lu().solve(&load).expect("a regular matrix");
        let expected = 1.0 / (1.0 / k1 + 1.0 / a) + 1.0 / (1.0 / k2 + 1.0 / b);
        let error = (1.0 / solution[0] / expected - 1.0).abs();
        assert!(error < 1e-12, "1e{exponent}: {error:e}");
    }
}

#[test]
fn delta_with_springs_of_any_stiffness() {
    let rigid = Delta::paper().model(&POSE).expect("a reachable pose");
    let rigid = exact(&rigid);
    let mut closest = f64::INFINITY;
    for exponent in 3..=18 {
        let k = 10.0_f64.powi(exponent);
        let model = delta(k);
        let expected = exact(&model);
        let ours = stiffness(&solve(&model).expect("a solution"));
        let ours = stiffness_difference(&ours, &expected);
        assert!(ours < 1e-12, "1e{exponent}: {ours:e}");
        for free_stiffness in [0.0, 1e-7] {
            let found = by_springs(&model, k, free_stiffness);
            let lost = stiffness_difference(&found, &expected);
            match exponent {
                6..=8 => assert!(lost < 1e-8, "1e{exponent}: {lost:e}"),
                16..=18 => assert!(lost > 1e-6, "1e{exponent}: {lost:e}"),
                _ => {}
            }
            closest = closest.min(stiffness_difference(&found, &rigid));
        }
    }
    assert!(
        closest > 1e-9,
        "springs come near rigid joints: {closest:e}"
    );
}

/// Deblaise's form, the joints' wrenches as multipliers and K_J inverted: stiff springs cost no digit, and
/// the rigid joint is a limit that is reached. What is wrong is the small stiffness of what is free, and
/// without it there is no inverse.
#[test]
fn the_deltas_joints_as_multipliers() {
    let rigid = Delta::paper().model(&POSE).expect("a reachable pose");
    let rigid = exact(&rigid);
    for exponent in [8, 12, 15, 18] {
        let k = 10.0_f64.powi(exponent);
        let model = delta(k);
        let expected = exact(&model);
        let form = TraditionalForm::Lagrange;
        let found = in_form(form, &model, k, 1e-7);
        let lost = stiffness_difference(&found, &expected);
        assert!(lost < 1e-9, "1e{exponent}: {lost:e}");
        // The error does not come from rounding: a hundred times the small stiffness, a hundred times the
        // error.
        let stiffer = stiffness_difference(&in_form(form, &model, k, 1e-5), &expected);
        let ratio = stiffer / lost;
        assert!((50.0..200.0).contains(&ratio), "1e{exponent}: {ratio}");
        if exponent == 18 {
            let error = stiffness_difference(&found, &rigid);
            assert!(error < 1e-9, "{error:e}");
        }
        let free = TraditionalOptions {
            form,
            joint_stiffness: k,
            angular_stiffness: k,
            free_stiffness: 0.0,
        };
        let result = traditional(&model, &free);
        assert_eq!(result.unwrap_err(), ReferenceError::Singular);
    }
}

/// Where springs for rigid joints are too soft, the error falls as 1/k.
#[test]
fn soft_springs_for_the_deltas_rigid_joints() {
    let rigid = Delta::paper().model(&POSE).expect("a reachable pose");
    let expected = exact(&rigid);
    let error = |k: f64| stiffness_difference(&by_springs(&rigid, k, 0.0), &expected);
    let ratio = error(1e9) / error(1e10);
    assert!((ratio / 10.0 - 1.0).abs() < 0.05, "{ratio}");
}
