//! Whatever a file holds, the loader answers: with a mechanism or batch, or with an error in
//! the file.

use crate::fuzzing;

use std::path::Path;

use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;

const FILES: [&str; 3] = [
    include_str!("../../../../tests/reference/every_joint.ron"),
    include_str!("../../../../examples/portal.ron"),
    include_str!("../../../../examples/paper.ron"),
];

/// Pieces that mean something in the format, or nearly.
const PIECES: [&str; 34] = [
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ":",
    "\"",
    "\\",
    "/*",
    "*/",
    "//",
    "'",
    "r#\"",
    "#![",
    "..",
    "-",
    "0",
    "1e999",
    "NaN",
    "-inf",
    "1e-320",
    "\"B\"",
    "\"ground\"",
    "Some(",
    "None",
    "()",
    "Revolute",
    "Matrix([])",
    "true",
    "\n",
    "\u{feff}",
    "é",
];

fn answer(text: &str) {
    // What a batch names is found beside it.
    fuzzing::answer(text, Path::new("../../examples/mutated.ron"));
}

fn boundary(text: &str, at: prop::sample::Index) -> usize {
    let at = at.index(text.len() + 1);
    (0..=at)
        .rev()
        .find(|&k| text.is_char_boundary(k))
        .unwrap_or(0)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 400,
        failure_persistence: Some(Box::new(FileFailurePersistence::Direct(
            "tests/mutations.proptest-regressions",
        ))),
        ..ProptestConfig::default()
    })]

    #[test]
    fn pieces_put_in_or_cut_out(
        file in 0..FILES.len(),
        edits in prop::collection::vec(
            (any::<prop::sample::Index>(), 0_usize..40, 0..PIECES.len()), 1..4),
    ) {
        let mut text = FILES[file].to_owned();
        for (at, cut, piece) in edits {
            let start = boundary(&text, at);
            let end = (start + cut).min(text.len());
            let end = (start..=end).rev().find(|&k| text.is_char_boundary(k)).unwrap_or(start);
            text.replace_range(start..end, PIECES[piece]);
        }
        answer(&text);
    }

    #[test]
    fn pieces_of_the_files_shuffled(
        parts in prop::collection::vec(
            (0..FILES.len(), any::<prop::sample::Index>(), 1_usize..200), 1..6),
    ) {
        let mut text = String::from("(");
        for (file, at, length) in parts {
            let start = boundary(FILES[file], at);
            text.extend(FILES[file][start..].chars().take(length));
        }
        answer(&text);
    }

    #[test]
    fn anything_at_all(text in any::<String>()) {
        answer(&text);
        answer(&format!("(name: {text}"));
    }
}

#[test]
fn deeply_nested_files_are_answered() {
    for piece in [
        "(", "[", "{\"a\":", "Some(", "(a:", "/*", "Beam(", "((", "[(", "-", "\"", "\\",
    ] {
        for count in [10, 100, 10_000, 1_000_000] {
            answer(&piece.repeat(count));
            answer(&format!("(jobs: {}", piece.repeat(count)));
        }
        let closed = piece.replace(['(', '[', '{'], ")").replace("\"a\":", "");
        answer(&format!("{}{}", piece.repeat(100), closed.repeat(100)));
    }
}

#[test]
fn every_beginning_of_a_file_is_answered() {
    let text = FILES[1];
    for (end, _) in text.char_indices() {
        answer(&text[..end]);
    }
}
