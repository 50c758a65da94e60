//! `hyperstat solve` without `--full`: the answer on a page.

use std::path::Path;

use crate::support::{Bench, CANTILEVER, delta_batch};

/// Lines of a page of paper.
const PAGE: usize = 60;

/// Three cases of a delta with its weight: what is asked first is on one page, and all of it stands in
/// the full report too.
#[test]
fn three_cases_fit_on_a_page() {
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/delta_states.ron");
    if !example.exists() {
        return; // The crate alone, without the examples.
    }
    let bench = Bench::new("answer-cases");
    let example = example.to_str().unwrap();
    let answer = bench.hyperstat(&["solve", example]).ends_with(0);
    let full = bench.hyperstat(&["solve", example, "--full"]).ends_with(0);
    assert!(answer.out().lines().count() <= PAGE, "{}", answer.out());
    assert!(full.out().lines().count() > 5 * PAGE);
    for part in [
        "mobility         3",
        "Gravity",
        "Stiffness of the output [N/m, N/rad; N, N·m/rad]",
        "Worst point of every body",
        "--full",
    ] {
        assert!(
            answer.out().contains(part),
            "no `{part}` in\n{}",
            answer.out()
        );
    }
    let words = |line: &str| {
        line.split_whitespace()
            .map(String::from)
            .collect::<Vec<_>>()
    };
    for case in ["carry", "push", "rod hit"] {
        let row = answer.out().lines().find_map(|line| {
            let rest = line.trim_start().strip_prefix(case)?;
            (words(rest).len() == 6).then(|| words(rest))
        });
        let title = format!("Case `{case}`: displacement of the output [m, rad]");
        let mut lines = full.out().lines().skip_while(|line| *line != title);
        assert_eq!(row, lines.nth(2).map(words), "{case}");
    }
    // The worst point of all cases is that of the case in which it is worst.
    let mut most = 0.0_f64;
    let sections = full.out().split("\n\n");
    for section in sections.filter(|section| section.contains("orst point of every body")) {
        let row = section.lines().find(|line| line.starts_with("  arm2 "));
        let last = row.and_then(|row| row.split_whitespace().last()).unwrap();
        most = most.max(last.parse().unwrap());
    }
    let worst = answer
        .out()
        .lines()
        .find(|line| line.starts_with("  arm2 "));
    let worst = worst.and_then(|line| line.split_whitespace().last()?.parse().ok());
    assert_eq!(worst, Some(most));
}

#[test]
fn json_is_the_same_with_and_without_full() {
    let bench = Bench::new("answer-json");
    bench.file("bar.ron", CANTILEVER);
    let solve = |more: &[&str]| {
        let arguments = [&["solve", "bar.ron", "--format", "json"], more].concat();
        bench.hyperstat(&arguments).ends_with(0).out().to_owned()
    };
    assert_eq!(solve(&[]), solve(&["--full"]));
}

/// What makes a report long is cut, and said to be.
#[test]
fn many_cases_idle_motions_and_loads_are_cut() {
    let bench = Bench::new("answer-many");
    let load = r#"(on: ("bar", "B"), force: (0.0, 1.0, 0.0))"#;
    let cases: String = (0..30).map(|k| format!("\"c{k}\": [{load}], ")).collect();
    let text = CANTILEVER.replacen("output:", &format!("cases: {{ {cases} }},\n    output:"), 1);
    bench.file("bar.ron", &text);
    let answer = bench.hyperstat(&["solve", "bar.ron"]).ends_with(0);
    assert!(answer.out().lines().count() <= PAGE, "{}", answer.out());
    // Seven of thirty cases stand beside the loads of no case.
    assert!(answer.out().contains("  … and 23 more"), "{}", answer.out());

    let batch = delta_batch("delta", "List([(0.03, 0.02, 0.45)])", "").replace(
        "rod_spacing: 0.12,",
        "rod_spacing: 0.12, rod_ends: Spherical,",
    );
    bench.file("delta.ron", &batch);
    let answer = bench.hyperstat(&["solve", "delta.ron"]).ends_with(0);
    assert!(answer.out().lines().count() <= PAGE, "{}", answer.out());
    assert!(
        answer.out().contains("  - … and 4 more"),
        "{}",
        answer.out()
    );
}

/// What is no plain answer is told on the page too.
#[test]
fn a_held_and_a_free_output_are_told() {
    let bench = Bench::new("answer-limits");
    let held = CANTILEVER.replace(r#"output: ("bar", "B")"#, r#"output: ("bar", "A")"#);
    bench.file("held.ron", &held);
    let answer = bench.hyperstat(&["solve", "held.ron"]).ends_with(0);
    assert!(answer.out().contains("held rigidly in these directions"));
    let free = crate::support::hinged().replace(r#"on: ("bar", "B")"#, r#"on: ("bar", "A")"#);
    bench.file("free.ron", &free);
    let answer = bench.hyperstat(&["solve", "free.ron"]).ends_with(2);
    assert!(answer.out().contains("it moves freely in these directions"));
}
