//! `hyperstat run`: every job of a batch, to CSV files and figures.

mod figures;
mod row;
mod summary;
mod sweep;

use std::fs;
use std::path::Path;

use hyperstat_mechanisms::{Batch, Registry};
use indicatif::{ProgressBar, ProgressStyle};

use crate::args;
use crate::atomic::AtomicFile;
use crate::case::Source;
use crate::error::CliError;
use summary::Summary;
use sweep::Sweep;

/// Runs a batch. `tell` gets the summary of every job.
///
/// Returns whether every pose has a result.
pub(crate) fn run(
    args: &args::Run,
    registry: &Registry,
    mut tell: impl FnMut(&str) -> Result<(), CliError>,
) -> Result<bool, CliError> {
    let batch = hyperstat_mechanisms::load_batch(&args.file, registry)?;
    let sweeps = prepare(&batch)?;
    fs::create_dir_all(&args.out).map_err(|source| CliError::Write {
        path: args.out.clone(),
        source,
    })?;
    let bar = progress_bar(batch.jobs.iter().map(|job| job.len() as u64).sum());
    let mut complete = true;
    for sweep in &sweeps {
        bar.set_message(sweep.job().name.clone());
        let summary = run_job(sweep, &args.out, &bar)?;
        complete &= summary.is_complete();
        bar.suspend(|| tell(&summary.to_string()))?;
    }
    bar.finish_and_clear();
    Ok(complete)
}

/// Checks all jobs before the first runs.
fn prepare(batch: &Batch) -> Result<Vec<Sweep<'_>>, CliError> {
    let prepare = |job| {
        Sweep::new(job).map_err(|unsolvable| {
            let (model, error) = *unsolvable;
            Source::Job(job).unsolvable(&model, error)
        })
    };
    batch.jobs.iter().map(prepare).collect()
}

fn run_job(sweep: &Sweep<'_>, folder: &Path, bar: &ProgressBar) -> Result<Summary, CliError> {
    let job = sweep.job();
    let path = folder.join(format!("{}.csv", job.name));
    let cannot_write = |source| CliError::Write {
        path: path.clone(),
        source,
    };
    let mut file = AtomicFile::create(&path).map_err(cannot_write)?;
    file.append(row::header().as_bytes())
        .map_err(cannot_write)?;
    let mut summary = Summary::new(job);
    let mut trajectory = figures::Trajectory::wanted_by(job);
    sweep.run(|records, text| -> Result<(), CliError> {
        file.append(text.as_bytes()).map_err(cannot_write)?;
        summary.add(records);
        if let Some(trajectory) = &mut trajectory {
            trajectory.add(records);
        }
        bar.inc(records.len() as u64);
        Ok(())
    })?;
    file.commit().map_err(cannot_write)?;
    summary.wrote(path.clone());
    bar.set_message(format!("{}: figures", job.name));
    figures::draw(job, trajectory.as_ref(), folder, &mut summary)?;
    Ok(summary)
}

/// A bar on a terminal; nothing elsewhere.
fn progress_bar(poses: u64) -> ProgressBar {
    let bar = ProgressBar::new(poses);
    // The template is a constant that a test reads.
    if let Ok(style) = ProgressStyle::with_template(TEMPLATE) {
        bar.set_style(style);
    }
    bar
}

const TEMPLATE: &str = "{msg} {wide_bar} {human_pos}/{human_len} poses, {eta} left";

#[cfg(test)]
mod tests {
    use indicatif::ProgressStyle;

    #[test]
    fn the_template_of_the_bar_can_be_read() {
        assert!(ProgressStyle::with_template(super::TEMPLATE).is_ok());
    }
}
