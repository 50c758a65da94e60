//! Frames and flexible bodies against beams, and all kinds of body against the independent solver.

use std::path::Path;

use hyperstat_assembly::{
    BodyKind, Geometry, JointStiffness, Member, Model, NodeId, Prepared, Solution, SolveError,
    Tapering, solve,
};
use hyperstat_elements::{Beam, Section, SectionShape, element_frame, rotate_matrix12};
use hyperstat_joints::{DofSet, Fixed, Revolute, frame_from_axis};
use hyperstat_mechanisms::{Disk, Registry, mechanism_from_str};
use hyperstat_tests::agreement::{
    compliances_agree, nearly_singular, stiffnesses_agree, wrenches_agree,
};
use hyperstat_tests::build::{circle, connection, member, node, steel, weld_to_ground};
use hyperstat_tests::random::check_random_mechanisms;
use hyperstat_tests::{moved, stiffness, stiffness_difference, turned_matrix, vector_differences};
use nalgebra::{DMatrix, Point3, Rotation3, Vector3, Vector6};
use proptest::prelude::*;

fn rectangle(width: f64, height: f64) -> Section {
    let shape = SectionShape::Rectangle { width, height };
    Section::new(shape, Some(0.8 * width * height), None).expect("a section")
}

const LOAD: [f64; 6] = [120.0, -80.0, 200.0, 4.0, -7.0, 11.0];

/// Stiffness over the nodes of a body of prismatic beams, global axes, added up beam by beam.
fn added_up(model: &Model, body: usize) -> DMatrix<f64> {
    let body = &model.bodies()[body];
    let mut sum = DMatrix::zeros(6 * body.nodes.len(), 6 * body.nodes.len());
    let place = |node: NodeId| body.nodes.iter().position(|n| *n == node);
    for id in &body.segments {
        let segment = &model.segments()[id.0];
        let [a, b] = segment.ends.map(|n| model.geometry().positions[n.0]);
        let y_axis = model.geometry().y_axes[id.0];
        let frame = element_frame(&(b - a), y_axis.as_ref()).expect("a frame");
        let beam = Beam::new(&segment.material, &segment.section, (b - a).norm());
        let k = rotate_matrix12(&beam.expect("a beam").stiffness(), &frame);
        let places = segment.ends.map(|n| place(n).expect("a node of the body"));
        for (r, row) in places.into_iter().enumerate() {
            for (c, column) in places.into_iter().enumerate() {
                let mut block = sum.fixed_view_mut::<6, 6>(6 * row, 6 * column);
                block += k.fixed_view::<6, 6>(6 * r, 6 * c);
            }
        }
    }
    sum
}

/// What to make of an elastic body of beams.
#[derive(Clone, Copy, PartialEq)]
enum Change {
    Keep,
    Flexible,
    Taper,
}

/// The model with some of its elastic bodies changed.
fn with_changes(model: &Model, change: impl Fn(usize) -> Change) -> Model {
    let mut new = Model::new(model.name.clone());
    let geometry = model.geometry();
    for (k, body) in model.bodies().iter().enumerate() {
        let position = |n: &NodeId| geometry.positions[n.0];
        let points: Vec<(&str, Point3<f64>)> = (body.nodes.iter())
            .map(|n| (model.nodes()[n.0].point.as_str(), position(n)))
            .collect();
        let place = |node: NodeId| body.nodes.iter().position(|n| *n == node);
        let added = match (body.kind, change(k)) {
            (BodyKind::Rigid, _) => new.add_rigid(&body.name, &points),
            (_, Change::Flexible) => new.add_flexible(&body.name, &points, &added_up(model, k)),
            (_, change) => {
                let members = body.segments.iter().map(|id| {
                    let segment = &model.segments()[id.0];
                    Member {
                        ends: segment.ends.map(|n| place(n).expect("a node of the body")),
                        material: segment.material.clone(),
                        section: segment.section.clone(),
                        taper: (change == Change::Taper)
                            .then(|| Tapering::whole(rectangle(0.055, 0.022))),
                        y_axis: geometry.y_axes[id.0],
                        elements: if change == Change::Taper { 2 } else { 1 },
                    }
                });
                new.add_elastic(&body.name, &points, &members.collect::<Vec<_>>())
            }
        };
        added.expect("a body");
    }
    for (joint, frame) in model.joints().iter().zip(&geometry.frames) {
        new.add_joint(joint.clone(), *frame).expect("a joint");
    }
    for load in model.loads() {
        new.add_load(load.node, load.wrench).expect("a load");
    }
    if let Some(output) = model.output() {
        new.set_output(output);
    }
    new
}

fn assert_same(found: &Solution, expected: &Solution) {
    let k = stiffness_difference(&stiffness(found), &stiffness(expected));
    assert!(k < 1e-10, "K_o {k:e}");
    let displacements = found.displacements.iter().zip(&expected.displacements);
    let [u, phi] = vector_differences(displacements, [0.0; 2]);
    assert!(u < 1e-10 && phi < 1e-10, "displacements {u:e} {phi:e}");
    let wrenches = found.joint_wrenches.iter().zip(&expected.joint_wrenches);
    let determined = wrenches.filter_map(|(a, b)| Some((a.as_ref()?, b.as_ref()?)));
    let [f, m] = vector_differences(determined, [0.0; 2]);
    assert!(f < 1e-9 && m < 1e-9, "wrenches {f:e} {m:e}");
}

/// The points of a bracket: two feet, a knee on each leg, and a head.
const BRACKET: [(&str, Point3<f64>); 5] = [
    ("left", Point3::new(-0.2, 0.0, 0.0)),
    ("right", Point3::new(0.2, 0.05, 0.0)),
    ("knee", Point3::new(-0.15, 0.1, 0.3)),
    ("elbow", Point3::new(0.15, 0.1, 0.25)),
    ("head", Point3::new(0.0, 0.3, 0.45)),
];

/// Its members, a triangle among them: ends, section, direction of local y.
fn bracket_members() -> Vec<Member> {
    let (thick, thin) = (rectangle(0.03, 0.05), circle(0.02));
    let mut members: Vec<Member> = [[0, 2], [1, 3], [2, 3], [2, 4], [3, 4], [0, 3]]
        .into_iter()
        .map(|ends| member(ends, &steel(), if ends[0] < 2 { &thick } else { &thin }))
        .collect();
    members[0].y_axis = Some(Vector3::new(1.0, 1.0, 0.0));
    members
}

/// The bracket as one body on two feet, welded and hinged, with a rigid tool on its head.
fn bracket(as_one: bool) -> Model {
    let mut model = Model::new("bracket");
    let members = bracket_members();
    if as_one {
        model
            .add_elastic("frame", &BRACKET, &members)
            .expect("a frame");
        weld_to_ground(&mut model, "frame", "left");
    } else {
        for (k, member) in members.iter().enumerate() {
            let points = member.ends.map(|p| BRACKET[p]);
            let ends = Member {
                ends: [0, 1],
                ..member.clone()
            };
            model
                .add_elastic(&format!("m{k}"), &points, &[ends])
                .expect("a beam");
        }
        weld_to_ground(&mut model, "m0", "left");
        // One weld for every member that meets others at a point.
        for (first, second, point) in [
            ("m0", "m5", "left"),
            ("m0", "m2", "knee"),
            ("m0", "m3", "knee"),
            ("m1", "m2", "elbow"),
            ("m1", "m4", "elbow"),
            ("m5", "m1", "elbow"),
            ("m3", "m4", "head"),
        ] {
            let between = [first, second].map(|body| Some(node(&model, body, point)));
            let weld = connection(&format!("{first}-{second}"), between, Fixed);
            model
                .add_joint(weld, Rotation3::identity())
                .expect("a weld");
        }
    }
    let tool = [BRACKET[4], ("tip", Point3::new(0.02, 0.4, 0.5))];
    model.add_rigid("tool", &tool).expect("a tool");
    let (foot, neck) = if as_one {
        ("frame", "frame")
    } else {
        ("m1", "m4")
    };
    let between = [None, Some(node(&model, foot, "right"))];
    let hinge = frame_from_axis(Some(&Vector3::x()), None).expect("a frame");
    model
        .add_joint(connection("hinge", between, Revolute), hinge)
        .expect("a joint");
    let between = [(neck, "head"), ("tool", "head")].map(|(b, p)| Some(node(&model, b, p)));
    model
        .add_joint(connection("flange", between, Fixed), Rotation3::identity())
        .expect("a joint");
    let tip = node(&model, "tool", "tip");
    model.set_output(tip);
    model.add_load(tip, LOAD.into()).expect("a load");
    model
}

#[test]
fn a_frame_is_its_beams_welded_together() {
    let (frame, welded) = (bracket(true), bracket(false));
    let [found, expected] = [&frame, &welded].map(|model| solve(model).expect("a solution"));
    let k = stiffness_difference(&stiffness(&found), &stiffness(&expected));
    assert!(k < 1e-10, "K_o {k:e}");
    for (body, point) in [
        ("m2", "elbow"),
        ("m4", "head"),
        ("tool", "tip"),
        ("m0", "knee"),
    ] {
        let own = if body == "tool" { body } else { "frame" };
        let u = found.displacements[node(&frame, own, point).0];
        let expected = expected.displacements[node(&welded, body, point).0];
        assert!(
            (u - expected).amax() < 1e-10 * expected.amax(),
            "{body}.{point}"
        );
    }
    // The feet carry the same.
    let foot = |model: &Model, name: &str| {
        let joints = model.joints();
        joints.iter().position(|j| j.name == name).expect("a foot")
    };
    for name in ["left", "hinge"] {
        let found = found.joint_wrenches[foot(&frame, name)].expect("determined");
        let expected = expected.joint_wrenches[foot(&welded, name)].expect("determined");
        assert!((found - expected).amax() < 1e-9 * expected.amax(), "{name}");
    }
}

#[test]
fn a_point_that_no_member_reaches_is_refused() {
    let mut model = Model::new("bracket");
    let members: Vec<Member> = bracket_members().drain(..2).collect();
    let error = model
        .add_elastic("frame", &BRACKET, &members)
        .expect_err("loose");
    let message = "no chain of members connects point `right` of body `frame` with its first point";
    assert_eq!(error.to_string(), message);
}

/// Two links, elbow and wrist elastic, load inside the elbow; the first drive elastic as well.
fn arm() -> Model {
    let mut model = Model::new("arm");
    let upper = [
        ("base", Point3::new(0.1, 0.2, 0.1)),
        ("middle", Point3::new(0.1, 0.45, 0.2)),
        ("elbow", Point3::new(0.15, 0.7, 0.1)),
    ];
    let lower = [
        ("elbow", Point3::new(0.15, 0.7, 0.1)),
        ("wrist", Point3::new(0.5, 0.75, -0.1)),
    ];
    let section = rectangle(0.02, 0.05);
    let y_axis = Some(Vector3::new(1.0, 0.1, 0.2));
    model
        .add_beam("upper", &upper, &steel(), &section, y_axis, 1)
        .expect("a beam");
    model
        .add_beam(
            "lower",
            &lower,
            &steel(),
            &circle(0.03),
            Some(Vector3::z()),
            1,
        )
        .expect("a beam");
    model
        .add_rigid("tool", &[("wrist", lower[1].1)])
        .expect("a tool");
    let axis = frame_from_axis(Some(&Vector3::x()), None).expect("a frame");
    let joints = [
        (
            None,
            Some(("upper", "base")),
            [Some(1e7), None, None, None, Some(3e4), None],
        ),
        (
            Some(("upper", "elbow")),
            Some(("lower", "elbow")),
            [Some(4e7), Some(1e8), None, Some(2e5), Some(1e5), None],
        ),
        (
            Some(("lower", "wrist")),
            Some(("tool", "wrist")),
            [None, None, Some(2e7), None, None, Some(1e4)],
        ),
    ];
    for (k, (first, second, springs)) in joints.into_iter().enumerate() {
        let between = [first, second].map(|n| n.map(|(body, point)| node(&model, body, point)));
        let mut joint = connection(&format!("j{k}"), between, Revolute);
        joint.locked = DofSet::ALL.intersection(hyperstat_joints::Joint::free(&Revolute));
        joint.stiffness = JointStiffness::Directions(springs);
        model.add_joint(joint, axis).expect("a joint");
    }
    model.set_output(node(&model, "tool", "wrist"));
    for (body, point) in [
        ("tool", "wrist"),
        ("upper", "elbow"),
        ("upper", "middle"),
        ("lower", "elbow"),
    ] {
        let on = node(&model, body, point);
        model.add_load(on, LOAD.into()).expect("a load");
    }
    model
}

/// The arm's geometry with both drives turned: about x, as the joints' axes stay parallel.
fn turned_arm(model: &Model, shoulder: f64, elbow: f64) -> Geometry {
    let mut geometry = model.geometry().clone();
    let about = |angle: f64| Rotation3::from_axis_angle(&Vector3::x_axis(), angle);
    let [base, pivot] = [("upper", "base"), ("lower", "elbow")]
        .map(|(body, point)| geometry.positions[node(model, body, point).0]);
    let first = about(shoulder);
    let both = about(shoulder + elbow);
    let pivot_now = base + first * (pivot - base);
    for (k, node) in model.nodes().iter().enumerate() {
        let p = geometry.positions[k];
        geometry.positions[k] = match node.body.0 {
            0 => base + first * (p - base),
            _ => pivot_now + both * (p - pivot),
        };
    }
    for (k, segment) in model.segments().iter().enumerate() {
        let turn = if segment.body.0 == 0 { first } else { both };
        geometry.y_axes[k] = geometry.y_axes[k].map(|y| turn * y);
    }
    for (k, flexible) in model.flexibles().iter().enumerate() {
        let turn = if flexible.body.0 == 0 { first } else { both };
        geometry.rotations[k] = turn * geometry.rotations[k];
    }
    // Each joint's frame goes with its first body.
    geometry.frames[1] = first * geometry.frames[1];
    geometry.frames[2] = both * geometry.frames[2];
    geometry
}

#[test]
fn a_beams_stiffness_makes_the_same_link_in_every_configuration() {
    let beams = arm();
    let flexible = with_changes(&beams, |_| Change::Flexible);
    assert_eq!(flexible.flexibles().len(), 2);
    assert!(flexible.segments().is_empty());
    assert_same(
        &solve(&flexible).expect("a solution"),
        &solve(&beams).expect("a solution"),
    );
    let plans = [&beams, &flexible].map(|model| Prepared::new(model.clone()));
    // Elastic joints are absorbed in both, loads inside them included.
    assert_eq!(plans[1].unknowns(), plans[0].unknowns());
    for (shoulder, elbow) in [(0.4, 0.0), (-1.1, 0.7), (2.0, -1.3)] {
        let [expected, found] =
            [(&plans[0], &beams), (&plans[1], &flexible)].map(|(prepared, model)| {
                let geometry = turned_arm(model, shoulder, elbow);
                let mut workspace = prepared.workspace().expect("a plan");
                prepared.sweep(&geometry, &mut workspace).expect("a result")
            });
        let [k, expected_k] = [&found, &expected].map(|r| r.stiffness.expect("a stiffness"));
        let difference = stiffness_difference(&k, &expected_k);
        assert!(difference < 1e-10, "K_o {difference:e}");
        let [u, expected_u] = [&found, &expected].map(|r| r.displacement.expect("held"));
        let off = (u - expected_u).amax();
        assert!(off < 1e-10 * expected_u.amax(), "u {off:e}");
    }
}

#[test]
fn a_flexible_body_turns_with_the_mechanism() {
    let changes = [Change::Flexible, Change::Keep, Change::Keep];
    let model = with_changes(&arm(), |body| changes[body]);
    let rotation = Rotation3::from_euler_angles(0.3, -1.2, 2.0);
    let elsewhere = moved(&model, &rotation, &Vector3::new(3.0, -1.0, 0.5));
    let [here, there] = [&model, &elsewhere].map(|m| stiffness(&solve(m).expect("a solution")));
    let difference = stiffness_difference(&there, &turned_matrix(&rotation, &here));
    assert!(difference < 1e-11, "{difference:e}");
}

/// The example, and the same file with the beam that its comment names.
#[test]
fn the_flexible_example_is_its_beam() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/flexible_link.ron");
    let text = std::fs::read_to_string(&path).expect("the example");
    let without_comment = text.replace("// \"arm\": Beam", "\"arm\": Beam");
    let (before, flexible) = without_comment
        .split_once("\"arm\": Flexible")
        .expect("the arm");
    let (_, after) = flexible.split_once('\n').expect("a line");
    let [found, expected] = [text.clone(), format!("{before}{after}")].map(|text| {
        let mechanism = mechanism_from_str(&text, &path, &Disk, &Registry::builtin());
        solve(&mechanism.expect("a mechanism").model).expect("a solution")
    });
    assert_same(&found, &expected);
}

/// Compares a mechanism with the independent solver, displacements by the largest translation or
/// rotation times 1 m: the matrix of a flexible body holds its stretch and its bending in the same
/// entries, and so their digits.
fn matrices_agree(model: &Model) -> Result<bool, TestCaseError> {
    let (ours, theirs) = match (solve(model), hyperstat_reference::solve(model)) {
        (Ok(ours), Ok(theirs)) => (ours, theirs),
        (Err(_), Err(_)) | (Err(SolveError::Unheld { .. }), Ok(_)) => return Ok(false),
        (Err(e), Ok(_)) => return Err(TestCaseError::fail(format!("only we refuse: {e}"))),
        (Ok(_), Err(e)) => return Err(TestCaseError::fail(format!("only they refuse: {e}"))),
    };
    if nearly_singular(&ours) {
        return Ok(false);
    }
    let counts = (ours.mobility, ours.overconstraint, ours.idle.len());
    let expected = (theirs.mobility, theirs.overconstraint, theirs.idle_modes);
    prop_assert_eq!(counts, expected);
    let (output, floor) = (&ours.output, &ours.floor);
    stiffnesses_agree(output.stiffness.as_ref(), theirs.stiffness.as_ref(), floor)?;
    compliances_agree(
        output.compliance.as_ref(),
        theirs.compliance.as_ref(),
        floor,
    )?;
    if ours.idle.is_empty() && ours.output.free_motions.is_empty() {
        let largest = |u: &[Vector6<f64>]| u.iter().map(|u| u.amax()).fold(1e-9, f64::max);
        let pairs = ours.displacements.iter().zip(&theirs.displacements);
        let off: Vec<_> = pairs.map(|(a, b)| a - b).collect();
        let part = off.iter().map(|u| u.amax()).fold(0.0, f64::max);
        let part = part / largest(&theirs.displacements);
        prop_assert!(part < 1e-8, "u {part:e}");
    }
    wrenches_agree(
        ours.joint_wrenches.iter().zip(&theirs.joint_wrenches),
        floor,
    )?;
    Ok(true)
}

/// Any topology: every third elastic body flexible, every third tapered in two elements.
#[test]
fn random_mechanisms_of_all_bodies_agree_with_the_independent_solver() {
    let changes = [Change::Flexible, Change::Taper, Change::Keep];
    check_random_mechanisms(0usize..3, |model, first| {
        matrices_agree(&with_changes(model, |body| changes[(body + first) % 3]))
    });
}
