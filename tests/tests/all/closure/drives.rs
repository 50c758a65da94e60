//! Values of drives against the closed forms, and what typed coordinates do to redundant loops.

use hyperstat_assembly::{Geometry, Model};
use hyperstat_closure::{Configuration, Drive, LoopClosure, Target};
use hyperstat_joints::Dof;
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

use super::mechanisms::{Case, cases};
use super::prebuilt::{asked, asked_from, file};

/// The pose of `case` this part of the way to the end of its range.
fn pose(case: &Case, part: f64) -> Vec<f64> {
    let signs = [0.6, -0.4, 0.7, 0.5, -0.8, 0.3];
    let spans = case.spans.iter().zip(signs);
    (case.home.iter().zip(spans))
        .map(|(home, (span, sign))| home + part * sign * span)
        .collect()
}

fn drives(closure: &LoopClosure, at: &Configuration) -> Vec<Drive> {
    let value = |(joint, direction)| Drive {
        joint,
        direction,
        value: closure
            .value(at, joint, direction)
            .expect("a drive's value"),
    };
    closure.drives().map(value).collect()
}

/// The distance of the two joints that a leg is between, or how far a crank or carriage has
/// moved, from the closed form's positions.
fn closed_form(model: &Model, home: &Geometry, there: &Geometry, drive: &Drive) -> f64 {
    let joint = &model.joints()[drive.joint.0];
    let [first, second] = joint.between;
    let axis: Vector3<f64> = home.frames[drive.joint.0].matrix().column(1).into_owned();
    let nodes = |node: hyperstat_assembly::NodeId| {
        let body = model.nodes()[node.0].body;
        &model.bodies()[body.0].nodes
    };
    let second = second.expect("a body");
    match (drive.direction, first) {
        // A leg of a cylinder and a piston: its whole length.
        (Dof::Y, Some(first)) => {
            let ends = [nodes(first)[0], *nodes(second).last().expect("a node")];
            let length = |g: &Geometry| (g.positions[ends[0].0] - g.positions[ends[1].0]).norm();
            length(there) - length(home)
        }
        // A carriage on its rail.
        (Dof::Y, None) => (there.positions[second.0] - home.positions[second.0]).dot(&axis),
        // A crank: its angle about the axis.
        _ => {
            let nodes = nodes(second);
            let arm = |g: &Geometry| -> Vector3<f64> {
                let other = nodes.iter().find(|n| **n != second).expect("a link");
                let arm = g.positions[other.0] - g.positions[second.0];
                arm - axis * axis.dot(&arm)
            };
            let (from, to) = (arm(home), arm(there));
            from.cross(&to).dot(&axis).atan2(from.dot(&to))
        }
    }
}

/// A pose gives the drives the values of the closed form, and these values give the pose back.
#[test]
fn drives_are_those_of_the_closed_forms() {
    for case in cases() {
        let what = case.mechanism.kind().to_owned();
        let model = file(&case);
        let closure = LoopClosure::new(&model).expect("a linkage");
        let there = pose(&case, 0.8);
        let mut wanted = model.geometry().clone();
        let whole = case.mechanism.place(&there, &mut wanted).expect("in reach");
        let at = closure.reach(&closure.home(), &Target::Output(asked(&case, &there)));
        let at = at.unwrap_or_else(|error| panic!("{what}: {error}"));
        let drives = drives(&closure, &at);
        // Two drives of the same rod ends would be free of each other.
        assert!([3, 6].contains(&drives.len()), "{what}: {}", drives.len());
        for drive in &drives {
            let value = closed_form(&model, model.geometry(), &wanted, drive);
            let off = (drive.value - value).abs();
            assert!(off < 1e-11, "{what} {drive:?}: {value}");
        }
        let again = closure.reach(&closure.home(), &Target::Drives(&drives));
        let again = again.unwrap_or_else(|error| panic!("{what}: {error}"));
        let found = closure.pose(&again).expect("its own");
        for k in 0..3 {
            assert!(
                (found[k] - whole[k]).abs() < 1e-10,
                "{what}: {found:?}, not {whole:?}"
            );
        }
        assert!(closure.misfit(&again).expect("its own") < 1e-12, "{what}");
    }
}

/// All numbers of a geometry to `digits` decimals, frames made square again.
fn typed(geometry: &Geometry, digits: i32) -> Geometry {
    let scale = 10.0_f64.powi(digits);
    let round = |v: Vector3<f64>| v.map(|c| (c * scale).round() / scale);
    let mut typed = geometry.clone();
    for p in &mut typed.positions {
        *p = Point3::from(round(p.coords));
    }
    for y in typed.y_axes.iter_mut().flatten() {
        *y = round(*y);
    }
    for frame in &mut typed.frames {
        let [x, y] = [0, 1].map(|c| round(frame.matrix().column(c).into_owned()));
        let y = y.normalize();
        let x = (x - y * y.dot(&x)).normalize();
        *frame = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, x.cross(&y)]));
    }
    typed
}

/// Redundant loops of coordinates typed to seven decimals contradict each other by as much; the
/// mechanism moves all the same, and the loops stay closed to that.
#[test]
fn typed_coordinates_do_not_hold_a_mechanism() {
    for case in cases() {
        let what = case.mechanism.kind().to_owned();
        let mut model = file(&case);
        model
            .set_geometry(typed(model.geometry(), 7))
            .expect("a geometry of this model");
        let closure = LoopClosure::new(&model).expect("a linkage");
        let there = pose(&case, 0.5);
        let asked = asked(&case, &there);
        let at = closure.reach(&closure.home(), &Target::Output(asked));
        let at = at.unwrap_or_else(|error| panic!("{what}: {error}"));
        assert!(
            closure.misfit(&at).expect("its own") < 2e-6,
            "{what}: {:e}",
            closure.misfit(&at).expect("its own")
        );
        let found = closure.pose(&at).expect("its own");
        for (k, wanted) in asked.iter().enumerate() {
            let off = wanted.map_or(0.0, |wanted| (found[k] - wanted).abs());
            assert!(off < 2e-6, "{what}: {found:?}, not {asked:?}");
        }
    }
}

/// The poses of a grid of `steps` values a coordinate, as wide as the mechanism's range times `wide`, that it
/// reaches; the last coordinate runs fastest, there and back, so that neighbours are near.
fn grid(case: &Case, steps: usize, wide: f64) -> Vec<Vec<f64>> {
    let mut poses = vec![Vec::new()];
    for (home, span) in case.home.iter().zip(&case.spans) {
        let values = (0..steps).map(|k| {
            let part = 2.0 * k as f64 / (steps - 1) as f64 - 1.0;
            home + wide * span * part
        });
        let values: Vec<f64> = values.collect();
        let longer = poses.iter().enumerate().flat_map(|(row, pose)| {
            let mut along = values.clone();
            if row % 2 == 1 {
                along.reverse();
            }
            along
                .into_iter()
                .map(|value| [&pose[..], &[value]].concat())
        });
        poses = longer.collect();
    }
    poses.retain(|pose| case.mechanism.place_at(pose).is_ok());
    poses
}

/// The difference of two values of a drive; of a turn within half of one.
fn apart(drive: &Drive, one: f64, other: f64) -> f64 {
    let turns = match drive.direction.is_rotation() {
        true => ((one - other) / std::f64::consts::TAU).round(),
        false => 0.0,
    };
    (one - other - turns * std::f64::consts::TAU).abs()
}

/// In a grid that begins in a far corner, the way to some poses is singular, or leads out of reach.
#[test]
fn every_pose_of_a_grid_has_its_drives_from_any_corner() {
    let (mut ways, mut neighbours) = (0, 0);
    for case in cases() {
        let what = case.mechanism.kind();
        let poses = grid(&case, if case.home.len() > 3 { 2 } else { 4 }, 1.6);
        assert!(poses.len() > 10, "{what}: {}", poses.len());
        for corner in [&poses[0], &poses[poses.len() - 1]] {
            let drives = |pose: &Vec<f64>| {
                let drives = case.mechanism.drives_between(corner, pose);
                drives.unwrap_or_else(|error| panic!("{what} {corner:?} {pose:?}: {error}"))
            };
            let found: Vec<Vec<Drive>> = poses.iter().map(drives).collect();
            for k in 1..poses.len() {
                ways += 1;
                let model = case.mechanism.model(&poses[k - 1]).expect("in reach");
                let closure = LoopClosure::new(&model).expect("a linkage");
                let asked = asked_from(&case, &poses[k - 1], &poses[k]);
                let Ok(reached) = closure.place_at(&Target::Output(asked)) else {
                    continue;
                };
                neighbours += 1;
                let [before, now] = [&found[k - 1], &found[k]];
                for ((before, now), step) in before.iter().zip(now).zip(&reached.drives) {
                    let off = apart(step, now.value - before.value, step.value);
                    assert!(off < 1e-8, "{what} {:?} {step:?}: {off:e}", poses[k]);
                }
            }
        }
    }
    assert!(neighbours * 10 > ways * 9, "{neighbours} of {ways}");
}
