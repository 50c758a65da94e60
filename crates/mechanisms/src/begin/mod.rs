//! Files to begin with.

use std::path::Path;

use crate::error::LoadError;
use crate::file::registry::{Known, Registry};
use crate::layout::laid_out;
use crate::schema::unit;
use crate::terms::Field;
use crate::text::as_json::as_json;
use crate::text::files::MemoryFiles;
use crate::text::fragment::Fragment;
use crate::text::names::nearest;
use crate::text::source::Source;

/// What a file to begin with holds.
const MECHANISM: &str = "mechanism";

/// A mechanism of two bodies.
const SMALLEST: &str = include_str!("mechanism.ron");

/// A job of each prebuilt mechanism, with poses that it reaches.
const PREBUILTS: &str = include_str!("prebuilts.ron");

/// Names of the files that [`begin`] makes: `mechanism`, and the prebuilt mechanisms as they are typed.
pub fn beginnings() -> Vec<String> {
    let kinds = jobs().into_iter().map(|(kind, _)| dashed(kind));
    std::iter::once(MECHANISM.into()).chain(kinds).collect()
}

/// A commented file to begin with, RON: a small mechanism, or a batch of one job of a prebuilt one with
/// poses that it reaches. `kind` is one of [`beginnings`], in any case and with or without dashes and
/// underscores.
///
/// # Errors
/// The name that was probably meant, if there is one.
pub fn begin(kind: &str) -> Result<String, Option<String>> {
    if plain(kind) == MECHANISM {
        return Ok(laid_out(SMALLEST, false));
    }
    let jobs = jobs();
    match jobs.iter().find(|(name, _)| plain(name) == plain(kind)) {
        Some((name, job)) => Ok(laid_out(&batch(name, job), false)),
        None => {
            let known = beginnings();
            let known: Vec<&str> = known.iter().map(String::as_str).collect();
            Err(nearest(&kind.replace('_', "-"), &known).map(Into::into))
        }
    }
}

/// A file in RON, which messages call `path`, in JSON: the same names and numbers, without comments.
///
/// # Errors
/// The first mistake in the grammar of the file.
pub fn to_json(text: &str, path: &Path) -> Result<String, LoadError> {
    let source = Source::new(path, text, &MemoryFiles::new());
    Fragment::of_file(&source)?;
    Ok(laid_out(&as_json(&source), true))
}

/// Kinds of prebuilt mechanisms with the text of their jobs.
fn jobs() -> Vec<(&'static str, &'static str)> {
    let jobs = PREBUILTS.split("\n//! ").skip(1);
    jobs.filter_map(|job| job.split_once('\n')).collect()
}

/// `three-rps` of `ThreeRps`.
fn dashed(kind: &str) -> String {
    let mut dashed = String::new();
    for (k, c) in kind.chars().enumerate() {
        if c.is_uppercase() && k > 0 {
            dashed.push('-');
        }
        dashed.extend(c.to_lowercase());
    }
    dashed
}

/// A name without what does not matter.
fn plain(name: &str) -> String {
    let name = name.chars().filter(|c| !"-_".contains(*c));
    name.flat_map(char::to_lowercase).collect()
}

/// A batch of one job, every parameter with what the table says of it.
fn batch(kind: &str, job: &str) -> String {
    let registry = Registry::builtin();
    let mut known = registry.known_prebuilts();
    let fields = match known.find(|(name, _)| *name == kind) {
        Some((_, Known::Fields(fields))) => fields,
        _ => &[],
    };
    let mut text = format!(
        "// A job of `{kind}`. SI units: m, N, rad, kg, s.\n\
         //\n\
         //     hyperstat check FILE\n\
         //     hyperstat run FILE --out results\n\
         (\njobs: [\n(\n"
    );
    for line in job.lines() {
        let about = about(line, fields).unwrap_or_default();
        let short = !line.contains('(');
        text += &match (about.is_empty(), short) {
            (true, _) => format!("{line}\n"),
            (false, true) => format!("{line} // {about}\n"),
            (false, false) => format!("// {about}\n{line}\n"),
        };
    }
    text + "),\n],\n)\n"
}

/// What the table says of the parameter that a line begins.
fn about(line: &str, fields: &[Field]) -> Option<String> {
    let (name, _) = line.split_once(':')?;
    let field = fields.iter().find(|field| field.name == name.trim())?;
    Some(match unit(field.of) {
        Some(unit) => format!("{} [{unit}]", field.about),
        None => field.about.into(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Disk, Input, load_str};

    #[test]
    fn every_prebuilt_mechanism_has_a_beginning_that_loads() {
        let registry = Registry::builtin();
        let mut known: Vec<String> = registry.prebuilts().map(dashed).collect();
        known.push(MECHANISM.into());
        known.sort();
        let mut found = beginnings();
        found.sort();
        assert_eq!(found, known);
        for name in found {
            let text = begin(&name).unwrap();
            let path = Path::new("begun.ron");
            let loaded = load_str(&text, path, &Disk, &registry);
            match loaded.unwrap_or_else(|error| panic!("{error}\n{text}")) {
                Input::Mechanism(_) => assert_eq!(name, MECHANISM),
                Input::Batch(batch) => {
                    let job = &batch.jobs[0];
                    let mut geometry = job.model().unwrap().geometry().clone();
                    for pose in 0..job.len() {
                        job.place(pose, &mut geometry).unwrap();
                    }
                }
            }
            let json = to_json(&text, path).unwrap();
            let loaded = load_str(&json, Path::new("begun.json"), &Disk, &registry);
            assert!(loaded.is_ok(), "{json}");
            assert!(
                text.lines().all(|line| line.chars().count() <= 100),
                "{text}"
            );
        }
    }

    #[test]
    fn names_are_told_by_their_letters() {
        for name in ["three-rps", "ThreeRps", "THREE_RPS", "threerps"] {
            assert!(begin(name).unwrap().contains("ThreeRps("), "{name}");
        }
        assert!(begin("Mechanism").is_ok());
        assert_eq!(begin("dleta"), Err(Some("delta".into())));
        assert_eq!(begin("x"), Err(None));
    }
}
