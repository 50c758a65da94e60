//! Misfits and preloads of joints, against closed forms of the strength of materials, rigid
//! kinematics, and loads that do the same.

use hyperstat_assembly::{
    Axes, Connection, Deformation, Influence, JointId, JointStiffness, Load, LoadCase, LoadSet,
    Model, ModelError, NodeId, Plan, Solution, SolveError, solve,
};
use hyperstat_elements::{Elasticity, Material, Section, SectionShape};
use hyperstat_joints::{Dof, DofSet, Fixed, Joint, Prismatic, Revolute};
use nalgebra::{Matrix3, Matrix6, Point3, Rotation3, Vector3, Vector6};

const YOUNG: f64 = 2.1e11;
const EXPANSION: f64 = 1.2e-5;
const LENGTH: f64 = 0.8;
const AREA: f64 = 0.02 * 0.03;
/// Against bending along z, the section standing upright.
const SECOND_MOMENT: f64 = 0.02 * 0.03 * 0.03 * 0.03 / 12.0;

fn steel() -> Material {
    Material::new(YOUNG, Elasticity::Poisson(0.3), None)
        .and_then(|steel| steel.with_expansion(EXPANSION))
        .expect("a material")
}

fn flat() -> Section {
    let shape = SectionShape::Rectangle {
        width: 0.02,
        height: 0.03,
    };
    Section::new(shape, None, None).expect("a section")
}

fn add(
    model: &mut Model,
    name: &str,
    between: [Option<NodeId>; 2],
    joint: impl Joint + 'static,
    stiffness: JointStiffness,
    frame: Rotation3<f64>,
) -> JointId {
    let connection = Connection {
        name: name.into(),
        between,
        joint: Box::new(joint),
        locked: DofSet::EMPTY,
        stiffness,
    };
    model.add_joint(connection, frame).expect("a joint")
}

fn weld(model: &mut Model, name: &str, between: [Option<NodeId>; 2]) -> JointId {
    let rigid = JointStiffness::default();
    add(model, name, between, Fixed, rigid, Rotation3::identity())
}

/// A bar along x through A, its middle M, which is the output, and B.
fn bar() -> Model {
    let mut model = Model::new("bar");
    let at = |share: f64| Point3::new(share * LENGTH, 0.0, 0.0);
    let points = [("A", at(0.0)), ("M", at(0.5)), ("B", at(1.0))];
    model
        .add_beam("bar", &points, &steel(), &flat(), None, 1)
        .expect("a body");
    model.set_output(on_bar(&model, "M"));
    model
}

fn on_bar(model: &Model, point: &str) -> NodeId {
    model.node("bar", point).expect("a node")
}

fn only(direction: Dof, value: f64) -> Vector6<f64> {
    Vector6::ith(direction.index(), value)
}

fn springs(stiffness: [f64; 6]) -> JointStiffness {
    JointStiffness::Directions(stiffness.map(Some))
}

/// Equal but for the rounding of a well-conditioned solve of a few elements.
fn near(found: f64, expected: f64, what: &str) {
    let difference = (found - expected).abs();
    assert!(
        difference <= 1e-11 * expected.abs(),
        "{what}: {found:e} instead of {expected:e}"
    );
}

/// All results of two solutions are equal to `tolerance` of the largest of their kind.
fn same(found: &Solution, expected: &Solution, tolerance: f64) {
    let wrenches = |s: &Solution| -> Vec<Vector6<f64>> {
        let all = s.joint_wrenches.iter();
        all.map(|w| w.expect("a determined wrench")).collect()
    };
    let (own, other) = (wrenches(found), wrenches(expected));
    for (found, expected) in [
        (&found.displacements, &expected.displacements),
        (&own, &other),
    ] {
        let largest = expected.iter().map(Vector6::amax).fold(0.0, f64::max);
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).amax() <= tolerance * largest, "{a} is not {b}");
        }
    }
    let difference = (found.output.displacement - expected.output.displacement).amax();
    assert!(difference <= tolerance * expected.output.displacement.amax());
}

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

/// Two bars from walls to a rigid platform on a slide along x, each on a spring along x alone.
fn between_drives(k: f64) -> (Model, [JointId; 2]) {
    let mut model = Model::new("drives");
    let point = |x: f64| Point3::new(x, 0.0, 0.0);
    let mut bar = |name: &str, from: f64, to: f64| {
        let points = [("wall", point(from)), ("drive", point(to))];
        model
            .add_beam(name, &points, &steel(), &flat(), None, 1)
            .expect("a body");
    };
    bar("left", -1.0, -0.1);
    bar("right", 1.0, 0.1);
    let points = [("L", point(-0.1)), ("P", point(0.0)), ("R", point(0.1))];
    model.add_rigid("platform", &points).expect("a body");
    let node = |model: &Model, body, point| model.node(body, point);
    let slide = [None, node(&model, "platform", "P")];
    let y_along_x = Rotation3::from_axis_angle(&Vector3::z_axis(), -std::f64::consts::FRAC_PI_2);
    let free = JointStiffness::default();
    add(&mut model, "slide", slide, Prismatic, free, y_along_x);
    let mut drives = [JointId(0); 2];
    for (drive, (name, at)) in drives.iter_mut().zip([("left", "L"), ("right", "R")]) {
        let wall = [None, node(&model, name, "wall")];
        weld(&mut model, &format!("{name} wall"), wall);
        let between = [node(&model, name, "drive"), node(&model, "platform", at)];
        let spring = springs([k, 0.0, 0.0, 0.0, 0.0, 0.0]);
        *drive = add(
            &mut model,
            name,
            between,
            Fixed,
            spring,
            Rotation3::identity(),
        );
    }
    let output = node(&model, "platform", "P").expect("a node");
    model.set_output(output);
    (model, drives)
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

/// Two cantilevers whose tips a hinge about z joins.
fn hinged() -> (Model, JointId, [NodeId; 2]) {
    let mut model = Model::new("hinged");
    let at = |x: f64| Point3::new(x, 0.0, 0.0);
    for (name, x) in [("left", 0.0), ("right", 2.0)] {
        let points = [("wall", at(x)), ("tip", at(1.0))];
        model
            .add_beam(name, &points, &steel(), &flat(), None, 1)
            .expect("a body");
        let wall = model.node(name, "wall");
        weld(&mut model, name, [None, wall]);
    }
    let tips = ["left", "right"].map(|name| model.node(name, "tip").expect("a node"));
    let columns = [Vector3::x(), Vector3::z(), -Vector3::y()];
    let frame = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&columns));
    let rigid = JointStiffness::default();
    let hinge = add(&mut model, "hinge", tips.map(Some), Revolute, rigid, frame);
    model.set_output(tips[0]);
    (model, hinge, tips)
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
    let plan = Plan::new(&model).expect("a plan");
    let respond = |model: &Model| {
        plan.respond(model, std::slice::from_ref(&load))
            .expect("a response")
    };
    let without = between_drives(2e6).0;
    let (with, without) = (respond(&model), respond(&without));
    assert_eq!(with[0].displacements, without[0].displacements);
    assert_eq!(with[0].joint_wrenches, without[0].joint_wrenches);
    let swept = plan
        .sweep(&model, model.geometry(), &mut plan.workspace())
        .expect("a pose");
    let alone = swept.displacement.expect("a displacement");
    near(alone[0], misfits_alone.output.displacement[0], "sweep");
    near(
        swept.cases[0][0],
        both.cases[0].state.output[0],
        "sweep of a case",
    );
}

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

#[test]
fn misfits_and_preloads_have_their_directions() {
    let (mut model, hinge, _) = hinged();
    let refused = model
        .set_misfit(hinge, &only(Dof::V, 1e-3))
        .expect_err("free");
    assert!(matches!(
        refused,
        ModelError::FreeMisfit {
            direction: Dof::V,
            ..
        }
    ));
    let refused = model
        .set_preload(hinge, &only(Dof::Z, 1.0))
        .expect_err("rigid");
    assert!(matches!(
        refused,
        ModelError::RigidPreload {
            direction: Dof::Z,
            ..
        }
    ));
    for wrong in [f64::NAN, f64::INFINITY] {
        let values = only(Dof::X, wrong);
        assert!(model.set_misfit(hinge, &values).is_err());
        assert!(model.set_preload(hinge, &values).is_err());
    }
    assert!(model.misfits().is_empty());
    assert_eq!(model.misfit(hinge), None);
}

#[test]
fn a_preload_on_a_motion_that_nothing_resists_is_refused() {
    let mut model = Model::new("spinner");
    let points = [("A", Point3::origin()), ("B", Point3::new(0.0, 0.1, 0.0))];
    model.add_rigid("wheel", &points).expect("a body");
    let a = model.node("wheel", "A");
    let rigid = JointStiffness::default();
    let axle = add(
        &mut model,
        "axle",
        [None, a],
        Revolute,
        rigid,
        Rotation3::identity(),
    );
    model.set_output(a.expect("a node"));
    model
        .set_preload(axle, &only(Dof::V, 1.0))
        .expect("a preload");
    let refused = solve(&model).expect_err("it spins");
    assert_eq!(
        refused.to_string(),
        "the preload of joint `axle` works on a motion that nothing resists: `wheel` turns about \
         its own axis (0, 1, 0)"
    );
    let wheel = model.body("wheel").expect("a body");
    assert!(matches!(refused, SolveError::PreloadOnFreeMotion { body, .. } if body == wheel));

    // A load that does more work is the one to blame.
    let load = Load {
        node: model.node("wheel", "B").expect("a node"),
        wrench: only(Dof::V, 5.0),
        axes: Axes::Global,
    };
    let nodes = vec![load];
    let lines = Vec::new();
    model.set_loads(LoadSet { nodes, lines }).expect("loads");
    let refused = solve(&model).expect_err("it spins");
    assert!(matches!(
        refused,
        SolveError::LoadOnFreeMotion { load: Some(0), .. }
    ));
}

#[test]
fn the_budget_of_a_displacement_has_the_misfits() {
    let (mut model, [left, right]) = between_drives(2e6);
    model
        .set_misfit(left, &only(Dof::X, 1e-4))
        .expect("a misfit");
    model
        .set_preload(right, &only(Dof::X, 70.0))
        .expect("a preload");
    model
        .set_misfit(JointId(1), &only(Dof::X, 3e-5))
        .expect("a misfit");
    let load = Load {
        node: model.output().expect("an output"),
        wrench: only(Dof::X, 50.0),
        axes: Axes::Global,
    };
    let loads = LoadSet {
        nodes: vec![load],
        lines: Vec::new(),
    };
    model.set_loads(loads).expect("loads");
    let solution = solve(&model).expect("a solution");
    let influence = Influence::new(&model).expect("unit states");
    let along = only(Dof::X, 1.0);
    let budget = influence.budget(&solution, &along);
    // The wall and the drive on the left push through one spring each side of the platform.
    let share = budget
        .parts
        .iter()
        .filter(|part| part.deformation == Deformation::Misfit);
    let misfits: f64 = share.map(|part| part.displacement).sum();
    near(misfits, (1e-4 + 3e-5) / 2.0, "misfits");
    assert!(
        budget.rest.abs() < 1e-11 * budget.total.abs(),
        "{}",
        budget.rest
    );
    // Each sensitivity against central differences: 1e-4 of the stiffness, errors of its square.
    for sensitivity in influence.sensitivities(&solution).expect("sensitivities") {
        if let hyperstat_assembly::Parameter::Joint { .. } = sensitivity.parameter {
            let moved = |factor: f64| {
                let (mut other, _) = between_drives(2e6 * factor);
                other
                    .set_misfit(left, &only(Dof::X, 1e-4))
                    .expect("a misfit");
                other
                    .set_preload(right, &only(Dof::X, 70.0))
                    .expect("a preload");
                other
                    .set_misfit(JointId(1), &only(Dof::X, 3e-5))
                    .expect("a misfit");
                other.set_loads(model.load_set().clone()).expect("loads");
                solve(&other).expect("a solution").output.displacement[0]
            };
            let step = 1e-4;
            let difference = (moved(1.0 + step) - moved(1.0 - step)) / (2.0 * step);
            let derivative = sensitivity.displacement.expect("a derivative");
            let found = derivative[0] * sensitivity.value;
            assert!((found - difference).abs() < 1e-7 * difference.abs());
        }
    }
}
