//! How the rows of a job came out.

#[cfg(feature = "parts")]
use std::collections::BTreeMap;

use hyperstat_mechanisms::Job;
use nalgebra::Matrix6;
#[cfg(feature = "parts")]
use serde::{Deserialize, Serialize};

#[cfg(feature = "parts")]
use super::record::Failure;
use super::record::Record;

/// The outcome of rows of a job.
#[derive(Debug, Clone)]
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

/// A status that a table may hold.
#[cfg(feature = "parts")]
#[derive(Debug, Clone, Copy, Serialize)]
struct Status(&'static str);

#[cfg(feature = "parts")]
impl<'de> Deserialize<'de> for Status {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let word = String::deserialize(deserializer)?;
        let known = Failure::STATUSES.into_iter().find(|known| *known == word);
        let missing = || serde::de::Error::custom(format!("there is no status `{word}`"));
        known.map(Self).ok_or_else(missing)
    }
}

/// The outcome of rows, as a part of a run keeps it.
#[cfg(feature = "parts")]
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct KeptSummary {
    first_row: usize,
    poses: usize,
    failures: Vec<KeptFailures>,
    /// By columns.
    stiffness: Option<Vec<f64>>,
}

#[cfg(feature = "parts")]
#[derive(Debug, Serialize, Deserialize)]
struct KeptFailures {
    status: Status,
    count: usize,
    first_pose: usize,
    why: String,
}

#[cfg(feature = "parts")]
impl Summary {
    /// All of it, to be kept.
    pub(crate) fn keep(&self) -> KeptSummary {
        let failures = self.failures.iter().map(|of| KeptFailures {
            status: Status(of.status),
            count: of.count,
            first_pose: of.first_pose,
            why: of.why.clone(),
        });
        KeptSummary {
            first_row: self.first_row,
            poses: self.poses,
            failures: failures.collect(),
            stiffness: self.stiffness.map(|k| k.as_slice().to_vec()),
        }
    }

    /// Adds the rows of the same job that follow these.
    pub(crate) fn add_kept(&mut self, kept: &KeptSummary) {
        let failures = kept.failures.iter().map(|of| Failures {
            status: of.status.0,
            count: of.count,
            first_pose: of.first_pose,
            why: of.why.clone(),
        });
        let stiffness = kept.stiffness.as_ref().filter(|k| k.len() == 36);
        let next = Self {
            job: self.job.clone(),
            designs: self.designs,
            of_design: self.of_design,
            first_row: kept.first_row,
            poses: kept.poses,
            failures: failures.collect(),
            stiffness: stiffness.map(|k| Matrix6::from_column_slice(k)),
        };
        self.merge(&next);
    }
}

#[cfg(feature = "parts")]
impl KeptSummary {
    /// Number of rows by status.
    pub(crate) fn statuses(&self) -> BTreeMap<String, usize> {
        let failed: usize = self.failures.iter().map(|of| of.count).sum();
        let ok = ("ok".to_string(), self.poses.saturating_sub(failed));
        let failures = self
            .failures
            .iter()
            .map(|of| (of.status.0.to_string(), of.count));
        [ok].into_iter().chain(failures).collect()
    }
}
