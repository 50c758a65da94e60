//! The fuzz targets' functions over their seeds, on stable Rust: all files of this workspace that
//! hold, or nearly hold, a mechanism, a batch or a table. `fuzz/seed.sh` gives the same files to the
//! fuzzer.

use std::path::Path;

use hyperstat_mechanisms::{Disk, LoadError, Registry, load_str};

use crate::fuzzing::{self, Folder, ROLES, seeds};

/// The repository, from this crate's folder.
const REPOSITORY: &str = "../..";

fn folder(name: &str) -> Folder {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("corpus")
        .join(name);
    Folder::new(Path::new(REPOSITORY), &path)
}

#[test]
fn every_seed_is_answered() {
    let seeds = seeds(Path::new(REPOSITORY), "ron");
    assert!(seeds.len() > 300, "only {} seeds", seeds.len());
    for (path, text) in &seeds {
        fuzzing::answer(text, path);
    }
}

#[test]
fn every_seed_is_solved_or_refused() {
    let folder = folder("solved");
    let taken = seeds(Path::new(REPOSITORY), "ron").into_iter();
    let taken = taken.filter(|(_, text)| fuzzing::solve(text, &folder.text()));
    assert!(taken.count() > 30);
}

/// What a text names is found in the folder: a mistake in a file that it names is found too.
#[test]
fn in_the_folder_every_seed_is_what_it_is_at_its_place() {
    let folder = folder("places");
    let found = |text: &str, path: &Path| {
        let loaded = load_str(text, path, &Disk, &Registry::builtin());
        // A message may name the text itself, or a file beside it.
        let folder = path.parent().unwrap().display().to_string();
        let message = |error: &LoadError| {
            let message = error.message();
            let message = message.replace(&path.display().to_string(), "the text");
            message.replace(&folder, "the folder")
        };
        loaded.err().map(|error| (message(&error), line_of(&error)))
    };
    for (path, text) in seeds(Path::new(REPOSITORY), "ron") {
        let (there, here) = (found(&text, &path), found(&text, &folder.text()));
        if let (Some(there), Some(here)) = (&there, &here)
            && there.0.starts_with("cannot read")
        {
            // Where it was not found is told; that it was not is the same.
            assert!(
                here.0.starts_with("cannot read"),
                "{}: {here:?}",
                path.display()
            );
            continue;
        }
        assert_eq!(here, there, "{}", path.display());
    }
}

fn line_of(error: &LoadError) -> Option<(usize, String)> {
    error.location().map(|at| (at.line, at.text.clone()))
}

/// Every way to name a table is reached, and takes one of the tables.
#[test]
fn every_table_is_answered_in_every_role() {
    let folder = folder("tables");
    for (path, text) in seeds(Path::new(REPOSITORY), "csv") {
        fuzzing::table(text.as_bytes(), &folder);
        assert!(path.is_file());
    }
    let taken = |text: &str| fuzzing::table(text.as_bytes(), &folder);
    assert_eq!(taken("x,y,z\n0,0,0.5\n"), 3);
    assert_eq!(taken("x,y,z,rx,ry,rz\n0,0,0.5,0,0,0\n"), 3);
    assert_eq!(taken("A1.v,A2.v\n0.1,-0.1\n"), 1);
    assert_eq!(taken(&folder.read("flexible_link.csv")), 1);
    assert_eq!(ROLES.len(), 5);
    assert_eq!(fuzzing::table(b"x,y,z\n0,0,\xff\n", &folder), 0);
}
