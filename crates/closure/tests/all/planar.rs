//! Plane linkages against trigonometry: cranks of many turns, dead centres, assembly modes.

use crate::support;

use std::f64::consts::{PI, TAU};

use hyperstat_closure::{ClosureError, LoopClosure, Target};
use hyperstat_joints::{Dof, Fixed, Prismatic, Revolute};
use hyperstat_model::{JointId, Model, NodeId};
use support::{Builder, drive, driven, geometry, placed, position};

const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// Links of 1 m from the origin along x and y; the elbow is on the right of the way to the tip.
fn arm() -> (Model, [JointId; 2]) {
    let mut b = Builder::new();
    b.body("upper", &[("A", [0.0; 3]), ("B", [1.0, 0.0, 0.0])]);
    b.body("lower", &[("B", [1.0, 0.0, 0.0]), ("C", [1.0, 1.0, 0.0])]);
    let shoulder = b.joint("A", "A", ["ground", "upper"], Revolute, Z, true);
    let elbow = b.joint("B", "B", ["upper", "lower"], Revolute, Z, true);
    b.output("lower", "C");
    (b.0, [shoulder, elbow])
}

#[test]
fn an_arm_keeps_its_elbow() {
    let (model, [shoulder, elbow]) = arm();
    let closure = LoopClosure::new(&model).expect("a linkage");
    for (x, y) in [(1.9, 0.1), (0.3, 0.2), (-1.0, 1.2), (0.9, -1.5)] {
        let at = placed(&closure, [x, y, 0.0]).expect("in reach");
        let distance = f64::hypot(x, y);
        let bend = (distance * distance / 2.0 - 1.0).acos();
        let angle = closure.value(&at, elbow, Dof::V).expect("an angle") + PI / 2.0;
        assert!((angle - bend).abs() < 1e-11, "{x} {y}: {angle}, not {bend}");
        let lean = f64::atan2(y, x) - bend / 2.0;
        let angle = closure.value(&at, shoulder, Dof::V).expect("an angle");
        let off = (angle - lean + PI).rem_euclid(TAU) - PI;
        assert!(off.abs() < 1e-11, "{x} {y}: {angle}, not {lean}");
        assert!(closure.misfit(&at).expect("its own") < 1e-14);
    }
}

#[test]
fn an_arm_says_what_it_cannot_do() {
    let (model, _) = arm();
    let closure = LoopClosure::new(&model).expect("a linkage");
    for place in [[2.001, 0.0, 0.0], [0.0, 30.0, 0.0]] {
        let error = placed(&closure, place).expect_err("too far");
        assert!(matches!(error, ClosureError::Unreachable { .. }), "{error}");
    }
    let error = placed(&closure, [2.0, 0.0, 0.0]).expect_err("stretched");
    assert!(matches!(error, ClosureError::Singular { .. }), "{error}");
    let error = placed(&closure, [1.0, 1.0, 0.1]).expect_err("out of its plane");
    assert!(
        matches!(error, ClosureError::CannotFollow { .. }),
        "{error}"
    );
    assert!(
        error.to_string().contains("z is 0.000000, not 0.1"),
        "{error}"
    );
    let error = placed(&closure, [f64::NAN, 1.0, 0.0]).expect_err("no number");
    assert!(matches!(error, ClosureError::NotFinite { .. }), "{error}");
    // Two freedoms: the orientation follows.
    let asked = [
        Some(1.2),
        Some(0.4),
        Some(0.0),
        Some(0.0),
        Some(0.0),
        Some(0.5),
    ];
    let error = closure.reach(&closure.home(), &Target::Output(asked));
    let error = error.expect_err("another orientation");
    assert!(
        matches!(error, ClosureError::CannotFollow { .. }),
        "{error}"
    );
    assert_eq!(closure.output_mobility(), 2);
}

/// Ground 4, crank 1, coupler 3, rocker 3.5: the crank turns round (Grashof).
fn four_bar() -> (Model, [JointId; 4]) {
    let (x, y) = circles((1.0, 0.0), 3.0, (4.0, 0.0), 3.5, 1.0);
    let (b, c, d) = ([1.0, 0.0, 0.0], [x, y, 0.0], [4.0, 0.0, 0.0]);
    let mut builder = Builder::new();
    builder.body("crank", &[("A", [0.0; 3]), ("B", b)]);
    builder.body("coupler", &[("B", b), ("C", c)]);
    builder.body("rocker", &[("C", c), ("D", d)]);
    let joints = [
        builder.joint("A", "A", ["ground", "crank"], Revolute, Z, true),
        builder.joint("B", "B", ["crank", "coupler"], Revolute, Z, false),
        builder.joint("C", "C", ["coupler", "rocker"], Revolute, Z, false),
        builder.joint("D", "D", ["ground", "rocker"], Revolute, Z, true),
    ];
    builder
        .0
        .set_output(builder.0.node("coupler", "C").expect("C"));
    (builder.0, joints)
}

/// Where two circles meet, on the side `side` of the way from one middle to the other.
fn circles(p: (f64, f64), r: f64, q: (f64, f64), s: f64, side: f64) -> (f64, f64) {
    let (dx, dy) = (q.0 - p.0, q.1 - p.1);
    let d = dx.hypot(dy);
    let along = (d * d + r * r - s * s) / (2.0 * d);
    let across = side * (r * r - along * along).sqrt();
    (
        p.0 + (along * dx - across * dy) / d,
        p.1 + (along * dy + across * dx) / d,
    )
}

/// Only one of its two drives may be given: the other is released by unlocking it.
fn with_one_drive(released: usize) -> (Model, [JointId; 4]) {
    let (model, joints) = four_bar();
    let mut builder = Builder::new();
    for body in model.bodies() {
        let points: Vec<(&str, [f64; 3])> = (body.nodes.iter())
            .map(|n| {
                let at = model.geometry().positions[n.0];
                (model.nodes()[n.0].point.as_str(), at.into())
            })
            .collect();
        builder.body(&body.name, &points);
    }
    for (k, joint) in model.joints().iter().enumerate() {
        let mut joint = joint.clone();
        if k == released {
            joint.locked = hyperstat_joints::DofSet::EMPTY;
        }
        let frame = model.geometry().frames[k];
        builder.0.add_joint(joint, frame).expect("a joint");
    }
    builder.0.set_output(model.output().expect("an output"));
    (builder.0, joints)
}

#[test]
fn a_crank_turns_round_and_round() {
    let (model, [a, ..]) = with_one_drive(3);
    let closure = LoopClosure::new(&model).expect("a linkage");
    let start = circles((1.0, 0.0), 3.0, (4.0, 0.0), 3.5, 1.0);
    assert!(start.1 > 0.0);
    for angle in [0.4, 2.0, -1.0, 3.0 * TAU + 0.7, -2.0 * TAU - 2.5_f64] {
        let at = driven(&closure, &[drive(a, Dof::V, angle)]).expect("a crank");
        let moved = geometry(&model, &closure, &at);
        let c = position(&model, &moved, "coupler", "C");
        let (x, y) = circles((angle.cos(), angle.sin()), 3.0, (4.0, 0.0), 3.5, 1.0);
        assert!(
            (c.x - x).hypot(c.y - y) < 1e-12,
            "{angle}: {c}, not {x} {y}"
        );
        assert_eq!(closure.value(&at, a, Dof::V), Some(angle));
        assert!(closure.misfit(&at).expect("its own") < 1e-14);
    }
}

/// The rocker cannot pass the line of the ground: beyond it there is the mirror image alone.
#[test]
fn a_rocker_does_not_jump_to_its_mirror_image() {
    let (model, [.., d]) = with_one_drive(0);
    let closure = LoopClosure::new(&model).expect("a linkage");
    let home = circles((1.0, 0.0), 3.0, (4.0, 0.0), 3.5, 1.0);
    let angle = f64::atan2(home.1, home.0 - 4.0);
    let error = driven(&closure, &[drive(d, Dof::V, TAU - 2.0 * angle)]).expect_err("mirrored");
    assert!(matches!(error, ClosureError::Branch { .. }), "{error}");
    let error = driven(&closure, &[drive(d, Dof::V, PI - angle)]).expect_err("too far");
    assert!(matches!(error, ClosureError::Unreachable { .. }), "{error}");
    driven(&closure, &[drive(d, Dof::V, 0.1)]).expect("a little");
}

/// A locked direction that is not named stays; one that is free is no drive.
#[test]
fn drives_are_what_is_locked() {
    let (model, [a, b, _, d]) = four_bar();
    let closure = LoopClosure::new(&model).expect("a linkage");
    let both: Vec<_> = closure.drives().collect();
    assert_eq!(both, [(a, Dof::V), (d, Dof::V)]);
    let error = driven(&closure, &[drive(a, Dof::V, 0.2)]).expect_err("the rocker is locked");
    assert!(matches!(error, ClosureError::Unreachable { .. }), "{error}");
    let error = driven(&closure, &[drive(b, Dof::V, 0.2)]).expect_err("free");
    assert!(
        error
            .to_string()
            .contains("`B.v` is not a drive: it is free"),
        "{error}"
    );
    let error = driven(&closure, &[drive(a, Dof::X, 0.2)]).expect_err("held");
    assert!(error.to_string().contains("does not move"), "{error}");
}

/// A slider and crank: `x = cos θ + √(l² − sin² θ)`.
#[test]
fn a_slider_follows_its_crank() {
    let mut b = Builder::new();
    b.body("crank", &[("A", [0.0; 3]), ("B", [0.0, 1.0, 0.0])]);
    let far = 3.0_f64.sqrt();
    b.body("rod", &[("B", [0.0, 1.0, 0.0]), ("C", [far, 0.0, 0.0])]);
    b.body("slider", &[("C", [far, 0.0, 0.0])]);
    let a = b.joint("A", "A", ["ground", "crank"], Revolute, Z, true);
    b.joint("B", "B", ["crank", "rod"], Revolute, Z, false);
    b.joint("C", "C", ["rod", "slider"], Revolute, Z, false);
    let guide = b.joint(
        "D",
        "C",
        ["ground", "slider"],
        Prismatic,
        [1.0, 0.0, 0.0],
        false,
    );
    b.output("slider", "C");
    let closure = LoopClosure::new(&b.0).expect("a linkage");
    for turn in [0.3, -1.2, PI, 9.0 * PI] {
        let at = driven(&closure, &[drive(a, Dof::V, turn)]).expect("a crank");
        let angle = turn + PI / 2.0;
        let x = angle.cos() + (4.0 - angle.sin().powi(2)).sqrt();
        let found = closure.pose(&at).expect("its own")[0];
        assert!((found - x).abs() < 1e-12, "{turn}: {found}, not {x}");
        let travel = closure.value(&at, guide, Dof::Y).expect("a travel");
        assert!((travel - (x - far)).abs() < 1e-12, "{turn}: {travel}");
        let moved = geometry(&b.0, &closure, &at);
        let [one, other] = ["rod", "slider"].map(|body| position(&b.0, &moved, body, "C"));
        assert!((one - other).norm() < 1e-13);
    }
}

/// What has no joint that moves stays where it is; there is nothing to decompose.
#[test]
fn what_cannot_move_stays_at_home() {
    let mut b = Builder::new();
    b.body("bar", &[("A", [0.0; 3]), ("B", [0.3, 0.0, 0.1])]);
    let z = [0.0, 0.0, 1.0];
    b.joint("weld", "A", ["ground", "bar"], Fixed, z, false);
    b.output("bar", "B");
    let closure = LoopClosure::new(&b.0).expect("a linkage");
    assert_eq!(closure.output_mobility(), 0);
    let home = closure.home();
    let stays = closure
        .reach(&home, &Target::Output([None; 6]))
        .expect("at home");
    assert_eq!(closure.pose(&stays), Ok([0.3, 0.0, 0.1, 0.0, 0.0, 0.0]));
    placed(&closure, [0.3, 0.0, 0.1]).expect("at home");
    driven(&closure, &[]).expect("at home");
    let error = placed(&closure, [0.3, 0.1, 0.1]).expect_err("it cannot move");
    assert!(
        matches!(error, ClosureError::CannotFollow { .. }),
        "{error}"
    );
    // A loop that cannot move, too.
    b.joint("second", "B", ["ground", "bar"], Fixed, z, false);
    let closure = LoopClosure::new(&b.0).expect("a linkage");
    assert_eq!(closure.output_mobility(), 0);
    placed(&closure, [0.3, 0.0, 0.1]).expect("at home");
}

/// Joints, configurations, geometries and models that do not belong together are errors.
#[test]
fn what_is_of_another_mechanism_is_refused() {
    let (model, [a, ..]) = with_one_drive(3);
    let closure = LoopClosure::new(&model).expect("a linkage");
    let other = LoopClosure::new(&model).expect("a linkage");
    let home = other.home();
    let foreign = Err(ClosureError::ForeignConfiguration);
    assert_eq!(closure.reach(&home, &Target::Drives(&[])), foreign);
    assert_eq!(closure.pose(&home), Err(ClosureError::ForeignConfiguration));
    assert_eq!(
        closure.misfit(&home),
        Err(ClosureError::ForeignConfiguration)
    );
    let mut moved = model.geometry().clone();
    assert_eq!(
        closure.write(&home, &mut moved),
        Err(ClosureError::ForeignConfiguration)
    );
    assert_eq!(closure.value(&home, a, Dof::V), None);
    assert_eq!(other.value(&home, a, Dof::V), Some(0.0));
    // A clone is the same mechanism.
    assert!(closure.clone().pose(&closure.home()).is_ok());
    let count = model.joints().len();
    let joint = ClosureError::ForeignJoint { joint: 99, count };
    let ids = [drive(JointId(99), Dof::V, 0.1)];
    assert_eq!(driven(&closure, &ids), Err(joint));
    assert_eq!(closure.value(&closure.home(), JointId(99), Dof::V), None);
    moved.positions.pop();
    let error = closure
        .write(&closure.home(), &mut moved)
        .expect_err("another size");
    assert!(error.to_string().contains("the geometry holds"), "{error}");
    let mut nowhere = model.clone();
    nowhere.set_output(NodeId(99));
    let error = LoopClosure::new(&nowhere).expect_err("no node");
    assert!(error.to_string().contains("node 99"), "{error}");
}

/// Dense matrices end somewhere: a chain of 2^16 hinges is refused at once.
#[test]
fn a_chain_too_long_is_refused() {
    let mut b = Builder::new();
    let z = [0.0, 0.0, 1.0];
    let name = |k: usize| format!("b{k}");
    for k in 0..1 << 16 {
        let at = |k: usize| [k as f64, 0.0, 0.0];
        let (here, next) = (format!("p{k}"), format!("p{}", k + 1));
        b.body(&name(k), &[(&here, at(k)), (&next, at(k + 1))]);
        let before = if k > 0 { name(k - 1) } else { "ground".into() };
        b.joint(&here, &here, [&before, &name(k)], Revolute, z, true);
    }
    b.output("b0", "p1");
    let error = LoopClosure::new(&b.0).expect_err("too large");
    assert!(
        error.to_string().contains("65536 joint coordinates"),
        "{error}"
    );
    assert!(error.to_string().contains("at most 2000"), "{error}");
}
