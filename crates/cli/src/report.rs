//! `hyperstat report`: a page of everything.

use hyperstat_mechanisms::{Disk, Job, Registry};
use hyperstat_study::disk;
use hyperstat_study::sweep::Threads;
use hyperstat_study::{Input, Page, Selection, Study, StudyError};

use crate::args::Report;
use crate::error::CliError;

/// Poses that are looked at for one that the mechanism can take.
const LOOKED_AT: usize = 1000;

/// The page, which goes to standard output where it is not written to a file.
pub(crate) fn run(args: &Report, registry: &Registry) -> Result<Option<String>, CliError> {
    let path = &args.input.file;
    let loaded = hyperstat_mechanisms::load(path, &Disk, registry)?;
    let read = loaded.files();
    disk::refuse(args.out.as_deref(), &read)?;
    let focus = args.dwelling.focus();
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let mut page = Page::new(args.title.clone().unwrap_or_else(|| name.into_owned()));
    let selection = args.input.selection();
    match loaded {
        Input::Mechanism(_) => page.add_study(&mut Study::of(loaded, path, &selection)?, &focus)?,
        Input::Batch(batch) => {
            let threads = Threads::new(args.threads)?;
            let is_chosen =
                |name: &str| selection.job.as_deref().is_none_or(|chosen| chosen == name);
            if let Some(job) = selection
                .job
                .as_ref()
                .filter(|_| !batch.jobs.iter().any(|job| is_chosen(&job.name)))
            {
                return Err(CliError::from(StudyError::UnknownJob {
                    path: path.clone(),
                    job: job.clone(),
                    known: batch.jobs.iter().map(|job| job.name.clone()).collect(),
                }));
            }
            for job in batch.jobs.into_iter().filter(|job| is_chosen(&job.name)) {
                let Selection { design, pose, .. } = selection;
                let design = design.unwrap_or_else(|| job.first_design());
                let study = match pose {
                    Some(pose) => Some(Study::of_job(job.clone(), design, pose)?),
                    None => first_in_reach(&job, design)?,
                };
                page.add_job(&job, &threads)?;
                if let Some(mut study) = study {
                    page.add_study(&mut study, &focus)?;
                }
            }
        }
    }
    page.add_files(&read, &Disk);
    let html = page.html();
    let Some(out) = &args.out else {
        return Ok(Some(html));
    };
    disk::write(out, html.as_bytes())?;
    Ok(None)
}

/// A design of a job at the first of its poses that it can take; `None` where that is none of those that are
/// looked at. What is chosen wrongly is told before the job is run.
fn first_in_reach(job: &Job, design: usize) -> Result<Option<Study>, StudyError> {
    for pose in 0..job.len().min(LOOKED_AT) {
        match Study::of_job(job.clone(), design, pose) {
            // Its table says so.
            Err(StudyError::Pose { .. }) => {}
            other => return other.map(Some),
        }
    }
    Ok(None)
}
