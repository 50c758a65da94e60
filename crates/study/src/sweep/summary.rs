//! How the rows of a job came out.

use hyperstat_mechanisms::Job;
use nalgebra::Matrix6;

use super::record::Record;

/// The outcome of rows of a job.
#[derive(Debug)]
pub struct Summary {
    /// Name of the job.
    pub job: String,
    /// Number of designs of a job that varies.
    pub designs: Option<usize>,
    /// Poses of a design.
    pub of_design: usize,
    /// First of the rows, from 0.
    pub first_row: usize,
    /// Number of rows: poses of all designs.
    pub poses: usize,
    /// Those without a result, by status.
    pub failures: Vec<Failures>,
    /// Stiffness of the output at the last pose that has one \[N/m, N/rad; N, N·m/rad\].
    pub stiffness: Option<Matrix6<f64>>,
}

/// The poses of one status.
#[derive(Debug, Clone)]
pub struct Failures {
    /// The word for it in a table.
    pub status: &'static str,
    /// How many there are.
    pub count: usize,
    /// Row of the first, from 0.
    pub first_pose: usize,
    /// Why the first has no result.
    pub why: String,
}

impl Summary {
    /// The summary of a job of which no row is solved yet, from this row on; 0 for all of them.
    pub fn new(job: &Job, first_row: usize) -> Self {
        Self {
            job: job.name.clone(),
            designs: (!job.varied().is_empty()).then(|| job.designs()),
            of_design: job.len(),
            first_row,
            poses: 0,
            failures: Vec::new(),
            stiffness: None,
        }
    }

    /// Counts the next rows.
    pub fn add(&mut self, records: &[Record]) {
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
                            first_pose: self.first_row + self.poses,
                            why: failure.in_words(),
                        }),
                    }
                }
            }
            self.poses += 1;
        }
    }

    /// Adds the rows of the same job that follow these.
    pub fn merge(&mut self, next: &Self) {
        self.poses += next.poses;
        for found in &next.failures {
            match self.failures.iter_mut().find(|f| f.status == found.status) {
                Some(failures) => failures.count += found.count,
                None => self.failures.push(found.clone()),
            }
        }
        self.stiffness = next.stiffness.or(self.stiffness);
    }

    /// Whether every pose has a result.
    pub fn is_complete(&self) -> bool {
        self.failures.is_empty()
    }
}
