//! `hyperstat plot`: figures from the tables that `hyperstat run` writes, of mechanisms, and of what
//! `hyperstat solve --why` found.

mod coordinates;
mod error;
mod lines;
mod map;
mod mechanism;
mod plane;
mod quantity;
mod rows;
mod solved;
mod table;

use std::path::{Path, PathBuf};

use hyperstat_figures::{ColorScale, Scale, TrajectoryFigure};
use hyperstat_mechanisms::Registry;

use crate::args;
use crate::drawing::{self, Drawing};
use crate::error::CliError;
use crate::outputs;
pub(crate) use error::PlotError;
use lines::Lines;
pub(crate) use map::{Map, figure as map};
pub(crate) use quantity::{Drawn, instead_of, is_frequency};
pub(crate) use rows::Choice;
pub(crate) use table::Table;

/// A figure, and its files without their extensions.
struct Plotted {
    drawing: Drawing,
    stem: PathBuf,
}

/// What a file is, by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Table,
    Json,
    /// Everything else: a mechanism or batch file.
    Ron,
}

impl Kind {
    fn of(path: &Path) -> Self {
        let extension = path.extension().and_then(|extension| extension.to_str());
        match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("csv" | "parquet") => Self::Table,
            Some("json") => Self::Json,
            _ => Self::Ron,
        }
    }
}

/// Draws what the command line asks for. `tell` gets the files and the caption.
pub(crate) fn run(
    args: &args::Plot,
    registry: &Registry,
    tell: impl FnOnce(&str) -> Result<(), CliError>,
) -> Result<bool, CliError> {
    let Plotted { drawing, stem } = plotted(args, registry)?;
    let mut told = String::new();
    for path in drawing.write(&stem)? {
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
    let kind = Kind::of(&args.file);
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
        (Some(_), Kind::Ron) => mechanism::figure(args, registry),
        (Some("--budget"), Kind::Json) => {
            let chosen = [
                ("--job", args.job.is_some()),
                ("--design", args.design.is_some()),
                ("--pose", args.pose.is_some()),
            ];
            refuse(args, "solved already", chosen)?;
            solved::figure(args)
        }
        (Some(option), _) => Err(CliError::Plot(PlotError::NoMechanism {
            path: args.file.clone(),
            option,
        })),
    }
}

/// The error of an option that has nothing to choose from.
fn refuse<const N: usize>(
    args: &args::Plot,
    what: &'static str,
    options: [(&'static str, bool); N],
) -> Result<(), PlotError> {
    let given = options.into_iter().find(|(_, given)| *given);
    given.map_or(Ok(()), |(option, _)| {
        Err(PlotError::NoChoice {
            path: args.file.clone(),
            option,
            what,
        })
    })
}

/// The figure of a table.
fn of_table(args: &args::Plot) -> Result<Plotted, CliError> {
    let table = &Table::open(&args.file)?;
    let title = args.title.clone();
    let choice = Choice {
        design: args.design,
        pose: args.pose,
    };
    // One design, where no more are asked for.
    let first = rows::first_design(table)?;
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
    let files = drawing::files(&stem);
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
        Drawing::Map(map::figure(table, &map)?)
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
        Drawing::Lines(lines::figure(table, &lines)?)
    } else {
        Drawing::Trajectory(trajectory(
            table,
            one_design,
            magnified(args.scale.as_ref())?,
            title,
        )?)
    };
    Ok(Plotted { drawing, stem })
}

/// The poses with a result as a trajectory, commanded and deflected.
fn trajectory(
    table: &Table,
    choice: Choice,
    scale: Scale,
    title: Option<String>,
) -> Result<TrajectoryFigure, PlotError> {
    let names = ["x", "y", "z", "dx", "dy", "dz"];
    let columns: Vec<_> = names.iter().filter_map(|name| table.find(name)).collect();
    let columns = table.read(&columns)?;
    let mut figure = TrajectoryFigure {
        title: title.unwrap_or_else(|| {
            let design = choice.design.filter(|_| table.varies());
            drawing::title(&table.job(), design, None, None)
        }),
        commanded: Vec::new(),
        displacement: Vec::new(),
        second: None,
        scale,
    };
    for row in choice.rows(table)? {
        let numbers: Option<Vec<f64>> = columns.iter().map(|column| column[row]).collect();
        if let Some([x, y, z, dx, dy, dz]) = numbers.as_deref() {
            figure.commanded.push([*x, *y, *z]);
            figure.displacement.push([*dx, *dy, *dz]);
        }
    }
    match figure.commanded.is_empty() {
        true => Err(PlotError::Nothing {
            path: table.path().into(),
        }),
        false => Ok(figure),
    }
}

/// A magnification from the command line.
fn magnified(scale: Option<&args::Scale>) -> Result<Scale, PlotError> {
    match scale {
        None => Ok(Scale::Auto),
        Some(args::Scale::Factor(factor)) => Ok(Scale::Factor(*factor)),
        Some(other) => Err(PlotError::Scale {
            given: other.to_string(),
            of: error::SHAPE,
        }),
    }
}

/// How the colours of a map go with its values, from the command line.
fn colors(scale: Option<&args::Scale>) -> Result<ColorScale, PlotError> {
    match scale {
        None => Ok(ColorScale::Auto),
        Some(args::Scale::Linear) => Ok(ColorScale::Linear),
        Some(args::Scale::Log) => Ok(ColorScale::Log),
        Some(other) => Err(PlotError::Scale {
            given: other.to_string(),
            of: error::MAP,
        }),
    }
}

/// Name of a file without folder and extension.
fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
}

/// `map` for `map`, `map.svg` and `map.png`.
fn without_extension(out: &Path) -> PathBuf {
    let extension = out.extension().and_then(|extension| extension.to_str());
    match extension {
        Some("svg" | "png") => out.with_extension(""),
        _ => out.into(),
    }
}
