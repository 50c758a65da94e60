//! Broken files, each with the message that its writer reads.
//!
//! Every `broken/NAME.ron`, and `NAME.json`, has its message in `broken/NAME.txt`. With `BLESS=1` in the
//! environment the messages are written instead of compared: read every change before keeping it.

use std::fmt::Write;
use std::path::Path;

use hyperstat_mechanisms::{Disk, LoadError, Registry, load};

/// The message with the line it is about and the place in it marked.
fn report(error: &LoadError) -> String {
    let mut text = format!("{error}\n");
    if let Some(at) = error.location() {
        let indent: String = " ".repeat(at.column - 1);
        let mark = "^".repeat(at.width);
        writeln!(text, "  | {}\n  | {indent}{mark}", at.text).unwrap();
    }
    if let Some(help) = error.help() {
        writeln!(text, "  = {help}").unwrap();
    }
    text
}

#[test]
fn every_broken_file_gets_its_message() {
    let bless = std::env::var_os("BLESS").is_some();
    let mut names: Vec<_> = Path::new("tests/broken")
        .read_dir()
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".ron") || name.ends_with(".json"))
        .collect();
    names.sort();
    assert!(names.len() > 100, "the corpus has gone");
    let mut wrong = String::new();
    for name in names {
        let file = Path::new("tests/broken").join(&name);
        let golden = file.with_extension("txt");
        let found = match load(&file, &Disk, &Registry::builtin()) {
            Ok(_) => "no mistake found\n".to_owned(),
            Err(error) => report(&error),
        };
        if bless {
            std::fs::write(golden, found).unwrap();
            continue;
        }
        let wanted = std::fs::read_to_string(golden).unwrap_or_default();
        if found != wanted {
            write!(wrong, "--- {name}, wanted:\n{wanted}--- found:\n{found}").unwrap();
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
