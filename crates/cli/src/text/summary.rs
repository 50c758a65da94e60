//! What `run` says about a job when it is done.

use std::fmt;
use std::path::PathBuf;

use hyperstat_study::sweep::{Failures, MeasureReport, Summary};

use super::parts::stiffness_table;
use super::statistics::Told;

/// The outcome of a job and its files.
#[derive(Debug)]
pub(crate) struct Outcome {
    /// How its poses came out.
    pub(crate) summary: Summary,
    /// Of a part the first of its rows, and how many the job has.
    pub(crate) part: Option<(usize, usize)>,
    /// Files that were written.
    pub(crate) files: Vec<PathBuf>,
    /// Figures that could not be drawn, with the reason of each.
    pub(crate) left_out: Vec<(String, String)>,
    /// How far the reference solver's points of figures are off, relative to the largest
    /// displacement.
    pub(crate) largest_difference: Option<f64>,
    /// Measures over the workspace.
    pub(crate) measures: Vec<MeasureReport>,
    /// What is hardly as it was meant.
    pub(crate) warnings: Vec<String>,
}

impl Outcome {
    /// Of a job of which no figure is drawn yet.
    pub(crate) fn new(summary: Summary) -> Self {
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
    pub(crate) fn compared(&mut self, difference: f64) {
        let largest = self.largest_difference.unwrap_or(0.0);
        self.largest_difference = Some(largest.max(difference));
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = |count: usize, what: &str| match count {
            1 => format!("1 {what}"),
            count => format!("{count} {what}s"),
        };
        let mut poses = count(self.summary.poses, "pose");
        if let Some(designs) = self.summary.designs {
            poses = format!("{}, {poses}", count(designs, "design"));
        }
        if let Some((first, all)) = self.part {
            let end = first + self.summary.poses;
            poses = match self.summary.poses {
                0 => format!("none of its {all} rows"),
                _ => format!("rows {first}..{end} of {all}"),
            };
        }
        let failed: usize = self
            .summary
            .failures
            .iter()
            .map(|failures| failures.count)
            .sum();
        match failed {
            0 => writeln!(f, "{}: {poses}, all solved", self.summary.job)?,
            _ => writeln!(
                f,
                "{}: {poses}, {failed} without a result",
                self.summary.job
            )?,
        }
        for Failures {
            status,
            count,
            first_pose,
            why,
        } in &self.summary.failures
        {
            let (design, pose) = (
                first_pose / self.summary.of_design,
                first_pose % self.summary.of_design,
            );
            let design = match self.summary.designs {
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
        for (figure, why) in &self.left_out {
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
        if let (1, Some(stiffness)) = (self.summary.poses, &self.summary.stiffness) {
            write!(
                f,
                "  stiffness of the output [N/m, N/rad; N, N·m/rad]\n{}",
                stiffness_table(&std::array::from_fn(|r| stiffness
                    .row(r)
                    .into_owned()
                    .into()))
            )?;
        }
        Ok(())
    }
}
