//! What the targets begin with: a folder with all that files name, and a mutator that knows the
//! files' tokens, beside libFuzzer's own.

use std::path::Path;

use crate::fuzzing::{Folder, Mutator, Random, seeds};

const REPOSITORY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// A copy of the repository's mechanisms and tables.
pub fn folder() -> Folder {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/folder");
    Folder::new(Path::new(REPOSITORY), &path)
}

/// Of the repository's files of this extension.
pub fn mutator(extension: &str) -> Mutator {
    let files = seeds(Path::new(REPOSITORY), extension).into_iter();
    Mutator::new(files.map(|(_, text)| text).collect())
}

/// Changes what `data` begins with, `size` bytes; gives the new size.
pub fn change(mutator: &Mutator, data: &mut [u8], size: usize, most: usize, seed: u32) -> usize {
    if seed.is_multiple_of(3) {
        return libfuzzer_sys::fuzzer_mutate(data, size, most);
    }
    let text = String::from_utf8_lossy(&data[..size]);
    let text = mutator.changed(&text, &mut Random::new(u64::from(seed)));
    let new = text.as_bytes();
    let size = new.len().min(most);
    data[..size].copy_from_slice(&new[..size]);
    size
}
