//! Copies of groups: a mechanism copied by any motion, or mirrored, has the stiffness, displacements and
//! wrenches of the one that was written, in axes that move with it; three limbs written as one are the
//! prebuilt delta.

use std::path::Path;

use hyperstat_assembly::{Model, Solution, solve};
use hyperstat_mechanisms::{
    Disk, MemoryFiles, Registry, batch_from_str, load_mechanism, mechanism_from_str,
};
use hyperstat_tests::{reference_text, stiffness_difference};
use nalgebra::{Matrix3, Matrix6, Rotation3, Unit, Vector3, Vector6};

fn read(text: &str) -> Model {
    let files = MemoryFiles::new();
    mechanism_from_str(text, Path::new("copies.ron"), &files, &Registry::builtin())
        .unwrap_or_else(|error| panic!("{error}"))
        .model
}

/// One of every kind of joint, beams whose axes follow from the default, and all that can act.
fn everything() -> String {
    let mut text = reference_text("every_joint.ron");
    while let Some(start) = text.find(", y_axis: (") {
        let end = start + text[start..].find(')').expect("the end of a vector");
        text.replace_range(start..=end, "");
    }
    let rows = (0..6).map(|row| {
        let entry = |column: usize| match (row, column) {
            (row, column) if row == column => {
                if row < 3 {
                    "4e7"
                } else {
                    "3e4"
                }
            }
            (row, column) if row < 3 && column < 3 => "1e7",
            (row, column) if row >= 3 && column >= 3 => "1e4",
            _ => "2e4",
        };
        format!("[{}]", (0..6).map(entry).collect::<Vec<_>>().join(", "))
    });
    let matrix = format!("Matrix([{}])", rows.collect::<Vec<_>>().join(", "));
    let changes = [
        (
            r#""N": (at: "e", between: ("l7", "top"), kind: Fixed)"#,
            format!(
                r#""N": (at: "e", between: ("l7", "top"), kind: Fixed, stiffness: {matrix},
                    misfit: (x: 1e-4, z: -2e-4, v: 1e-3))"#
            ),
        ),
        (
            "stiffness: (x: 100000000.0, w: 100000.0)",
            "stiffness: (x: 1e8, w: 1e5), preload: (x: 40.0, w: 3.0), misfit: (z: 1e-4, u: 2e-3)".into(),
        ),
        (
            r#"        (on: ("top", "T"), force"#,
            r#"        (on: "l1", per_length: (10.0, 20.0, -30.0), moment_per_length: (1.0, 0.5, -2.0)),
               (on: ("l3", "c", "d"), from: (5.0, 0.0, 9.0), to: (-50.0, 3.0, 0.0), frame: Body),
               (on: ("l2", "c"), force: (1.0, 2.0, 3.0), moment: (3.0, 1.0, -1.0), frame: Output),
               (on: ("top", "T"), force"#
                .into(),
        ),
    ];
    for (old, new) in changes {
        assert!(text.contains(old), "{old}");
        text = text.replace(old, &new);
    }
    text
}

/// The parts of a mechanism as the group of another, with these copies.
fn as_group(text: &str, copies: &str) -> String {
    let start = text.find("    points:").expect("points");
    let end = text.find("    output:").expect("an output");
    format!(
        "{}groups: {{ \"all\": (\n{}masses: [(on: (\"l4\", \"e\"), mass: 2.0, inertia: (0.1, 0.2, 0.25, 0.01, -0.02, 0.03))]) }},
        copies: {{ \"all\": {copies} }}, points: {{}}, bodies: {{}}, joints: {{}},
        output: (\"top1\", \"T1\"))",
        &text[..start],
        &text[start..end],
    )
}

fn blocks(linear: &Matrix3<f64>, axial: &Matrix3<f64>) -> Matrix6<f64> {
    let mut whole = Matrix6::zeros();
    whole.fixed_view_mut::<3, 3>(0, 0).copy_from(linear);
    whole.fixed_view_mut::<3, 3>(3, 3).copy_from(axial);
    whole
}

/// The wrench of a joint of a copy, by the joint's name in the group.
fn wrench(model: &Model, solution: &Solution, name: &str) -> Vector6<f64> {
    let name = format!("{name}1");
    let joint = model.joints().iter().position(|joint| joint.name == name);
    let found = solution.joint_wrenches[joint.expect("a joint of this name")].as_ref();
    *found.expect("a wrench that is determined")
}

/// Compares a copy, whose names end with 1, with what was written; `linear` is the copy's motion or mirror
/// image.
fn compare(copies: &str, linear: &Matrix3<f64>) {
    let text = everything();
    let [written, copied] = ["Moved(by: [(0.0, 0.0, 0.0)])", copies].map(|copies| {
        let model = read(&as_group(&text, copies));
        let solution = solve(&model).expect("a solution");
        (model, solution)
    });
    let sign = linear.determinant();
    let turn = blocks(linear, &(linear * sign));
    let stiffness = |solution: &Solution| *solution.output.stiffness.as_ref().expect("a stiffness");
    let expected = turn * stiffness(&written.1) * turn.transpose();
    let difference = stiffness_difference(&stiffness(&copied.1), &expected);
    assert!(difference < 1e-10, "{copies}: {difference:e}");
    let expected = turn * written.1.output.displacement;
    let found = copied.1.output.displacement;
    assert!(
        (expected - found).norm() < 1e-10 * expected.norm(),
        "{expected} {found}"
    );
    let signs = match sign < 0.0 {
        true => Vector6::new(1.0, 1.0, -1.0, -1.0, -1.0, 1.0),
        false => Vector6::repeat(1.0),
    };
    for name in ["C", "W", "E", "U", "F", "L", "Q", "R", "S", "K", "N"] {
        let expected = signs.component_mul(&wrench(&written.0, &written.1, name));
        let found = wrench(&copied.0, &copied.1, name);
        let scale = expected.norm().max(1.0);
        assert!(
            (expected - found).norm() < 1e-8 * scale,
            "{name}: {expected} {found}"
        );
    }
}

#[test]
fn a_turned_copy_is_what_was_written_in_turned_axes() {
    for (axis, angle) in [
        (Vector3::new(0.0, 0.0, 1.0), 2.0),
        (Vector3::new(1.0, -2.0, 0.5), -1.1),
        (Vector3::new(0.0, 1.0, 0.0), std::f64::consts::FRAC_PI_2),
    ] {
        let [x, y, z] = axis.into();
        let turn = Rotation3::from_axis_angle(&Unit::new_normalize(axis), angle);
        let copies = format!(
            "Turned(axis: ({x:?}, {y:?}, {z:?}), through: (0.3, 0.1, -0.2), angles: [{angle:?}])"
        );
        compare(&copies, turn.matrix());
    }
}

#[test]
fn a_mirrored_copy_is_the_mirror_image() {
    let normal = Vector3::new(0.3, 1.0, -0.4_f64).normalize();
    let mirror = Matrix3::identity() - 2.0 * normal * normal.transpose();
    let copies = "[Mirrored(normal: (0.3, 1.0, -0.4), through: (0.0, 0.2, 0.0)), Moved(by: [(0.0, 0.0, 0.0)])]";
    // The mirror image alone: the copies' names are given so that it is the first.
    let copies = format!("(places: {copies}, names: [\"2\", \"1\"])");
    let text = everything();
    let both = read(&as_group(&text, &copies));
    let here = read(&as_group(&text, "Moved(by: [(0.0, 0.0, 0.0)])"));
    assert_eq!(both.bodies().len(), 2 * here.bodies().len());
    compare(&copies, &mirror);
}

/// At home, with every joint rigid.
#[test]
fn three_limbs_written_as_one_are_the_prebuilt_delta() {
    let registry = Registry::builtin();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/delta_limbs.ron");
    let limbs = load_mechanism(&path, &Disk, &registry)
        .expect("a valid file")
        .model;
    let batch = r#"(jobs: [(name: "delta", mechanism: Delta(
        base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60, rod_spacing: 0.12,
        arm: (section: Circle(diameter: 0.030), material: (young: 2.1e11, poisson: 0.3)),
        bar: (section: Circle(diameter: 0.020), material: (young: 2.1e11, poisson: 0.3)),
        rod: (section: Circle(diameter: 0.014), material: (young: 2.1e11, poisson: 0.3)),
    ), poses: List([(0.0, 0.0, 0.5)]),
        loads: [(on: ("platform", "P"), force: (-20.0, 10.0, 100.0), moment: (5.0, 5.0, 8.0))])])"#;
    let batch = batch_from_str(batch, Path::new("b.ron"), &MemoryFiles::new(), &registry);
    let batch = batch.expect("a valid batch");
    let written = batch.jobs[0]
        .design(0)
        .expect("a design")
        .model()
        .expect("in reach");
    let solved = [&limbs, &written].map(|model| solve(model).expect("a solution"));
    assert_eq!(solved[0].unknowns, solved[1].unknowns);
    let [found, expected] =
        [0, 1].map(|k| *solved[k].output.stiffness.as_ref().expect("a stiffness"));
    let difference = stiffness_difference(&found, &expected);
    assert!(difference < 1e-12, "{difference:e}");
    for (joint, wanted) in written.joints().iter().zip(&solved[1].joint_wrenches) {
        let place = limbs.joints().iter().position(|own| own.name == joint.name);
        let found = solved[0].joint_wrenches[place.expect("a joint of this name")];
        // Of frames that follow from the axis alone, only what does not depend on x.
        let about = |wrench: &Option<Vector6<f64>>| wrench.as_ref().map(|w| [w[1], w[4], w.norm()]);
        match (about(&found), about(wanted)) {
            (Some(found), Some(wanted)) => {
                for (found, wanted) in found.iter().zip(wanted) {
                    assert!(
                        (found - wanted).abs() < 1e-9 * 100.0,
                        "{}: {found} {wanted}",
                        joint.name
                    );
                }
            }
            (found, wanted) => assert_eq!(found, wanted, "{}", joint.name),
        }
    }
}
