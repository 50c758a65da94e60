//! The loader on any bytes: an answer, never a panic. The function is that of the stable test
//! `crates/mechanisms/tests/corpus.rs`.
#![no_main]

use std::path::Path;

#[path = "../../crates/mechanisms/tests/all/fuzzing/mod.rs"]
mod fuzzing;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    fuzzing::answer(&String::from_utf8_lossy(bytes), Path::new("fuzzed.ron"));
});
