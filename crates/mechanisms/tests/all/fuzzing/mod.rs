//! What the loader and the solvers owe to any text at all: the functions that `fuzz/` runs and the
//! tests share.
//!
//! A text stands in a [`Folder`] beside all files that the repository's mechanisms name.
//! [`answer`] reads it as a mechanism or batch, [`table`] as the tables that files name, [`expression`]
//! and [`quantity`] as what may stand in the place of a number; [`solve`] takes what was read on: poses, plans, solutions. Each says whether the text was taken.

// A fuzz target uses a part of this, and the tests use the rest.
#![allow(dead_code)]

mod folder;
mod mutator;
mod numbers;
mod random;
mod solve;
mod table;

use std::path::Path;

use hyperstat_mechanisms::{
    Disk, Input, LoadError, Registry, WriteError, format, load_str, mechanism_from_str, write,
};

pub use folder::{Folder, jobs_alone, seeds};
pub use mutator::Mutator;
pub use numbers::{expression, expressions, quantities, quantity};
pub use random::Random;
pub use solve::solve;
pub use table::{ROLES, table};

/// Reads a text that stands at `path`. The loader must answer with a mechanism or batch, or with an
/// error that points into the text or into a file that it names; a mechanism must be the same after
/// it is written and read again. A text that has been put in order stays as it is.
pub fn answer(text: &str, path: &Path) -> bool {
    let registry = Registry::builtin();
    if let Ok(even) = format(text, path) {
        let again = format(&even, path).unwrap_or_else(|error| panic!("{error}\n{even}"));
        assert_eq!(again, even, "of {text}");
    }
    match load_str(text, path, &Disk, &registry) {
        Ok(Input::Batch(_)) => true,
        Ok(Input::Mechanism(mechanism)) => {
            let written = match write(&mechanism.model, &registry) {
                Ok(written) => written,
                Err(WriteError::Flexible { .. }) => return true,
                Err(error) => panic!("it came from a file, but {error}"),
            };
            let again = mechanism_from_str(&written, path, &Disk, &registry)
                .unwrap_or_else(|error| panic!("{error}\n{written}"))
                .model;
            assert_eq!(again.nodes().len(), mechanism.model.nodes().len());
            assert_eq!(again.loads(), mechanism.model.loads());
            assert_eq!(again.output(), mechanism.model.output());
            true
        }
        Err(error) => {
            check_error(&error, text, path);
            false
        }
    }
}

/// An error about `text`, which stands at `path`, or about another file.
fn check_error(error: &LoadError, text: &str, path: &Path) {
    let at = error.location().expect("the text itself was read");
    assert!(at.line >= 1 && at.column >= 1 && at.width >= 1);
    assert!(!error.message().is_empty() && !at.text.contains('\n'));
    if at.path != path {
        return;
    }
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let line = text.split('\n').nth(at.line - 1);
    let line = line.expect("a line of the text");
    assert_eq!(at.text, line.trim_end_matches('\r'));
    assert!(at.column <= line.chars().count() + 1);
}
