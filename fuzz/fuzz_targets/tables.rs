//! Any bytes as the tables that files name: poses of prebuilt mechanisms and of files, values of
//! drives, stiffnesses of flexible bodies. What is taken is posed and solved.
#![no_main]

use std::sync::LazyLock;

#[path = "../beginning.rs"]
mod beginning;
#[path = "../../crates/mechanisms/tests/all/fuzzing/mod.rs"]
mod fuzzing;

use fuzzing::{Folder, Mutator};

static FOLDER: LazyLock<Folder> = LazyLock::new(beginning::folder);
static MUTATOR: LazyLock<Mutator> = LazyLock::new(|| beginning::mutator("csv"));

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    fuzzing::table(bytes, &FOLDER);
});

libfuzzer_sys::fuzz_mutator!(|data: &mut [u8], size: usize, most: usize, seed: u32| {
    beginning::change(&MUTATOR, data, size, most, seed)
});
