//! Tells states of a clone apart that have one version: what a run left of one is not gone on with by another.

use std::fs;
use std::path::{Path, PathBuf};

/// Crates whose sources say what bytes a run leaves.
const CRATES: [&str; 9] = [
    "assembly",
    "closure",
    "elements",
    "figures",
    "joints",
    "mechanisms",
    "model",
    "reference",
    "study",
];

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let crates = Path::new("..");
    let mut hash = Fnv::new();
    let mut whole = true;
    for name in CRATES {
        let folder = crates.join(name).join("src");
        // A package by itself is told by its version.
        whole &= folder.is_dir();
        if !whole {
            break;
        }
        println!("cargo:rerun-if-changed={}", folder.display());
        let mut files = Vec::new();
        sources(&folder, &mut files);
        files.sort();
        for file in files {
            hash.add(file.to_string_lossy().replace('\\', "/").as_bytes());
            hash.add(&fs::read(&file).unwrap_or_default());
        }
    }
    let state = match whole {
        true => format!("+{:016x}", hash.0),
        false => String::new(),
    };
    println!("cargo:rustc-env=HYPERSTAT_STATE={state}");
}

/// The Rust sources below a folder.
fn sources(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            sources(&path, files);
        } else if path.extension().is_some_and(|own| own == "rs") {
            files.push(path);
        }
    }
}

/// Fowler, Noll and Vo's hash of 64 bits, the same on every machine; line ends of any kind are one.
struct Fnv(u64);

impl Fnv {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn add(&mut self, bytes: &[u8]) {
        for byte in bytes.iter().filter(|byte| **byte != b'\r').chain(&[0]) {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}
