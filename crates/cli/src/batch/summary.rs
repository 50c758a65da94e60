//! What `run` says about a job when it is done.

use std::fmt;
use std::path::PathBuf;

use hyperstat_mechanisms::Job;
use nalgebra::Matrix6;

use super::record::Record;
use super::statistics::{Report, Told};
use crate::report::{rows, stiffness_table};

/// The outcome of a job.
#[derive(Debug)]
pub(crate) struct Summary {
    job: String,
    /// Number of designs of a job that varies.
    designs: Option<usize>,
    /// Poses of a design.
    of_design: usize,
    /// Poses of all designs.
    poses: usize,
    failures: Vec<Failures>,
    /// Of the last pose that has one; told where it is the only pose.
    stiffness: Option<Matrix6<f64>>,
    files: Vec<PathBuf>,
    /// With the reason of each.
    figures_left_out: Vec<(String, String)>,
    largest_difference: Option<f64>,
    measures: Vec<Report>,
    warnings: Vec<String>,
}

/// The poses of one status.
#[derive(Debug)]
struct Failures {
    status: &'static str,
    count: usize,
    first_pose: usize,
    /// Why the first has no result.
    why: String,
}

impl Summary {
    /// The summary of a job of which no pose is solved yet.
    pub(crate) fn new(job: &Job) -> Self {
        Self {
            job: job.name.clone(),
            designs: (!job.varied().is_empty()).then(|| job.designs()),
            of_design: job.len(),
            poses: 0,
            failures: Vec::new(),
            stiffness: None,
            files: Vec::new(),
            figures_left_out: Vec::new(),
            largest_difference: None,
            measures: Vec::new(),
            warnings: Vec::new(),
        }
    }

    /// Counts the next poses.
    pub(crate) fn add(&mut self, records: &[Record]) {
        for record in records {
            match &record.result {
                Ok(found) => self.stiffness = Some(found.stiffness),
                Err(failure) => {
                    let status = failure.status();
                    match self.failures.iter_mut().find(|f| f.status == status) {
                        Some(failures) => failures.count += 1,
                        None => self.failures.push(Failures {
                            status,
                            count: 1,
                            first_pose: self.poses,
                            why: failure.in_words(),
                        }),
                    }
                }
            }
            self.poses += 1;
        }
    }

    /// Notes a file that was written.
    pub(crate) fn wrote(&mut self, path: PathBuf) {
        self.files.push(path);
    }

    /// Notes a figure that could not be drawn, and why.
    pub(crate) fn left_out(&mut self, figure: String, why: String) {
        self.figures_left_out.push((figure, why));
    }

    /// Notes how far the reference solver's points of a figure are off, relative to the largest
    /// displacement.
    pub(crate) fn compared(&mut self, difference: f64) {
        let largest = self.largest_difference.unwrap_or(0.0);
        self.largest_difference = Some(largest.max(difference));
    }

    /// Notes the measures over the workspace.
    pub(crate) fn measured(&mut self, measures: Vec<Report>) {
        self.measures = measures;
    }

    /// Notes what is hardly as it was meant.
    pub(crate) fn warned(&mut self, warnings: Vec<String>) {
        self.warnings.extend(warnings);
    }

    /// Whether every pose has a result.
    pub(crate) fn is_complete(&self) -> bool {
        self.failures.is_empty()
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = |count: usize, what: &str| match count {
            1 => format!("1 {what}"),
            count => format!("{count} {what}s"),
        };
        let mut poses = count(self.poses, "pose");
        if let Some(designs) = self.designs {
            poses = format!("{}, {poses}", count(designs, "design"));
        }
        let failed: usize = self.failures.iter().map(|failures| failures.count).sum();
        match failed {
            0 => writeln!(f, "{}: {poses}, all solved", self.job)?,
            _ => writeln!(f, "{}: {poses}, {failed} without a result", self.job)?,
        }
        for Failures {
            status,
            count,
            first_pose,
            why,
        } in &self.failures
        {
            let (design, pose) = (first_pose / self.of_design, first_pose % self.of_design);
            let design = match self.designs {
                Some(_) => format!("design {design}, "),
                None => String::new(),
            };
            writeln!(
                f,
                "  {count} {status}, the first of them {design}pose {pose}: {why}"
            )?;
        }
        for warning in &self.warnings {
            writeln!(f, "  warning: {warning}")?;
        }
        for path in &self.files {
            writeln!(f, "  {}", path.display())?;
        }
        for (figure, why) in &self.figures_left_out {
            writeln!(f, "  no {figure}: {why}")?;
        }
        if let Some(difference) = self.largest_difference {
            writeln!(
                f,
                "  largest difference from the reference solver in the figures: {difference:.1e} \
                 of the largest displacement"
            )?;
        }
        if !self.measures.is_empty() {
            write!(f, "{}", Told(&self.measures))?;
        }
        if let (1, Some(stiffness)) = (self.poses, &self.stiffness) {
            write!(
                f,
                "  stiffness of the output [N/m, N/rad; N, N·m/rad]\n{}",
                stiffness_table(&rows(stiffness))
            )?;
        }
        Ok(())
    }
}
