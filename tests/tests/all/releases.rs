//! Members of frames that are released, sprung or offset at their ends, beside closed forms and beside the same
//! written out body by body.

use std::path::Path;

use hyperstat_assembly::{Model, Solution, solve};
use hyperstat_mechanisms::{
    LoadError, Mechanism, MemoryFiles, Registry, mechanism_from_str, write,
};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

const E: f64 = 2.1e11;
const G: f64 = 8.0e10;

/// A frame of `members`, held by `joints`, with an output.
fn file(points: &str, members: &str, more: &str, joints: &str, output: &str) -> String {
    format!(
        r#"(
    name: "frame",
    materials: {{ "steel": (young: 2.1e11, shear: 8.0e10, density: 7850.0, expansion: 1.2e-5) }},
    sections: {{ "bar": Rectangle(width: 0.02, height: 0.03) }},
    points: {{ {points} }},
    bodies: {{ "frame": Frame(members: [{members}], section: "bar", material: "steel"{more}) }},
    joints: {{ {joints} }},
    output: {output},
)"#
    )
}

fn try_read(text: &str) -> Result<Mechanism, LoadError> {
    let files = MemoryFiles::new();
    mechanism_from_str(text, Path::new("frame.ron"), &files, &Registry::builtin())
}

fn read(text: &str) -> Model {
    try_read(text)
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
        .model
}

fn solution(model: &Model) -> Solution {
    solve(model).unwrap_or_else(|error| panic!("{error}"))
}

fn compliance(model: &Model) -> Matrix6<f64> {
    solution(model).output.compliance.expect("a compliance")
}

fn near(found: &Matrix6<f64>, expected: &Matrix6<f64>, what: &str) {
    let difference = (found - expected).amax() / expected.amax();
    assert!(
        difference < 1e-12,
        "{what}: {difference:e}\n{found}{expected}"
    );
}

const AB: &str = r#""A": (0.0, 0.0, 0.0), "B": (0.8, 0.0, 0.0)"#;
const FOOT: &str = r#""foot": (at: "A", between: ("ground", "frame"), kind: Fixed)"#;
const TIP: &str = r#"("frame", "B")"#;

fn member(fastening: &str) -> String {
    format!(r#"(through: ["A", "B"], y_axis: (0.0, 1.0, 0.0){fastening})"#)
}

#[test]
fn springs_at_an_end_add_their_give() {
    let plain = read(&file(AB, &member(""), "", FOOT, TIP));
    let sprung = ", springs: { \"A\": (x: 2e7, y: 3e6, v: 1e4, w: 2e4) }";
    let model = read(&file(AB, &member(sprung), "", FOOT, TIP));
    let mut expected = compliance(&plain);
    let arm = Vector3::new(0.8, 0.0, 0.0);
    for (axis, turns, k) in [
        (0, false, 2e7),
        (1, false, 3e6),
        (1, true, 1e4),
        (2, true, 2e4),
    ] {
        let direction = Vector3::ith(axis, 1.0);
        let (v, w) = match turns {
            true => (direction.cross(&arm), direction),
            false => (direction, Vector3::zeros()),
        };
        let twist = Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z);
        expected += twist * twist.transpose() / k;
    }
    near(&compliance(&model), &expected, "springs");
    // At the other end, and as a chain of two members.
    let swapped = ", springs: { \"B\": (x: 2e7) }";
    let model = read(&file(AB, &member(swapped), "", FOOT, TIP));
    let mut expected = compliance(&plain);
    expected[(0, 0)] += 1.0 / 2e7;
    near(&compliance(&model), &expected, "at the tip");
}

#[test]
fn an_offset_is_a_rigid_arm() {
    let offset = ", offset: { \"B\": (0.0, 0.05, 0.1), \"A\": (0.1, 0.0, -0.02) }, springs: { \"B\": (w: 500.0) }";
    let model = read(&file(AB, &member(offset), "", FOOT, TIP));
    // The member from A' to B', written out.
    let text = r#"(
    name: "written out",
    materials: { "steel": (young: 2.1e11, shear: 8.0e10) },
    sections: { "bar": Rectangle(width: 0.02, height: 0.03) },
    points: { "A": (0.0, 0.0, 0.0), "A'": (0.1, 0.0, -0.02), "B'": (0.8, 0.05, 0.1), "B": (0.8, 0.0, 0.0) },
    bodies: {
        "foot": Rigid(points: ["A", "A'"]),
        "bar": Beam(through: ["A'", "B'"], section: "bar", material: "steel", y_axis: (0.0, 1.0, 0.0)),
        "tip": Rigid(points: ["B'", "B"]),
    },
    joints: {
        "ground": (at: "A", between: ("ground", "foot"), kind: Fixed),
        "a": (at: "A'", between: ("foot", "bar"), kind: Fixed),
        "b": (at: "B'", between: ("bar", "tip"), kind: Fixed(axis: AXIS), x_axis: (0.7, 0.05, 0.12), stiffness: (w: 500.0)),
    },
    output: ("tip", "B"),
)"#;
    let x = Vector3::new(0.7, 0.05, 0.12).normalize();
    let y = (Vector3::y() - x * x.y).normalize();
    let text = text.replace("AXIS", &format!("({:?}, {:?}, {:?})", y.x, y.y, y.z));
    near(&compliance(&model), &compliance(&read(&text)), "offset");
}

#[test]
fn bars_that_are_pinned_carry_no_bending() {
    let points = r#""P": (0.1, 0.05, 1.0), "A": (0.5, 0.0, 0.0), "B": (-0.3, 0.4, 0.0), "C": (-0.2, -0.5, 0.1)"#;
    let pin =
        |a: &str| format!(r#"(through: ["{a}", "P"], releases: {{ "{a}": [v, w], "P": [v, w] }})"#);
    let members = ["A", "B", "C"].map(pin).join(", ");
    let feet = ["A", "B", "C"]
        .map(|a| format!(r#""{a}": (at: "{a}", between: ("ground", "frame"), kind: Fixed)"#));
    let model = read(&file(
        points,
        &members,
        "",
        &feet.join(", "),
        r#"("frame", "P")"#,
    ));
    let mut expected = Matrix3::zeros();
    for foot in [[0.5, 0.0, 0.0], [-0.3, 0.4, 0.0], [-0.2, -0.5, 0.1]] {
        let span = Vector3::new(0.1, 0.05, 1.0) - Vector3::from(foot);
        let e = span.normalize();
        expected += e * e.transpose() * (E * 0.02 * 0.03 / span.norm());
    }
    let k = solution(&model).output.stiffness.expect("a stiffness");
    let linear = k.fixed_view::<3, 3>(0, 0).into_owned();
    assert!(
        (linear - expected).amax() / expected.amax() < 1e-12,
        "{linear}{expected}"
    );
    assert!(k.fixed_view::<3, 3>(0, 3).amax() / k.amax() < 1e-12);
    // The bars' torsion alone holds the point against turning.
    assert!(k.fixed_view::<3, 3>(3, 3).amax() < 3.0 * G * 6e-8);
    assert_eq!(model.bodies().len(), 4 + 3);
    assert!(model.body("frame").is_some() && model.body("frame A-P").is_some());
}

#[test]
fn welded_members_stay_one_body_and_loads_find_their_places() {
    let points =
        r#""A": (0.0, 0.0, 0.0), "B": (0.0, 0.0, 1.0), "C": (0.7, 0.0, 1.0), "D": (0.7, 0.0, 0.0)"#;
    let members = r#"["A", "B"], (through: ["B", "C"], releases: { "B": [v, w] }, springs: { "C": (v: 3e3) }), ["C", "D"]"#;
    let feet = r#""a": (at: "A", between: ("ground", "frame"), kind: Fixed), "d": (at: "D", between: ("ground", "frame"), kind: Fixed)"#;
    let loads = r#"loads: [(on: ("frame", "B"), force: (100.0, 0.0, 0.0)), (on: ("frame", "C", "B"), per_length: (0.0, 0.0, -50.0)),
        (on: "frame", per_length: (0.0, 20.0, 0.0))], gravity: (0.0, 0.0, -9.81),"#;
    let text = file(
        points,
        members,
        ", temperature: 15.0",
        feet,
        r#"("frame", "B")"#,
    );
    let text = text.replace("    output", &format!("    {loads}\n    output"));
    let model = read(&text);
    let names: Vec<_> = model.bodies().iter().map(|body| &*body.name).collect();
    assert_eq!(names, ["frame", "frame C", "frame B-C"]);
    assert!(model.bodies().iter().all(|body| body.temperature == 15.0));
    assert_eq!(model.load_set().lines.len(), 1 + 3);
    let found = solution(&model);
    // Written out it is the same.
    let written = write(&model, &Registry::builtin()).expect("a file");
    let again = solution(&read(&written));
    let same = (found.output.displacement - again.output.displacement).amax();
    assert!(same <= 1e-12 * found.output.displacement.amax());
    // Released is released.
    let joint = model
        .joints()
        .iter()
        .position(|own| own.name == "frame B-C at B")
        .expect("a joint");
    let wrench = found.joint_wrenches[joint].expect("a wrench");
    let size = wrench.amax();
    assert!(
        wrench[4].abs() < 1e-9 * size && wrench[5].abs() < 1e-9 * size,
        "{wrench}"
    );
    // All held as it was: a frame without releases.
    let stiff = text.replace(
        ", releases: { \"B\": [v, w] }, springs: { \"C\": (v: 3e3) }",
        "",
    );
    let stiff = solution(&read(&stiff)).output.displacement.norm();
    assert!(found.output.displacement.norm() > 1.05 * stiff);
}

#[test]
fn copies_turn_the_ends_with_the_member() {
    let group = r#"(
    name: "copies",
    materials: { "steel": (young: 2.1e11, shear: 8.0e10) },
    sections: { "bar": Rectangle(width: 0.02, height: 0.03) },
    groups: { "leg": (
        points: { "A": (0.5, 0.0, 0.0), "B": (0.2, 0.0, 0.8) },
        bodies: { "leg": Frame(members: [(through: ["A", "B"], springs: { "B": (v: 2e3, x: 1e7) }, offset: { "A": (0.0, 0.05, 0.02) })], section: "bar", material: "steel") },
        joints: {
            "foot": (at: "A", between: ("ground", "leg"), kind: Fixed),
            "head": (at: "B", between: ("leg", "top"), kind: Fixed),
        },
    ) },
    copies: { "leg": Turned(axis: (0.0, 0.0, 1.0), count: 3) },
    points: { "P": (0.0, 0.0, 0.8) },
    bodies: { "top": Rigid(points: ["P", "B1", "B2", "B3"]) },
    joints: {},
    output: ("top", "P"),
)"#;
    let c = compliance(&read(group));
    // Of three equal legs all round.
    let size = c.amax();
    assert!((c[(0, 0)] - c[(1, 1)]).abs() < 1e-12 * size);
    assert!((c[(3, 3)] - c[(4, 4)]).abs() < 1e-12 * size);
    assert!(c[(0, 2)].abs() < 1e-12 * size && c[(2, 3)].abs() < 1e-12 * size);
}

#[test]
fn mistakes_are_told_where_they_stand() {
    for (fastening, told) in [
        (
            ", releases: { \"Q\": [v] }",
            "`Q` is no end of member 1 of frame `frame`",
        ),
        (", releases: { \"A\": [q] }", "q"),
        (
            ", releases: { \"A\": [v], }, springs: { \"A\": (v: 1e4) }",
            "`v` is fastened twice",
        ),
        (", releases: {}", "fastened in no way"),
        (
            ", springs: { \"A\": (v: -1e4) }",
            "a stiffness cannot be -1e4",
        ),
        (", offset: { \"A\": (0.0, \"5 N\", 0.0) }", "a length"),
        (", release: { \"A\": [v] }", "release"),
    ] {
        let text = file(AB, &member(fastening), "", FOOT, TIP);
        let error = try_read(&text).expect_err(fastening).to_string();
        assert!(
            error.contains(told) && error.contains("frame.ron:6:"),
            "{fastening}: {error}"
        );
    }
    let three = r#"(through: ["A", "C", "B"], releases: { "A": [v] })"#;
    let points = r#""A": (0.0, 0.0, 0.0), "B": (0.8, 0.0, 0.0), "C": (0.4, 0.0, 0.0)"#;
    let error = try_read(&file(points, three, "", FOOT, TIP)).expect_err("three points");
    assert!(
        error.to_string().contains("runs through 3 points"),
        "{error}"
    );
}
