//! Misfits and preloads that elastic parts take.

use super::*;

#[test]
fn a_support_that_settles_bends_a_clamped_beam() {
    let settlement = 2e-4;
    for ground_first in [true, false] {
        let mut model = bar();
        let (a, b) = (on_bar(&model, "A"), on_bar(&model, "B"));
        weld(&mut model, "A", [None, Some(a)]);
        // The beam's end follows the support down: as second body it stands off by −δ.
        let (between, sign) = if ground_first {
            ([None, Some(b)], 1.0)
        } else {
            ([Some(b), None], -1.0)
        };
        let support = weld(&mut model, "B", between);
        model
            .set_misfit(support, &only(Dof::Z, -settlement * sign))
            .expect("a misfit");
        let solution = solve(&model).expect("a solution");
        let wrench = solution.joint_wrenches[support.0].expect("determined");
        let stiffness = YOUNG * SECOND_MOMENT / LENGTH.powi(3);
        near(wrench[2], -12.0 * stiffness * settlement * sign, "force");
        let moment = -6.0 * stiffness * LENGTH * settlement * sign;
        near(wrench[4], moment, "moment");
        near(solution.displacements[b.0][2], -settlement, "end");
        near(solution.output.displacement[2], -settlement / 2.0, "middle");
        // 1.5 δ / L, downwards to the end: about y it is positive.
        near(
            solution.output.displacement[4],
            1.5 * settlement / LENGTH,
            "slope",
        );
    }
}

#[test]
fn a_bar_too_long_between_walls_is_a_bar_that_is_warm() {
    let change = 40.0;
    let excess = EXPANSION * change * LENGTH;
    let walls = |model: &mut Model| {
        let (a, b) = (on_bar(model, "A"), on_bar(model, "B"));
        let left = weld(model, "left", [None, Some(a)]);
        (left, weld(model, "right", [Some(b), None]))
    };
    let mut long = bar();
    let (left, right) = walls(&mut long);
    // The right wall stands nearer by the excess.
    long.set_misfit(right, &only(Dof::X, excess))
        .expect("a misfit");
    let solution = solve(&long).expect("a solution");
    let force = YOUNG * AREA * excess / LENGTH;
    for joint in [left, right] {
        let wrench = solution.joint_wrenches[joint.0].expect("determined");
        near(wrench[0], force, "force");
    }
    let mut warm = bar();
    walls(&mut warm);
    let body = warm.body("bar").expect("a body");
    warm.set_temperature(body, change).expect("a temperature");
    let warm = solve(&warm).expect("a solution");
    for (own, other) in solution.joint_wrenches.iter().zip(&warm.joint_wrenches) {
        let (own, other) = (own.expect("determined"), other.expect("determined"));
        assert!((own - other).amax() < 1e-11 * force);
    }
}

#[test]
fn springs_in_series_share_a_misfit() {
    let (k, misfit) = (3e7, 1e-4);
    let series = 1.0 / (1.0 / k + LENGTH / (YOUNG * AREA));
    // Rigid but along x; at the end the spring goes into the beam's element, at the middle of a
    // second body's end it keeps a coordinate of its own.
    let along_x = || JointStiffness::Directions([Some(k), None, None, None, None, None]);
    for soft_first in [true, false] {
        let mut model = bar();
        let (a, b) = (on_bar(&model, "A"), on_bar(&model, "B"));
        let (first, second) = if soft_first { (a, b) } else { (b, a) };
        let frame = Rotation3::identity();
        let soft = add(
            &mut model,
            "soft",
            [None, Some(first)],
            Fixed,
            along_x(),
            frame,
        );
        weld(&mut model, "hard", [None, Some(second)]);
        model
            .set_misfit(soft, &only(Dof::X, misfit))
            .expect("a misfit");
        let solution = solve(&model).expect("a solution");
        let wrench = solution.joint_wrenches[soft.0].expect("determined");
        near(wrench[0], series * misfit, "force");
        let left = misfit - series * misfit / k;
        near(solution.displacements[first.0][0], left, "end");
    }
}

#[test]
fn drives_preloaded_against_each_other_move_nothing() {
    let (k, preload) = (2e6, 300.0);
    let (mut model, [left, right]) = between_drives(k);
    model
        .set_preload(left, &only(Dof::X, preload))
        .expect("a preload");
    model
        .set_preload(right, &only(Dof::X, -preload))
        .expect("a preload");
    let solution = solve(&model).expect("a solution");
    assert!(solution.output.displacement.amax() < 1e-11 * preload / k);
    let bar = YOUNG * AREA / 0.9;
    // Each bar gives by F / (EA/L), and its drive's spring takes back as much of the preload.
    let force = preload / (1.0 + k / bar);
    for (joint, sign) in [(left, 1.0), (right, -1.0)] {
        let wrench = solution.joint_wrenches[joint.0].expect("determined");
        near(wrench[0], sign * force, "force");
    }
    // One preload alone: the same as a misfit F/k.
    model.set_preload(right, &Vector6::zeros()).expect("none");
    let preloaded = solve(&model).expect("a solution");
    model.set_preload(left, &Vector6::zeros()).expect("none");
    assert!(model.misfits().is_empty());
    model
        .set_misfit(left, &only(Dof::X, preload / k))
        .expect("a misfit");
    let misfit = solve(&model).expect("a solution");
    for (a, b) in preloaded.displacements.iter().zip(&misfit.displacements) {
        assert!((a - b).amax() < 1e-11 * preload / k);
    }
}

#[test]
fn a_preload_on_a_full_matrix_is_a_misfit_by_its_compliance() {
    let half = Matrix6::from_fn(|r, c| f64::from((3 * r as i32 + 5 * c as i32) % 7) + 1.0);
    let unit = half * half.transpose() + Matrix6::identity() * 20.0;
    let lengths = Vector6::new(1.0, 1.0, 1.0, 0.1, 0.1, 0.1);
    let matrix = Matrix6::from_fn(|r, c| 1e4 * unit[(r, c)] * lengths[r] * lengths[c]);
    let frame = Rotation3::from_euler_angles(0.3, -0.5, 0.7);
    let preload = Vector6::new(20.0, -10.0, 30.0, 1.0, 2.0, -3.0);
    let solved = |misfit: Vector6<f64>, preload: Vector6<f64>| {
        let mut model = bar();
        let (a, b) = (on_bar(&model, "A"), on_bar(&model, "B"));
        weld(&mut model, "A", [None, Some(a)]);
        let soft = JointStiffness::Matrix(matrix);
        let joint = add(&mut model, "soft", [None, Some(b)], Fixed, soft, frame);
        model.set_misfit(joint, &misfit).expect("a misfit");
        model.set_preload(joint, &preload).expect("a preload");
        solve(&model).expect("a solution")
    };
    let misfit = matrix.try_inverse().expect("regular") * preload;
    // The tolerance: the condition of the matrix, some 1e4, over rounding.
    same(
        &solved(Vector6::zeros(), preload),
        &solved(misfit, Vector6::zeros()),
        1e-11,
    );
}

#[test]
fn a_preload_along_a_free_direction_is_a_pair_of_loads() {
    let torque = 25.0;
    let (mut model, hinge, tips) = hinged();
    model
        .set_preload(hinge, &only(Dof::V, torque))
        .expect("a preload");
    let preloaded = solve(&model).expect("a solution");
    let (mut loaded, ..) = hinged();
    let moment = Vector6::new(0.0, 0.0, 0.0, 0.0, 0.0, torque);
    loaded.add_load(tips[0], -moment).expect("a load");
    loaded.add_load(tips[1], moment).expect("a load");
    let mut expected = solve(&loaded).expect("a solution");
    // The loads are the joint's own: its wrench holds them.
    if let Some(wrench) = &mut expected.joint_wrenches[hinge.0] {
        wrench[4] += torque;
    }
    same(&preloaded, &expected, 1e-11);
}

#[test]
fn misfits_act_in_every_state_but_not_in_unit_responses() {
    let (mut model, [left, right]) = between_drives(2e6);
    let output = model.output().expect("an output");
    let load = LoadSet::on(output, only(Dof::X, 50.0));
    let bare = solve(&model).expect("a solution");
    let set = |model: &mut Model| {
        model
            .set_misfit(left, &only(Dof::X, 1e-4))
            .expect("a misfit");
        model
            .set_preload(right, &only(Dof::X, 70.0))
            .expect("a preload");
    };
    let misfits_alone = {
        let mut model = between_drives(2e6).0;
        set(&mut model);
        solve(&model).expect("a solution")
    };
    let case = LoadCase {
        name: "pull".into(),
        loads: load.clone(),
    };
    model.add_case(case).expect("a case");
    let loads_alone = solve(&model).expect("a solution");
    set(&mut model);
    let both = solve(&model).expect("a solution");
    let pulled = |s: &Solution| s.cases[0].state.displacements.clone();
    for (node, both_there) in pulled(&both).iter().enumerate() {
        let sum = pulled(&loads_alone)[node] + misfits_alone.displacements[node];
        assert!((both_there - sum).amax() < 1e-11 * 1e-4, "node {node}");
        assert_eq!(bare.displacements[node].amax(), 0.0);
    }
    assert_eq!(both.output.stiffness, loads_alone.output.stiffness);
    let prepared = Prepared::new(model.clone());
    let respond = |model: &Model| {
        let prepared = Prepared::new(model.clone());
        prepared
            .here()
            .respond(std::slice::from_ref(&load))
            .expect("a response")
    };
    let without = between_drives(2e6).0;
    let (with, without) = (respond(&model), respond(&without));
    assert_eq!(with[0].displacements, without[0].displacements);
    assert_eq!(with[0].joint_wrenches, without[0].joint_wrenches);
    let swept = prepared
        .sweep(model.geometry(), &mut prepared.workspace().expect("a plan"))
        .expect("a pose");
    let alone = swept.displacement.expect("a displacement");
    near(alone[0], misfits_alone.output.displacement[0], "sweep");
    near(
        swept.cases[0][0],
        both.cases[0].state.output[0],
        "sweep of a case",
    );
}
