//! Misfits in rigid loops, and of what floats.

use super::*;

/// A triangle of rigid bars A–C and B–C, hinged about z to the ground and to each other.
fn triangle() -> Model {
    let (a, b, c) = (
        Point3::origin(),
        Point3::new(1.0, 0.0, 0.0),
        Point3::new(0.3, 0.4, 0.0),
    );
    let mut model = Model::new("triangle");
    model
        .add_rigid("left", &[("A", a), ("C", c)])
        .expect("a body");
    model
        .add_rigid("right", &[("C", c), ("B", b)])
        .expect("a body");
    let columns = [Vector3::x(), Vector3::z(), -Vector3::y()];
    let frame = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&columns));
    let at = |model: &Model, body, point| model.node(body, point);
    for (name, between) in [
        ("A", [None, at(&model, "left", "A")]),
        ("B", [at(&model, "right", "B"), None]),
        ("C", [at(&model, "left", "C"), at(&model, "right", "C")]),
    ] {
        let rigid = JointStiffness::default();
        add(&mut model, name, between, Revolute, rigid, frame);
    }
    let output = model.node("left", "C").expect("a node");
    model.set_output(output);
    model
}

#[test]
fn a_rigid_triangle_follows_its_misfits() {
    // C moves normal to A–C, and relative to B as far as B moves, normal to B–C.
    let motion = |of_b: f64| {
        let (ac, bc) = ([0.3, 0.4], [-0.7, 0.4]);
        let right = of_b * bc[0];
        let determinant = ac[0] * bc[1] - ac[1] * bc[0];
        [-ac[1] * right / determinant, ac[0] * right / determinant]
    };
    let misfit = 1e-3;
    let mut model = triangle();
    // Of ground and `right` the ground is second: the hinge of `right` moves by −m.
    model
        .set_misfit(JointId(1), &only(Dof::X, misfit))
        .expect("a misfit");
    let solution = solve(&model).expect("a solution");
    let [x, y] = motion(-misfit);
    near(solution.output.displacement[0], x, "x");
    near(solution.output.displacement[1], y, "y");
    assert!(solution.output.stiffness.is_none());
    let far = model.node("right", "B").expect("a node");
    near(solution.displacements[far.0][0], -misfit, "B");
    for wrench in solution.joint_wrenches.iter().flatten() {
        assert_eq!(wrench.amax(), 0.0);
    }
}

#[test]
fn misfits_that_rigid_loops_cannot_take_are_refused() {
    let mut model = triangle();
    // Out of the plane nothing gives: y of the joints is global z.
    model
        .set_misfit(JointId(2), &only(Dof::Y, 1e-4))
        .expect("a misfit");
    let refused = solve(&model).expect_err("does not fit");
    let joints = vec!["C".to_string()];
    assert_eq!(refused, SolveError::Misfit { joints });
    assert!(refused.to_string().contains("joint `C`"), "{refused}");
    // Taken back by another joint it fits: the right bar lies 1e-4 higher.
    model
        .set_misfit(JointId(1), &only(Dof::Y, -1e-4))
        .expect("a misfit");
    let solution = solve(&model).expect("a solution");
    let lifted = model.node("right", "B").expect("a node");
    near(solution.displacements[lifted.0][2], 1e-4, "z");
    assert!(solution.output.displacement.amax() < 1e-16);
    // Off by more than the digits that redundant conditions are told by.
    model
        .set_misfit(JointId(1), &only(Dof::Y, -1.00001e-4))
        .expect("a misfit");
    let joints = vec!["B".to_string(), "C".to_string()];
    assert_eq!(
        solve(&model).expect_err("no fit"),
        SolveError::Misfit { joints }
    );
}

#[test]
fn a_rigid_body_that_cannot_move_takes_no_misfit_but_one_that_fits() {
    let mut model = Model::new("block");
    let points = [("A", Point3::origin()), ("B", Point3::new(0.5, 0.0, 0.0))];
    model.add_rigid("block", &points).expect("a body");
    let [a, b] = ["A", "B"].map(|point| model.node("block", point));
    let first = weld(&mut model, "first", [None, a]);
    let second = weld(&mut model, "second", [None, b]);
    model.set_output(a.expect("a node"));
    model
        .set_misfit(second, &only(Dof::Z, 1e-3))
        .expect("a misfit");
    let joints = vec!["second".to_string()];
    assert_eq!(
        solve(&model).expect_err("no fit"),
        SolveError::Misfit { joints }
    );
    // Both supports of a block that turns by −0.002 about y as it rises.
    let turned = Vector6::new(0.0, 0.0, 0.0, 0.0, -2e-3, 0.0);
    model.set_misfit(first, &turned).expect("a misfit");
    let raised = turned + only(Dof::Z, 1e-3);
    model.set_misfit(second, &raised).expect("a misfit");
    let solution = solve(&model).expect("a solution");
    assert!((solution.output.displacement - turned).amax() < 1e-15);
    let end = solution.displacements[b.expect("a node").0];
    assert!((end - raised).amax() < 1e-15);
}

/// A bent bar in a rigid frame: what a preload presses does not ask whether the frame is held.
#[test]
fn a_mechanism_that_floats_bears_its_own_preloads() {
    let pressed = |held: bool| {
        let mut model = Model::new("frame");
        let points = [
            ("A", Point3::new(0.13, -0.21, 0.37)),
            ("M", Point3::new(0.41, 0.29, 0.11)),
            ("B", Point3::new(0.77, 0.53, -0.19)),
        ];
        model
            .add_beam("bar", &points, &steel(), &flat(), None, 1)
            .expect("a body");
        model.add_rigid("frame", &points).expect("a body");
        let frame = Rotation3::from_euler_angles(0.3, -0.5, 0.7);
        for (k, point) in ["A", "M", "B"].into_iter().enumerate() {
            let between = ["frame", "bar"].map(|body| model.node(body, point));
            let stiffness = springs([1e8, 2e8, 3e8, 1e5, 2e5, 3e5]);
            let soft = add(&mut model, point, between, Fixed, stiffness, frame);
            let force = Vector6::new(3.0, -2.0, 5.0, 0.7, 1.1, -0.9) * (k as f64 + 1.0);
            model.set_preload(soft, &force).expect("a preload");
        }
        model.set_output(model.node("frame", "A").expect("a node"));
        if held {
            let foot = model.node("frame", "B");
            weld(&mut model, "foot", [None, foot]);
        }
        solve(&model).expect("a solution")
    };
    let (floating, held) = (pressed(false), pressed(true));
    assert_eq!(floating.output.free_motions.len(), 6);
    assert!(floating.warnings.is_empty(), "{:?}", floating.warnings);
    for k in 0..3 {
        let wrench = |solution: &Solution| solution.joint_wrenches[k].expect("determined");
        let difference = (wrench(&floating) - wrench(&held)).amax();
        assert!(difference < 1e-11 * wrench(&held).amax(), "{difference:e}");
    }
}
