//! What the loader owes to any bytes at all: the function that `fuzz/` runs and the tests share.

use std::path::Path;

use hyperstat_mechanisms::{
    Input, LoadError, Registry, WriteError, load_str, mechanism_from_str, write,
};

/// Reads a text, which messages call `path`. The loader must answer with a mechanism or batch,
/// or with an error that points into the text or into a file that it names; a mechanism must be
/// the same after it is written and read again.
pub fn answer(text: &str, path: &Path) {
    let registry = Registry::builtin();
    match load_str(text, path, &registry) {
        Ok(Input::Batch(_)) => {}
        Ok(Input::Mechanism(mechanism)) => {
            let written = match write(&mechanism.model, &registry) {
                Ok(written) => written,
                Err(WriteError::Flexible { .. }) => return,
                Err(error) => panic!("it came from a file, but {error}"),
            };
            let again = mechanism_from_str(&written, path, &registry)
                .unwrap_or_else(|error| panic!("{error}\n{written}"))
                .model;
            assert_eq!(again.nodes().len(), mechanism.model.nodes().len());
            assert_eq!(again.loads(), mechanism.model.loads());
            assert_eq!(again.output(), mechanism.model.output());
        }
        Err(error) => check_error(&error, text, path),
    }
}

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
