//! A gripper of any size: two elastic fingers between driven carriages and a rigid grip plate.

use hyperstat_assembly::{JointStiffness, Member, Model};
use hyperstat_joints::{Fixed, Prismatic, Revolute, frame_from_axis};
use nalgebra::{Point3, Rotation3, Vector3, Vector6};

use crate::build::{circle, connection, member, node, steel};

/// Distance of neighbouring nodes of a finger (m).
const PITCH: f64 = 0.02;
/// Nodes of a finger along x and along y.
const ACROSS: usize = 4;
/// Distance of the fingers' middles (m).
const APART: f64 = 0.3;

/// A compliant gripper: two fingers of lattices with 4 × 4 × `layers` nodes, welded beams of one
/// frame body each, lean towards one another. A finger's lowest layer is welded to a rigid
/// carriage, which a locked slide along x with an elastic drive holds on the ground; its uppermost
/// layer is joined by hinges to the rigid plate that both hold. The output is the middle
/// of the plate, with a force and a moment on it.
///
/// # Panics
/// With fewer than three layers.
pub fn gripper(layers: usize) -> Model {
    assert!(layers > 2, "a finger has a layer between its ends");
    let mut model = Model::new("gripper");
    let height = PITCH * (layers - 1) as f64;
    let middle = Point3::new(0.0, 0.0, height);
    let tops: Vec<_> = [-1.0, 1.0].map(|side| tip_points(side, height)).concat();
    let mut points = vec![("middle", middle)];
    points.extend(tops.iter().map(|(name, place)| (name.as_str(), *place)));
    model.add_rigid("plate", &points).expect("a plate");
    for (finger, side) in [("left", -1.0), ("right", 1.0)] {
        add_finger(&mut model, finger, side, layers);
    }
    let output = node(&model, "plate", "middle");
    let wrench = Vector6::new(10.0, -20.0, 5.0, 0.3, 0.2, -0.1);
    model.add_load(output, wrench).expect("a load");
    model.set_output(output);
    model
}

/// Nodes of a layer: their names' parts and their places.
fn layer(side: f64, z: f64, height: f64) -> impl Iterator<Item = ([usize; 2], Point3<f64>)> {
    // The fingers' tips are nearer by a tenth than their roots.
    let lean = side * (APART / 2.0 - 0.1 * (z / height) * APART);
    let grid = (0..ACROSS).flat_map(|y| (0..ACROSS).map(move |x| [x, y]));
    grid.map(move |[x, y]| {
        let [x_place, y_place] = [x, y].map(|k| PITCH * (k as f64 - (ACROSS - 1) as f64 / 2.0));
        ([x, y], Point3::new(lean + x_place, y_place, z))
    })
}

/// The plate's points at the tip of the finger on a side.
fn tip_points(side: f64, height: f64) -> Vec<(String, Point3<f64>)> {
    let finger = if side < 0.0 { "left" } else { "right" };
    let points = layer(side, height, height);
    points
        .map(|([x, y], place)| (format!("{finger}_{x}_{y}"), place))
        .collect()
}

fn add_finger(model: &mut Model, finger: &str, side: f64, layers: usize) {
    let height = PITCH * (layers - 1) as f64;
    let (steel, section) = (steel(), circle(0.004));
    let mut names = Vec::new();
    let mut places = Vec::new();
    for z in 0..layers {
        for ([x, y], place) in layer(side, PITCH * z as f64, height) {
            names.push(format!("{x}_{y}_{z}"));
            places.push(place);
        }
    }
    let points = names.iter().map(String::as_str).zip(places.iter().copied());
    let points: Vec<_> = points.collect();
    let mut members: Vec<Member> = Vec::new();
    let counts = [ACROSS, ACROSS, layers];
    for k in 0..names.len() {
        let at = [k % ACROSS, k / ACROSS % ACROSS, k / (ACROSS * ACROSS)];
        for (axis, step) in [1, ACROSS, ACROSS * ACROSS].into_iter().enumerate() {
            // The carriage and the plate stand for the beams within the outer layers.
            let outer = axis < 2 && (at[2] == 0 || at[2] == layers - 1);
            if at[axis] + 1 < counts[axis] && !outer {
                members.push(member([k, k + step], &steel, &section));
            }
        }
    }
    model
        .add_elastic(finger, &points, &members)
        .expect("a finger");

    let carriage = format!("{finger}_carriage");
    let roots: Vec<_> = layer(side, 0.0, height)
        .map(|([x, y], place)| (format!("{x}_{y}"), place))
        .collect();
    let drive = Point3::new(side * APART / 2.0, 0.0, -PITCH);
    let mut points = vec![("drive", drive)];
    points.extend(roots.iter().map(|(name, place)| (name.as_str(), *place)));
    model.add_rigid(&carriage, &points).expect("a carriage");
    for (name, _) in &roots {
        let ends = [
            Some(node(model, &carriage, name)),
            Some(node(model, finger, &format!("{name}_0"))),
        ];
        let weld = connection(&format!("{finger}_root_{name}"), ends, Fixed);
        model
            .add_joint(weld, Rotation3::identity())
            .expect("a joint");
        let ends = [
            Some(node(model, finger, &format!("{name}_{}", layers - 1))),
            Some(node(model, "plate", &format!("{finger}_{name}"))),
        ];
        let hinge = connection(&format!("{finger}_tip_{name}"), ends, Revolute);
        let frame = frame_from_axis(Some(&Vector3::y()), None).expect("an axis");
        model.add_joint(hinge, frame).expect("a joint");
    }
    let ends = [None, Some(node(model, &carriage, "drive"))];
    let mut slide = connection(&format!("{finger}_drive"), ends, Prismatic);
    slide.locked = slide.joint.free();
    let mut stiffness = [None; 6];
    for dof in slide.joint.free().iter() {
        stiffness[dof.index()] = Some(1e6);
    }
    slide.stiffness = JointStiffness::Directions(stiffness);
    let frame = frame_from_axis(Some(&Vector3::x()), None).expect("an axis");
    model.add_joint(slide, frame).expect("a joint");
}
