//! `hyperstat merge`: parts of a run, joined.

use hyperstat_mechanisms::Registry;
use hyperstat_study::parts::{Folder, Origin, Results, Work, hashes, sweeps_of};
use hyperstat_study::sweep::Threads;

use super::note;
use crate::args;
use crate::error::CliError;
use crate::signals::Signals;
use crate::text::Said;

/// Joins the parts of a run. `tell` gets the summary of every job, or what is missing.
///
/// Returns whether every pose has a result.
pub(crate) fn merge(
    args: &args::Merge,
    registry: &Registry,
    mut tell: impl FnMut(&str) -> Result<(), CliError>,
) -> Result<bool, CliError> {
    let failed = CliError::parts(&args.out);
    let shelf = Folder::new(&args.out);
    let hash = hashes(&shelf).map_err(&failed)?;
    let origin = Origin::read(&shelf, &hash).map_err(&failed)?;
    let options = origin.options();
    if args.dataset && !options.parquet {
        return Err(CliError::NoDataset {
            out: args.out.clone(),
        });
    }
    let batch = origin.batch(registry)?;
    let sweeps = sweeps_of(&batch, options.way())?;
    let results = Results::new(&args.out, options);
    results.check(&batch)?;
    let threads = Threads::new(args.threads)?;
    let signals = Signals::heard();
    let stop = || signals.came();
    let work = Work::of_parts(&shelf, &origin, &threads, &stop);
    let (all, missing) = work.gather(&sweeps, args.dataset).map_err(&failed)?;
    for (name, why) in all.iter().flat_map(|found| found.broken()) {
        note(&format!("{}: {why}", args.out.join(name).display()));
    }
    if !missing.is_empty() {
        let lines = missing.arguments().into_iter();
        tell(&lines.map(|line| line + "\n").collect::<String>())?;
        return Err(CliError::Missing {
            out: args.out.clone(),
            rows: missing.rows(),
        });
    }
    let mut complete = true;
    for (sweep, found) in sweeps.iter().zip(all) {
        let job = sweep.job();
        let ran = work.merge(sweep, found, args.dataset).map_err(&failed)?.ran;
        let outcome = match args.dataset {
            true => results.measured(job, &ran, args.out.join("parts").join(&job.name))?,
            false => results.finish(job, ran, &threads)?,
        };
        complete &= outcome.summary.is_complete();
        tell(&Said(&outcome).to_string())?;
    }
    Ok(complete)
}
