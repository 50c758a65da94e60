//! `hyperstat plot`: figures from the tables that `hyperstat run` writes.

mod error;
mod lines;
mod map;
mod plane;
mod quantity;
mod rows;
mod table;

use std::path::{Path, PathBuf};

use hyperstat_figures::{FigureError, LineFigure, MapFigure, Scale, TrajectoryFigure};

use crate::args;
use crate::atomic::AtomicFile;
use crate::error::CliError;
pub(crate) use error::PlotError;
use lines::Lines;
pub(crate) use map::{Map, figure as map};
pub(crate) use quantity::{Drawn, known as quantities};
pub(crate) use rows::Choice;
pub(crate) use table::Table;

/// A figure of any kind.
enum Figure {
    Map(MapFigure),
    Lines(LineFigure),
    Trajectory(TrajectoryFigure),
}

impl Figure {
    /// The figure as an SVG document.
    fn svg(&self) -> Result<String, FigureError> {
        match self {
            Self::Map(figure) => figure.svg(),
            Self::Lines(figure) => figure.svg(),
            Self::Trajectory(figure) => figure.svg(),
        }
    }

    /// The figure as a PNG file.
    fn png(&self) -> Result<Vec<u8>, FigureError> {
        match self {
            Self::Map(figure) => figure.png(),
            Self::Lines(figure) => figure.png(),
            Self::Trajectory(figure) => figure.png(),
        }
    }

    /// What a caption says of it.
    fn caption(&self) -> String {
        match self {
            Self::Map(figure) => format!("{} {}", figure.subtitle, figure.caption()),
            Self::Lines(figure) => format!("{} {}", figure.subtitle, figure.caption()),
            Self::Trajectory(_) => "Commanded and deflected trajectory.".into(),
        }
    }
}

/// Draws what the command line asks for. `tell` gets the files and the caption.
pub(crate) fn run(
    args: &args::Plot,
    tell: impl FnOnce(&str) -> Result<(), CliError>,
) -> Result<bool, CliError> {
    let table = Table::open(&args.table)?;
    let (figure, kind) = figure(args, &table)?;
    let stem = match &args.out {
        Some(out) => without_extension(out),
        None => args.table.with_file_name(format!("{}-{kind}", table.job())),
    };
    let mut told = String::new();
    for path in write(&stem, figure.svg(), figure.png())? {
        told += &format!("{}\n", path.display());
    }
    told += &format!("{}\n", figure.caption());
    tell(&told)?;
    Ok(true)
}

/// The figure that is asked for, and what it is called.
fn figure(args: &args::Plot, table: &Table) -> Result<(Figure, String), CliError> {
    let title = args.title.clone();
    let choice = Choice {
        design: args.design,
        pose: args.pose,
    };
    // One design, where no more are asked for.
    let one_design = Choice {
        design: choice.design.or(Some(0)),
        ..choice
    };
    if let Some(value) = &args.kind.map {
        let map = Map {
            value: value.clone(),
            planes: args.plane.clone(),
            axes: args.axes.clone(),
            choice: one_design,
            title,
        };
        return Ok((Figure::Map(map::figure(table, &map)?), value.clone()));
    }
    if let Some(values) = &args.kind.lines {
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
        let figure = lines::figure(table, &lines)?;
        return Ok((Figure::Lines(figure), values.join("-")));
    }
    let figure = trajectory(table, one_design, args.scale, title)?;
    Ok((Figure::Trajectory(figure), "trajectory".into()))
}

/// The poses with a result as a trajectory, commanded and deflected.
fn trajectory(
    table: &Table,
    choice: Choice,
    scale: Option<f64>,
    title: Option<String>,
) -> Result<TrajectoryFigure, PlotError> {
    let names = ["x", "y", "z", "dx", "dy", "dz"];
    let columns: Vec<_> = names.iter().filter_map(|name| table.find(name)).collect();
    let columns = table.read(&columns)?;
    let mut figure = TrajectoryFigure {
        title: title.unwrap_or_else(|| table.job()),
        commanded: Vec::new(),
        displacement: Vec::new(),
        second: None,
        scale: scale.map_or(Scale::Auto, Scale::Factor),
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

/// Writes a figure as `STEM.svg` and `STEM.png`; both are drawn before the first is written.
pub(crate) fn write(
    stem: &Path,
    svg: Result<String, FigureError>,
    png: Result<Vec<u8>, FigureError>,
) -> Result<[PathBuf; 2], CliError> {
    let [as_svg, as_png] = ["svg", "png"].map(|extension| {
        let mut path = stem.as_os_str().to_owned();
        path.push(".");
        path.push(extension);
        PathBuf::from(path)
    });
    let cannot_draw = |path: &Path, source| CliError::Figure {
        path: path.into(),
        source,
    };
    let svg = svg.map_err(|source| cannot_draw(&as_svg, source))?;
    let png = png.map_err(|source| cannot_draw(&as_png, source))?;
    for (path, content) in [(&as_svg, svg.as_bytes()), (&as_png, &png)] {
        AtomicFile::write(path, content).map_err(|source| CliError::Write {
            path: path.clone(),
            source,
        })?;
    }
    Ok([as_svg, as_png])
}

/// `map` for `map`, `map.svg` and `map.png`.
fn without_extension(out: &Path) -> PathBuf {
    let extension = out.extension().and_then(|extension| extension.to_str());
    match extension {
        Some("svg" | "png") => out.with_extension(""),
        _ => out.into(),
    }
}
