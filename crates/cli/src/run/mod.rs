//! `hyperstat run` and `hyperstat merge`: every job of a batch, or a part of each, to tables and figures.

mod dry;
mod merge;

use std::fs;

use hyperstat_mechanisms::{Disk, Registry};
use hyperstat_study::disk::OutputError;
use hyperstat_study::parts::{
    Done, Folder, Found, Origin, Outcome, Part, PartsError, Reading, Results, Share, Work,
    sweeps_of,
};
use hyperstat_study::sweep::{Sweep, Threads};
use indicatif::{ProgressBar, ProgressStyle};

use crate::args::Shard;
use crate::error::CliError;
use crate::signals::Signals;
use crate::text::Said;
use crate::{args, consent, terminal};
pub(crate) use merge::merge;

/// Runs a batch. `tell` gets the summary of every job; what it fails with ends no run, since the
/// results are files.
///
/// Returns whether every pose has a result.
pub(crate) fn run(
    args: &args::Run,
    registry: &Registry,
    mut tell: impl FnMut(&str) -> Result<(), CliError>,
) -> Result<bool, CliError> {
    let reading = Reading::of(&Disk);
    let batch = hyperstat_mechanisms::load_batch(&args.file, &reading, registry)?;
    let options = args.options();
    let sweeps = sweeps_of(&batch, options.way())?;
    let part = part_of(args, &sweeps)?;
    let threads = Threads::new(args.threads)?;
    if args.dry_run {
        tell(&dry::told(&sweeps, &part, &threads, args))?;
        return Ok(true);
    }
    let results = Results::new(&args.out, options);
    results.check(&batch)?;
    consent::ask(&sweeps, &part, args)?;
    fs::create_dir_all(&args.out).map_err(OutputError::write(&args.out))?;
    let signals = Signals::heard();
    let work = Work {
        shelf: &Folder::new(&args.out),
        origin: &Origin::new(&args.file, &batch, &reading, options),
        part,
        threads: &threads,
        secured_every: args.secure,
        stop: &|| signals.came(),
    };
    let found = look(&work, &sweeps, args)?;
    let rows = found.iter().map(|found| found.rows().len() as u64);
    let rows = rows.fold(0, u64::saturating_add);
    let bar = progress_bar(rows);
    let mut complete = true;
    let mut told = Ok(());
    for (sweep, found) in sweeps.iter().zip(found) {
        let outcome = run_job(&work, sweep, found, &results, &bar);
        let outcome = outcome.inspect_err(|_| {
            bar.finish_and_clear();
            let kept = args.out.join("parts").join(&sweep.job().name);
            if kept.is_dir() {
                let kept = kept.display();
                note(&format!(
                    "what was done is kept in {kept}; the same command goes on from there"
                ));
            }
        })?;
        // A bar that is finished says that all is done.
        let done = bar.position();
        let Some(outcome) = outcome.filter(|_| done == rows || !signals.came()) else {
            bar.finish_and_clear();
            return Err(CliError::Interrupted {
                done,
                rows,
                out: args.out.clone(),
            });
        };
        complete &= outcome.summary.is_complete();
        told = told.and(bar.suspend(|| tell(&Said(&outcome).to_string())));
    }
    bar.finish_and_clear();
    told.map(|()| complete)
}

/// The rows that are asked for.
fn part_of(args: &args::Run, sweeps: &[Sweep<'_>]) -> Result<Part, CliError> {
    if let Some(shard) = args.shard {
        let share = match shard {
            Shard::Of(share) => share,
            Shard::Auto => {
                let found = Share::of_slurm(|name| std::env::var(name).ok());
                found.map_err(CliError::NoTask)?
            }
        };
        return Ok(Part::Share(share));
    }
    let Some(rows) = &args.rows else {
        return Ok(Part::Whole);
    };
    let longest = sweeps.iter().max_by_key(|sweep| sweep.len());
    let count = longest.map_or(0, Sweep::len);
    if rows.end > count {
        return Err(CliError::NoRows {
            row: rows.start.max(count),
            job: longest.map_or_else(String::new, |sweep| sweep.job().name.clone()),
            count,
            there: (rows.start < count).then_some(rows.start..count),
        });
    }
    Ok(Part::Rows(rows.clone()))
}

/// Looks up what is there of all jobs before the first is run.
fn look(work: &Work<'_>, sweeps: &[Sweep<'_>], args: &args::Run) -> Result<Vec<Found>, CliError> {
    let failed = CliError::parts(&args.out);
    if args.fresh {
        sweeps
            .iter()
            .try_for_each(|sweep| work.clear(sweep))
            .map_err(&failed)?;
    }
    let look = |sweep| work.look(sweep, args.fresh);
    let found: Vec<Found> = sweeps
        .iter()
        .map(look)
        .collect::<Result<_, _>>()
        .map_err(&failed)?;
    for (sweep, found) in sweeps.iter().zip(&found) {
        let job = &sweep.job().name;
        for (name, why) in found.broken() {
            let path = args.out.join(name);
            note(&format!(
                "{}: {why}; its rows are computed again",
                path.display()
            ));
        }
        if let Some(difference) = found.replaces(work.shelf, work.origin) {
            let out = args.out.display();
            note(&format!(
                "{out} has the table of another run of `{job}`, which is replaced: {difference}"
            ));
        }
        match (found.taken(), found.rows().len()) {
            (0, _) => {}
            (taken, all) if taken == all => note(&format!(
                "all rows of `{job}` were computed before, from the same files and options; `--fresh` \
                 computes them anew"
            )),
            (taken, all) => note(&format!(
                "{taken} of {all} rows of `{job}` were computed before"
            )),
        }
    }
    Ok(found)
}

/// Says something that is no result.
fn note(text: &str) {
    // Nothing is left to be told where standard error is closed.
    let _ = terminal::note(text);
}

/// Writes a job's table and its figures, or a part of its rows; `None` where it was stopped on the way.
fn run_job(
    work: &Work<'_>,
    sweep: &Sweep<'_>,
    found: Found,
    results: &Results,
    bar: &ProgressBar,
) -> Result<Option<Outcome>, CliError> {
    let job = sweep.job();
    bar.set_message(job.name.clone());
    let taken = found.taken();
    bar.inc(taken as u64);
    let advance = &mut |rows: usize| bar.inc(rows as u64);
    let done = match work.run(sweep, found, advance) {
        Err(PartsError::Stopped) => return Ok(None),
        done => done.map_err(CliError::parts(results.out()))?,
    };
    if done.is_stopped() {
        return Ok(None);
    }
    if work.part == Part::Whole {
        bar.set_message(format!("{}: figures", job.name));
        return Ok(Some(results.finish(job, done.ran, work.threads)?));
    }
    let Done { ran, rows, .. } = done;
    let warnings = ran.warnings(job);
    let mut outcome = Outcome::new(ran.summary);
    outcome.part = Some((rows.start, sweep.len()));
    outcome.warnings = warnings;
    if !rows.is_empty() {
        outcome
            .files
            .push(results.out().join(work.table_name(sweep)));
    }
    Ok(Some(outcome))
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
    use hyperstat_study::parts::{Options, Origin, Part, Reading, Work};
    use hyperstat_study::sweep::Way;
    use indicatif::{ProgressBar, ProgressStyle};

    use super::{Folder, Results, Threads, run_job, sweeps_of};

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
        let sweeps = sweeps_of(&batch, Way::Lanes).unwrap();
        let out = std::env::temp_dir().join(format!("hyperstat-bar-{}", std::process::id()));
        std::fs::create_dir_all(&out).unwrap();
        let threads = Threads::new(3).unwrap();
        let bar = ProgressBar::hidden();
        bar.set_length(sweeps[0].len() as u64);
        let options = Options {
            parquet: true,
            summary: false,
            pdf: false,
            one_by_one: false,
        };
        let path = Path::new("line.ron");
        let work = Work {
            shelf: &Folder::new(&out),
            origin: &Origin::new(path, &batch, &Reading::of(&Disk), options),
            part: Part::Whole,
            threads: &threads,
            secured_every: std::time::Duration::from_secs(60),
            stop: &|| false,
        };
        let found = work.look(&sweeps[0], false).unwrap();
        let results = Results::new(&out, options);
        let outcome = run_job(&work, &sweeps[0], found, &results, &bar)
            .unwrap()
            .unwrap();
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
