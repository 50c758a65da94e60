//! The files of a job's results, and those beside its table.

use std::path::{Path, PathBuf};

use hyperstat_mechanisms::{Batch, Job};

use super::origin::Options;
use crate::disk::{
    Destination, LONGER, LONGEST_NAME, OutputError, Room, refuse, write, write_figure,
};
use crate::figure::{self, Form};
use crate::plain::json;
use crate::ran::Ran;
use crate::sweep::{MeasureReport, Summary, Threads};
use crate::table::TableReader;

/// The outcome of a job and its files.
#[derive(Debug)]
pub struct Outcome {
    /// How its poses came out.
    pub summary: Summary,
    /// Of a part the first of its rows, and how many the job has.
    pub part: Option<(usize, usize)>,
    /// Files that were written.
    pub files: Vec<PathBuf>,
    /// Figures that could not be drawn, with the reason of each.
    pub left_out: Vec<(String, String)>,
    /// How far the reference solver's points of figures are off, relative to the largest
    /// displacement.
    pub largest_difference: Option<f64>,
    /// Measures over the workspace.
    pub measures: Vec<MeasureReport>,
    /// What is hardly as it was meant.
    pub warnings: Vec<String>,
}

impl Outcome {
    /// Of a job of which no figure is drawn yet.
    pub fn new(summary: Summary) -> Self {
        Self {
            summary,
            part: None,
            files: Vec::new(),
            left_out: Vec::new(),
            largest_difference: None,
            measures: Vec::new(),
            warnings: Vec::new(),
        }
    }

    /// Notes how far a figure's second method is off.
    fn compared(&mut self, difference: f64) {
        let largest = self.largest_difference.unwrap_or(0.0);
        self.largest_difference = Some(largest.max(difference));
    }
}

/// The files of a run's results.
#[derive(Debug)]
pub struct Results {
    out: PathBuf,
    options: Options,
}

impl Results {
    /// In this folder, of a run with these options.
    pub fn new(out: &Path, options: Options) -> Self {
        Self {
            out: out.into(),
            options,
        }
    }

    /// Their folder.
    pub fn out(&self) -> &Path {
        &self.out
    }

    /// Checks that all can have their names, and are no files that were read.
    ///
    /// # Errors
    /// The first that cannot, or is.
    pub fn check(&self, batch: &Batch) -> Result<(), OutputError> {
        let longest = Room::of(&self.out).map_or(LONGEST_NAME, |room| room.longest_name);
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
                    return Err(OutputError::NameTooLong {
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
        refuse(all.iter().map(|path| &**path), &batch.files())?;
        // What cannot be written is told before hours have gone.
        let taken = |path: &&PathBuf| path.is_dir();
        match all
            .iter()
            .find(taken)
            .map(|path| (path, Destination::of(path)))
        {
            Some((path, Err(source))) => Err(OutputError::Write {
                path: path.clone(),
                source,
            }),
            _ => Ok(()),
        }
    }

    /// The file of a job's table.
    pub fn table(&self, job: &Job) -> PathBuf {
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
        figure::names(job).flat_map(move |name| Form::files(&out.join(name), &forms))
    }

    /// Writes what is beside a job's table, which is there.
    ///
    /// # Errors
    /// What cannot be written.
    pub fn finish(&self, job: &Job, ran: Ran, threads: &Threads) -> Result<Outcome, OutputError> {
        let table = self.table(job);
        let trajectory = ran.trajectory.as_ref();
        let mut outcome = self.measured(job, &ran, table.clone())?;
        let forms = Form::all(self.options.pdf);
        threads.install(|| draw(job, trajectory, (&table, &forms), &mut outcome))?;
        Ok(outcome)
    }

    /// Writes the measures over a job's poses, whose table is or lies in `table`.
    ///
    /// # Errors
    /// They cannot be written.
    pub fn measured(&self, job: &Job, ran: &Ran, table: PathBuf) -> Result<Outcome, OutputError> {
        let mut outcome = Outcome::new(ran.summary.clone());
        outcome.files.push(table);
        outcome.warnings = ran.warnings(job);
        if let Some(found) = ran.measures(job) {
            let path = self.summary(job);
            let text = json(&found).map_err(|error| OutputError::write(&path)(error.into()))?;
            write(&path, text.as_bytes())?;
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
) -> Result<(), OutputError> {
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
        match write_figure(&drawing, &table.with_file_name(&name), forms) {
            Ok(paths) => outcome.files.extend(paths),
            // One that cannot be drawn is as one without a result: the run goes on.
            Err(OutputError::Figure { source, .. }) => {
                outcome.left_out.push((name, source.to_string()));
            }
            Err(error) => return Err(error),
        }
    }
    Ok(())
}
