//! The help, as the only thing a stranger has.

use std::path::Path;

use crate::support::{BATCH, Bench, CANTILEVER};

#[test]
fn the_help_names_the_commands_and_shows_examples() {
    let bench = Bench::new("help");
    for arguments in [&["--help"][..], &["help"], &["-h"]] {
        let outcome = bench.hyperstat(arguments).ends_with(0);
        for part in [
            "solve",
            "run",
            "check",
            "hyperstat solve portal.ron --format json",
            "Exit status:",
            "SI",
        ] {
            assert!(
                outcome.out().contains(part),
                "no `{part}` in\n{}",
                outcome.out()
            );
        }
    }
    let outcome = bench.hyperstat(&[]).ends_with(2);
    assert!(outcome.err().contains("Usage: hyperstat"));
}

#[test]
fn every_command_has_help_with_an_example() {
    let bench = Bench::new("help-commands");
    let expected = [
        (
            "solve",
            &[
                "--format",
                "--job",
                "--pose",
                "--verify",
                "--allow-free",
                "Rectangle",
                "text",
                "json",
            ][..],
        ),
        ("check", &["--format", "--job", "--pose", "Ends with 2"]),
        ("export", &["--job", "--pose", "--out", "FILE.ron"]),
        (
            "run",
            &[
                "--out",
                "--format",
                "--threads",
                "parquet",
                "k11,k12",
                "unreachable",
                "BATCH.ron",
            ],
        ),
    ];
    for (command, parts) in expected {
        let outcome = bench.hyperstat(&[command, "--help"]).ends_with(0);
        let example = format!("  hyperstat {command} ");
        for part in parts.iter().copied().chain([example.as_str()]) {
            assert!(
                outcome.out().contains(part),
                "no `{part}` in\n{}",
                outcome.out()
            );
        }
    }
}

/// What the book's table of `status` has, `run --help` has.
#[test]
fn the_help_has_every_status() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/commands.md");
    let Ok(page) = std::fs::read_to_string(page) else {
        return; // The crate alone, without the book.
    };
    let (_, table) = page.split_once("| status | |\n|---|---|\n").unwrap();
    let rows = table.lines().take_while(|line| line.starts_with('|'));
    let mut words: Vec<_> = rows.map(|row| row.split('`').nth(1).unwrap()).collect();
    assert!(words.contains(&"branch") && words.len() >= 6, "{words:?}");
    let outcome = Bench::new("help-status").hyperstat(&["run", "--help"]);
    let outcome = outcome.ends_with(0);
    let (_, told) = outcome
        .out()
        .split_once("why there is no result:\n")
        .unwrap();
    let rows = told.lines().take_while(|line| line.starts_with("  "));
    // A line further to the right goes on with the one before.
    let rows = rows.filter(|line| !line.starts_with("   "));
    let mut told: Vec<_> = rows
        .filter_map(|row| row.split_whitespace().next())
        .collect();
    told.sort_unstable();
    words.sort_unstable();
    assert_eq!(told, words);
}

#[test]
fn the_files_in_the_help_work() {
    let bench = Bench::new("help-files");
    let shown = bench.hyperstat(&["solve", "--help"]).ends_with(0);
    assert!(
        shown.out().contains(CANTILEVER.trim_end()),
        "{}",
        shown.out()
    );
    let shown = bench.hyperstat(&["run", "--help"]).ends_with(0);
    assert!(shown.out().contains(BATCH.trim_end()), "{}", shown.out());
    bench.file("cantilever.ron", CANTILEVER);
    bench.file("batch.ron", BATCH);
    bench.hyperstat(&["solve", "cantilever.ron"]).ends_with(0);
    bench
        .hyperstat(&["run", "batch.ron", "--out", "out"])
        .ends_with(0);
    assert_eq!(
        bench.results("out"),
        ["bar-deformed.png", "bar-deformed.svg", "bar.csv"]
    );
}

#[test]
fn a_command_line_that_means_nothing_ends_with_2() {
    let bench = Bench::new("help-usage");
    bench
        .hyperstat(&["slove", "a.ron"])
        .ends_with(2)
        .says(&["slove", "solve"]);
    bench
        .hyperstat(&["run", "a.ron"])
        .ends_with(2)
        .says(&["--out"]);
    bench
        .hyperstat(&["solve", "a.ron", "--pose", "-1"])
        .ends_with(2);
}

#[test]
fn the_version_is_the_crate_s() {
    let outcome = Bench::new("version").hyperstat(&["--version"]).ends_with(0);
    assert_eq!(
        outcome.out(),
        concat!("hyperstat ", env!("CARGO_PKG_VERSION"), "\n")
    );
}
