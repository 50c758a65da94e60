//! Checks of one mechanism, alike for all.

use hyperstat_assembly::{BodyId, Geometry, Model, NodeId, solve};
use hyperstat_mechanisms::PoseError;
use hyperstat_mechanisms::prebuilt::{ParameterError, Prebuilt};
use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;

use super::{CLOSED, Case, FLOOR, loaded, solved};
use crate::{stiffness, stiffness_difference, vector_differences};

/// Between the two solvers, both of which refine.
const AGREEMENT: f64 = 1e-9;

/// Bodies that slide in each other: their lengths change.
const SLIDING: [&str; 4] = ["piston", "spline", "housing", "ram"];

/// Place writes what the model is built with, and the output where it says.
///
/// # Errors
/// What differs.
///
/// # Panics
/// Where the pose is out of reach.
pub fn check_place_is_model(case: &Case, pose: &[f64]) -> Result<(), TestCaseError> {
    let model = case.mechanism.model(pose).expect("in reach");
    let other = case.mechanism.model(&case.poses[0]).expect("in reach");
    let mut geometry = other.geometry().clone();
    let whole = case.mechanism.place(pose, &mut geometry).expect("in reach");
    prop_assert_eq!(&geometry, model.geometry());
    for (value, coordinate) in pose.iter().zip(case.mechanism.coordinates()) {
        prop_assert_eq!(*value, whole[coordinate.index()]);
    }
    let output = model.output().expect("an output");
    prop_assert_eq!(model.node_name(output), "platform.P");
    let at = geometry.positions[output.0];
    prop_assert_eq!(at.coords, Vector3::new(whole[0], whole[1], whole[2]));
    Ok(())
}

/// Every body keeps its shape, with the axes of the joints that it carries, from pose to pose;
/// the platform turns as the pose says; the ground's joints stay where they are or slide
/// along their axis, and keep the axes that are fixed in the ground.
///
/// # Errors
/// What does not.
///
/// # Panics
/// Where the pose is out of reach.
pub fn check_loops_close(case: &Case, pose: &[f64]) -> Result<(), TestCaseError> {
    let home = case.mechanism.model(&case.poses[1]).expect("in reach");
    let (mut first, mut second) = (home.geometry().clone(), home.geometry().clone());
    let place = |pose: &[f64], g: &mut Geometry| case.mechanism.place(pose, g).expect("in reach");
    let from = place(&case.poses[1], &mut first);
    let to = place(pose, &mut second);
    for (k, body) in home.bodies().iter().enumerate() {
        let [before, after] = [&first, &second].map(|g| directions(&home, g, BodyId(k)));
        for r in 0..before.len() {
            for c in 0..r {
                let change = before[r].dot(&before[c]) - after[r].dot(&after[c]);
                prop_assert!(change.abs() < CLOSED, "{} {}: {}", body.name, r, change);
            }
        }
        let slides = SLIDING.iter().any(|word| body.name.starts_with(word));
        for node in body.nodes.iter().filter(|_| !slides) {
            let length = |g: &Geometry| (g.positions[node.0] - g.positions[body.nodes[0].0]).norm();
            let change = length(&first) - length(&second);
            prop_assert!(change.abs() < CLOSED, "{}", body.name);
        }
    }

    let rotation =
        |pose: [f64; 6]| Rotation3::from_scaled_axis(Vector3::new(pose[3], pose[4], pose[5]));
    let turn = rotation(to) * rotation(from).inverse();
    let platform = home.body("platform").expect("a platform");
    let [before, after] = [&first, &second].map(|g| directions(&home, g, platform));
    for (before, after) in before.iter().zip(&after) {
        prop_assert!((turn * before - after).amax() < CLOSED, "platform");
    }

    for (k, joint) in home.joints().iter().enumerate() {
        let [a, b] = joint.between;
        let (Some(node), None) = (b.or(a), a.and(b)) else {
            continue;
        };
        let kind = joint.joint.kind();
        let travel = second.positions[node.0] - first.positions[node.0];
        let axis = |g: &Geometry| {
            let column = if kind == "Universal" { 0 } else { 1 };
            g.frames[k].matrix().column(column).into_owned()
        };
        let across = match kind {
            "Prismatic" => travel - axis(&first) * axis(&first).dot(&travel),
            _ => travel,
        };
        prop_assert!(across.amax() < CLOSED, "{}", joint.name);
        let change = axis(&first) - axis(&second);
        prop_assert!(change.amax() < CLOSED, "{}", joint.name);
    }
    Ok(())
}

/// Unit directions fixed in a body: from its first node to its others, its segments' local y, and
/// the axes of its joints.
fn directions(model: &Model, geometry: &Geometry, body: BodyId) -> Vec<Vector3<f64>> {
    let nodes = &model.bodies()[body.0].nodes;
    let at = |node: &NodeId| geometry.positions[node.0];
    let spans = nodes[1..]
        .iter()
        .map(|node| (at(node) - at(&nodes[0])).normalize());
    let mut all: Vec<_> = spans.collect();
    let segments = model.bodies()[body.0].segments.iter();
    all.extend(segments.map(|segment| geometry.y_axes[segment.0].expect("a local y").normalize()));
    for (joint, frame) in model.joints().iter().zip(&geometry.frames) {
        let of_body = |node: &Option<NodeId>| node.is_some_and(|node| nodes.contains(&node));
        let Some(side) = joint.between.iter().position(of_body) else {
            continue;
        };
        let columns: &[usize] = match joint.joint.kind() {
            "Revolute" => &[1],
            "Prismatic" => &[0, 1],
            "Universal" => &[[0], [1]][side],
            _ => &[],
        };
        all.extend(
            columns
                .iter()
                .map(|k| frame.matrix().column(*k).into_owned()),
        );
    }
    all
}

/// Asserts that mobility, degree of over-constraint and idle motions are those of the literature,
/// in all the case's poses.
///
/// # Panics
/// Where they are not.
pub fn assert_counts(case: &Case) {
    for pose in &case.poses {
        let what = case.what(pose);
        let found = solved(&*case.mechanism, pose);
        let counts = [found.mobility, found.overconstraint, found.idle.len()];
        assert_eq!(counts, case.counts, "{what}");
        assert!(found.warnings.is_empty(), "{what}: {:?}", found.warnings);
    }
}

/// Asserts that stiffness and displacements are the independent solver's, in all the case's poses.
///
/// # Panics
/// Where they are not.
pub fn assert_solved_as_by_reference(case: &Case) {
    for pose in &case.poses {
        let what = case.what(pose);
        let model = loaded(&*case.mechanism, pose);
        let found = solve(&model).expect(&what);
        let expected = hyperstat_reference::solve(&model).expect(&what);
        let wanted = expected.stiffness.expect(&what);
        let difference = stiffness_difference(&stiffness(&found), &wanted);
        assert!(difference <= AGREEMENT, "{what}: K_o {difference:e}");
        let output = expected.displacement.expect(&what);
        let difference = vector_differences([(&found.output.displacement, &output)], FLOOR);
        assert!(
            difference.iter().all(|d| *d <= AGREEMENT),
            "{what}: output {difference:?}"
        );
        if !found.idle.is_empty() {
            // Displacements of spinning legs and rods are defined only up to the spin.
            continue;
        }
        let nodes = found.displacements.iter().zip(&expected.displacements);
        let difference = vector_differences(nodes, FLOOR);
        assert!(
            difference.iter().all(|d| *d <= AGREEMENT),
            "{what}: displacements {difference:?}"
        );
    }
}

/// A parameter's name, and what spoils it.
pub type Spoilt<'a, M> = (&'a str, fn(&mut M));

/// Asserts that `check` and `model` name the field, once it is spoilt, and its value.
///
/// # Panics
/// Where they do not.
pub fn assert_refused<M: Prebuilt + Clone>(
    mechanism: &M,
    check: fn(&M) -> Result<(), ParameterError>,
    pose: &[f64],
    cases: &[Spoilt<'_, M>],
) {
    assert_eq!(check(mechanism), Ok(()));
    for (field, spoil) in cases {
        let mut spoilt = mechanism.clone();
        spoil(&mut spoilt);
        let error = check(&spoilt).expect_err(field);
        assert_eq!(error.field, *field);
        let model = spoilt.model(pose).map(drop);
        assert_eq!(model, Err(PoseError::Parameter(error)), "{field}");
    }
}
