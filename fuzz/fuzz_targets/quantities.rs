//! Any bytes as a number with its unit: a finite number, or an error at its place.
#![no_main]

#[path = "../../crates/mechanisms/tests/all/fuzzing/mod.rs"]
mod fuzzing;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    fuzzing::quantity(&String::from_utf8_lossy(bytes));
});
