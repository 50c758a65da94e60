//! The files of a job's results, and those beside its table.

use std::path::{Path, PathBuf};

use hyperstat_mechanisms::{Batch, Job};
use hyperstat_study::parts::Options;
use hyperstat_study::sweep::Threads;
use hyperstat_study::table::TableReader;
use hyperstat_study::{Ran, figure};

use crate::atomic::LONGER;
use crate::destination::Destination;
use crate::disk::{Disk, LONGEST_NAME};
use crate::error::CliError;
use crate::json::json;
use crate::plot::Form;
use crate::text::Outcome;
use crate::{outputs, plot};

/// The files of a run's results.
pub(super) struct Results {
    out: PathBuf,
    options: Options,
}

impl Results {
    pub(super) fn new(out: &Path, options: Options) -> Self {
        Self {
            out: out.into(),
            options,
        }
    }

    /// Their folder.
    pub(super) fn out(&self) -> &Path {
        &self.out
    }

    /// Checks that all can have their names, and are no files that were read.
    pub(super) fn check(&self, batch: &Batch) -> Result<(), CliError> {
        let longest = Disk::of(&self.out).map_or(LONGEST_NAME, |disk| disk.longest_name);
        let mut all = Vec::new();
        for job in &batch.jobs {
            let table = self.table(job);
            let summary = self.options.summary.then(|| self.summary(job));
            let mut files: Vec<PathBuf> = self.figures(job).chain(summary).collect();
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
        outputs::refuse(all.iter().map(|path| &**path), &batch.files())?;
        // What cannot be written is told before hours have gone.
        let taken = |path: &&PathBuf| path.is_dir();
        match all
            .iter()
            .find(taken)
            .map(|path| (path, Destination::of(path)))
        {
            Some((path, Err(source))) => Err(CliError::Write {
                path: path.clone(),
                source,
            }),
            _ => Ok(()),
        }
    }

    /// The file of a job's table.
    pub(super) fn table(&self, job: &Job) -> PathBuf {
        let extension = self.options.format().extension();
        self.out.join(format!("{}.{extension}", job.name))
    }

    /// The file of a job's measures over its poses.
    fn summary(&self, job: &Job) -> PathBuf {
        self.out.join(format!("{}-summary.json", job.name))
    }

    /// The files of a job's figures, beside its table.
    fn figures(&self, job: &Job) -> impl Iterator<Item = PathBuf> {
        let (out, forms) = (self.out.clone(), Form::all(self.options.pdf));
        figure::names(job).flat_map(move |name| plot::files(&out.join(name), &forms))
    }

    /// Writes what is beside a job's table, which is there.
    pub(super) fn finish(
        &self,
        job: &Job,
        ran: Ran,
        threads: &Threads,
    ) -> Result<Outcome, CliError> {
        let table = self.table(job);
        let trajectory = ran.trajectory.as_ref();
        let mut outcome = self.measured(job, &ran, table.clone())?;
        let forms = Form::all(self.options.pdf);
        threads.install(|| draw(job, trajectory, (&table, &forms), &mut outcome))?;
        Ok(outcome)
    }

    /// Writes the measures over a job's poses, whose table is or lies in `table`.
    pub(super) fn measured(
        &self,
        job: &Job,
        ran: &Ran,
        table: PathBuf,
    ) -> Result<Outcome, CliError> {
        let mut outcome = Outcome::new(ran.summary.clone());
        outcome.files.push(table);
        outcome.warnings = ran.warnings(job);
        if let Some(found) = ran.measures(job) {
            let path = self.summary(job);
            outputs::write(&path, json(&found)?.as_bytes())?;
            outcome.files.push(path);
            outcome.measures = found;
        }
        Ok(outcome)
    }
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
