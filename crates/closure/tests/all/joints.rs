//! The finite motions of every kind of joint, against products of plain turns and travels, and
//! where joints stand when they slide.

use crate::support;

use hyperstat_closure::{ClosureError, LoopClosure, Target};
use hyperstat_joints::{
    Cylindrical, Dof, DofSet, Joint, Planar, Prismatic, Revolute, Screw, Spherical, Universal,
    frame_from_axes,
};
use hyperstat_model::{JointId, Model};
use nalgebra::{Matrix3, Matrix6, Point3, Rotation3, Vector3};
use support::{Builder, drive, driven, geometry, position, turned};

const ZERO: [f64; 3] = [0.0; 3];

/// A body that spans space, on one joint with the ground at the point O.
fn on_one_joint(joint: impl Joint + 'static, frame: Rotation3<f64>) -> (Model, JointId) {
    let mut b = Builder::new();
    let points = [
        ("O", ZERO),
        ("X", [0.5, 0.0, 0.0]),
        ("Y", [0.0, 0.5, 0.0]),
        ("Z", [0.0, 0.0, 0.5]),
    ];
    b.body("body", &points);
    let joint = b.framed("J", "O", ["ground", "body"], joint, frame, true);
    b.output("body", "O");
    (b.0, joint)
}

fn oblique() -> Rotation3<f64> {
    frame_from_axes(&Vector3::new(1.0, 2.0, -0.5), &Vector3::new(0.3, -0.1, 1.0)).expect("a frame")
}

/// Asserts that values of a joint's directions turn and move the body as expected, in the
/// joint's frame at home.
fn assert_moves(
    joint: impl Joint + 'static,
    values: &[(Dof, f64)],
    turn: Matrix3<f64>,
    travel: Vector3<f64>,
) {
    let frame = oblique();
    let (model, id) = on_one_joint(joint, frame);
    let closure = LoopClosure::new(&model).expect("a linkage");
    let drives: Vec<_> = values.iter().map(|(dof, v)| drive(id, *dof, *v)).collect();
    let at = driven(&closure, &drives).expect("an open chain");
    let moved = geometry(&model, &closure, &at);
    let r = frame.matrix();
    let found = turned(&model, &moved, "body");
    let wanted = r * turn * r.transpose();
    assert!((found - wanted).amax() < 1e-13, "{found}{wanted}");
    let place = position(&model, &moved, "body", "O").coords;
    assert!((place - r * travel).amax() < 1e-13, "{place}");
    for (dof, value) in values {
        let found = closure.value(&at, id, *dof).expect("a value");
        assert!((found - value).abs() < 1e-13);
    }
}

fn about(axis: Vector3<f64>, angle: f64) -> Matrix3<f64> {
    Rotation3::new(axis * angle).into_inner()
}

#[test]
fn every_kind_moves_as_it_is_made() {
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let still = Matrix3::identity();
    let none = Vector3::zeros();
    use Dof::{U, V, W, X, Y, Z};
    assert_moves(Revolute, &[(V, 7.5)], about(y, 7.5), none);
    assert_moves(Prismatic, &[(Y, -0.8)], still, y * -0.8);
    assert_moves(Cylindrical, &[(Y, 0.4), (V, -4.0)], about(y, -4.0), y * 0.4);
    let screw = Screw::new(0.01).expect("a pitch");
    assert_moves(screw, &[(V, 40.0)], about(y, 40.0), y * 0.4);
    // x is fixed in the ground, y in the body.
    let cross = about(x, 1.1) * about(y, -2.0);
    assert_moves(Universal, &[(U, 1.1), (V, -2.0)], cross, none);
    assert_moves(
        Planar,
        &[(X, 0.3), (Z, -0.2), (V, 2.5)],
        about(y, 2.5),
        x * 0.3 - z * 0.2,
    );
    // Locked rotations of a ball are three turns, one after another.
    let ball = about(x, 0.4) * about(y, 0.7) * about(z, -1.3);
    assert_moves(Spherical, &[(U, 0.4), (V, 0.7), (W, -1.3)], ball, none);
}

/// A screw of 1 mm per radian moves 0.25 m in forty turns.
#[test]
fn a_screw_counts_its_turns() {
    let screw = Screw::new(0.001).expect("a pitch");
    let (model, id) = on_one_joint(screw, Rotation3::identity());
    let closure = LoopClosure::new(&model).expect("a linkage");
    let asked = [None, Some(0.25), None, None, None, None];
    let at = closure
        .reach(&closure.home(), &Target::Output(asked))
        .expect("in reach");
    let angle = closure.value(&at, id, Dof::V).expect("an angle");
    assert!((angle - 250.0).abs() < 1e-9, "{angle}");
    let [_, y, _, rx, ry, rz] = closure.pose(&at).expect("its own");
    assert!((y - 0.25).abs() < 1e-13 && rx.abs() < 1e-12 && rz.abs() < 1e-12);
    assert!((ry - 250.0).abs() < 1e-9, "turns are kept: {ry}");
    // The same by its rotation vector.
    let asked = [None, None, None, Some(0.0), Some(-100.0), Some(0.0)];
    let at = closure
        .reach(&closure.home(), &Target::Output(asked))
        .expect("in reach");
    assert!((closure.pose(&at).expect("its own")[1] + 0.1).abs() < 1e-12);
}

/// A shaft that turns in the ground drives a nut that slides on the ground.
#[test]
fn a_spindle_drives_its_nut() {
    let pitch = 0.002;
    let mut b = Builder::new();
    b.body("shaft", &[("A", ZERO), ("B", [0.0, 0.3, 0.0])]);
    b.body("nut", &[("B", [0.0, 0.3, 0.0]), ("N", [0.1, 0.3, 0.0])]);
    let y = [0.0, 1.0, 0.0];
    let motor = b.joint("motor", "A", ["ground", "shaft"], Revolute, y, true);
    let thread = Screw::new(pitch).expect("a pitch");
    let thread = b.joint("thread", "B", ["shaft", "nut"], thread, y, false);
    let guide = b.joint("guide", "N", ["ground", "nut"], Prismatic, y, false);
    b.output("nut", "N");
    let closure = LoopClosure::new(&b.0).expect("a linkage");
    for turns in [30.0, -77.7] {
        let at = driven(&closure, &[drive(motor, Dof::V, turns)]).expect("a nut");
        let values = [(thread, Dof::V, -turns), (guide, Dof::Y, -pitch * turns)];
        for (joint, dof, wanted) in values {
            let found = closure.value(&at, joint, dof).expect("a value");
            assert!((found - wanted).abs() < 1e-11, "{found}, not {wanted}");
        }
        // The thread's point stays with its first body, the shaft; the nut's gives way.
        let moved = geometry(&b.0, &closure, &at);
        let place = position(&b.0, &moved, "nut", "B");
        assert!(
            (place - Point3::new(0.0, 0.3, 0.0)).norm() < 1e-12,
            "{place}"
        );
        let place = position(&b.0, &moved, "nut", "N");
        assert!(
            (place - Point3::new(0.1, 0.3 - pitch * turns, 0.0)).norm() < 1e-12,
            "{place}"
        );
    }
}

/// A universal joint whose axes pass each other at a distance, stated by its basis alone.
#[derive(Debug, Clone)]
struct Offset(f64);

impl Joint for Offset {
    fn kind(&self) -> &str {
        "Offset"
    }
    fn free(&self) -> DofSet {
        DofSet::new(&[Dof::U, Dof::V])
    }
    fn basis(&self) -> Matrix6<f64> {
        // The turn about y, whose axis passes at this distance along z.
        let mut basis = Matrix6::identity();
        basis[(0, 4)] = -self.0;
        basis
    }
    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(self.clone())
    }
}

#[test]
fn a_joint_of_one_s_own_moves_by_its_basis() {
    let offset = 0.1;
    let (model, id) = on_one_joint(Offset(offset), Rotation3::identity());
    let closure = LoopClosure::new(&model).expect("a linkage");
    let (u, v) = (0.8_f64, -1.7_f64);
    let at = driven(&closure, &[drive(id, Dof::U, u), drive(id, Dof::V, v)]).expect("open");
    let centre = Vector3::new(0.0, 0.0, offset);
    let place = about(Vector3::x(), u) * (centre - about(Vector3::y(), v) * centre);
    let [x, y, z, ..] = closure.pose(&at).expect("its own");
    assert!((Vector3::new(x, y, z) - place).amax() < 1e-14);
}

/// Free motions that are not those of the basis once it has moved: a travel along y that does
/// not turn with the first of two turns.
#[derive(Debug, Clone)]
struct Loose;

impl Joint for Loose {
    fn kind(&self) -> &str {
        "Loose"
    }
    fn free(&self) -> DofSet {
        DofSet::new(&[Dof::Y, Dof::U, Dof::W])
    }
    fn clone_box(&self) -> Box<dyn Joint> {
        Box::new(self.clone())
    }
}

#[test]
fn a_basis_that_holds_at_home_alone_is_refused() {
    let (model, _) = on_one_joint(Loose, Rotation3::identity());
    let error = LoopClosure::new(&model).expect_err("no finite motion");
    assert!(matches!(error, ClosureError::Motions { .. }), "{error}");
}

/// The frame of a universal joint keeps x in its first body and y in its second.
#[test]
fn the_frame_of_a_universal_joint_stands_between_its_bodies() {
    let frame = oblique();
    let (model, id) = on_one_joint(Universal, frame);
    let closure = LoopClosure::new(&model).expect("a linkage");
    let at = driven(&closure, &[drive(id, Dof::U, 0.9), drive(id, Dof::V, 0.6)]).expect("open");
    let moved = geometry(&model, &closure, &at);
    let found = moved.frames[0];
    assert!((found.matrix().column(0) - frame.matrix().column(0)).amax() < 1e-14);
    let y = turned(&model, &moved, "body") * frame.matrix().column(1);
    assert!((found.matrix().column(1) - y).amax() < 1e-13);
}
