//! From solutions to the drawings of `hyperstat-figures`.

mod deformed;
mod trajectory;

use std::path::Path;

use hyperstat_figures::{DeformedFigure, FigureError, MapFigure, TrajectoryFigure};
use hyperstat_mechanisms::{Figure, Job, Scale};
use nalgebra::Vector6;

use super::summary::Summary;
use crate::error::CliError;
use crate::plot::{self, Choice, Drawn, Map, PlotError, Table, quantities};
pub(crate) use trajectory::Trajectory;

/// Name of the second method in the figures.
const SECOND: &str = "reference solver";

/// That the job's maps are of quantities that its table, with these columns, will hold.
pub(crate) fn check(job: &Job, columns: &[String]) -> Result<(), CliError> {
    let unknown = job.figures.iter().find_map(|figure| match figure {
        Figure::Map { value, .. } if Drawn::named(value, columns).is_none() => Some(value),
        _ => None,
    });
    match unknown {
        Some(value) => Err(CliError::UnknownQuantity {
            location: Box::new(job.location()),
            job: job.name.clone(),
            value: value.clone(),
            help: quantities(columns),
        }),
        None => Ok(()),
    }
}

/// Draws the figures of a job and writes them beside its table.
pub(crate) fn draw(
    job: &Job,
    trajectory: Option<&Trajectory>,
    table: &Path,
    summary: &mut Summary,
) -> Result<(), CliError> {
    for (place, figure) in job.figures.iter().enumerate() {
        let name = file_name(job, place);
        let drawing = match figure {
            Figure::Trajectory { scale } => trajectory
                .filter(|trajectory| !trajectory.is_empty())
                .map(|trajectory| Drawing::Trajectory(trajectory.figure(job, *scale)))
                .ok_or_else(|| NO_RESULT.to_string()),
            Figure::Deformed { pose, scale } => deformed::figure(job, *pose, *scale)
                .map(Drawing::Deformed)
                .ok_or_else(|| NO_RESULT.to_string()),
            Figure::Map { value, plane } => map(table, value, *plane).map_err(|error| {
                let help = error
                    .help()
                    .map_or_else(String::new, |help| format!("; {help}"));
                format!("{error}{help}")
            }),
        };
        let drawing = match drawing {
            Ok(drawing) => drawing,
            Err(why) => {
                summary.left_out(name, why);
                continue;
            }
        };
        if let Some(difference) = drawing.difference() {
            summary.compared(difference);
        }
        for path in plot::write(&table.with_file_name(name), drawing.svg(), drawing.png())? {
            summary.wrote(path);
        }
    }
    Ok(())
}

/// Why a figure of poses without a result is left out.
const NO_RESULT: &str = "the poses it would show have no result";

/// The map of the job's table that is now complete, as `plot` draws it.
fn map(table: &Path, value: &str, plane: Option<(&str, f64)>) -> Result<Drawing, PlotError> {
    let map = Map {
        value: value.into(),
        planes: plane
            .map(|(axis, at)| (axis.into(), at))
            .into_iter()
            .collect(),
        axes: None,
        choice: Choice {
            design: Some(0),
            pose: None,
        },
        title: None,
    };
    plot::map(&Table::open(table)?, &map).map(Drawing::Map)
}

/// `<job>-<figure>`, numbered from 1 where the job has several figures of the kind.
fn file_name(job: &Job, place: usize) -> String {
    let kinds: Vec<_> = job.figures.iter().map(kind).collect();
    let kind = kinds[place];
    let of_kind = |kinds: &[&str]| kinds.iter().filter(|k| **k == kind).count();
    if of_kind(&kinds) == 1 {
        format!("{}-{kind}", job.name)
    } else {
        format!("{}-{kind}-{}", job.name, of_kind(&kinds[..=place]))
    }
}

fn kind(figure: &Figure) -> &'static str {
    match figure {
        Figure::Trajectory { .. } => "trajectory",
        Figure::Deformed { .. } => "deformed",
        Figure::Map { .. } => "map",
    }
}

/// A figure of any kind.
enum Drawing {
    Map(MapFigure),
    Trajectory(TrajectoryFigure),
    Deformed(DeformedFigure),
}

impl Drawing {
    fn svg(&self) -> Result<String, FigureError> {
        match self {
            Self::Map(figure) => figure.svg(),
            Self::Trajectory(figure) => figure.svg(),
            Self::Deformed(figure) => figure.svg(),
        }
    }

    fn png(&self) -> Result<Vec<u8>, FigureError> {
        match self {
            Self::Map(figure) => figure.png(),
            Self::Trajectory(figure) => figure.png(),
            Self::Deformed(figure) => figure.png(),
        }
    }

    fn difference(&self) -> Option<f64> {
        match self {
            Self::Map(_) => None,
            Self::Trajectory(figure) => figure.second.as_ref().map(|second| second.difference),
            Self::Deformed(figure) => figure.second.as_ref().map(|second| second.difference),
        }
    }
}

fn figure_scale(scale: Scale) -> hyperstat_figures::Scale {
    match scale {
        Scale::Auto => hyperstat_figures::Scale::Auto,
        Scale::Factor(factor) => hyperstat_figures::Scale::Factor(factor),
    }
}

/// The translation of a displacement.
fn linear(displacement: &Vector6<f64>) -> [f64; 3] {
    [displacement[0], displacement[1], displacement[2]]
}

/// The largest difference between two lists of displacements over the largest displacement in
/// either; zero where nothing moves.
fn difference(ours: &[[f64; 3]], others: &[[f64; 3]]) -> f64 {
    let norm = |v: &[f64; 3]| v[0].hypot(v[1]).hypot(v[2]);
    let largest = ours.iter().chain(others).map(norm).fold(0.0, f64::max);
    let pairs = ours.iter().zip(others);
    let apart = pairs
        .map(|(a, b)| norm(&[a[0] - b[0], a[1] - b[1], a[2] - b[2]]))
        .fold(0.0, f64::max);
    if largest == 0.0 { 0.0 } else { apart / largest }
}

#[cfg(test)]
mod tests {
    use super::difference;

    #[test]
    fn the_difference_is_relative_to_the_largest_displacement() {
        let ours = [[0.0, 3.0, 4.0], [1.0, 0.0, 0.0]];
        let others = [[0.0, 3.0, 4.0], [1.0, 0.5, 0.0]];
        assert_eq!(difference(&ours, &others), 0.1);
        assert_eq!(difference(&[[0.0; 3]], &[[0.0; 3]]), 0.0);
        assert_eq!(difference(&[[0.0; 3]], &[[0.0, 2.0, 0.0]]), 1.0);
    }
}
