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

fn refused(text: &str) -> String {
    let files = MemoryFiles::from_iter([
        ("loop.ron", r#"(include: ["b.ron"])"#),
        (
            "steel.ron",
            r#"(materials: { "steel": (young: 1e11, poisson: 0.3) })"#,
        ),
    ]);
    let found = mechanism_from_str(text, Path::new("b.ron"), &files, &Registry::builtin());
    let error = found.expect_err("a mistake");
    format!("{error}; {}", error.help().unwrap_or_default())
}

/// A bar on the ground in some copies, with more fields.
fn bar(copies: &str, more: &str) -> String {
    format!(
        r#"(name: "bars", materials: {{ "steel": (young: 2.1e11, poisson: 0.3) }}, sections: {{ "rod": Circle(diameter: 0.02) }},
groups: {{ "bar": (points: {{ "A": (1.0, 0.0, 0.0), "B": (1.0, 0.0, 1.0) }},
    bodies: {{ "rod": Beam(through: ["A", "B"], section: "rod", material: "steel") }},
    joints: {{ "A": (at: "A", between: ("ground", "rod"), kind: Fixed) }}) }},
copies: {{ {copies} }}, {more} output: ("rod2", "B2"))"#
    )
}

#[test]
fn mistakes_in_copies_are_told_where_they_are() {
    for (copies, more, wanted) in [
        (
            r#""bra": Turned(axis: (0.0, 0.0, 1.0), count: 3)"#,
            "",
            "b.ron:5:11: unknown group `bra`; the groups are `bar`",
        ),
        (
            r#""bar": Turnt(axis: (0.0, 0.0, 1.0), count: 3)"#,
            "",
            "b.ron:5:18: unknown way of placing copies `Turnt`; did you mean `Turned`?",
        ),
        (
            r#""bar": Turned(axis: (0.0, 0.0, 1.0), count: 0)"#,
            "",
            "b.ron:5:55: expected a whole number of copies from 1 to 10000, found `0`; ",
        ),
        (
            r#""bar": Turned(axis: (0.0, 0.0, 1.0), count: "3 mm")"#,
            "",
            "b.ron:5:55: expected a whole number of copies from 1 to 10000",
        ),
        (
            r#""bar": Moved(by: ("1 N", 0.0, 0.0), count: 3)"#,
            "",
            "b.ron:5:29: `by` is a length, \"1 N\" is a force; give it in m",
        ),
        (
            r#""bar": (places: Moved(by: [(1.0, 0.0, 0.0)]), names: ["a", "b"])"#,
            "",
            "b.ron:5:64: there are 1 copies, and 2 endings; give one ending for each copy",
        ),
        (
            r#""bar": (places: Mirrored(normal: (1.0, 0.0, 0.0)), overrides: { "3": {} })"#,
            "",
            "b.ron:5:75: group `bar` has no copy `3`; the copies are `1`, `2`",
        ),
        (
            r#""bar": (places: Mirrored(normal: (1.0, 0.0, 0.0)), overrides: { "2": { "pionts.A.0": 2.0 } })"#,
            "",
            "group `bar` has no `pionts`; did you mean `points`?",
        ),
        (
            r#""bar": (places: Mirrored(normal: (1.0, 0.0, 0.0)), overrides: { "2": { "points.C.0": 2.0 } })"#,
            "",
            "`points` has no `C`",
        ),
        (
            r#""bar": Mirrored(normal: (1.0, 0.0, 0.0))"#,
            r#"points: { "A": (0.0, 0.0, 0.0) },"#,
            "b.ron:2:29: the mechanism has a point `A`, too; give the one of group `bar` another name",
        ),
        (
            r#""bar": Mirrored(normal: (1.0, 0.0, 0.0))"#,
            r#"points: { "A2": (0.0, 0.0, 0.0) },"#,
            "b.ron:2:29: a copy makes a second point `A2`; it stands in line 5 already; remove one of the two",
        ),
        (
            r#""bar": Mirrored(normal: (1.0, 0.0, 0.0))"#,
            r#"include: ["steel.ron"],"#,
            "steel.ron:1:15: the name \"steel\" is given twice; it stands in b.ron:1:29 already; remove one of the two",
        ),
        (
            r#""bar": Mirrored(normal: (1.0, 0.0, 0.0))"#,
            r#"include: ["loop.ron"],"#,
            "loop.ron:1:12: b.ron includes itself",
        ),
        (
            r#""bar": Mirrored(normal: (1.0, 0.0, 0.0))"#,
            r#"include: ["../b.ron"],"#,
            "a file that is included lies in the folder",
        ),
        (
            r#""bar": Mirrored(normal: (1.0, 0.0, 0.0))"#,
            r#"include: ["none.ron"],"#,
            "cannot read none.ron",
        ),
    ] {
        let found = refused(&bar(copies, more));
        assert!(
            found.contains(wanted),
            "{copies} {more}:\n{found}\n{wanted}"
        );
    }
}

#[test]
fn a_group_is_one_for_whoever_varies_it_and_a_copy_may_differ() {
    let copies = r#""bar": (places: Moved(by: (0.5, 0.0, 0.0), count: 3), names: ["1", "2", "3"],
        overrides: { "3": { "points.B.2": "= 2 * B.z", "joints.A.stiffness": (x: 1e7) } })"#;
    let text = bar(copies, r#"parameters: { "k": 1e6 },"#)
        .replace("kind: Fixed)", r#"kind: Fixed, stiffness: (x: "= k"))"#);
    // In the group `B` is its own; in `copies` there is none of this name.
    assert!(
        refused(&text).contains("unknown name `B`"),
        "{}",
        refused(&text)
    );
    let text = text.replace("= 2 * B.z", "= 2 * k / 1e6");
    let files = MemoryFiles::new();
    let read = mechanism_from_str(&text, Path::new("b.ron"), &files, &Registry::builtin());
    let read = read.unwrap_or_else(|error| panic!("{error}"));
    let height = |model: &Model, name: &str| {
        let place = model.nodes().iter().position(|node| node.point == name);
        model.geometry().positions[place.expect("a point")]
    };
    assert_eq!(
        height(&read.model, "B3"),
        nalgebra::Point3::new(2.0, 0.0, 2.0)
    );
    let varied = read
        .with_values(&[("groups.bar.points.B.2", 1.5)])
        .expect("a mechanism");
    for (name, z) in [("B1", 1.5), ("B2", 1.5), ("B3", 2.0)] {
        assert_eq!(height(&varied.model, name).z, z, "{name}");
    }
    let mut named = read.model.clone();
    read.name_values(&mut named);
    let names: Vec<_> = named
        .values()
        .into_iter()
        .map(|(place, _)| format!("{place:?}"))
        .collect();
    assert!(!names.is_empty());
}

#[test]
fn overrides_of_one_copy_do_not_overlap() {
    let copies = r#""bar": (places: Mirrored(normal: (1.0, 0.0, 0.0)),
        overrides: { "2": { "points.A.0": 2.0, "points.A": (1.0, 0.0, 0.0) } })"#;
    let found = refused(&bar(copies, ""));
    assert!(
        found.contains("`points.A.0` and `points.A` overlap"),
        "{found}"
    );
}

#[test]
fn kinds_without_arguments_are_turned_in_json_too() {
    let text = r#"{"name": "bars", "materials": {"steel": {"young": 2.1e11, "poisson": 0.3}},
        "sections": {"rod": {"Circle": {"diameter": 0.02}}},
        "groups": {"bar": {"points": {"A": [1.0, 0.0, 0.0], "B": ["= A.x", 0.0, "= 3-2"]},
            "bodies": {"rod": {"Beam": {"through": ["A", "B"], "section": "rod", "material": "steel"}}},
            "joints": {"A": {"at": "A", "between": ["ground", "rod"], "kind": "Fixed", "stiffness": {"x": 1e6}}}}},
        "copies": {"bar": {"Turned": {"axis": [0.0, 0.0, 1.0], "count": 4}}}, "output": ["rod2", "B2"]}"#;
    let model = read(text);
    let frame = model.geometry().frames[1];
    assert!(
        (frame.matrix().column(0) - Vector3::y()).norm() < 1e-15,
        "{frame}"
    );
}

#[test]
fn a_job_knows_the_points_of_copies() {
    let copies = r#""bar": Turned(axis: (0.0, 0.0, 1.0), count: 4)"#;
    let more = r#"points: { "M": ("= B1.z + 0.5-0.25", 0.0, 0.0) },"#;
    let files = MemoryFiles::from_iter([("bars.ron", bar(copies, more))]);
    let batch = r#"(jobs: [(name: "j", mechanism: File("bars.ron"),
        loads: [(on: ("rod2", "B2"), force: ("= 4 * M.x", "= B1.z", 0.0))])])"#;
    let batch = batch_from_str(batch, Path::new("b.ron"), &files, &Registry::builtin());
    let batch = batch.unwrap_or_else(|error| panic!("{error}"));
    let model = batch.jobs[0]
        .design(0)
        .expect("a design")
        .model()
        .expect("in reach");
    assert_eq!(
        model.loads()[0].wrench.as_slice(),
        [5.0, 1.0, 0.0, 0.0, 0.0, 0.0]
    );
}

#[test]
fn a_comment_may_be_the_last_thing_in_a_file() {
    let copies = r#""bar": Turned(axis: (0.0, 0.0, 1.0), count: 4)"#;
    read(&format!("{} // the end", bar(copies, "")));
}
