//! What the loader takes is posed, planned and solved: finite numbers or an error, never a panic.
//! Small models only.
#![no_main]

use std::sync::LazyLock;

#[path = "../beginning.rs"]
mod beginning;
#[path = "../../crates/mechanisms/tests/all/fuzzing/mod.rs"]
mod fuzzing;

use fuzzing::{Folder, Mutator};

static FOLDER: LazyLock<Folder> = LazyLock::new(beginning::folder);
static MUTATOR: LazyLock<Mutator> = LazyLock::new(|| beginning::mutator("ron"));

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    fuzzing::solve(&String::from_utf8_lossy(bytes), &FOLDER.text());
});

libfuzzer_sys::fuzz_mutator!(|data: &mut [u8], size: usize, most: usize, seed: u32| {
    beginning::change(&MUTATOR, data, size, most, seed)
});
