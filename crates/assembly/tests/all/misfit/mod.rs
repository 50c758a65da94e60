//! Misfits and preloads of joints, against closed forms of the strength of materials, rigid
//! kinematics, and loads that do the same.

use hyperstat_assembly::{
    Axes, Connection, Deformation, JointId, JointStiffness, Load, LoadCase, LoadSet, Model,
    ModelError, NodeId, Prepared, Solution, SolveError, solve,
};
use hyperstat_elements::{Elasticity, Material};
use hyperstat_joints::{Dof, DofSet, Fixed, Joint, Prismatic, Revolute};
use nalgebra::{Matrix3, Matrix6, Point3, Rotation3, Vector3, Vector6};

use crate::parts::flat;

mod budget;
mod elastic;
mod refused;
mod rigid;

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
