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
    outcome.says(&[
        "nothing that acts may be larger than 1e50",
        "help: ",
        "units",
    ]);
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

/// Of two materials the one without `yield` has no utilisation, and the table of points says so.
#[test]
fn what_is_not_known_is_no_nan() {
    let bench = Bench::new("messages-nan");
    let text = CANTILEVER
        .replace("} },\n", "}\n")
        .replace(
            "poisson: 0.3) }",
            r#"poisson: 0.3, yield: 2.5e8), "free": (young: 7e10, poisson: 0.3) }"#,
        )
        .replace(
            r#""B": (0.5, 0.0, 0.0) }"#,
            r#""B": (0.5, 0.0, 0.0), "C": (0.7, 0.0, 0.0) }"#,
        )
        .replace(
            r#"material: "steel") }"#,
            r#"material: "steel"), "tip": Beam(through: ["B", "C"], section: "rod", material: "free") }"#,
        )
        .replace(
            "kind: Fixed) }",
            r#"kind: Fixed), "weld": (at: "B", between: ("bar", "tip"), kind: Fixed) }"#,
        )
        .replace(r#"("bar", "B")"#, r#"("tip", "C")"#)
        .replace(r#"between: ("tip", "C")"#, r#"between: ("bar", "tip")"#);
    bench.file("m.ron", &text);
    let outcome = bench.hyperstat(&["solve", "m.ron"]).ends_with(0);
    assert!(outcome.out().contains("utilisation"), "{}", outcome.out());
    assert!(!outcome.out().contains("NaN"), "{}", outcome.out());
    let row = outcome.out().lines().find(|line| line.contains("B-C"));
    assert!(row.unwrap().ends_with("  –"), "{}", outcome.out());
}

/// Comments of other languages, and characters that do not show.
#[test]
fn what_stands_before_the_first_value_or_does_not_show_is_named() {
    let bench = Bench::new("messages-slips");
    let slip = |text: &str, place: &str, words: &[&str]| {
        bench.file("m.ron", text);
        let outcome = bench.hyperstat(&["solve", "m.ron"]).ends_with(2);
        outcome.says(&[words, &[place]].concat());
    };
    let comment: &[&str] = &["`#` begins no comment", "comments are `// …`"];
    slip(&format!("# a bar\n{CANTILEVER}"), "m.ron:1:1", comment);
    slip(
        &format!("\n\n  # a bar\n{CANTILEVER}"),
        "m.ron:3:3",
        comment,
    );
    slip(
        &format!("// one # and\n#two\n{CANTILEVER}"),
        "m.ron:2:1",
        comment,
    );
    slip("#! a script\n(jobs: [])", "m.ron:1:1", comment);
    slip("# of jobs\n(jobs: [])", "m.ron:1:1", comment);
    for (c, name) in [
        ('\u{a0}', "U+00A0 (no-break space)"),
        ('\u{200b}', "U+200B (zero-width space)"),
        ('\u{feff}', "U+FEFF (byte order mark)"),
    ] {
        for (from, to) in [
            ("young: ", format!("young:{c} ")),
            ("young: 2.1e11", format!("young: 2.1e11{c}")),
            ("young: 2.1e11", format!("young: 2.1e{c}11")),
            ("young:", format!("young{c}:")),
            ("young:", format!("{c}young:")),
        ] {
            slip(
                &CANTILEVER.replace(from, &to),
                "m.ron:3:",
                &[name, "delete it"],
            );
        }
    }
    let thousands = CANTILEVER.replace("2.1e11", "210,000,000,000.0");
    slip(
        &thousands,
        "m.ron:3:35",
        &["thousands", "write 210000000000.0"],
    );
    let both = CANTILEVER.replace("diameter: 0.02", "diameter: 1,020");
    slip(&both, "m.ron:4:", &["write 1.020, or 1020.0 if"]);
}

/// Tables of poses with comments, blanks and what does not show.
#[test]
fn slips_in_tables_are_named() {
    let bench = Bench::new("messages-tables");
    bench.file("d.ron", &delta_batch("d", r#"Csv("p.csv")"#, ""));
    for (table, words) in [
        (
            "# poses\nx,y,z\n0,0,0.5\n",
            ["p.csv:1:1", "`#` begins no comment"],
        ),
        (
            "x,y,z\n# poses\n0,0,0.5\n",
            ["p.csv:2:1", "`#` begins no comment"],
        ),
        (
            "x y z\n0 0 0.5\n",
            ["p.csv:1:2", "a blank separates the cells"],
        ),
        (
            "x,y,z\n0 0 0.5\n",
            ["p.csv:2:2", "a blank separates the cells"],
        ),
        (
            "x,y,z\n0,0,0.5\u{200b}\n",
            ["p.csv:2:5", "U+200B (zero-width space)"],
        ),
    ] {
        bench.file("p.csv", table);
        let outcome = bench.hyperstat(&["run", "d.ron", "--out", "out"]);
        outcome
            .ends_with(2)
            .says(&[&words[..], &["help: "]].concat());
    }
    bench.file("p.csv", "x,y,z\r0,0,0.5\r0.1,0,0.5\r");
    let outcome = bench
        .hyperstat(&["run", "d.ron", "--out", "out"])
        .ends_with(0);
    assert!(
        outcome.out().contains("d: 2 poses, all solved"),
        "{}",
        outcome.out()
    );
}

/// Lines may end with a carriage return alone, as old programs write them.
#[test]
fn carriage_returns_end_lines() {
    let bench = Bench::new("messages-cr");
    let text = CANTILEVER
        .replace('\n', "\r")
        .replacen('(', "( // a bar", 1);
    bench.file("m.ron", &text);
    bench.hyperstat(&["solve", "m.ron"]).ends_with(0);
    bench.file("m.ron", &text.replace("\"steel\") }", "\"steal\") }"));
    let outcome = bench.hyperstat(&["solve", "m.ron"]).ends_with(2);
    outcome.says(&["m.ron:6:"]);
}
