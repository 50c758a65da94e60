//! The loader on any bytes: an answer, never a panic.
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
    fuzzing::answer(&String::from_utf8_lossy(bytes), &FOLDER.text());
});

libfuzzer_sys::fuzz_mutator!(|data: &mut [u8], size: usize, most: usize, seed: u32| {
    beginning::change(&MUTATOR, data, size, most, seed)
});
