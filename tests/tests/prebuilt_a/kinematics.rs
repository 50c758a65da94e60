//! Poses: what they place is what the model is built with, and their loops close.

use std::collections::HashMap;

use hyperstat_assembly::{BodyId, Geometry, Model, NodeId};
use hyperstat_mechanisms::prebuilt::{Prebuilt, TelescopicLeg, ThreeRps};
use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;

use crate::mechanisms::{
    cases, hexapod, leg, linear_delta, position, three_prs, three_rps, tricept,
};

/// Loops close to rounding.
const CLOSED: f64 = 1e-12;

/// The orientation of the Tricept is that of two turns, about x and then about its own y.
#[test]
fn the_tricept_turns_as_its_middle_leg() {
    let tricept = tricept();
    let model = tricept.model(&[0.0, 0.0, 0.9]).expect("in reach");
    let mut geometry = model.geometry().clone();
    for (about_x, about_y) in [(0.0, 0.0), (0.3, 0.0), (0.0, -0.4), (0.25, 0.35_f64)] {
        let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), about_x)
            * Rotation3::from_axis_angle(&Vector3::y_axis(), about_y);
        let place = turn * Vector3::new(0.0, 0.0, 0.95);
        let whole = tricept
            .place(place.as_slice(), &mut geometry)
            .expect("in reach");
        let found = Rotation3::from_scaled_axis(Vector3::new(whole[3], whole[4], whole[5]));
        assert!((found.matrix() - turn.matrix()).amax() < 1e-15);
    }
}

/// A mechanism and a pose in its reach.
fn posed() -> impl Strategy<Value = (usize, Vec<f64>)> {
    (0..cases().len(), prop::array::uniform6(-1.0..1.0_f64)).prop_map(|(index, unit)| {
        let case = &cases()[index];
        let home = case.poses[0].iter().zip(unit);
        (index, home.map(|(c, u)| c + case.span * u).collect())
    })
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

/// Lengths that bodies have by their parameters.
fn lengths(model: &Model, geometry: &Geometry) -> HashMap<String, f64> {
    let length = |nodes: &[NodeId]| {
        let [first, last] = [nodes[0], nodes[nodes.len() - 1]];
        (geometry.positions[last.0] - geometry.positions[first.0]).norm()
    };
    let bodies = model.bodies().iter();
    let fixed = bodies.filter(|body| {
        !["piston", "spline"]
            .iter()
            .any(|w| body.name.starts_with(w))
    });
    fixed
        .map(|body| (body.name.clone(), length(&body.nodes)))
        .collect()
}

#[test]
fn links_have_the_lengths_of_their_parameters() {
    let wanted = HashMap::from([
        ("Hexapod", ("cylinder", 0.36)),
        ("LinearDelta", ("rod", 0.45)),
        ("Tricept", ("cylinder", 0.36)),
        ("ThreeRps", ("cylinder", 0.36)),
        ("ThreePrs", ("rod", 0.5)),
    ]);
    let mechanisms: [(&dyn Prebuilt, &[f64]); 5] = [
        (&hexapod(), &[0.1, 0.05, 0.75, 0.2, -0.15, 0.3]),
        (&linear_delta(), &[0.08, -0.05, 0.8]),
        (&tricept(), &[0.25, 0.2, 0.95]),
        (&three_rps(), &[0.7, 0.2, -0.1]),
        (&three_prs(), &[0.9, 0.2, -0.1]),
    ];
    for (mechanism, pose) in mechanisms {
        let model = mechanism.model(pose).expect("in reach");
        let (body, wanted) = wanted[mechanism.kind()];
        let found = lengths(&model, model.geometry());
        let found: Vec<_> = found
            .iter()
            .filter(|(name, _)| name.starts_with(body))
            .collect();
        assert!(found.len() >= 3, "{}", mechanism.kind());
        for (name, length) in found {
            assert!((length - wanted).abs() < CLOSED, "{name}: {length}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// Place writes what the model is built with, and the output where it says.
    #[test]
    fn place_is_model((index, pose) in posed()) {
        let case = &cases()[index];
        let model = case.mechanism.model(&pose).expect("in reach");
        let other = case.mechanism.model(&case.poses[0]).expect("in reach");
        let mut geometry = other.geometry().clone();
        let whole = case.mechanism.place(&pose, &mut geometry).expect("in reach");
        prop_assert_eq!(&geometry, model.geometry());
        for (value, coordinate) in pose.iter().zip(case.mechanism.coordinates()) {
            prop_assert_eq!(*value, whole[coordinate.index()]);
        }
        let output = model.output().expect("an output");
        prop_assert_eq!(model.node_name(output), "platform.P");
        let at = geometry.positions[output.0];
        prop_assert_eq!(at.coords, Vector3::new(whole[0], whole[1], whole[2]));
    }

    /// Every body keeps its shape, with the axes of the joints that it carries, from pose to pose;
    /// the platform turns as the pose says; the ground's joints stay where they are or slide
    /// along their axis, and keep the axes that are fixed in the ground.
    #[test]
    fn loops_close((index, pose) in posed()) {
        let case = &cases()[index];
        let home = case.mechanism.model(&case.poses[1]).expect("in reach");
        let mut first = home.geometry().clone();
        let mut second = first.clone();
        let from = case.mechanism.place(&case.poses[1], &mut first).expect("in reach");
        let to = case.mechanism.place(&pose, &mut second).expect("in reach");
        for (k, body) in home.bodies().iter().enumerate() {
            let [before, after] = [&first, &second].map(|g| directions(&home, g, BodyId(k)));
            for r in 0..before.len() {
                for c in 0..r {
                    let change = before[r].dot(&before[c]) - after[r].dot(&after[c]);
                    prop_assert!(change.abs() < CLOSED, "{} {}: {}", body.name, r, change);
                }
            }
        }
        let after = lengths(&home, &second);
        for (body, length) in lengths(&home, &first) {
            prop_assert!((length - after[&body]).abs() < CLOSED, "{}", body);
        }

        let rotation = |pose: [f64; 6]| {
            Rotation3::from_scaled_axis(Vector3::new(pose[3], pose[4], pose[5]))
        };
        let turn = rotation(to) * rotation(from).inverse();
        let platform = &home.bodies()[home.body("platform").expect("a platform").0].nodes;
        for node in platform {
            let seen = |g: &Geometry| g.positions[node.0] - g.positions[platform[0].0];
            prop_assert!((turn * seen(&first) - seen(&second)).amax() < CLOSED, "platform");
        }

        for (k, joint) in home.joints().iter().enumerate() {
            let [None, Some(node)] = joint.between else { continue };
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
            prop_assert!((axis(&first) - axis(&second)).amax() < CLOSED, "{}", joint.name);
        }
    }

    /// 3-RPS and 3-PRS: the corners stay in their planes, for tilts of any size.
    #[test]
    fn corners_stay_in_their_planes(rx in -1.5..1.5, ry in -1.5..1.5) {
        let three_rps = ThreeRps {
            leg: TelescopicLeg { lengths: (0.37, 9.0), ..leg() },
            ..three_rps()
        };
        let model = three_rps.model(&[2.0, rx, ry]).expect("in reach");
        for (number, angle) in [(1, 90.0_f64), (2, 210.0), (3, 330.0)] {
            let (sin, cos) = angle.to_radians().sin_cos();
            let corner = position(&model, "platform", &format!("S{number}"));
            let aside = corner.coords.dot(&Vector3::new(-sin, cos, 0.0));
            prop_assert!(aside.abs() < 1e-15, "S{} is {} aside", number, aside);
        }
    }
}
