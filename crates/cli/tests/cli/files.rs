//! Files themselves: in JSON, begun, put in order, described; completions.

use std::fs;

use serde_json::Value;

use crate::support::{Bench, CANTILEVER, delta_batch};

#[test]
fn a_mechanism_in_json_gives_the_same_bytes() {
    let bench = Bench::new("files-json");
    bench.file("bar.ron", CANTILEVER);
    let json = bench.hyperstat(&["export", "bar.ron", "--format", "json"]);
    let json = json.ends_with(0);
    assert_eq!(json.json()["bodies"]["bar"]["Beam"]["section"], "bar");
    bench.file("bar.json", json.out());
    let ron = bench.hyperstat(&["export", "bar.ron"]).ends_with(0);
    bench.file("again.ron", ron.out());
    let out = [
        "export",
        "bar.ron",
        "--format",
        "json",
        "--out",
        "bar2.json",
    ];
    assert_eq!(bench.hyperstat(&out).ends_with(0).out(), "");
    assert_eq!(bench.read("bar2.json"), json.out());
    for arguments in [
        &["solve", "--full"][..],
        &["solve", "--format", "json", "--why"],
        &["check"],
        &["export"],
    ] {
        let said = |file: &str| {
            let outcome = bench.hyperstat(&[arguments, &[file]].concat()).ends_with(0);
            outcome.out().to_owned()
        };
        assert_eq!(said("bar.json"), said("again.ron"), "{arguments:?}");
    }
    let drawn = bench.hyperstat(&["plot", "bar.json", "--deformed", "--out", "bar"]);
    drawn.ends_with(0);
    let budget = bench.hyperstat(&["plot", "bar.json", "--budget", "--out", "budget"]);
    budget.ends_with(0);
}

#[test]
fn a_mistake_in_json_has_its_place() {
    let bench = Bench::new("files-json-mistake");
    bench.file("bar.ron", CANTILEVER);
    let json = bench.hyperstat(&["export", "bar.ron", "--format", "json"]);
    let wrong = json.ends_with(0).out().replace("\"young\"", "\"yuong\"");
    bench.file("wrong.json", &wrong);
    let line = 1 + wrong
        .lines()
        .position(|line| line.contains("yuong"))
        .unwrap();
    let outcome = bench.hyperstat(&["solve", "wrong.json"]).ends_with(2);
    outcome.says(&[
        "unknown field `yuong`",
        &format!("wrong.json:{line}:"),
        "did you mean `young`?",
    ]);
    bench.file("comment.json", "{ // a comment\n}\n");
    let outcome = bench.hyperstat(&["check", "comment.json"]).ends_with(2);
    outcome.says(&["JSON has no comments", "comment.json:1:3"]);
}

#[test]
fn a_batch_in_json_runs_as_in_ron() {
    let bench = Bench::new("files-json-batch");
    let poses = "Grid(x: (-0.1, 0.1, 2), y: (0.0, 0.0, 1), z: (0.5, 0.5, 1))";
    bench.file(
        "delta.ron",
        &delta_batch(
            "delta",
            poses,
            "vary: { \"rod.section.diameter\": [0.014, 0.016] },",
        ),
    );
    let ron = bench.read("delta.ron");
    let json = hyperstat_study::files::to_json(&ron, "delta.ron".as_ref()).unwrap();
    bench.file("delta.json", &json);
    for (file, out) in [("delta.ron", "one"), ("delta.json", "other")] {
        bench.hyperstat(&["run", file, "--out", out]).ends_with(0);
    }
    assert_eq!(bench.read("one/delta.csv"), bench.read("other/delta.csv"));
}

#[test]
fn every_new_file_passes_check_and_run() {
    let bench = Bench::new("files-new");
    let kinds = hyperstat_study::files::beginnings();
    assert!(kinds.len() > 12, "{kinds:?}");
    for kind in kinds {
        for format in ["ron", "json"] {
            let file = format!("{kind}.{format}");
            let begun = bench
                .hyperstat(&["new", &kind, "--format", format])
                .ends_with(0);
            bench.file(&file, begun.out());
            assert_eq!(begun.out().contains("//"), format == "ron");
            bench.hyperstat(&["check", &file]).ends_with(0);
            match kind == "mechanism" {
                true => bench.hyperstat(&["solve", &file]).ends_with(0),
                false => bench
                    .hyperstat(&["run", &file, "--out", "out"])
                    .ends_with(0),
            };
            // It is in order already.
            let fmt = bench.hyperstat(&["fmt", "--check", &file]).ends_with(0);
            assert_eq!(fmt.out(), "");
        }
    }
    let typed = bench.hyperstat(&["new", "ThreeRps"]).ends_with(0);
    assert_eq!(typed.out(), bench.read("three-rps.ron"));
    let wrong = bench.hyperstat(&["new", "dleta"]).ends_with(2);
    wrong.says(&[
        "there is no file `dleta` to begin with",
        "did you mean `delta`?",
    ]);
    let wrong = bench.hyperstat(&["new", "xyz"]).ends_with(2);
    wrong.says(&["give one of `mechanism`, `delta`"]);
}

#[test]
fn fmt_puts_files_in_order_and_leaves_wrong_ones() {
    let bench = Bench::new("files-fmt");
    let uneven = CANTILEVER.replace("\n    ", "\n  // note\n  ");
    bench.file("bar.ron", &uneven);
    bench.file("even.ron", "(\n    name: \"a\",\n)\n");
    bench.file("wrong.ron", "(name: \"a\"");
    let check = bench
        .hyperstat(&["fmt", "--check", "bar.ron", "even.ron"])
        .ends_with(1);
    assert_eq!(check.out(), "bar.ron\n");
    assert_eq!(bench.read("bar.ron"), uneven);

    // Nothing is written where one of them is wrong.
    let wrong = bench
        .hyperstat(&["fmt", "bar.ron", "wrong.ron"])
        .ends_with(2);
    wrong.says(&["wrong.ron:1:", "a closing bracket"]);
    assert_eq!(bench.read("bar.ron"), uneven);
    assert_eq!(bench.read("wrong.ron"), "(name: \"a\"");

    let before = bench.hyperstat(&["solve", "bar.ron"]).ends_with(0);
    let done = bench.hyperstat(&["fmt", "bar.ron"]).ends_with(0);
    assert_eq!(done.out(), "bar.ron\n");
    assert_eq!(
        bench.read("bar.ron").matches("// note").count(),
        uneven.matches("// note").count()
    );
    let after = bench.hyperstat(&["solve", "bar.ron"]).ends_with(0);
    assert_eq!(after.out(), before.out());
    bench.hyperstat(&["fmt", "--check", "bar.ron"]).ends_with(0);
    assert_eq!(bench.names("."), ["bar.ron", "even.ron", "wrong.ron"]);
}

#[cfg(unix)]
#[test]
fn fmt_keeps_permissions_and_refuses_what_cannot_be_written() {
    use std::os::unix::fs::PermissionsExt;

    let bench = Bench::new("files-fmt-permissions");
    bench.file("bar.ron", "(name:\"a\")");
    let mode = |mode| fs::set_permissions(bench.path("bar.ron"), fs::Permissions::from_mode(mode));
    mode(0o444).unwrap();
    let refused = bench.hyperstat(&["fmt", "bar.ron"]).ends_with(3);
    refused.says(&["cannot write bar.ron"]);
    assert_eq!(bench.read("bar.ron"), "(name:\"a\")");
    mode(0o640).unwrap();
    bench.hyperstat(&["fmt", "bar.ron"]).ends_with(0);
    let found = fs::metadata(bench.path("bar.ron")).unwrap().permissions();
    assert_eq!(found.mode() & 0o777, 0o640);
}

#[test]
fn the_schema_is_json() {
    let bench = Bench::new("files-schema");
    let schema: Value = bench.hyperstat(&["schema"]).ends_with(0).json();
    assert_eq!(
        schema["$schema"],
        "https://json-schema.org/draft/2020-12/schema"
    );
    assert_eq!(schema["oneOf"].as_array().unwrap().len(), 2);
}

#[test]
fn completions_know_the_commands() {
    let bench = Bench::new("files-completions");
    for shell in ["bash", "zsh", "fish"] {
        let script = bench.hyperstat(&["completions", shell]).ends_with(0);
        for word in ["hyperstat", "completions", "allow-free"] {
            assert!(script.out().contains(word), "{shell}: {word}");
        }
    }
    bench.hyperstat(&["completions", "tcsh"]).ends_with(2);
}
