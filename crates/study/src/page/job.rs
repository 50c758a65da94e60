//! The part of a report about a job of a batch: run, measured over its poses, and drawn.

use std::path::PathBuf;

use hyperstat_mechanisms::Job;
use maud::{Markup, html};

use super::parts::{Row, figure, list, table};
use crate::error::StudyError;
use crate::figure;
use crate::ran::Ran;
use crate::sweep::{Chunk, Columns, MeasureReport, Summary, Sweep, Threads, Way};
use crate::table::{TableFormat, TableReader, TableWriter, numeric, render};

pub(super) fn section(job: &Job, threads: &Threads) -> Result<Markup, StudyError> {
    figure::check(job, &numeric(&Columns::of(job)))?;
    let (ran, rows_of_it) = run(&Sweep::new(job, Way::Lanes)?, threads)?;
    let Summary {
        poses, failures, ..
    } = &ran.summary;
    let failed: usize = failures.iter().map(|of| of.count).sum();
    let rows: Vec<Row> = (failures.iter())
        .map(|of| Row {
            words: vec![of.status.into(), of.why.clone()],
            numbers: Vec::new(),
            counts: vec![of.count, of.first_pose],
        })
        .collect();
    let measures = ran.measures(job).unwrap_or_default();
    let drawn = figures(job, &ran, &rows_of_it);
    Ok(html! {
        p {
            (poses) " rows, " @if failed == 0 { "all solved." } @else { (failed) " without a result." }
        }
        @if !rows.is_empty() { (table(&["status", "why the first has none", "rows", "first row"], &rows)) }
        (list("Warnings", &ran.warnings(job)))
        @if !measures.is_empty() {
            h3 { "Over the poses" }
            (spread(&measures))
        }
        (drawn)
    })
}

/// Runs a job, and gives its table.
fn run(sweep: &Sweep<'_>, threads: &Threads) -> Result<(Ran, Vec<u8>), StudyError> {
    let job = sweep.job();
    let format = TableFormat::Csv;
    let of_memory = |source| StudyError::Table { source };
    let mut table = TableWriter::new(Vec::new(), format, &Columns::of(job)).map_err(of_memory)?;
    let mut ran = Ran::new(job, true);
    let prepare = |chunk: &mut Chunk| {
        render(format, chunk);
        Ran::measure(chunk);
    };
    let take = |chunk: &mut Chunk| {
        ran.see(chunk);
        table.append(chunk).map_err(of_memory)
    };
    sweep.run(threads, 0..sweep.len(), prepare, take)?;
    Ok((ran, table.finish().map_err(of_memory)?))
}

fn spread(measures: &[MeasureReport]) -> Markup {
    let row = |of: &MeasureReport| Row {
        words: vec![of.words.clone(), of.unit.into()],
        numbers: [of.min.value]
            .into_iter()
            .chain(of.percentiles.iter().map(|percentile| percentile.value))
            .chain([of.max.value])
            .map(Some)
            .collect(),
        counts: vec![of.min.row, of.max.row],
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
fn figures(job: &Job, ran: &Ran, rows: &[u8]) -> Markup {
    let path = PathBuf::from(format!("{}.csv", job.name));
    let drawn = figure::names(job).enumerate().map(|(place, name)| {
        let table = || TableReader::of(&path, rows.to_vec());
        match figure::draw(job, place, ran.trajectory.as_ref(), table) {
            Ok(drawing) => figure(&drawing),
            Err(why) => html! { p { "The figure " (name) " is left out: " (why) "." } },
        }
    });
    let drawn: Vec<Markup> = drawn.collect();
    html! { @for drawing in drawn { (drawing) } }
}
