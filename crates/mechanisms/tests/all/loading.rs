//! Mechanism files: what the loader makes of every part of one.

use std::path::{Path, PathBuf};

use hyperstat_joints::{Dof, DofSet};
use hyperstat_mechanisms::{Disk, Mechanism, Registry, load_mechanism, mechanism_from_str};
use hyperstat_model::{BodyId, BodyKind, JointId, JointStiffness, Model};
use nalgebra::{Matrix3, Matrix6, Point3, Vector3, Vector6};

fn reference(name: &str) -> PathBuf {
    Path::new("../../tests/reference").join(name)
}

fn read(text: &str) -> Mechanism {
    mechanism_from_str(text, Path::new("test.ron"), &Disk, &Registry::builtin())
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// A plate on the ground by one joint, with these fields of the joint.
fn with_joint(fields: &str) -> Model {
    let text = r#"(
        name: "plate",
        points: { "P": (1.0, 2.0, 3.0) },
        bodies: { "plate": Rigid(points: ["P"]) },
        joints: { "j": (at: "P", between: ("plate", "ground"), FIELDS) },
        output: ("plate", "P"),
    )"#;
    read(&text.replace("FIELDS", fields)).model
}

/// The joint frame, by columns x, y, z.
fn frame(fields: &str) -> [Vector3<f64>; 3] {
    let model = with_joint(fields);
    let frame = model.geometry().frames[0].matrix();
    [0, 1, 2].map(|k| frame.column(k).into_owned())
}

#[test]
fn every_reference_file_is_read() {
    let mut read = 0;
    for entry in reference("").read_dir().unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "ron") {
            let mechanism = load_mechanism(&path, &Disk, &Registry::builtin());
            let model = mechanism.unwrap_or_else(|error| panic!("{error}")).model;
            assert!(model.output().is_some() && !model.loads().is_empty());
            read += 1;
        }
    }
    assert_eq!(read, 14);
}

#[test]
fn everything_keeps_the_order_of_the_file() {
    let path = reference("every_joint.ron");
    let model = load_mechanism(&path, &Disk, &Registry::builtin())
        .unwrap()
        .model;
    let bodies: Vec<_> = model.bodies().iter().map(|b| b.name.as_str()).collect();
    assert_eq!(bodies, ["l1", "l2", "l3", "l4", "l5", "l6", "l7", "top"]);
    let joints: Vec<_> = model.joints().iter().map(|j| j.name.as_str()).collect();
    assert_eq!(
        joints,
        ["C", "W", "E", "U", "F", "L", "Q", "R", "S", "K", "N"]
    );
    let nodes = &model.bodies()[7].nodes;
    let nodes: Vec<_> = nodes.iter().map(|n| model.node_name(*n)).collect();
    assert_eq!(nodes, ["top.T", "top.e", "top.d"]);
    let kinds: Vec<_> = model.joints().iter().map(|j| j.joint.kind()).collect();
    assert_eq!(
        kinds,
        [
            "Cylindrical",
            "Screw",
            "Planar",
            "Universal",
            "Fixed",
            "Revolute",
            "Prismatic",
            "Revolute",
            "Spherical",
            "Universal",
            "Fixed"
        ]
    );
}

#[test]
fn bodies_nodes_loads_and_output_are_the_file_s() {
    let mechanism = read(
        r#"(
        name: "bent",
        materials: { "steel": (young: 2e11, shear: 8e10) },
        sections: { "box": General(area: 4e-4, iy: 1e-8, iz: 2e-8, torsion: 2.5e-8, shear_y: 3e-4) },
        points: { "A": (0, 0, 0), "B": (0.0, 0.0, 1.0), "C": (1.0, 0.0, 1.0), "unused": (9, 9, 9) },
        bodies: {
            "frame": Beam(through: ["A", "B", "C"], section: "box", material: "steel",
                          y_axis: (0.0, 2.0, 0.0), elements: 7),
            "tool": Rigid(points: ["C", "A"]),
        },
        joints: {
            "foot": (at: "A", between: ("ground", "frame"), kind: Fixed),
            "weld": (at: "C", between: ("frame", "tool"), kind: Fixed()),
        },
        loads: [
            (on: ("frame", "B"), moment: (1.0, 2.0, 3.0)),
            (on: ("tool", "A"), force: (4.0, 5.0, 6.0)),
        ],
        output: ("tool", "C"),
    )"#,
    );
    let model = &mechanism.model;
    assert_eq!(model.name, "bent");
    let [frame, tool] = model.bodies() else {
        panic!("two bodies")
    };
    assert_eq!(
        (frame.kind, tool.kind),
        (BodyKind::Elastic, BodyKind::Rigid)
    );
    assert_eq!((frame.nodes.len(), frame.segments.len()), (3, 2));
    assert_eq!((tool.nodes.len(), tool.segments.len()), (2, 0));
    let segment = &model.segments()[1];
    assert_eq!(segment.ends, [frame.nodes[1], frame.nodes[2]]);
    assert_eq!(segment.elements, 7);
    assert_eq!(
        (segment.material.young(), segment.material.shear()),
        (2e11, 8e10)
    );
    assert_eq!((segment.section.iy(), segment.section.iz()), (1e-8, 2e-8));
    assert_eq!(
        (segment.section.shear_y(), segment.section.shear_z()),
        (Some(3e-4), None)
    );
    assert_eq!(
        model.geometry().y_axes,
        [Some(Vector3::new(0.0, 2.0, 0.0)); 2]
    );
    let place = |node: usize| model.geometry().positions[node];
    assert_eq!(place(frame.nodes[2].0), Point3::new(1.0, 0.0, 1.0));
    assert_eq!(place(tool.nodes[1].0), Point3::origin());
    let joints = model.joints();
    assert_eq!(joints[0].between, [None, Some(frame.nodes[0])]);
    assert_eq!(
        joints[1].between,
        [Some(frame.nodes[2]), Some(tool.nodes[0])]
    );
    let [first, second] = model.loads() else {
        panic!("two loads")
    };
    assert_eq!(first.node, frame.nodes[1]);
    assert_eq!(first.wrench, Vector6::new(0.0, 0.0, 0.0, 1.0, 2.0, 3.0));
    assert_eq!(second.node, tool.nodes[1]);
    assert_eq!(second.wrench, Vector6::new(4.0, 5.0, 6.0, 0.0, 0.0, 0.0));
    assert_eq!(model.output(), Some(tool.nodes[0]));

    let spot = |at: hyperstat_mechanisms::Location| (at.line, at.column, at.width);
    assert_eq!(spot(mechanism.locate_body(BodyId(1))), (9, 13, 6));
    assert_eq!(spot(mechanism.locate_joint(JointId(1))), (13, 13, 6));
    assert_eq!(spot(mechanism.locate_load(1)), (17, 13, 43));
    assert_eq!(spot(mechanism.locate_output()), (19, 17, 13));
    assert_eq!(mechanism.locate_output().path, Path::new("test.ron"));
}

#[test]
fn a_frame_s_y_is_its_axis_and_x_is_given_or_least_aligned() {
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    for kind in [
        "Revolute(axis: A)",
        "Prismatic(axis: A)",
        "Cylindrical(axis: A)",
        "Screw(axis: A, pitch: -0.01)",
        "Planar(normal: A)",
        "Fixed(axis: A)",
        "Spherical(axis: A)",
    ] {
        let fields = |axis: &str| format!("kind: {}", kind.replace('A', axis));
        // y and z tie for the axis x: y is first. x and z tie for y, x and y for z: x is first.
        assert_eq!(frame(&fields("(2.0, 0.0, 0.0)")), [y, x, -z], "{kind}");
        assert_eq!(frame(&fields("(0, -3, 0)")), [x, -y, -z], "{kind}");
        assert_eq!(frame(&fields("(0, 0, 1)")), [x, z, -y], "{kind}");
        let given = fields("(0, 0, 1)") + ", x_axis: (0.0, 5.0, 7.0)";
        assert_eq!(frame(&given), [y, z, x], "{kind}");
    }
}

#[test]
fn other_frames_are_global_or_follow_from_two_axes() {
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    for kind in [
        "Fixed",
        "Fixed()",
        "Spherical",
        "Spherical()",
        "Spherical ( )",
    ] {
        assert_eq!(frame(&format!("kind: {kind}")), [x, y, z]);
    }
    let two = "kind: Universal(axes: ((0, 0, 2.0), (1.0, 0.0, 4.0)))";
    assert_eq!(frame(two), [z, x, y]);
}

#[test]
fn a_screw_has_its_pitch() {
    let model = with_joint("kind: Screw(axis: (0, 1, 0), pitch: -0.005)");
    let basis = model.joints()[0].joint.basis();
    assert_eq!(
        basis.column(4),
        Vector6::new(0.0, -0.005, 0.0, 0.0, 1.0, 0.0)
    );
}

#[test]
fn locked_holds_all_free_directions_or_the_listed_ones() {
    use Dof::{V, Y};
    let locked = |fields: &str| {
        with_joint(&format!("kind: Cylindrical(axis: (0, 0, 1)), {fields}")).joints()[0].locked
    };
    assert_eq!(locked(""), DofSet::EMPTY);
    assert_eq!(locked("locked: false"), DofSet::EMPTY);
    assert_eq!(locked("locked: []"), DofSet::EMPTY);
    assert_eq!(locked("locked: true"), DofSet::new(&[Y, V]));
    assert_eq!(locked("locked: [y]"), DofSet::new(&[Y]));
    assert_eq!(locked("locked: [v, y,]"), DofSet::new(&[V, Y]));
}

#[test]
fn stiffness_is_by_direction_or_a_matrix() {
    let stiffness = |fields: &str| {
        let model = with_joint(&format!("kind: Fixed, {fields}"));
        model.joints()[0].stiffness.clone()
    };
    assert_eq!(stiffness(""), JointStiffness::default());
    assert_eq!(
        stiffness("stiffness: (w: 3, x: 1e8, v: 0.0)"),
        JointStiffness::Directions([Some(1e8), None, None, None, Some(0.0), Some(3.0)])
    );
    let mut wanted = Matrix6::from_diagonal(&Vector6::new(1e6, 2e6, 3e6, 1e3, 2e3, 3e3));
    (wanted[(0, 4)], wanted[(4, 0)]) = (-5.0, -5.0);
    let row = |r: usize| {
        let row: Vec<_> = wanted.row(r).iter().map(|v| format!("{v:e}")).collect();
        row.join(", ")
    };
    let rows: Vec<_> = (0..6).map(row).collect();
    for text in [
        format!("Matrix([[{}]])", rows.join("], [")),
        format!("Matrix([({})])", rows.join("), (")),
        format!("Matrix([{}])", rows.join(", ")),
    ] {
        let found = stiffness(&format!("stiffness: {text}"));
        assert_eq!(found, JointStiffness::Matrix(wanted), "{text}");
    }
}

#[test]
fn frames_of_the_reference_joints_are_rotations() {
    let path = reference("delta_elastic_joints.ron");
    let model = load_mechanism(&path, &Disk, &Registry::builtin())
        .unwrap()
        .model;
    assert_eq!(model.joints().len(), 21);
    for frame in &model.geometry().frames {
        let error = frame.matrix().transpose() * frame.matrix() - Matrix3::identity();
        assert!(error.amax() < 1e-15);
        assert!((frame.matrix().determinant() - 1.0).abs() < 1e-15);
    }
}

#[test]
fn comments_headers_marks_and_line_ends_are_passed_over() {
    let plain = include_str!("../../../../examples/portal.ron");
    let names = |text: &str| {
        let model = read(text).model;
        (
            model.bodies().len(),
            model.joints().len(),
            model.loads().len(),
        )
    };
    let wanted = names(plain);
    assert_eq!(names(&plain.replace('\n', "\r\n")), wanted);
    assert_eq!(names(&format!("\u{feff}{plain}")), wanted);
    assert_eq!(
        names(&format!("#![enable(implicit_some)]\n{plain}")),
        wanted
    );
    let value = &plain[plain.find("\n(").unwrap()..];
    let commented = value
        .replace(',', "/* , */ , // ,\n")
        .replace(": ", " /* : */ :\n");
    assert_eq!(names(&commented), wanted);
}

#[test]
fn places_are_exact_between_comments() {
    let text = include_str!("../../../../examples/portal.ron");
    let text = text.replace("0.014", "/* ü */ -0.014 /* mm? */");
    let error =
        mechanism_from_str(&text, Path::new("p.ron"), &Disk, &Registry::builtin()).unwrap_err();
    let at = error.location().unwrap();
    let line = text.lines().nth(at.line - 1).unwrap();
    assert_eq!(at.text, line);
    let value: String = line.chars().skip(at.column - 1).take(at.width).collect();
    assert_eq!(value, "-0.014");
}
