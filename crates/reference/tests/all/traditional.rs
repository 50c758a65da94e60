//! The traditional method: right where its springs are the model's, soft or without digits where
//! they stand for rigid joints.

use crate::common;

use common::{JointSpec, circle, node, point, steel, stiffness_error};
use hyperstat_joints::{Fixed, Revolute, Screw, Spherical};
use hyperstat_model::Model;
use hyperstat_reference::{
    ReferenceError, TraditionalForm, TraditionalOptions, solve, traditional,
};
use nalgebra::{Rotation3, Vector6};

/// Two bent beams to a rigid plate; `joint` makes the joint at the plate.
fn bracket(joint: impl Fn(&'static str, &'static str, [&'static str; 2]) -> JointSpec) -> Model {
    let mut model = Model::new("bracket");
    let (a, b) = (point(0.0, 0.0, 0.0), point(0.3, 0.1, 0.2));
    let (c, d) = (point(0.5, 0.1, 0.2), point(0.8, -0.2, 0.1));
    model
        .add_beam(
            "left",
            &[("A", a), ("B", b)],
            &steel(),
            &circle(0.02),
            None,
            2,
        )
        .unwrap();
    model
        .add_rigid("plate", &[("B", b), ("O", point(0.4, 0.2, 0.2)), ("C", c)])
        .unwrap();
    model
        .add_beam(
            "right",
            &[("C", c), ("D", d)],
            &steel(),
            &circle(0.03),
            None,
            1,
        )
        .unwrap();
    joint("a", "A", ["ground", "left"]).add(&mut model);
    joint("b", "B", ["left", "plate"]).add(&mut model);
    joint("c", "C", ["plate", "right"]).add(&mut model);
    joint("d", "D", ["right", "ground"]).add(&mut model);
    let output = node(&model, "plate", "O");
    model.set_output(output);
    model
        .add_load(output, Vector6::new(10.0, -20.0, 30.0, 1.0, 2.0, 3.0))
        .unwrap();
    model
}

fn options(stiffness: f64, free_stiffness: f64) -> TraditionalOptions {
    TraditionalOptions {
        form: TraditionalForm::Penalty,
        joint_stiffness: stiffness,
        angular_stiffness: stiffness,
        free_stiffness,
    }
}

/// Where every direction has a stiffness of its own, both methods solve the same model: one with
/// 12×12 and 6×6 stiffness blocks, the other with deformations and flexibilities.
#[test]
fn both_methods_agree_on_elastic_joints() {
    let frame = Rotation3::from_euler_angles(0.7, -0.3, 1.2);
    let springs = [(0, 1e7), (1, 3e7), (2, 2e7), (3, 1e4), (4, 2e4), (5, 5e4)];
    let model = bracket(|name, at, between| {
        let screw = Screw::new(0.004).unwrap();
        JointSpec::new(name, at, between, screw)
            .frame(frame)
            .springs(&springs)
    });
    let ours = solve(&model).unwrap();
    // Seven nodes and one inside the left beam; two of the plate's follow its first.
    let penalty = 6 * 8 + 6 * 2;
    for (form, equations) in [
        (TraditionalForm::Penalty, penalty),
        (TraditionalForm::Lagrange, penalty + 6 * 4),
    ] {
        let options = TraditionalOptions {
            form,
            ..options(f64::NAN, f64::NAN)
        };
        let theirs = traditional(&model, &options).unwrap();
        let error = stiffness_error(&theirs.stiffness, &ours.stiffness.unwrap());
        assert!(error < 1e-10, "{form:?}: {error:e}");
        let displacement = ours.displacement.unwrap();
        assert!((theirs.displacement - displacement).amax() < 1e-10 * displacement.amax());
        assert_eq!(theirs.equations, equations);
    }
}

/// The form of Lagrange inverts K_J: it stands for rigid joints as well as the springs are stiff, and
/// cannot have a free direction without a stiffness.
#[test]
fn the_form_of_lagrange_inverts_the_joints_stiffness() {
    let frame = Rotation3::from_euler_angles(0.7, -0.3, 1.2);
    let lagrange = |k: f64, free_stiffness: f64| TraditionalOptions {
        form: TraditionalForm::Lagrange,
        ..options(k, free_stiffness)
    };
    let model = bracket(|name, at, between| JointSpec::new(name, at, between, Fixed).frame(frame));
    let exact = solve(&model).unwrap().stiffness.unwrap();
    let error = |k: f64| {
        let found = traditional(&model, &lagrange(k, 0.0)).unwrap().stiffness;
        stiffness_error(&found, &exact)
    };
    let (soft, stiff) = (error(1e10), error(1e12));
    assert!(
        (soft / stiff / 100.0 - 1.0).abs() < 0.1,
        "{soft:e} {stiff:e}"
    );
    // The springs' own stiffness stands in one equation only: no digit is lost by it, and what is
    // left is still what the springs give.
    let stiffest = error(1e18);
    assert!(
        (stiff / stiffest / 1e6 - 1.0).abs() < 0.01,
        "{stiff:e} {stiffest:e}"
    );

    let hinged = bracket(|name, at, between| match name {
        "b" => JointSpec::new(name, at, between, Revolute).frame(frame),
        _ => JointSpec::new(name, at, between, Fixed).frame(frame),
    });
    let result = traditional(&hinged, &lagrange(1e15, 0.0));
    assert_eq!(result.unwrap_err(), ReferenceError::Singular);
    let found = traditional(&hinged, &lagrange(1e15, 1e-7)).unwrap();
    let exact = solve(&hinged).unwrap().stiffness.unwrap();
    let error = stiffness_error(&found.stiffness, &exact);
    assert!(error < 1e-6, "{error:e}");
}

/// Springs for rigid joints: the error falls as 1/k while they are soft, and rises again where
/// the stiffness matrix has no digits left for the beams.
#[test]
fn springs_for_rigid_joints_are_too_soft_or_lose_the_digits() {
    let frame = Rotation3::from_euler_angles(0.7, -0.3, 1.2);
    let model = bracket(|name, at, between| JointSpec::new(name, at, between, Fixed).frame(frame));
    let exact = solve(&model).unwrap().stiffness.unwrap();
    let error = |k: f64| {
        let found = traditional(&model, &options(k, 0.0)).unwrap().stiffness;
        stiffness_error(&found, &exact)
    };
    let (soft, stiff) = (error(1e10), error(1e12));
    assert!(
        (soft / stiff / 100.0 - 1.0).abs() < 0.1,
        "{soft:e} {stiff:e}"
    );
    assert!(error(1e18) > 10.0 * error(1e14));
}

/// A beam between ball joints spins: without a stiffness on free rotations nothing is found.
#[test]
fn idle_motions_need_the_small_stiffness() {
    let joint = |name, at, between: [&'static str; 2]| match name {
        "a" | "b" => JointSpec::new(name, at, between, Spherical),
        _ => JointSpec::new(name, at, between, Fixed),
    };
    let model = bracket(joint);
    let exact = solve(&model).unwrap();
    assert_eq!(exact.idle_modes, 1);
    let found = traditional(&model, &options(1e13, 1e-7)).unwrap().stiffness;
    assert!(stiffness_error(&found, &exact.stiffness.unwrap()) < 1e-3);
    let nothing = bracket(|name, at, between| {
        JointSpec::new(name, at, between, Spherical).springs(&[(0, 0.0), (1, 0.0), (2, 0.0)])
    });
    let result = traditional(&nothing, &options(1e13, 0.0));
    assert_eq!(result.unwrap_err(), ReferenceError::Singular);
}
