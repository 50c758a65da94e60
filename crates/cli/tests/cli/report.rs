//! `hyperstat report` as a user meets it: one page with everything on it.

use crate::support::{Bench, delta_batch};

/// A map of a delta.
fn grid(z: &str) -> String {
    let poses = format!("Grid(x: (-0.1, 0.1, 3), y: (-0.1, 0.1, 3), z: ({z}, {z}, 1))");
    delta_batch("grid", &poses, "figures: [Map(value: \"k33\")],")
}

#[test]
fn a_page_of_a_batch_stands_by_itself() {
    let bench = Bench::new("report-batch");
    bench.file("grid.ron", &grid("0.5"));
    bench
        .hyperstat(&[
            "report",
            "grid.ron",
            "--out",
            "grid.html",
            "--title",
            "A delta <& its map>",
        ])
        .ends_with(0);
    let page = bench.read("grid.html");
    assert!(page.starts_with("<!DOCTYPE html>"));
    for part in [
        "<h1>A delta &lt;&amp; its map&gt;</h1>",
        "9 rows, all solved.",
        "Over the poses",
        "pure_force_stiffness_min",
        "Natural frequencies",
        "Worst points",
        "figures: [Map(value: &quot;k33&quot;)]",
        "<dt>stiffness</dt>",
    ] {
        assert!(page.contains(part), "no {part:?}");
    }
    // The map, the deformed mechanism, the budget, three modes; nothing is fetched, nothing runs.
    assert_eq!(page.matches("<figure>").count(), 6, "figures");
    for fetched in ["src=", "<script", "<link", "url(", "@import"] {
        assert!(!page.contains(fetched), "{fetched}");
    }
    let links = page.match_indices("http").map(|(at, _)| &page[at..at + 26]);
    assert!(
        links
            .into_iter()
            .all(|link| link == "http://www.w3.org/2000/svg")
    );
    // The numbers are those of `solve`.
    let solved = bench
        .hyperstat(&["solve", "grid.ron"])
        .ends_with(0)
        .out()
        .to_string();
    let row = solved
        .lines()
        .find(|line| line.trim_start().starts_with("Fz"))
        .unwrap();
    for number in row
        .split_whitespace()
        .skip(1)
        .filter(|number| *number != "0")
    {
        assert!(page.contains(&format!("<td>{number}</td>")), "{number}");
    }
    // The same page again, at any number of threads.
    let again = bench.hyperstat(&[
        "report",
        "grid.ron",
        "--threads",
        "1",
        "--title",
        "A delta <& its map>",
    ]);
    assert_eq!(again.ends_with(0).out().to_string(), page);
}

#[test]
fn what_cannot_be_reported_says_so() {
    let bench = Bench::new("report-errors");
    bench.file("grid.ron", &grid("0.5"));
    bench.file("far.ron", &grid("5.0"));
    for (arguments, part) in [
        (
            vec!["grid.ron", "--out", "grid.ron"],
            "grid.ron would be overwritten",
        ),
        (vec!["grid.ron", "--job", "grib"], "no job `grib`"),
        (vec!["grid.ron", "--pose", "9"], "pose 9"),
        (vec!["grid.ron", "--case", "push"], "no case `push`"),
        (vec!["none.ron"], "none.ron"),
    ] {
        let arguments = [vec!["report"], arguments].concat();
        let outcome = bench.hyperstat(&arguments);
        assert_eq!(outcome.status(), 2, "{arguments:?}");
        assert!(
            outcome.err().contains(part),
            "{arguments:?}:\n{}",
            outcome.err()
        );
    }
    assert_eq!(bench.read("grid.ron"), grid("0.5"));
    // Nothing of it is in reach: the page says so.
    let page = bench
        .hyperstat(&["report", "far.ron"])
        .ends_with(0)
        .out()
        .to_string();
    assert!(page.contains("9 without a result") && page.contains("unreachable"));
}
