//! `hyperstat plot`: figures from the tables that `hyperstat run` writes, of mechanisms, and of what
//! `hyperstat solve --why` found.

mod mechanism;
mod solved;

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use hyperstat_figures::{ColorScale, Scale};
use hyperstat_mechanisms::{Registry, files as read};
use hyperstat_study::figure::{self, Choice, Drawing, Lines, Map};
use hyperstat_study::table::TableReader;
use serde::de::IgnoredAny;

use crate::args;
use crate::error::{CliError, MAP, SHAPE};
use crate::outputs;

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
    /// Everything else: a mechanism or batch file.
    Mechanism,
}

impl FileKind {
    fn of(path: &Path) -> Self {
        let extension = path.extension().and_then(|extension| extension.to_str());
        match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("csv" | "parquet") => Self::Table,
            Some("json") if !is_mechanism(path) => Self::Solved,
            _ => Self::Mechanism,
        }
    }
}

/// Whether a JSON file has the fields of a mechanism or a batch file, as what `solve` prints has not.
fn is_mechanism(path: &Path) -> bool {
    let bytes = read::read(path).unwrap_or_default();
    let fields: Option<HashMap<String, IgnoredAny>> = serde_json::from_slice(&bytes).ok();
    fields.is_some_and(|fields| {
        ["jobs", "points"]
            .iter()
            .any(|own| fields.contains_key(*own))
    })
}

/// Draws what the command line asks for. `tell` gets the files and the caption.
pub(crate) fn run(
    args: &args::Plot,
    registry: &Registry,
    tell: impl FnOnce(&str) -> Result<(), CliError>,
) -> Result<bool, CliError> {
    let Plotted { drawing, stem } = plotted(args, registry)?;
    let mut told = String::new();
    for path in write(&drawing, &stem)? {
        told += &format!("{}\n", path.display());
    }
    let caption = drawing.caption().map_err(|source| CliError::Figure {
        path: stem.clone(),
        source,
    })?;
    told += &format!("{caption}\n");
    tell(&told)?;
    Ok(true)
}

/// Writes a figure as `STEM.svg` and `STEM.png`; both are drawn before the first is written.
pub(crate) fn write(drawing: &Drawing, stem: &Path) -> Result<[PathBuf; 2], CliError> {
    let [as_svg, as_png] = files(stem);
    let cannot_draw = |path: &Path, source| CliError::Figure {
        path: path.into(),
        source,
    };
    let svg = drawing
        .svg()
        .map_err(|source| cannot_draw(&as_svg, source))?;
    let png = drawing
        .png()
        .map_err(|source| cannot_draw(&as_png, source))?;
    outputs::write(&as_svg, svg.as_bytes())?;
    outputs::write(&as_png, &png)?;
    Ok([as_svg, as_png])
}

/// The files `STEM.svg` and `STEM.png` of a figure.
pub(crate) fn files(stem: &Path) -> [PathBuf; 2] {
    ["svg", "png"].map(|extension| {
        let mut path = stem.as_os_str().to_owned();
        path.push(".");
        path.push(extension);
        PathBuf::from(path)
    })
}

/// The files of a figure without their extensions: as the command line says, or of the `name` beside
/// the input.
fn stem_of(args: &args::Plot, name: &str) -> PathBuf {
    match &args.out {
        Some(out) => without_extension(out),
        None => args.file.with_file_name(name),
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
            of_table(args)
        }
        (Some(_), FileKind::Mechanism) => mechanism::figure(args, registry),
        (Some("--budget"), FileKind::Solved) => {
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

/// The figure of a table.
fn of_table(args: &args::Plot) -> Result<Plotted, CliError> {
    let table = &TableReader::open(&args.file)?;
    let title = args.title.clone();
    let choice = Choice {
        design: args.design,
        pose: args.pose,
    };
    // One design, where no more are asked for.
    let first = figure::first_design(table)?;
    let one_design = Choice {
        design: choice.design.or(first).or(Some(0)),
        ..choice
    };
    let kind = match (&args.kind.map, &args.kind.lines) {
        (Some(value), _) => value.clone(),
        (None, Some(values)) => values.join("-"),
        (None, None) => "trajectory".into(),
    };
    let stem = stem_of(args, &format!("{}-{kind}", table.job()));
    let files = files(&stem);
    outputs::refuse(
        files.iter().map(|path| &**path),
        std::slice::from_ref(&args.file),
    )?;
    let drawing = if let Some(value) = &args.kind.map {
        let map = Map {
            value: value.clone(),
            planes: args.plane.clone(),
            axes: args.axes.clone(),
            asked: None,
            limits: args.limits,
            scale: colors(args.scale.as_ref())?,
            choice: one_design,
            title,
        };
        Drawing::Map(figure::map(table, &map)?)
    } else if let Some(values) = &args.kind.lines {
        let over = args.over.clone().unwrap_or_else(|| "pose".into());
        // Along what varies from design to design: one pose of each.
        let design = table.find("design");
        let varies = design.is_some_and(|design| table.find(&over) >= Some(design));
        let lines = Lines {
            values: values.clone(),
            choice: match varies {
                true => Choice {
                    pose: choice.pose.or(Some(0)),
                    ..choice
                },
                false => one_design,
            },
            over,
            title,
        };
        Drawing::Lines(figure::lines(table, &lines)?)
    } else {
        let scale = magnified(args.scale.as_ref())?;
        let mut drawn = figure::trajectory(table, one_design, scale, title)?;
        drawn.view = figure::viewpoint(args.view);
        Drawing::Trajectory(drawn)
    };
    Ok(Plotted { drawing, stem })
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

/// How the colours of a map go with its values, from the command line.
fn colors(scale: Option<&args::Scale>) -> Result<ColorScale, CliError> {
    match scale {
        None => Ok(ColorScale::Auto),
        Some(args::Scale::Linear) => Ok(ColorScale::Linear),
        Some(args::Scale::Log) => Ok(ColorScale::Log),
        Some(other) => Err(CliError::Scale {
            given: other.to_string(),
            of: MAP,
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

/// The files of a figure that the command line names.
pub(crate) fn files_of(out: &Path) -> [PathBuf; 2] {
    files(&without_extension(out))
}

/// `map` for `map`, `map.svg` and `map.png`.
pub(crate) fn without_extension(out: &Path) -> PathBuf {
    let extension = out.extension().and_then(|extension| extension.to_str());
    match extension {
        Some("svg" | "png") => out.with_extension(""),
        _ => out.into(),
    }
}
