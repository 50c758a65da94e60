//! `hyperstat plot`: figures from the tables that `hyperstat run` writes, of mechanisms, and of what
//! `hyperstat solve --why` found.

mod mechanism;
mod solved;
mod table;

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use hyperstat_figures::Scale;
use hyperstat_mechanisms::{Registry, files as read};
use hyperstat_study::disk::{OutputError, write_figure};
use hyperstat_study::figure::{Drawing, Form};
use serde::de::IgnoredAny;

use crate::args;
use crate::error::{CliError, SHAPE};

/// A figure, and its files without their extensions.
struct Plotted {
    drawing: Drawing,
    stem: PathBuf,
}

/// What a file is, by its name, and of JSON by its fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FileKind {
    Table,
    /// What `solve` printed.
    Solved,
    /// JSON with a mistake in its grammar: whoever reads it says where.
    Broken,
    /// Everything else: a mechanism or batch file.
    Mechanism,
}

impl FileKind {
    fn of(path: &Path) -> Self {
        let extension = path.extension().and_then(|extension| extension.to_str());
        match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("csv" | "parquet") => Self::Table,
            Some("json") => Self::of_json(path),
            _ => Self::Mechanism,
        }
    }

    /// What `solve` prints has not the fields of a mechanism or a batch file.
    fn of_json(path: &Path) -> Self {
        let bytes = read::read(path).unwrap_or_default();
        let fields: Result<HashMap<String, IgnoredAny>, _> = serde_json::from_slice(&bytes);
        match fields {
            Ok(fields) if fields.contains_key("jobs") || fields.contains_key("points") => {
                Self::Mechanism
            }
            Err(error) if error.is_syntax() || error.is_eof() => Self::Broken,
            _ => Self::Solved,
        }
    }
}

/// Draws what the command line asks for. `tell` gets the files and the caption.
pub(crate) fn run(
    args: &args::Plot,
    registry: &Registry,
    tell: impl FnOnce(&str) -> Result<(), CliError>,
) -> Result<bool, CliError> {
    let gif = |out: &PathBuf| out.extension().is_some_and(|own| own == "gif");
    if let Some(path) = args.out.as_ref().filter(|out| gif(out) && !args.animate) {
        return Err(CliError::Still { path: path.clone() });
    }
    let Plotted { drawing, stem } = plotted(args, registry)?;
    let mut told = String::new();
    for path in write_figure(&drawing, &stem, &forms(args))? {
        told += &format!("{}\n", path.display());
    }
    let caption = drawing.caption().map_err(|source| OutputError::Figure {
        path: stem.clone(),
        source,
    })?;
    told += &format!("{caption}\n");
    tell(&told)?;
    Ok(true)
}

/// The forms that the command line asks for.
fn forms(args: &args::Plot) -> Vec<Form> {
    let mut forms = args
        .out
        .as_deref()
        .map_or_else(|| Form::all(false), forms_of);
    if args.pdf && !forms.contains(&Form::Pdf) {
        forms.push(Form::Pdf);
    }
    if args.animate {
        forms.push(Form::Gif);
    }
    forms
}

/// The files of a figure without their extensions: as the command line says, or of the `name` beside
/// the input.
fn stem_of(args: &args::Plot, name: &str) -> PathBuf {
    match &args.out {
        Some(out) => named(out, name),
        None => args.file.with_file_name(name),
    }
}

/// The files that `--out` names, without their extensions; of a folder, a file of this name in it.
pub(crate) fn named(out: &Path, name: &str) -> PathBuf {
    let is_folder = out.file_name().is_none() || out.to_string_lossy().ends_with('/');
    match is_folder || out.is_dir() {
        true => out.join(name),
        false => without_extension(out),
    }
}

/// The figure that is asked for.
fn plotted(args: &args::Plot, registry: &Registry) -> Result<Plotted, CliError> {
    let kind = FileKind::of(&args.file);
    let of_mechanism = match &args.kind {
        kind if kind.deformed => Some("--deformed"),
        kind if kind.mode.is_some() => Some("--mode"),
        kind if kind.budget => Some("--budget"),
        _ => None,
    };
    match (of_mechanism, kind) {
        (None, _) => {
            refuse(args, "a table", [("--job", args.job.is_some())])?;
            table::figure(args)
        }
        (Some(option), FileKind::Broken) if option != "--budget" => {
            mechanism::figure(args, registry)
        }
        (Some(_), FileKind::Mechanism) => mechanism::figure(args, registry),
        (Some("--budget"), FileKind::Solved | FileKind::Broken) => {
            let chosen = [
                ("--job", args.job.is_some()),
                ("--design", args.design.is_some()),
                ("--pose", args.pose.is_some()),
            ];
            refuse(args, "solved already", chosen)?;
            solved::figure(args)
        }
        (Some(option), _) => Err(CliError::NoMechanism {
            path: args.file.clone(),
            option,
        }),
    }
}

/// The error of an option that has nothing to choose from.
fn refuse<const N: usize>(
    args: &args::Plot,
    what: &'static str,
    options: [(&'static str, bool); N],
) -> Result<(), CliError> {
    let given = options.into_iter().find(|(_, given)| *given);
    given.map_or(Ok(()), |(option, _)| {
        Err(CliError::NoChoice {
            path: args.file.clone(),
            option,
            what,
        })
    })
}

/// A magnification from the command line.
fn magnified(scale: Option<&args::Scale>) -> Result<Scale, CliError> {
    match scale {
        None => Ok(Scale::Auto),
        Some(args::Scale::Factor(factor)) => Ok(Scale::Factor(*factor)),
        Some(other) => Err(CliError::Scale {
            given: other.to_string(),
            of: SHAPE,
        }),
    }
}

/// Name of a file without folder and extension.
fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
}

/// Whether a file is a table, by its name.
pub(crate) fn is_table(path: &Path) -> bool {
    FileKind::of(path) == FileKind::Table
}

/// The forms of a figure that the command line names: a PDF too where that is the name's ending.
pub(crate) fn forms_of(out: &Path) -> Vec<Form> {
    Form::all(out.extension().is_some_and(|own| own == "pdf"))
}

/// `map` for `map`, `map.svg` and `map.png`.
fn without_extension(out: &Path) -> PathBuf {
    let extension = out.extension().and_then(|extension| extension.to_str());
    match extension {
        Some("svg" | "png" | "pdf" | "gif") => out.with_extension(""),
        _ => out.into(),
    }
}
