//! Runs of batches in shares, for whoever spreads them over machines: begun, computed, merged.

use std::path::{Path, PathBuf};
use std::time::Duration;

use hyperstat_study::parts::{
    Folder, Options, Origin, Part, PartsError, Reading, Results, Share, Work, sweeps_of, took,
};
use hyperstat_study::sweep::{Sweep, Threads, Way};
use hyperstat_study::table::TableFormat;
use hyperstat_study::{Disk, Registry, load_batch};
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

use crate::error::Ended;
use crate::given;
use crate::mechanism::Core;
use crate::watched::watched;

/// How long rows are solved to tell how long all take.
const MEASURED: Duration = Duration::from_millis(300);
/// What a share has done for so long is kept.
const SECURED: Duration = Duration::from_secs(60);

/// A job that is merged: its name, rows, how many came out how without a result, files, and what is to be said.
type Merged = (
    String,
    usize,
    Vec<(&'static str, usize)>,
    Vec<PathBuf>,
    Vec<String>,
);

/// Begins a run in a folder of results, where shares of it find all that they need: its hash, how many rows its
/// longest job has, and how long all of them take on one thread \[s\].
#[pyfunction]
pub(crate) fn begin_run(
    py: Python<'_>,
    batch: PathBuf,
    out: PathBuf,
    parquet: bool,
    summary: bool,
    pdf: bool,
    one_by_one: bool,
) -> PyResult<(String, usize, f64)> {
    let options = Options {
        parquet,
        summary,
        pdf,
        one_by_one,
    };
    watched(py, None, move |watch| {
        let reading = Reading::of(&Disk);
        let read = load_batch(&batch, &reading, &Registry::builtin())?;
        let sweeps = sweeps_of(&read, options.way())?;
        Results::new(&out, options).check(&read)?;
        let (shelf, threads) = (Folder::new(&out), Threads::new(1)?);
        let origin = Origin::new(&batch, &read, &reading, options);
        let work = Work {
            shelf: &shelf,
            origin: &origin,
            part: Part::Whole,
            threads: &threads,
            secured_every: SECURED,
            stop: &|| false,
        };
        let mut seconds = 0.0;
        for sweep in &sweeps {
            work.look(sweep, false).map_err(parts(&out))?;
            watch.at(0, 0)?;
            seconds += measured(sweep, &threads, (options.format(), summary));
        }
        let written = origin.write(&shelf);
        written.map_err(|source| {
            let name = "parts".into();
            parts(&out)(PartsError::Write { name, source })
        })?;
        let rows = sweeps.iter().map(Sweep::len).max().unwrap_or(0);
        Ok((origin.hash().into(), rows, seconds))
    })
}

/// Computes a share of every job's rows of a run, on one thread: files that could not be used, and why.
#[pyfunction]
pub(crate) fn run_share(
    py: Python<'_>,
    out: PathBuf,
    run: String,
    index: usize,
    count: usize,
) -> PyResult<Vec<String>> {
    watched(py, None, move |watch| {
        let shelf = Folder::new(&out);
        let origin = Origin::read(&shelf, &run).map_err(parts(&out))?;
        let batch = origin.batch(&Registry::builtin())?;
        let share = Share::new(index, count);
        let share = share.map_err(|help| Ended::argument("there is no such share", &help))?;
        let work = Work {
            shelf: &shelf,
            origin: &origin,
            part: Part::Share(share),
            threads: &Threads::new(1)?,
            secured_every: SECURED,
            stop: &|| watch.at(0, 0).is_err(),
        };
        let mut unusable = Vec::new();
        for sweep in &sweeps_of(&batch, origin.options().way())? {
            let found = work.look(sweep, false).map_err(parts(&out))?;
            unusable.extend(told(&out, found.broken()));
            let done = work.run(sweep, found, &mut |_| {}).map_err(parts(&out))?;
            if done.is_stopped() {
                return Err(Ended::Stopped);
            }
        }
        Ok(unusable)
    })
}

/// Joins the shares of a run, job by job.
#[pyfunction]
pub(crate) fn merge_run(py: Python<'_>, out: PathBuf, run: String) -> PyResult<Vec<Merged>> {
    watched(py, None, move |watch| {
        let shelf = Folder::new(&out);
        let origin = Origin::read(&shelf, &run).map_err(parts(&out))?;
        let batch = origin.batch(&Registry::builtin())?;
        let sweeps = sweeps_of(&batch, origin.options().way())?;
        let threads = Threads::new(0)?;
        let stop = || watch.at(0, 0).is_err();
        let work = Work::of_parts(&shelf, &origin, &threads, &stop);
        let (all, missing) = work.gather(&sweeps, false).map_err(parts(&out))?;
        if !missing.is_empty() {
            let rows = missing.rows();
            let mut lines = vec![format!("{}: {rows} rows are missing", out.display())];
            lines.extend(all.iter().flat_map(|found| told(&out, found.broken())));
            let help = Some("run it again: what is there is not computed again".into());
            return Err(Ended::Parts(lines.join("\n"), help));
        }
        let results = Results::new(&out, origin.options());
        let mut merged = Vec::new();
        for (sweep, found) in sweeps.iter().zip(all) {
            watch.at(0, 0)?;
            let (job, rows) = (sweep.job(), sweep.len());
            let done = match work.merge(sweep, found, false) {
                Err(PartsError::Stopped) => return Err(Ended::Stopped),
                done => done.map_err(parts(&out))?,
            };
            let outcome = results.finish(job, done.ran, &threads)?;
            let left_out = outcome.left_out.into_iter();
            let left_out = left_out.map(|(figure, why)| format!("no {figure}: {why}"));
            let failures = outcome.summary.failures.iter();
            merged.push((
                job.name.clone(),
                rows,
                failures.map(|own| (own.status, own.count)).collect(),
                outcome.files,
                outcome.warnings.into_iter().chain(left_out).collect(),
            ));
        }
        Ok(merged)
    })
}

/// How long a sweep of a mechanism in these poses takes on one thread \[s\], by some of them.
#[pyfunction]
pub(crate) fn lasts(
    mechanism: &Bound<'_, Core>,
    poses: (Vec<String>, PyReadonlyArray2<'_, f64>),
    fields: Vec<(String, String)>,
    one_by_one: bool,
) -> PyResult<f64> {
    let poses = given::poses(poses.0, &poses.1);
    let own = mechanism.clone().unbind();
    watched(mechanism.py(), None, move |_| {
        let mut job = own.get().job_with(&fields)?;
        job.set_poses(poses)?;
        let way = match one_by_one {
            true => Way::OneByOne,
            false => Way::Lanes,
        };
        let form = (TableFormat::Csv, false);
        Ok(measured(&Sweep::new(&job, way)?, &Threads::new(1)?, form))
    })
}

fn measured(sweep: &Sweep<'_>, threads: &Threads, form: (TableFormat, bool)) -> f64 {
    let rows = sweep.len();
    took(sweep, threads, 0..rows, form, MEASURED).row * rows as f64
}

/// Files of a folder that cannot be used, and why, in words.
fn told<'f>(
    out: &Path,
    broken: impl Iterator<Item = (&'f str, &'f str)>,
) -> impl Iterator<Item = String> {
    broken.map(|(name, why)| format!("{}: {why}", out.join(name).display()))
}

/// What is wrong with parts in a folder.
fn parts(out: &Path) -> impl Fn(PartsError) -> Ended {
    |error| {
        let help = match &error {
            PartsError::Other { .. } => {
                Some("write to another folder, or remove its folder `parts`".into())
            }
            PartsError::NoOrigin { .. } => {
                Some("every worker has to see this folder, under the same path".into())
            }
            error => error.help(),
        };
        match error {
            PartsError::Write { name, source } => {
                hyperstat_study::disk::OutputError::write(&out.join(name))(source).into()
            }
            error => Ended::Parts(format!("{}: {error}", out.display()), help),
        }
    }
}
