//! Whatever a file holds, the loader answers: with a mechanism or batch, or with an error in
//! the file; and whatever it takes is posed, planned and solved, or refused.
//!
//! The seeds are changed at random, by bytes and by tokens, for `HYPERSTAT_MUTATION_SECONDS` in each
//! test of a kind of input; `HYPERSTAT_MUTATION_SEED` gives other changes. The last text is kept in
//! the target folder, for what ends the whole program.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::{Duration, Instant};

use hyperstat_mechanisms::to_json;
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;

use crate::fuzzing::{self, Folder, Mutator, Random, jobs_alone, seeds};

/// The repository, from this crate's folder.
const REPOSITORY: &str = "../..";

/// Time of each kind of input without `HYPERSTAT_MUTATION_SECONDS` [s].
const SECONDS: f64 = 2.0;

/// Inputs of which some are taken, however long they take.
const ENOUGH: u64 = 500;

/// Texts to begin with that are kept, those that were taken among them.
const KEPT: usize = 2000;

fn folder() -> Folder {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("mutations/folder");
    Folder::new(Path::new(REPOSITORY), &path)
}

fn variable<T: std::str::FromStr>(name: &str, default: T) -> T {
    match std::env::var(name) {
        Err(_) => default,
        Ok(text) => text
            .parse()
            .unwrap_or_else(|_| panic!("{name} is `{text}`")),
    }
}

/// Changes texts until the time is over, and gives each to `takes`, which says whether it was taken.
fn change(what: &str, texts: Vec<String>, takes: impl Fn(&str) -> bool) {
    let time = Duration::from_secs_f64(variable("HYPERSTAT_MUTATION_SECONDS", SECONDS));
    let seed = variable("HYPERSTAT_MUTATION_SEED", 1_u64);
    let kept = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("mutations/{what}.txt"));
    fs::create_dir_all(kept.parent().unwrap()).unwrap();
    let (mut random, mut mutator) = (Random::new(seed), Mutator::new(texts));
    let (begin, mut count, mut taken, mut slowest) = (Instant::now(), 0_u64, 0_u64, 0.0_f64);
    // On a machine that has much else to do, too, one is taken.
    while begin.elapsed() < time || (taken == 0 && count < ENOUGH) {
        let text = mutator.text(&mut random);
        fs::write(&kept, &text).unwrap();
        let one = Instant::now();
        let was_taken = catch_unwind(AssertUnwindSafe(|| takes(&text))).unwrap_or_else(|_| {
            panic!(
                "input {count} of seed {seed}, kept in {}:\n{text}",
                kept.display()
            )
        });
        slowest = slowest.max(one.elapsed().as_secs_f64());
        count += 1;
        if was_taken {
            taken += 1;
            mutator.learn(text, KEPT, &mut random);
        }
    }
    println!(
        "{what}: {count} inputs of seed {seed} in {:.0} s, {taken} of them taken, {} texts to begin with \
         at the end, the slowest {slowest:.2} s",
        begin.elapsed().as_secs_f64(),
        mutator.seeds(),
    );
    assert!(count > 0 && taken > 0, "{count} inputs, {taken} taken");
}

/// The repository's mechanisms and batches, and every job of a batch alone.
fn mechanisms_and_batches() -> Vec<String> {
    let files = seeds(Path::new(REPOSITORY), "ron").into_iter();
    let mut texts: Vec<String> = files.map(|(_, text)| text).collect();
    let alone: Vec<_> = texts.iter().flat_map(|text| jobs_alone(text)).collect();
    texts.extend(alone);
    texts
}

#[test]
fn files_are_answered() {
    let path = folder().text();
    change("files", mechanisms_and_batches(), |text| {
        fuzzing::answer(text, &path)
    });
}

#[test]
fn files_in_json_are_answered() {
    let path = folder().text().with_extension("json");
    let texts = mechanisms_and_batches().into_iter();
    let texts = texts.filter_map(|text| to_json(&text, &path).ok());
    change("json", texts.collect(), |text| fuzzing::answer(text, &path));
}

#[test]
fn what_is_taken_is_solved_or_refused() {
    let path = folder().text();
    let texts = mechanisms_and_batches().into_iter();
    let texts = texts.filter(|text| fuzzing::answer(text, &path));
    change("solved", texts.collect(), |text| {
        fuzzing::solve(text, &path)
    });
}

#[test]
fn tables_are_answered() {
    let folder = folder();
    let files = seeds(Path::new(REPOSITORY), "csv").into_iter();
    let texts = files.map(|(_, text)| text).filter(|text| text.len() < 4000);
    change("tables", texts.collect(), |text| {
        fuzzing::table(text.as_bytes(), &folder) > 0
    });
}

#[test]
fn expressions_are_answered() {
    change("expressions", fuzzing::expressions(), fuzzing::expression);
}

#[test]
fn quantities_are_answered() {
    change("quantities", fuzzing::quantities(), fuzzing::quantity);
}

fn answer(text: &str) {
    // What a batch names is found beside it.
    fuzzing::answer(text, Path::new("../../examples/mutated.ron"));
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
    fn anything_at_all(text in any::<String>()) {
        answer(&text);
        answer(&format!("(name: {text}"));
        fuzzing::expression(&text);
        fuzzing::quantity(&text);
        answer(&format!("{{\"name\": {text}"));
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
fn deeply_nested_expressions_are_answered() {
    for piece in [
        "(", "-", "2^", "sin(", "1+", "a.", "'", ",", "1-(", "A+", "\n", "min(1,",
    ] {
        for count in [10, 55, 100, 10_000, 1_000_000] {
            fuzzing::expression(&piece.repeat(count));
            fuzzing::expression(&format!("{}1", piece.repeat(count)));
            fuzzing::quantity(&format!("1 {}", piece.repeat(count)));
        }
    }
    let chain = |count: usize| {
        let one = |k: usize| format!("\"p{k}\": \"= p{} + 1\", ", k + 1);
        let all: String = (0..count).map(one).collect();
        answer(&format!(
            "(name: \"chain\", parameters: {{ {all} \"p{count}\": 1 }})"
        ));
    };
    [10, 99, 100, 101, 100_000].into_iter().for_each(chain);
}

#[test]
fn every_beginning_of_a_file_is_answered() {
    let text = include_str!("../../../../examples/portal.ron");
    let json = to_json(text, Path::new("portal.ron")).unwrap();
    for text in [text, &json] {
        for (end, _) in text.char_indices() {
            answer(&text[..end]);
        }
    }
}
