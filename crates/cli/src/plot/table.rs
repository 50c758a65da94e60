//! Figures of tables: maps of one or of two, lines, trajectories.

use std::path::PathBuf;

use hyperstat_figures::{ColorScale, MapFigure};
use hyperstat_study::disk;
use hyperstat_study::figure::{self, Choice, Drawing, Form, Labels, Lines, Map, NamedTable};
use hyperstat_study::table::TableReader;

use super::{Plotted, forms, magnified, stem, stem_of};
use crate::args;
use crate::error::{CliError, MAP};

/// The figure that is asked for.
pub(super) fn figure(args: &args::Plot) -> Result<Plotted, CliError> {
    let table = &TableReader::open(&args.file)?;
    let title = args.title.clone();
    let labels = Labels(args.label.clone());
    let choice = Choice {
        design: args.design,
        pose: match &args.pose {
            None => None,
            Some(args::Pose::Number(number)) => Some(*number),
            Some(args::Pose::At(at)) => Some(figure::pose_of_table(table, at)?),
        },
    };
    // One design, where no more are asked for.
    let first = figure::first_design(table)?;
    let one_design = Choice {
        design: choice.design.or(first).or(Some(0)),
        ..choice
    };
    let stem = stem_of(args, &format!("{}-{}", table.job(), kind(args)));
    let read: Vec<PathBuf> = [&args.file]
        .into_iter()
        .chain(&args.beside)
        .cloned()
        .collect();
    let files = Form::files(&stem, &forms(args));
    disk::refuse(files.iter().map(|path| &**path), &read)?;
    let drawing = if let Some(value) = &args.kind.map {
        let map = Map {
            value: value.clone(),
            plane: args.plane.clone(),
            planes: args.planes.clone(),
            axes: args.axes.clone(),
            asked: None,
            limits: args.limits,
            scale: colors(args.scale.as_ref())?,
            choice: one_design,
            marks: args.mark.clone(),
            title,
            labels,
        };
        let two = args.beside.is_some() || args.with_design.is_some();
        Drawing::Map(match two {
            false => figure::map(table, &map)?,
            true => of_two(args, table, &map)?,
        })
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
            labels,
        };
        Drawing::Lines(figure::lines(table, &lines)?)
    } else {
        let scale = magnified(args.scale.as_ref())?;
        let mut drawn = figure::trajectory(table, one_design, scale, title)?;
        drawn.view = figure::viewpoint(args.view);
        drawn.axis_names = labels.axes()?;
        Drawing::Trajectory(drawn)
    };
    Ok(Plotted { drawing, stem })
}

/// What a figure is called beside its table, without the job's name.
fn kind(args: &args::Plot) -> String {
    match (&args.kind.map, &args.kind.lines) {
        (Some(value), _) if args.ratio => format!("{value}-ratio"),
        (Some(value), _) if args.beside.is_some() || args.with_design.is_some() => {
            format!("{value}-beside")
        }
        (Some(value), _) => value.clone(),
        (None, Some(values)) => values.join("-"),
        (None, None) => "trajectory".into(),
    }
}

/// The map of two tables, or of two designs of one, or of their ratio.
fn of_two(args: &args::Plot, table: &TableReader, map: &Map) -> Result<MapFigure, CliError> {
    let path = args.beside.as_ref().unwrap_or(&args.file);
    let other = &TableReader::open(path)?;
    // The first of these that tell them apart.
    let jobs = [table.job(), other.job()];
    let stems = [&args.file, path].map(|path| stem(path));
    let paths = [&args.file, path].map(|path| path.display().to_string());
    let designs = [map.choice.design, args.with_design]
        .map(|design| format!("design {}", design.unwrap_or(0)));
    let names = [jobs, stems, paths.clone(), designs].into_iter();
    let names = names.into_iter().find(|[a, b]| a != b).unwrap_or(paths);
    let named = |k: usize, table, design| NamedTable {
        name: &names[k],
        table,
        design,
    };
    // Where both are of one table, their designs tell them apart.
    let own = args.beside.is_none().then_some(map.choice.design).flatten();
    let tables = [named(0, table, own), named(1, other, args.with_design)];
    Ok(match args.ratio {
        true => figure::ratio(tables, map)?,
        false => figure::beside(tables, map)?,
    })
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
