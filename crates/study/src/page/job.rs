//! The part of a report about a job of a batch: run, measured over its poses, and drawn.

use std::path::PathBuf;

use hyperstat_mechanisms::Job;
use maud::{Markup, html};

use super::parts::{Row, figure, list, table};
use crate::doubts::Watch;
use crate::error::StudyError;
use crate::figure;
use crate::sweep::{
    Chunk, Columns, MeasureReport, Statistics, Summary, Sweep, Threads, Way, measure,
};
use crate::table::{TableFormat, TableReader, TableWriter, numeric, render};

/// What a run of a job found.
struct Ran {
    table: Vec<u8>,
    summary: Summary,
    statistics: Statistics,
    watch: Watch,
    trajectory: Option<figure::Trajectory>,
}

pub(super) fn section(job: &Job, threads: &Threads) -> Result<Markup, StudyError> {
    figure::check(job, &numeric(&Columns::of(job)))?;
    let ran = run(&Sweep::new(job, Way::Lanes)?, threads)?;
    let Summary {
        poses, failures, ..
    } = &ran.summary;
    let failed: usize = failures.iter().map(|of| of.count).sum();
    let rows: Vec<Row> = (failures.iter())
        .map(|of| Row {
            words: vec![of.status.into(), of.why.clone()],
            numbers: vec![Some(of.count as f64), Some(of.first_pose as f64)],
        })
        .collect();
    let measures = ran.statistics.report().unwrap_or_default();
    let drawn = figures(job, &ran);
    Ok(html! {
        p {
            (poses) " rows, " @if failed == 0 { "all solved." } @else { (failed) " without a result." }
        }
        @if !rows.is_empty() { (table(&["status", "why the first has none", "rows", "first row"], &rows)) }
        (list("Warnings", &ran.watch.warnings(job)))
        @if !measures.is_empty() {
            h3 { "Over the poses" }
            (spread(&measures))
        }
        (drawn)
    })
}

fn run(sweep: &Sweep<'_>, threads: &Threads) -> Result<Ran, StudyError> {
    let job = sweep.job();
    let format = TableFormat::Csv;
    let mut ran = Ran {
        table: Vec::new(),
        summary: Summary::new(job, 0),
        statistics: Statistics::default(),
        watch: Watch::new(job),
        trajectory: figure::Trajectory::wanted_by(job),
    };
    let of_memory = |source| StudyError::Table { source };
    let mut table = TableWriter::new(Vec::new(), format, &Columns::of(job)).map_err(of_memory)?;
    let prepare = |chunk: &mut Chunk| {
        render(format, chunk);
        chunk.measures.extend(chunk.records.iter().map(measure));
    };
    sweep.run(
        threads,
        0..sweep.len(),
        prepare,
        |chunk| -> Result<(), StudyError> {
            table.append(chunk).map_err(of_memory)?;
            ran.summary.add(&chunk.records);
            for (row, record) in chunk.rows.clone().zip(&chunk.records) {
                if let Ok(found) = &record.result {
                    ran.watch.see(row, &found.displacement);
                }
            }
            for (k, values) in chunk.measures.iter().enumerate() {
                if let Some(values) = values {
                    let row = chunk.rows.start + k;
                    ran.statistics.add(row, &chunk.records[k].pose, values);
                }
            }
            if let Some(trajectory) = &mut ran.trajectory {
                trajectory.add(chunk.rows.start, &chunk.records);
            }
            Ok(())
        },
    )?;
    ran.table = table.finish().map_err(of_memory)?;
    Ok(ran)
}

fn spread(measures: &[MeasureReport]) -> Markup {
    let row = |of: &MeasureReport| Row {
        words: vec![of.words.clone(), of.unit.into()],
        numbers: [of.min.value]
            .into_iter()
            .chain(of.percentiles.iter().map(|percentile| percentile.value))
            .chain([of.max.value, of.min.row as f64, of.max.row as f64])
            .map(Some)
            .collect(),
    };
    let rows: Vec<Row> = measures.iter().map(row).collect();
    let heads = [
        "",
        "unit",
        "least",
        "5 %",
        "median",
        "95 %",
        "greatest",
        "row of least",
        "row of greatest",
    ];
    table(&heads, &rows)
}

/// The figures that the job asks for.
fn figures(job: &Job, ran: &Ran) -> Markup {
    let path = PathBuf::from(format!("{}.csv", job.name));
    let drawn = figure::names(job).enumerate().map(|(place, name)| {
        let table = || TableReader::of(&path, ran.table.clone());
        match figure::draw(job, place, ran.trajectory.as_ref(), table) {
            Ok(drawing) => figure(&drawing),
            Err(why) => html! { p { "The figure " (name) " is left out: " (why) "." } },
        }
    });
    let drawn: Vec<Markup> = drawn.collect();
    html! { @for drawing in drawn { (drawing) } }
}
