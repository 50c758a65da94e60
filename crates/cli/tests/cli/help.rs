//! The help, as the only thing a stranger has.

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
        bench.names("out"),
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
