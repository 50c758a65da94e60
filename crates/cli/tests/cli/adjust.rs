//! Rounded coordinates: what is said of them, and what gives their freedoms back.

use std::path::Path;

use crate::support::Bench;

/// The Exechon of the examples, with all of its numbers rounded to so many decimals.
fn exechon(decimals: usize) -> Option<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/exechon.ron");
    let text = std::fs::read_to_string(path).ok()?;
    Some(rounded(&text, decimals))
}

/// A file with all of its numbers rounded.
fn rounded(text: &str, decimals: usize) -> String {
    let numbers = |c: char| c.is_ascii_digit() || ".-e".contains(c);
    let mut rounded = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit() || c == '-') {
        let (before, number) = rest.split_at(start);
        let end = number.find(|c| !numbers(c)).unwrap_or(number.len());
        let (number, after) = number.split_at(end);
        rounded += before;
        let inside = before.ends_with(|c: char| c.is_alphanumeric() || c == '"');
        rounded += &match number.parse::<f64>() {
            Ok(value) if number.contains('.') && !inside => {
                let short: f64 = format!("{value:.decimals$}").parse().unwrap();
                format!("{short:?}")
            }
            _ => number.to_owned(),
        };
        rest = after;
    }
    rounded + rest
}

const MISSED: &str = "a third freedom is missed by 1e-4: coordinates rounded to three digits? `hyperstat \
                      adjust` moves them by the least that it takes";

const POSES: &str =
    "List([(0.15, -0.2, 1.0), (0.1, -0.15, 0.95), (0.25, -0.05, 1.1), (-0.1, 0.1, 0.9)])";

#[test]
fn check_solve_and_run_name_the_freedom_that_rounding_took() {
    let Some(text) = exechon(3) else { return };
    let bench = Bench::new("adjust-warnings");
    bench.file("rounded.ron", &text);
    let job = format!("(name: \"rounded\", mechanism: File(\"rounded.ron\"), poses: {POSES})");
    bench.file("batch.ron", &format!("(jobs: [{job}])"));
    for arguments in [
        &["check", "rounded.ron"][..],
        &["check", "rounded.ron", "--format", "json"],
        &["solve", "rounded.ron"],
        &["solve", "rounded.ron", "--format", "json"],
    ] {
        let outcome = bench.hyperstat(arguments).ends_with(0);
        assert!(
            outcome.out().contains(MISSED),
            "{arguments:?}\n{}",
            outcome.out()
        );
    }
    let run = bench
        .hyperstat(&["run", "batch.ron", "--out", "out"])
        .ends_with(1);
    assert!(
        run.out().contains("warning: a third freedom is missed"),
        "{}",
        run.out()
    );
    let pose = bench
        .hyperstat(&["solve", "batch.ron", "--pose", "1"])
        .ends_with(2);
    pose.says(&[
        "cannot follow: it has 2 freedoms",
        MISSED,
        "choose a pose in reach with `--pose`",
    ]);
}

#[test]
fn an_adjusted_file_moves_as_the_one_that_was_not_rounded() {
    let (Some(exact), Some(rounded)) = (exechon(17), exechon(4)) else {
        return;
    };
    let bench = Bench::new("adjust-rows");
    bench.file("exact.ron", &exact);
    bench.file("rounded.ron", &rounded);
    let said = bench.hyperstat(&["adjust", "rounded.ron", "--out", "adjusted.ron"]);
    let said = said.ends_with(0);
    for part in [
        "freedoms         3",
        "four digits behind the point",
        "points.M1",
        "joints.D1.kind.axis",
    ] {
        assert!(said.out().contains(part), "{part}\n{}", said.out());
    }
    let check = |file: &str| {
        bench
            .hyperstat(&["check", file, "--format", "json"])
            .ends_with(0)
            .json()
    };
    let [exact, adjusted] = ["exact.ron", "adjusted.ron"].map(check);
    for field in ["mobility", "overconstraint", "unknowns", "warnings"] {
        assert_eq!(adjusted[field], exact[field], "{field}");
    }
    assert!(
        bench
            .read("adjusted.ron")
            .starts_with("// The Exechon tripod (2-UPR + SPR)")
    );
    let jobs = ["exact", "adjusted"]
        .map(|name| format!("(name: \"{name}\", mechanism: File(\"{name}.ron\"), poses: {POSES})"));
    bench.file("batch.ron", &format!("(jobs: [{}])", jobs.join(", ")));
    bench
        .hyperstat(&["run", "batch.ron", "--out", "out"])
        .ends_with(0);
    let rows = |name: &str| -> Vec<Vec<f64>> {
        let table = bench.read(&format!("out/{name}.csv"));
        let rows = table.lines().skip(1);
        rows.map(|row| {
            row.split(',')
                .filter_map(|cell| cell.parse().ok())
                .collect()
        })
        .collect()
    };
    let (exact, adjusted) = (rows("exact"), rows("adjusted"));
    assert_eq!((exact.len(), exact[3].len()), (4, 34));
    for (one, other) in exact.iter().zip(&adjusted) {
        // Pose coordinates: what was rounded, some times over.
        for k in 1..7 {
            assert!((one[k] - other[k]).abs() < 1e-3, "{one:?}\n{other:?}");
        }
        // Stiffness: k11, k22 and k33.
        for k in [13, 19, 24] {
            assert!((one[k] / other[k] - 1.0).abs() < 1e-2, "{one:?}\n{other:?}");
        }
    }
}

#[test]
fn nothing_is_overwritten_and_nothing_needless_moved() {
    let (Some(exact), Some(rounded)) = (exechon(17), exechon(5)) else {
        return;
    };
    let bench = Bench::new("adjust-files");
    bench.file("rounded.ron", &rounded);
    bench.file("exact.ron", &exact);
    let refused = bench.hyperstat(&["adjust", "rounded.ron", "--out", "rounded.ron"]);
    refused
        .ends_with(2)
        .says(&["rounded.ron would be overwritten"]);
    assert_eq!(bench.read("rounded.ron"), rounded);
    let done = bench.hyperstat(&[
        "adjust",
        "exact.ron",
        "--out",
        "same.ron",
        "--format",
        "json",
    ]);
    let done = done.ends_with(0).json();
    assert_eq!(done["freedoms"], serde_json::Value::Null);
    assert_eq!(bench.read("same.ron"), exact);
    // JSON in, JSON out.
    let json = bench.hyperstat(&["export", "exact.ron", "--format", "json"]);
    bench.file("rounded.json", &self::rounded(json.ends_with(0).out(), 5));
    let told = bench.hyperstat(&[
        "adjust",
        "rounded.json",
        "--out",
        "a.json",
        "--format",
        "json",
    ]);
    let told = told.ends_with(0).json();
    assert_eq!(told["freedoms"], 3);
    assert!(told["most_roundings"].as_f64().unwrap() <= 5.0);
    let number = &told["moved"][0]["numbers"][0];
    assert!(number["path"].as_str().unwrap().starts_with("points.") && number["line"].is_u64());
    bench.hyperstat(&["check", "a.json"]).ends_with(0);
    let expressions = rounded.replace("points: {", "points: { \"Q\": (\"= P.x\", 0, 0),");
    let expressions = expressions.replace("kind: Spherical", "kind: Spherical /* = */");
    bench.file("held.ron", &expressions);
    bench
        .hyperstat(&["adjust", "held.ron", "--out", "moved.ron"])
        .ends_with(0);
    assert!(
        bench
            .read("moved.ron")
            .contains("\"Q\": (\"= P.x\", 0, 0),")
    );
    let batch = bench.hyperstat(&["new", "delta"]).ends_with(0);
    bench.file("batch.ron", batch.out());
    bench.hyperstat(&["adjust", "batch.ron"]).ends_with(2);
}
