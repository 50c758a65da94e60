//! The fuzz target's function over its seeds, on stable Rust: all files of this workspace that
//! hold, or nearly hold, a mechanism or a batch. `fuzz/seed.sh` gives the same files to the fuzzer.

use crate::fuzzing;

use std::path::Path;

/// Folders of the seeds, from this crate's.
const SEEDS: [&str; 3] = ["../../tests/reference", "../../examples", "tests/broken"];

#[test]
fn every_seed_is_answered() {
    let mut count = 0;
    for folder in SEEDS {
        for entry in Path::new(folder).read_dir().unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "ron") {
                let bytes = std::fs::read(&path).unwrap();
                fuzzing::answer(&String::from_utf8_lossy(&bytes), &path);
                count += 1;
            }
        }
    }
    assert!(count > 120, "only {count} seeds");
}
