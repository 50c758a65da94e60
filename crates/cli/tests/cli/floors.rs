//! Numbers that are truly zero: no warning, no table and no budget is made of what rounding leaves of
//! them, and the independent solver agrees.

use serde_json::Value;

use crate::support::{Bench, numbers};

const PARTS: &str = r#"    materials: { "steel": (young: 2.1e11, poisson: 0.3) },
    sections: { "rod": Circle(diameter: 0.02) },
"#;

/// A beam from A askew to its tip B, the output, held at A by a joint of which `joint` is said;
/// `more` is at the end.
fn cantilever(joint: &str, more: &str) -> String {
    format!(
        r#"(
    name: "cantilever",
{PARTS}    points: {{ "A": (0.0, 0.0, 0.0), "B": (0.4, 0.1, -0.3) }},
    bodies: {{ "bar": Beam(through: ["A", "B"], section: "rod", material: "steel") }},
    joints: {{ "wall": (at: "A", between: ("ground", "bar"), {joint}) }},
    output: ("bar", "B"),{more}
)
"#
    )
}

const ELASTIC: &str = "stiffness: (x: 1e8, y: 2e7, z: 3e8, u: 1e5, v: 2e4, w: 3e5)";

fn verified(bench: &Bench, file: &str, more: &[&str]) -> Value {
    let arguments = [&["solve", file, "--verify", "--format", "json"], more].concat();
    let report = bench.hyperstat(&arguments).ends_with(0).json();
    assert_eq!(report["warnings"], Value::Array(vec![]), "{file}");
    for of in ["stiffness", "compliance", "displacements", "joint_wrenches"] {
        let difference = &report["verification"][of];
        assert!(
            difference.is_null() || difference.as_f64().is_some_and(|d| d < 1e-8),
            "{file}, {of}: {difference}"
        );
    }
    report
}

/// What a misfit displaces, it displaces without force.
#[test]
fn a_misfit_that_nothing_holds_back_bears_no_force() {
    let bench = Bench::new("floors-misfit");
    let misfit = "misfit: (x: 1e-4, y: -3e-4, w: 2e-3)";
    for (name, joint) in [
        ("elastic.ron", format!("kind: Fixed, {ELASTIC}, {misfit}")),
        ("rigid.ron", format!("kind: Fixed, {misfit}")),
    ] {
        bench.file(name, &cantilever(&joint, ""));
        let report = verified(&bench, name, &[]);
        assert_eq!(numbers(&report["joints"]["wall"]["wrench"]), [0.0; 6]);
        // m + φ × r, r = (0.4, 0.1, −0.3), φ = (0, 0, 2e-3).
        let moved = numbers(&report["displacements"]["bar.B"]);
        let expected = [1e-4 - 2e-3 * 0.1, -3e-4 + 2e-3 * 0.4, 0.0, 0.0, 0.0, 2e-3];
        for (found, expected) in moved.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-15, "{moved:?}");
        }
    }
}

/// A preload of 10 N on a spring of 1e6 N/m that carries a free tip, beyond the output: the tip moves
/// by 1e-5 m, the rest by nothing.
#[test]
fn a_preload_beyond_the_output_leaves_it_where_it_is() {
    let bench = Bench::new("floors-preload");
    let file = format!(
        r#"(
    name: "tip",
{PARTS}    points: {{ "A": (0.0, 0.0, 0.0), "B": (0.4, 0.1, -0.3), "C": (0.5, 0.3, -0.2) }},
    bodies: {{
        "bar": Beam(through: ["A", "B"], section: "rod", material: "steel"),
        "tip": Beam(through: ["B", "C"], section: "rod", material: "steel"),
    }},
    joints: {{
        "wall": (at: "A", between: ("ground", "bar"), kind: Fixed, {ELASTIC}),
        "spring": (at: "B", between: ("bar", "tip"), kind: Fixed,
            stiffness: (x: 1e6, y: 1e6, z: 1e6, u: 1e3, v: 1e3, w: 1e3), preload: (x: 10.0)),
    }},
    output: ("bar", "B"),
)
"#
    );
    bench.file("tip.ron", &file);
    let report = verified(&bench, "tip.ron", &["--why"]);
    assert_eq!(numbers(&report["output"]["displacement"]), [0.0; 6]);
    for joint in ["wall", "spring"] {
        assert_eq!(numbers(&report["joints"][joint]["wrench"]), [0.0; 6]);
    }
    let tip = numbers(&report["displacements"]["tip.C"]);
    assert!((tip[0].abs() - 1e-5).abs() < 1e-18, "{tip:?}");
    // The loads do not move the output, so that its compliance is told.
    assert_eq!(report["budget"]["of"], "compliance");
    let along = verified(&bench, "tip.ron", &["--why", "--along", "x"]);
    for sums in [&report["budget"], &along["budget"]] {
        for part in sums["parts"].as_array().expect("parts") {
            let share = part["share"].as_f64().unwrap_or(0.0);
            assert!(share.abs() <= 1.0 + 1e-9, "{part}");
        }
    }
    let text = bench.hyperstat(&["solve", "tip.ron", "--why"]).ends_with(0);
    let tiny = text.out().split_whitespace().find(|word| {
        let power = word.split_once("e-").map(|(_, power)| power.parse::<u32>());
        matches!(power, Some(Ok(15..)))
    });
    assert_eq!(tiny, None, "{}", text.out());
}

/// A load along x of a bar along x moves it along x alone: along y it has a budget of nothing.
#[test]
fn a_budget_of_nothing_has_no_shares() {
    let bench = Bench::new("floors-budget");
    let load = "\n    loads: [(on: (\"bar\", \"B\"), force: (40.0, 10.0, -30.0))],";
    // The load is along the bar, so that 3 x − 4 y of its displacement is rounding.
    let text = cantilever("kind: Fixed", load);
    bench.file("bar.ron", &text);
    let across = [
        "--why",
        "--along",
        "0.24253562503633297,-0.9701425001453319,0",
    ];
    let report = verified(&bench, "bar.ron", &across);
    let budget = &report["budget"];
    assert_eq!(budget["total"].as_f64(), Some(0.0), "{budget}");
    for part in budget["parts"].as_array().expect("parts") {
        assert!(part["share"].is_null(), "{part}");
    }
    for parameter in report["sensitivities"].as_array().expect("a list") {
        assert!(parameter["relative"].is_null(), "{parameter}");
    }
}

/// Outputs that are held in all translations, or rotations, or free in them.
#[test]
fn outputs_that_are_held_or_free_agree() {
    let bench = Bench::new("floors-held");
    let block = |joint: &str| {
        cantilever(joint, "").replace(
            r#"Beam(through: ["A", "B"], section: "rod", material: "steel")"#,
            r#"Rigid(points: ["A", "B"])"#,
        )
    };
    let at_joint = |text: String| text.replace(r#"("bar", "B")"#, r#"("bar", "A")"#);
    let free = "x: 0.0, y: 0.0, z: 0.0";
    for (name, text) in [
        (
            "turns.ron",
            at_joint(block("kind: Fixed, stiffness: (u: 1e3, v: 2e3, w: 3e3)")),
        ),
        (
            "slides.ron",
            block("kind: Fixed, stiffness: (x: 1e6, y: 2e6, z: 3e6)"),
        ),
        (
            "floats.ron",
            block(&format!(
                "kind: Fixed, stiffness: ({free}, u: 1e3, v: 2e3, w: 3e3)"
            )),
        ),
        (
            "ball.ron",
            block("kind: Spherical, stiffness: (x: 1e6, y: 2e6, z: 3e6)"),
        ),
        (
            "swings.ron",
            at_joint(block(
                "kind: Spherical, stiffness: (x: 1e6, y: 2e6, z: 3e6)",
            )),
        ),
        ("stands.ron", block("kind: Fixed")),
        ("hinged.ron", cantilever("kind: Spherical", "")),
    ] {
        bench.file(name, &text);
        verified(&bench, name, &["--allow-free"]);
    }
}
