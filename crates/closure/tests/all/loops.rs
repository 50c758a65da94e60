//! Random single loops and chains: what is reached keeps every body rigid and every joint joined.

use crate::support;

use hyperstat_closure::{ClosureError, Configuration, LoopClosure, Target};
use hyperstat_joints::{Cylindrical, Dof, Prismatic, Revolute, Spherical, Universal};
use hyperstat_model::{Geometry, JointId, Model};
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use proptest::prelude::*;
use support::{Builder, drive, turned};

/// What is joined stays joined to this (m, rad), in mechanisms of the size of a metre.
const JOINED: f64 = 1e-11;
/// How far apart the points are that a body's turn is read from.
const ARM: f64 = 0.4;

/// [`JOINED`], and what reading a place costs where slides have gone far: a position of size L is
/// known to its rounding, which turns axes read from points [`ARM`] apart, and moves what is L away.
fn joined(geometry: &Geometry) -> f64 {
    let far = geometry
        .positions
        .iter()
        .fold(0.0_f64, |far, p| far.max(p.coords.amax()));
    JOINED + 4.0 * f64::EPSILON * far * (1.0 + far / ARM)
}

/// Kinds of joints around a loop of mobility 1, and how many there are of them.
pub fn loop_of(kinds: &[u8], places: &[[f64; 3]], axes: &[[f64; 3]]) -> Model {
    let mut b = Builder::new();
    let count = kinds.len();
    let names: Vec<String> = (0..count).map(|k| format!("j{k}")).collect();
    let body = |k: usize| -> String {
        match k {
            0 => "ground".into(),
            k if k == count => "ground".into(),
            k => format!("b{k}"),
        }
    };
    for k in 1..count {
        let [from, to] = [places[k - 1], places[k]];
        let off = |d: usize| -> [f64; 3] {
            std::array::from_fn(|c| from[c] + if c == d { ARM } else { 0.0 })
        };
        let points = [
            ("o", from),
            ("x", off(0)),
            ("y", off(1)),
            ("z", off(2)),
            (names[k - 1].as_str(), from),
            (names[k].as_str(), to),
        ];
        b.body(&body(k), &points);
    }
    for k in 0..count {
        let bodies = [body(k), body(k + 1)];
        // Either order of the bodies.
        let [one, other] = [bodies[0].as_str(), bodies[1].as_str()];
        let bodies = if k % 3 == 2 {
            [other, one]
        } else {
            [one, other]
        };
        let (name, axis) = (names[k].as_str(), axes[k]);
        match kinds[k] {
            b'R' => b.joint(name, name, bodies, Revolute, axis, k == 0),
            b'P' => b.joint(name, name, bodies, Prismatic, axis, k == 0),
            b'C' => b.joint(name, name, bodies, Cylindrical, axis, k == 0),
            b'U' => b.joint(name, name, bodies, Universal, axis, k == 0),
            _ => b.joint(name, name, bodies, Spherical, axis, k == 0),
        };
    }
    b.output("b2", "x");
    b.0
}

/// Loops of mobility 1 that begin with a driven revolute joint.
pub const LOOPS: [&str; 7] = ["RRRRRRR", "RSSR", "RUSR", "RSCR", "RCCC", "RRSRR", "RPSRR"];

fn turn_of(model: &Model, geometry: &Geometry, joint: usize, side: usize) -> Matrix3<f64> {
    match model.joints()[joint].between[side] {
        None => Matrix3::identity(),
        Some(node) => {
            let body = model.nodes()[node.0].body;
            turned(model, geometry, &model.bodies()[body.0].name)
        }
    }
}

/// Where the body on one side of a joint has the point that was its node at home.
fn point_of(model: &Model, geometry: &Geometry, joint: usize, side: usize) -> Point3<f64> {
    let between = model.joints()[joint].between;
    match between[side] {
        None => {
            let other = between[1 - side].expect("a body");
            model.geometry().positions[other.0]
        }
        Some(node) => {
            let body = &model.bodies()[model.nodes()[node.0].body.0];
            let origin = body.nodes[0].0;
            let home = model.geometry().positions[node.0] - model.geometry().positions[origin];
            geometry.positions[origin] + turned(model, geometry, &body.name) * home
        }
    }
}

/// The conditions of every kind, from the bodies' points alone.
fn check_joints(model: &Model, geometry: &Geometry) -> Result<(), TestCaseError> {
    let joined = joined(geometry);
    for body in model.bodies() {
        let r = turned(model, geometry, &body.name);
        let off = (r.transpose() * r - Matrix3::identity()).amax();
        prop_assert!(off < joined, "{} is strained: {off:e}", body.name);
    }
    for (k, joint) in model.joints().iter().enumerate() {
        let home = model.geometry().frames[k];
        let [first, second] = [0, 1].map(|side| turn_of(model, geometry, k, side));
        let [p, q] = [0, 1].map(|side| point_of(model, geometry, k, side));
        let axis = |turn: &Matrix3<f64>, column: usize| turn * home.matrix().column(column);
        let apart: Vector3<f64> = q - p;
        let off = match joint.joint.kind() {
            "Revolute" => apart
                .norm()
                .max((axis(&first, 1) - axis(&second, 1)).norm()),
            "Prismatic" => (apart.cross(&axis(&first, 1)).norm()).max((first - second).amax()),
            "Cylindrical" => {
                let across = apart.cross(&axis(&first, 1)).norm();
                across.max((axis(&first, 1) - axis(&second, 1)).norm())
            }
            "Universal" => apart
                .norm()
                .max(axis(&first, 0).dot(&axis(&second, 1)).abs()),
            "Spherical" => apart.norm(),
            other => panic!("{other}"),
        };
        prop_assert!(
            off < joined,
            "{} ({}) is off by {off:e}",
            joint.name,
            joint.joint.kind()
        );
    }
    Ok(())
}

pub fn vectors(count: usize) -> impl Strategy<Value = Vec<[f64; 3]>> {
    proptest::collection::vec(proptest::array::uniform3(-1.0..1.0_f64), count)
}

pub fn is_fit(places: &[[f64; 3]], axes: &[[f64; 3]]) -> bool {
    let far = |p: &[[f64; 3]]| (Vector3::from(p[0]) - Vector3::from(p[1])).norm() > 0.2;
    places.windows(2).all(far) && axes.iter().all(|a| Vector3::from(*a).norm() > 0.3)
}

fn write(closure: &LoopClosure, model: &Model, at: &Configuration) -> Geometry {
    let mut geometry = model.geometry().clone();
    closure
        .write(at, &mut geometry)
        .expect("rigid bodies give way");
    geometry
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    /// A driven loop stays closed, or says that it cannot go so far; and what was done is undone
    /// on the way back.
    #[test]
    fn loops_stay_closed(
        kind in 0..LOOPS.len(),
        places in vectors(7),
        axes in vectors(7),
        angle in -1.5..1.5_f64,
    ) {
        prop_assume!(is_fit(&places, &axes));
        let model = loop_of(LOOPS[kind].as_bytes(), &places, &axes);
        let closure = LoopClosure::new(&model).expect("a linkage");
        let home = closure.home();
        let drives = [drive(JointId(0), Dof::V, angle)];
        let reached = match closure.reach(&home, &Target::Drives(&drives)) {
            Ok(reached) => reached,
            Err(ClosureError::Unreachable { .. } | ClosureError::Singular { .. } | ClosureError::Branch { .. }) => return Ok(()),
            Err(other) => return Err(TestCaseError::fail(other.to_string())),
        };
        prop_assert_eq!(closure.value(&reached, JointId(0), Dof::V).map(|v| (v - angle).abs() < 1e-12), Some(true));
        prop_assert!(closure.misfit(&reached).expect("its own") < 1e-12);
        check_joints(&model, &write(&closure, &model, &reached))?;
        // And back: the same branch.
        let drives = [drive(JointId(0), Dof::V, 0.0)];
        let back = closure.reach(&reached, &Target::Drives(&drives));
        let back = back.map_err(|error| TestCaseError::fail(error.to_string()))?;
        let [found, wanted] = [&back, &home].map(|at| write(&closure, &model, at));
        for (node, (p, q)) in found.positions.iter().zip(&wanted.positions).enumerate() {
            // A rod between two balls may have spun.
            let spins = LOOPS[kind] == "RSSR" && model.nodes()[node].body.0 == 1;
            prop_assert!(spins || (p - q).norm() < 1e-8, "{} {node}: {}", LOOPS[kind], (p - q).norm());
        }
    }

    /// A chain of six joints reaches poses near home, whole.
    #[test]
    fn chains_reach_poses(
        kinds in proptest::collection::vec(prop_oneof![3 => Just(b'R'), 1 => Just(b'P')], 6),
        places in vectors(7),
        axes in vectors(6),
        offset in proptest::array::uniform6(-0.05..0.05_f64),
    ) {
        prop_assume!(is_fit(&places, &axes));
        let mut b = Builder::new();
        for k in 0..6 {
            let off = |d: usize| -> [f64; 3] { std::array::from_fn(|c| places[k][c] + if c == d { ARM } else { 0.0 }) };
            let next = format!("j{}", k + 1);
            let own = format!("j{k}");
            let points = [
                ("o", places[k]),
                ("x", off(0)),
                ("y", off(1)),
                ("z", off(2)),
                (own.as_str(), places[k]),
                (next.as_str(), places[k + 1]),
            ];
            b.body(&format!("b{}", k + 1), &points);
        }
        for k in 0..6 {
            let [one, other] = [k, k + 1].map(|k| if k == 0 { "ground".into() } else { format!("b{k}") });
            let name = format!("j{k}");
            match kinds[k] {
                b'R' => b.joint(&name, &name, [&one, &other], Revolute, axes[k], true),
                _ => b.joint(&name, &name, [&one, &other], Prismatic, axes[k], true),
            };
        }
        b.output("b6", "j6");
        let model = b.0;
        let closure = LoopClosure::new(&model).expect("a linkage");
        prop_assume!(closure.output_mobility() == 6);
        let mut wanted = offset;
        for k in 0..3 { wanted[k] += places[6][k]; }
        match closure.reach(&closure.home(), &Target::Output(wanted.map(Some))) {
            Ok(reached) => {
                let found = closure.pose(&reached).expect("its own");
                let geometry = write(&closure, &model, &reached);
                let near = joined(&geometry);
                for k in 0..6 { prop_assert!((found[k] - wanted[k]).abs() < near, "{found:?} {wanted:?}"); }
                check_joints(&model, &geometry)?;
                let turn = Rotation3::new(Vector3::new(wanted[3], wanted[4], wanted[5]));
                prop_assert!((turned(&model, &geometry, "b6") - turn.matrix()).amax() < near);
            }
            Err(ClosureError::Unreachable { .. } | ClosureError::Singular { .. } | ClosureError::Branch { .. }) => {}
            Err(other) => return Err(TestCaseError::fail(other.to_string())),
        }
    }
}
