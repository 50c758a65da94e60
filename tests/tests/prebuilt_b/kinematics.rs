//! Bodies keep their shape from pose to pose, and `place` gives what `model` gives.

use hyperstat_assembly::{BodyId, Geometry, Model, NodeId};
use hyperstat_mechanisms::prebuilt::Prebuilt;
use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;

use crate::mechanisms::{agile_eye, cases, exechon};

/// Loops close to rounding.
const CLOSED: f64 = 1e-12;

/// A mechanism and a pose in its reach.
fn posed() -> impl Strategy<Value = (usize, [f64; 3])> {
    (0..cases().len(), [-1.0..1.0, -1.0..1.0, -1.0..1.0_f64]).prop_map(|(index, unit)| {
        let case = &cases()[index];
        let (middle, span) = match case.mechanism.kind() {
            "PlanarThreeRrr" => ([0.0; 3], [0.06, 0.06, 0.4]),
            "SphericalThreeRrr" => ([0.0, 0.0, 0.4], [0.3, 0.3, 0.3]),
            "Exechon" => ([0.0, 0.0, case.poses[0][2]], [0.3, 0.3, 0.3]),
            _ => ([0.0; 3], [0.1; 3]),
        };
        (
            index,
            std::array::from_fn(|k| middle[k] + span[k] * unit[k]),
        )
    })
}

/// Unit directions fixed in a body: from its first node to its others, and the axes of its joints.
/// The directions of links that slide in each other are theirs too.
fn directions(model: &Model, geometry: &Geometry, body: BodyId) -> Vec<Vector3<f64>> {
    let nodes = &model.bodies()[body.0].nodes;
    let at = |node: NodeId| geometry.positions[node.0];
    let first = at(nodes[0]);
    let spans = nodes[1..]
        .iter()
        .map(|node| (at(*node) - first).normalize());
    let axes = model.joints().iter().zip(&geometry.frames);
    let axes = axes.flat_map(|(joint, frame)| {
        let side = joint.between.iter().position(|node| {
            let body_of = |node: NodeId| model.nodes()[node.0].body;
            node.map(body_of) == Some(body)
        });
        let column = |k: usize| frame.matrix().column(k).into_owned();
        match (side, joint.joint.kind()) {
            (Some(_), "Revolute") => vec![column(1)],
            (Some(_), "Prismatic") => vec![column(0), column(1)],
            (Some(side), "Universal") => vec![column(side)],
            _ => Vec::new(),
        }
    });
    spans.chain(axes).collect()
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
    /// along their axis.
    #[test]
    fn loops_close((index, pose) in posed()) {
        let case = &cases()[index];
        let home = case.mechanism.model(&case.poses[0]).expect("in reach");
        let mut first = home.geometry().clone();
        let mut second = first.clone();
        let from = case.mechanism.place(&case.poses[0], &mut first).expect("in reach");
        let to = case.mechanism.place(&pose, &mut second).expect("in reach");
        for (k, body) in home.bodies().iter().enumerate() {
            let [before, after] = [&first, &second].map(|g| directions(&home, g, BodyId(k)));
            for r in 0..before.len() {
                for c in 0..r {
                    let change = before[r].dot(&before[c]) - after[r].dot(&after[c]);
                    prop_assert!(change.abs() < CLOSED, "{} {}: {}", body.name, r, change);
                }
            }
            let slides = ["housing", "ram"].iter().any(|word| body.name.starts_with(word));
            for node in body.nodes.iter().filter(|_| !slides) {
                let length = |g: &Geometry| {
                    (g.positions[node.0] - g.positions[body.nodes[0].0]).norm()
                };
                prop_assert!((length(&first) - length(&second)).abs() < CLOSED, "{}", body.name);
            }
        }

        let rotation = |pose: [f64; 6]| {
            Rotation3::from_scaled_axis(Vector3::new(pose[3], pose[4], pose[5]))
        };
        let turn = rotation(to) * rotation(from).inverse();
        let platform = home.body("platform").expect("a platform");
        let [before, after] = [&first, &second].map(|g| directions(&home, g, platform));
        for (before, after) in before.iter().zip(&after) {
            prop_assert!((turn * before - after).amax() < CLOSED, "platform");
        }

        for (k, joint) in home.joints().iter().enumerate() {
            let [a, b] = joint.between;
            let (Some(node), None) = (b.or(a), a.and(b)) else { continue };
            let travel = second.positions[node.0] - first.positions[node.0];
            let axis = |g: &Geometry| g.frames[k].matrix().column(1).into_owned();
            let across = match joint.joint.kind() {
                "Prismatic" => travel - axis(&first) * axis(&first).dot(&travel),
                _ => travel,
            };
            prop_assert!(across.amax() < CLOSED, "{}", joint.name);
            if ["Prismatic", "Revolute"].contains(&joint.joint.kind()) {
                prop_assert!((axis(&first) - axis(&second)).amax() < CLOSED, "{}", joint.name);
            }
        }
    }
}

#[test]
fn the_agile_eye_is_orthogonal() {
    let model = agile_eye().model(&[0.0; 3]).expect("in reach");
    for at in ["A", "C"] {
        let axis = |limb: usize| {
            let name = format!("{at}{limb}");
            let joint = model.joints().iter().position(|j| j.name == name);
            let frame = model.geometry().frames[joint.expect("the joint")];
            frame.matrix().column(1).into_owned()
        };
        for (r, c) in [(1, 2), (2, 3), (3, 1)] {
            assert!(axis(r).dot(&axis(c)).abs() < 1e-15);
        }
    }
}

/// The platform of the Exechon is not turned where it stands over the middle of the base, and is
/// tilted everywhere else.
#[test]
fn the_exechon_tilts_as_its_legs_ask() {
    let exechon = exechon();
    let mut geometry = exechon
        .model(&[0.0, 0.0, 0.9])
        .expect("in reach")
        .geometry()
        .clone();
    let mut turn = |pose: [f64; 3]| {
        let whole = exechon.place(&pose, &mut geometry).expect("in reach");
        [whole[3], whole[4], whole[5]]
    };
    assert_eq!(turn([0.0, 0.0, 0.9]), [0.0; 3]);
    assert_eq!(turn([0.0, 0.0, -0.9]), [0.0; 3]);
    let [rx, ry, rz] = turn([0.0, -0.9, 0.9]);
    assert!((rx - std::f64::consts::FRAC_PI_4).abs() < 1e-15 && ry == 0.0 && rz == 0.0);
    let [rx, ry, rz] = turn([0.3, 0.0, 0.9]);
    assert!((ry - (1.0 / 3.0_f64).atan()).abs() < 1e-15 && rx == 0.0 && rz == 0.0);
}
