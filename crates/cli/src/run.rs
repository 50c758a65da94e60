//! `hyperstat run`: every job of a batch, to CSV files and figures.

use std::fs;
use std::path::{Path, PathBuf};

use hyperstat_mechanisms::{Batch, Job, Registry};
use hyperstat_study::sweep::{Chunk, Columns, Sweep, Threads, Way};
use hyperstat_study::table::{self, TableFormat, TableReader, TableWriter};
use hyperstat_study::{Ran, figure};
use indicatif::{ProgressBar, ProgressStyle};

use crate::atomic::{AtomicFile, LONGER};
use crate::disk::{Disk, LONGEST_NAME};
use crate::error::CliError;
use crate::json::json;
use crate::plot::Form;
use crate::text::Outcome;
use crate::{args, consent, outputs, plot, terminal};

/// Runs a batch. `tell` gets the summary of every job; what it fails with ends no run, since the
/// results are files.
///
/// Returns whether every pose has a result.
pub(crate) fn run(
    args: &args::Run,
    registry: &Registry,
    mut tell: impl FnMut(&str) -> Result<(), CliError>,
) -> Result<bool, CliError> {
    let batch =
        hyperstat_mechanisms::load_batch(&args.file, &hyperstat_mechanisms::Disk, registry)?;
    let way = match args.one_by_one {
        true => Way::OneByOne,
        false => Way::Lanes,
    };
    let sweeps = prepare(&batch, way)?;
    check_outputs(&batch, args)?;
    consent::ask(&sweeps, args)?;
    fs::create_dir_all(&args.out).map_err(|source| CliError::Write {
        path: args.out.clone(),
        source,
    })?;
    let threads = Threads::new(args.threads)?;
    let rows = sweeps.iter().map(|sweep| sweep.len() as u64);
    let bar = progress_bar(rows.fold(0, u64::saturating_add));
    let mut complete = true;
    let mut told = Ok(());
    for sweep in &sweeps {
        bar.set_message(sweep.job().name.clone());
        let outcome = run_job(sweep, args, &threads, &bar)?;
        complete &= outcome.summary.is_complete();
        told = told.and(bar.suspend(|| tell(&outcome.to_string())));
    }
    bar.finish_and_clear();
    told.map(|()| complete)
}

/// Checks that all outputs can have their names, and are no files that were read.
fn check_outputs(batch: &Batch, args: &args::Run) -> Result<(), CliError> {
    let longest = Disk::of(&args.out).map_or(LONGEST_NAME, |disk| disk.longest_name);
    let mut all = Vec::new();
    for job in &batch.jobs {
        let table = table_path(job, args);
        let summary = args.summary.then(|| summary_path(job, args));
        let figures = figure_files(job, &table, args);
        let mut files: Vec<PathBuf> = figures.chain(summary).collect();
        files.push(table);
        for file in &files {
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            let length = (name.len() + LONGER) as u64;
            if length > longest {
                return Err(CliError::NameTooLong {
                    location: Box::new(job.location()),
                    job: job.name.clone(),
                    file: name.into_owned(),
                    length,
                    longest: longest.saturating_sub(length - job.name.len() as u64),
                });
            }
        }
        all.extend(files);
    }
    outputs::refuse(all.iter().map(|path| &**path), &batch.files())
}

/// The file of a job's table.
fn table_path(job: &Job, args: &args::Run) -> PathBuf {
    let extension = TableFormat::from(args.format).extension();
    args.out.join(format!("{}.{extension}", job.name))
}

/// The file of a job's measures over its poses.
fn summary_path(job: &Job, args: &args::Run) -> PathBuf {
    args.out.join(format!("{}-summary.json", job.name))
}

/// Checks all jobs before the first runs.
fn prepare(batch: &Batch, way: Way) -> Result<Vec<Sweep<'_>>, CliError> {
    let prepare = |job| prepare_job(job, way);
    batch.jobs.iter().map(prepare).collect()
}

fn prepare_job(job: &Job, way: Way) -> Result<Sweep<'_>, CliError> {
    let columns = table::numeric(&Columns::of(job));
    figure::check(job, &columns)?;
    Ok(Sweep::new(job, way)?)
}

/// The files of a job's figures, beside its table.
fn figure_files(job: &Job, table: &Path, args: &args::Run) -> impl Iterator<Item = PathBuf> {
    let forms = Form::all(args.pdf);
    figure::names(job).flat_map(move |name| plot::files(&table.with_file_name(name), &forms))
}

/// Writes a job's table and its figures.
fn run_job(
    sweep: &Sweep<'_>,
    args: &args::Run,
    threads: &Threads,
    bar: &ProgressBar,
) -> Result<Outcome, CliError> {
    let job = sweep.job();
    let path = table_path(job, args);
    let format = args.format.into();
    let cannot_write = |source| CliError::Write {
        path: path.clone(),
        source,
    };
    let file = AtomicFile::create(&path).map_err(cannot_write)?;
    let mut table = TableWriter::new(file, format, &Columns::of(job)).map_err(cannot_write)?;
    let mut ran = Ran::new(job, args.summary);
    let render = |chunk: &mut Chunk| {
        table::render(format, chunk);
        if args.summary {
            Ran::measure(chunk);
        }
    };
    sweep.run(
        threads,
        0..sweep.len(),
        render,
        |chunk| -> Result<(), CliError> {
            table.append(chunk).map_err(cannot_write)?;
            ran.see(chunk);
            bar.inc(chunk.records.len() as u64);
            Ok(())
        },
    )?;
    let file = table.finish().map_err(cannot_write)?;
    file.commit().map_err(cannot_write)?;
    let (found, warnings) = (ran.measures(job), ran.warnings(job));
    let mut outcome = Outcome::new(ran.summary);
    outcome.files.push(path.clone());
    outcome.warnings = warnings;
    if let Some(found) = found {
        let path = summary_path(job, args);
        outputs::write(&path, json(&found)?.as_bytes())?;
        outcome.files.push(path);
        outcome.measures = found;
    }
    bar.set_message(format!("{}: figures", job.name));
    let forms = Form::all(args.pdf);
    threads.install(|| draw(job, ran.trajectory.as_ref(), (&path, &forms), &mut outcome))?;
    Ok(outcome)
}

/// Draws the figures of a job and writes them beside its table.
fn draw(
    job: &Job,
    trajectory: Option<&figure::Trajectory>,
    (table, forms): (&Path, &[Form]),
    outcome: &mut Outcome,
) -> Result<(), CliError> {
    for (place, name) in figure::names(job).enumerate() {
        let drawing = match figure::draw(job, place, trajectory, || TableReader::open(table)) {
            Ok(drawing) => drawing,
            Err(why) => {
                outcome.left_out.push((name, why));
                continue;
            }
        };
        if let Some(difference) = drawing.difference() {
            outcome.compared(difference);
        }
        match plot::write(&drawing, &table.with_file_name(&name), forms) {
            Ok(paths) => outcome.files.extend(paths),
            // One that cannot be drawn is as one without a result: the run goes on.
            Err(CliError::Figure { source, .. }) => {
                outcome.left_out.push((name, source.to_string()));
            }
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

/// A bar on a terminal; nothing elsewhere.
fn progress_bar(poses: u64) -> ProgressBar {
    let bar = match terminal::cannot_redraw() {
        true => ProgressBar::hidden(),
        false => ProgressBar::new(poses),
    };
    // The template is a constant that a test reads.
    if let Ok(style) = ProgressStyle::with_template(TEMPLATE) {
        bar.set_style(style);
    }
    bar
}

const TEMPLATE: &str = "{msg} {wide_bar} {human_pos}/{human_len} poses, {eta} left";

#[cfg(test)]
mod tests {
    use std::path::Path;

    use hyperstat_mechanisms::{Disk, Registry, batch_from_str};
    use indicatif::{ProgressBar, ProgressStyle};

    use super::{Threads, Way, prepare, run_job};
    use crate::args::{Run, TableFormat};

    const BATCH: &str = r#"(jobs: [(
        name: "line",
        mechanism: Delta(
            base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60,
            rod_spacing: 0.12,
            arm: (section: Circle(diameter: 0.030), material: (young: 2.1e11, poisson: 0.3)),
            bar: (section: Circle(diameter: 0.020), material: (young: 2.1e11, poisson: 0.3)),
            rod: (section: Circle(diameter: 0.014), material: (young: 2.1e11, poisson: 0.3)),
        ),
        poses: Grid(x: (-1.0, 1.0, 2100), y: (0.0, 0.0, 1), z: (0.45, 0.45, 1)),
    )])"#;

    #[test]
    fn the_bar_ends_at_the_number_of_poses() {
        let batch = batch_from_str(BATCH, Path::new("."), &Disk, &Registry::builtin()).unwrap();
        let sweeps = prepare(&batch, Way::Lanes).unwrap();
        let out = std::env::temp_dir().join(format!("hyperstat-bar-{}", std::process::id()));
        std::fs::create_dir_all(&out).unwrap();
        let threads = Threads::new(3).unwrap();
        let bar = ProgressBar::hidden();
        bar.set_length(sweeps[0].len() as u64);
        let args = Run {
            file: "line.ron".into(),
            out: out.clone(),
            format: TableFormat::Parquet,
            threads: 3,
            summary: false,
            yes: false,
            one_by_one: false,
            pdf: false,
        };
        let outcome = run_job(&sweeps[0], &args, &threads, &bar).unwrap();
        assert!(!outcome.summary.is_complete());
        assert_eq!(bar.position(), 2100);
        assert_eq!(bar.length(), Some(2100));
        std::fs::remove_dir_all(out).unwrap();
    }

    #[test]
    fn the_template_of_the_bar_can_be_read() {
        assert!(ProgressStyle::with_template(super::TEMPLATE).is_ok());
    }
}
