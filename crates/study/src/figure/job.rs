//! The figures that a job asks for.

use hyperstat_assembly::{ModalOptions, Prepared, Solution};
use hyperstat_figures::Extreme;
use hyperstat_mechanisms::{
    ColorScale, Commanded, Dimension, Figure, FigurePose, Job, Look, Mark, Noted, Scale,
};

use super::budget::budget as budget_figure;
use super::deformed::{compare, deformed as deformed_figure, mode as mode_figure};
use super::drawing::Drawing;
use super::labels::Labels;
use super::map::{Map, figure as map_figure};
use super::notes;
use super::pose::{in_words, of_job};
use super::quantity::{Drawn, instead_of};
use super::rows::Choice;
use super::tables::{NamedTable, beside, ratio};
use super::trajectory::Trajectory;
use crate::answer::Asked;
use crate::error::StudyError;
use crate::plot_error::PlotError;
use crate::schema::{asking_for, is_frequency};
use crate::source::Written;
use crate::study::job_model;
use crate::table::TableReader;

/// That the job's maps are of quantities that its table, with these columns, will hold, over planes
/// and along axes that its poses have, and that it has modes where one is to be drawn.
///
/// # Errors
/// What is wrong with the first that is wrong.
pub fn check(job: &Job, columns: &[String]) -> Result<(), StudyError> {
    for (place, figure) in job.figures.iter().enumerate() {
        let at = |fields: &[&str], source: PlotError| StudyError::JobMap {
            location: Box::new(job.figure_location(place, fields)),
            source: Box::new(source),
        };
        let refused = |source: PlotError| at(source.fields(), source);
        if !matches!(figure, Figure::Map { .. }) {
            words(figure).1.axes().map_err(refused)?;
        }
        if let Some(pose) = pose(figure) {
            place_of(job, pose).map_err(|source| at(&["pose"], source))?;
        }
        match figure {
            Figure::Map {
                value,
                measured,
                beside,
                ratio,
                ..
            } => {
                let mut drawn = drawn(job, value, columns).map_err(refused)?;
                if *ratio {
                    drawn.quantity.unit.clear();
                }
                check_limits(&drawn, *measured).map_err(refused)?;
                if let Some(design) = beside.filter(|design| *design >= job.designs()) {
                    return Err(refused(PlotError::NoDesign {
                        design,
                        count: job.designs(),
                    }));
                }
                let commanded = job.commanded();
                if let Some(map) = map(job, figure, &commanded) {
                    map.check(&commanded).map_err(refused)?;
                }
            }
            // Of a job that varies it is left out where the first design has none.
            Figure::Mode { number, .. } if job.varied().is_empty() => {
                // Where no pose can be reached there is no model, and no figure.
                if let Ok(model) = job.model() {
                    let prepared = Prepared::new(model);
                    let modal = prepared.modal(&modal_options(job, *number));
                    modal.map_err(|error| Written::Job(job).unsolvable(&prepared.here(), error))?;
                }
            }
            _ => {}
        }
    }
    Ok(())
}

/// The pose that a figure is of, where it is of one.
fn pose(figure: &Figure) -> Option<&FigurePose> {
    match figure {
        Figure::Deformed { pose, .. } | Figure::Mode { pose, .. } | Figure::Budget { pose, .. } => {
            Some(pose)
        }
        Figure::Trajectory { .. } | Figure::Map { .. } => None,
    }
}

/// The number of a pose.
fn place_of(job: &Job, pose: &FigurePose) -> Result<usize, PlotError> {
    match pose {
        FigurePose::Number(number) => Ok(*number),
        FigurePose::At(at) => of_job(job, at),
    }
}

/// The same, or why there is none, in words.
fn number(job: &Job, pose: &FigurePose) -> Result<usize, String> {
    place_of(job, pose).map_err(|error| told(&error))
}

/// An error with what would be right, in words.
fn told(error: &PlotError) -> String {
    let help = error.help();
    let help = help.map_or_else(String::new, |help| format!("; {help}"));
    format!("{error}{help}")
}

/// The quantity of this name, of a job whose table has these columns.
fn drawn(job: &Job, value: &str, columns: &[String]) -> Result<Drawn, PlotError> {
    Drawn::named(value, columns).ok_or_else(|| PlotError::NoQuantity {
        name: value.into(),
        help: match (&job.modes, is_frequency(value)) {
            (None, true) => {
                let count = value.trim_start_matches(['f', '0']);
                format!("natural frequencies need `modes: {count}` in the job")
            }
            _ => match asking_for(value) {
                Some(asked) => format!("it needs `columns: [{asked}]` in the job"),
                None => instead_of(value, columns),
            },
        },
    })
}

/// That limits which measure something measure what is drawn; of a unit that files do not know that is
/// nothing.
fn check_limits(drawn: &Drawn, measured: Option<Dimension>) -> Result<(), PlotError> {
    let unit = &drawn.quantity.unit;
    let wanted = Dimension::of_unit(unit);
    match measured {
        Some(given) if wanted != Some(given) => Err(PlotError::LimitsMeasure {
            name: drawn.quantity.name.clone(),
            given: given.to_string(),
            wanted: wanted.map_or_else(|| format!("in {unit}"), |wanted| wanted.to_string()),
            unit: unit.clone(),
        }),
        _ => Ok(()),
    }
}

/// The masses that the job's modes are found with, for so many of them.
fn modal_options(job: &Job, count: usize) -> ModalOptions {
    let of_job = job.modes.clone();
    of_job.map_or_else(
        || ModalOptions::lowest(count),
        |options| ModalOptions { count, ..options },
    )
}

/// Names of the job's figures: `<job>-<figure>`, numbered from 1 where the job has several of a kind.
pub fn names(job: &Job) -> impl Iterator<Item = String> {
    (0..job.figures.len()).map(move |place| file_name(job, place))
}

/// Draws the figure of this place among those of the job. Of its poses the sweep has seen those of
/// `trajectory`; `table` opens the job's table, which is complete.
///
/// # Errors
/// Why there is no such figure, in words.
pub fn draw(
    job: &Job,
    place: usize,
    trajectory: Option<&Trajectory>,
    table: impl FnOnce() -> Result<TableReader, PlotError>,
) -> Result<Drawing, String> {
    let Some(figure) = job.figures.get(place) else {
        return Err("the job has no such figure".into());
    };
    let mut drawing = match figure {
        Figure::Trajectory { scale, .. } => trajectory
            .filter(|trajectory| trajectory.fits(job) && !trajectory.is_empty())
            .map(|trajectory| Drawing::Trajectory(trajectory.figure(job, figure_scale(*scale))))
            .ok_or_else(|| NO_RESULT.to_string()),
        Figure::Deformed {
            pose,
            case,
            scale,
            look,
            ..
        } => deformed(
            job,
            number(job, pose)?,
            case.as_deref(),
            (figure_scale(*scale), look),
        )
        .ok_or_else(|| NO_RESULT.to_string()),
        Figure::Mode {
            number: mode_number,
            pose,
            scale,
            look,
            ..
        } => mode(
            job,
            *mode_number,
            number(job, pose)?,
            (figure_scale(*scale), look),
        ),
        Figure::Budget {
            along, pose, case, ..
        } => {
            let (case, along) = (case.clone(), *along);
            budget(job, &Asked { case, along }, number(job, pose)?)
        }
        Figure::Map { .. } => {
            let table = table().map(|table| table.varying(job.varied()));
            let drawn = table.and_then(|table| drawn_map(job, figure, &table));
            drawn.map_err(|error| told(&error))
        }
    }?;
    name(&mut drawing, figure);
    Ok(drawing)
}

/// Title and labels of a figure.
fn words(figure: &Figure) -> (Option<&String>, Labels) {
    match figure {
        Figure::Budget { title, .. } => (title.as_ref(), Labels::default()),
        Figure::Trajectory { words, .. }
        | Figure::Deformed { words, .. }
        | Figure::Mode { words, .. }
        | Figure::Map { words, .. } => (words.title.as_ref(), Labels(words.labels.clone())),
    }
}

/// Gives a drawing the title and, in space, the names of axes that the job says.
fn name(drawing: &mut Drawing, figure: &Figure) {
    let (title, labels) = words(figure);
    // They were checked before the job ran.
    let axes = || labels.axes().ok().flatten();
    let own = match drawing {
        Drawing::Trajectory(drawn) => {
            drawn.axis_names = axes();
            &mut drawn.title
        }
        Drawing::Deformed(drawn) => {
            drawn.axis_names = axes();
            &mut drawn.title
        }
        Drawing::Budget(drawn) => &mut drawn.title,
        Drawing::Map(drawn) => &mut drawn.title,
        Drawing::Lines(_) | Drawing::Moving(_) => return,
    };
    if let Some(title) = title {
        own.clone_from(title);
    }
}

/// The mechanism at a pose with its solution, under the loads of a case where one is named; `None`
/// where it has none, or the output moves freely.
fn solved(job: &Job, pose: usize, case: Option<&str>) -> Option<(Prepared, Solution)> {
    let prepared = Prepared::new(job_model(job, pose).ok()?);
    let mut solution = prepared.here().solve().ok()?;
    if let Some(name) = case {
        solution = solution.of_case(name)?;
    }
    let held = solution.output.free_motions.is_empty();
    held.then_some((prepared, solution))
}

/// Title of a figure of the job's first design that can be.
fn title(job: &Job, pose: usize, case: Option<&str>) -> String {
    let design = (!job.varied().is_empty()).then_some(job.first_design());
    crate::title::title(&job.name, design, Some(pose), case)
}

/// The pose by its coordinates, where that is to be shown.
fn pose_in_words(job: &Job, pose: usize, look: &Look) -> Option<String> {
    let shown = look.shown.contains(&Noted::Pose);
    shown.then(|| in_words(job, pose)).flatten()
}

fn deformed(
    job: &Job,
    pose: usize,
    case: Option<&str>,
    (scale, look): (hyperstat_figures::Scale, &Look),
) -> Option<Drawing> {
    let (prepared, solution) = solved(job, pose, case)?;
    let model = prepared.model();
    let title = title(job, pose, case);
    let mut figure = deformed_figure(model, &solution, title, scale).ok()?;
    notes::add(&mut figure, model, case, look);
    figure.pose = pose_in_words(job, pose, look);
    if case.is_none()
        && let Ok(reference) = hyperstat_reference::solve(model)
    {
        compare(&mut figure, model, &solution, &reference);
    }
    Some(Drawing::Deformed(figure))
}

fn mode(
    job: &Job,
    number: usize,
    pose: usize,
    (scale, look): (hyperstat_figures::Scale, &Look),
) -> Result<Drawing, String> {
    let model = job_model(job, pose).map_err(|_| NO_RESULT)?;
    let found = hyperstat_assembly::modes(&model, &modal_options(job, number))
        .map_err(|error| error.to_string())?;
    let mode = found.modes.get(number - 1).ok_or_else(|| {
        format!(
            "there are {} modes only: no more coordinates have mass (of consistent and lumped \
             masses, more `elements` a segment make more)",
            found.modes.len()
        )
    })?;
    let title = title(job, pose, None);
    let mut figure =
        mode_figure(&model, mode, number, title, scale).map_err(|error| error.to_string())?;
    notes::add(&mut figure, &model, None, look);
    figure.pose = pose_in_words(job, pose, look);
    Ok(Drawing::Deformed(figure))
}

fn budget(job: &Job, asked: &Asked, pose: usize) -> Result<Drawing, String> {
    let (prepared, solution) = solved(job, pose, asked.case.as_deref()).ok_or(NO_RESULT)?;
    let budget = crate::answer::budget(&prepared.here(), &solution, asked)
        .map_err(|error| error.to_string())?
        .ok_or(NO_RESULT)?;
    let model = prepared.model();
    let output = model.output().map(|node| model.node_name(node));
    let title = title(job, pose, asked.case.as_deref());
    budget_figure(&budget, &output.unwrap_or_default(), title)
        .map(Drawing::Budget)
        .ok_or_else(|| "the output does not move along this direction".into())
}

/// Why a figure of poses without a result is left out.
const NO_RESULT: &str = "the poses it would show have no result";

/// The map of the job's table that is now complete, as `plot` draws it.
fn drawn_map(job: &Job, figure: &Figure, table: &TableReader) -> Result<Drawing, PlotError> {
    let map = map(job, figure, &job.commanded()).ok_or_else(|| PlotError::Nothing {
        path: table.path().into(),
    })?;
    let Figure::Map {
        beside: Some(other),
        ratio: of_both,
        ..
    } = figure
    else {
        return map_figure(table, &map).map(Drawing::Map);
    };
    let designs = [job.first_design(), *other];
    let names = designs.map(|design| format!("design {design}"));
    let tables = [0, 1].map(|k| NamedTable {
        name: &names[k],
        table,
        design: Some(designs[k]),
    });
    let drawn = match of_both {
        true => ratio(tables, &map),
        false => beside(tables, &map),
    };
    drawn.map(Drawing::Map)
}

/// A figure that is a map, of a job whose poses give these coordinates.
fn map(job: &Job, figure: &Figure, commanded: &[Commanded]) -> Option<Map> {
    let Figure::Map {
        value,
        plane,
        planes,
        axes,
        limits,
        scale,
        marks,
        ..
    } = figure
    else {
        return None;
    };
    let names = commanded.iter().map(|coordinate| coordinate.name.clone());
    Some(Map {
        value: value.clone(),
        plane: plane.clone(),
        planes: planes.clone(),
        axes: axes.clone(),
        asked: Some(names.collect()),
        limits: *limits,
        scale: match scale {
            ColorScale::Auto => hyperstat_figures::ColorScale::Auto,
            ColorScale::Linear => hyperstat_figures::ColorScale::Linear,
            ColorScale::Log => hyperstat_figures::ColorScale::Log,
        },
        choice: Choice {
            design: Some(job.first_design()),
            pose: None,
        },
        marks: (marks.iter())
            .map(|mark| match mark {
                Mark::Least => Extreme::Least,
                Mark::Most => Extreme::Most,
            })
            .collect(),
        title: None,
        labels: words(figure).1,
    })
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
        Figure::Mode { .. } => "mode",
        Figure::Budget { .. } => "budget",
        Figure::Map { .. } => "map",
    }
}

fn figure_scale(scale: Scale) -> hyperstat_figures::Scale {
    match scale {
        Scale::Auto => hyperstat_figures::Scale::Auto,
        Scale::Factor(factor) => hyperstat_figures::Scale::Factor(factor),
    }
}
