//! Mistakes in files: the place, the line, what is wrong, what would be right.

use crate::support::{Bench, CANTILEVER, delta_batch};

#[test]
fn a_mistake_is_shown_with_its_line() {
    let bench = Bench::new("messages-line");
    let text = CANTILEVER.replace(r#"material: "steel") }"#, r#"material: "steal") }"#);
    bench.file("typo.ron", &text);
    let outcome = bench.hyperstat(&["solve", "typo.ron"]).ends_with(2);
    let line = text.lines().nth(5).unwrap();
    let column = line.find("\"steal\"").unwrap() + 1;
    outcome.says(&[
        "error: ",
        &format!("--> typo.ron:6:{column}"),
        line.trim(),
        "^^^^^^^",
        "help: ",
        "steel",
    ]);
    assert_eq!(outcome.out(), "");
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let bench = Bench::new("messages-missing");
    for command in ["solve", "check"] {
        bench
            .hyperstat(&[command, "none.ron"])
            .ends_with(2)
            .says(&["none.ron: cannot be read"]);
    }
    let outcome = bench.hyperstat(&["run", "none.ron", "--out", "out"]);
    outcome.ends_with(2).says(&["none.ron: cannot be read"]);
    assert!(!bench.path("out").exists());
}

#[test]
fn nothing_is_coloured_away_from_a_terminal() {
    let bench = Bench::new("messages-plain");
    bench.file("broken.ron", "(name: ");
    let outcome = bench.hyperstat(&["solve", "broken.ron"]).ends_with(2);
    assert!(!outcome.err().contains('\u{1b}'));
}

#[test]
fn a_body_that_nothing_holds_is_pointed_at() {
    let bench = Bench::new("messages-unheld");
    let text = CANTILEVER.replace(r#"joints: {"#, r#"joints: { "#);
    let text = text.replace(
        r#"bodies: { "#,
        "bodies: {\n        \"loose\": Rigid(points: [\"B\"]),\n        ",
    );
    bench.file("loose.ron", &text);
    let outcome = bench.hyperstat(&["solve", "loose.ron"]).ends_with(2);
    outcome.says(&["loose.ron:7:", "`loose`", "help: "]);
}

#[test]
fn numbers_out_of_all_proportion_get_help() {
    let bench = Bench::new("messages-proportion");
    let load = r#"loads: [(on: ("bar", "B"), moment: (1.7e308, 0.0, 0.0)), "#;
    bench.file("huge.ron", &CANTILEVER.replace("loads: [", load));
    let outcome = bench.hyperstat(&["solve", "huge.ron"]).ends_with(2);
    outcome.says(&["nothing that acts is larger than 1e50", "help: ", "units"]);
    // 1e50 N·m on a hinge of 1e-260 N·m/rad.
    let text = CANTILEVER
        .replace("kind: Fixed", "kind: Fixed, stiffness: (u: 1e-260)")
        .replace("moment: (10.0", "moment: (1e50");
    bench.file("huge.ron", &text);
    let outcome = bench.hyperstat(&["solve", "huge.ron"]).ends_with(2);
    outcome.says(&["overflow", "help: ", "too different size", "units"]);
}

#[test]
fn a_load_on_an_unknown_body_is_told_where_no_pose_is_in_reach() {
    let bench = Bench::new("messages-unreachable-load");
    let batch = delta_batch("delta", "List([(0.0, 0.0, 9.0)])", "");
    bench.file(
        "delta.ron",
        &batch.replace("(\"platform\", \"P\")", "(\"platfrm\", \"P\")"),
    );
    for command in ["run", "check", "solve"] {
        let out: &[&str] = if command == "run" {
            &["--out", "out"]
        } else {
            &[]
        };
        let arguments = [&[command, "delta.ron"][..], out].concat();
        let outcome = bench.hyperstat(&arguments).ends_with(2);
        outcome.says(&["delta.ron:", "unknown body `platfrm`", "`platform`"]);
    }
    assert!(!bench.path("out").exists());
}
