//! What a run of a job finds beside its table: how poses came out, measures over them, what is hardly meant,
//! and what its figures need.

use hyperstat_mechanisms::Job;
#[cfg(feature = "parts")]
use serde::{Deserialize, Serialize};

use crate::doubts::Watch;
use crate::figure::Trajectory;
use crate::sweep::{Chunk, MeasureReport, Statistics, Summary, measure};

/// What a run of a job finds beside its table, chunk by chunk in the order of the rows.
#[derive(Debug)]
pub struct Ran {
    /// How its poses came out.
    pub summary: Summary,
    /// Commanded and deflected trajectory, where a figure needs it.
    pub trajectory: Option<Trajectory>,
    watch: Watch,
    statistics: Option<Statistics>,
}

impl Ran {
    /// Of a job of which no pose is solved yet, with or without measures over its poses.
    pub fn new(job: &Job, measured: bool) -> Self {
        Self::from_row(job, 0, measured)
    }

    /// The same of the rows from this one on.
    pub fn from_row(job: &Job, first: usize, measured: bool) -> Self {
        Self {
            summary: Summary::new(job, first),
            trajectory: Trajectory::wanted_by(job),
            watch: Watch::new(job),
            statistics: measured.then(|| Statistics::of(job)),
        }
    }

    /// What can be done for measured chunks before their turn, on any thread.
    pub fn measure(chunk: &mut Chunk) {
        chunk.measures.extend(chunk.records.iter().map(measure));
    }

    /// Sees the next rows; measured ones where it is measured.
    pub fn see(&mut self, chunk: &Chunk) {
        self.summary.add(&chunk.records);
        let rows = || chunk.rows.clone().zip(&chunk.records);
        for (row, record) in rows() {
            if let Ok(found) = &record.result {
                self.watch.see(row, &found.displacement);
            }
        }
        if let Some(statistics) = &mut self.statistics {
            for ((row, record), values) in rows().zip(&chunk.measures) {
                if let Some(values) = values {
                    statistics.add(row, &record.pose, values);
                }
            }
            for (row, record) in rows() {
                statistics.add_asked(row, record);
            }
        }
        if let Some(trajectory) = &mut self.trajectory {
            trajectory.add(chunk.rows.start, &chunk.records);
        }
    }

    /// The measures over the poses; `None` where they are not measured, or no pose has a result.
    pub fn measures(&self, job: &Job) -> Option<Vec<MeasureReport>> {
        self.statistics.as_ref()?.report_of(job)
    }

    /// What is hardly as it was meant.
    pub fn warnings(&self, job: &Job) -> Vec<String> {
        self.watch.warnings(job)
    }
}

/// The same, as a part of a run keeps it.
#[cfg(feature = "parts")]
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Kept {
    summary: crate::sweep::KeptSummary,
    watch: crate::doubts::Seen,
    #[serde(skip_serializing_if = "Option::is_none")]
    trajectory: Option<crate::figure::Path>,
    #[serde(skip_serializing_if = "Option::is_none")]
    statistics: Option<Statistics>,
}

#[cfg(feature = "parts")]
impl Ran {
    /// All of it, to be kept.
    pub(crate) fn keep(self) -> Kept {
        Kept {
            summary: self.summary.keep(),
            watch: self.watch.seen().clone(),
            trajectory: self.trajectory.map(|of| of.path().clone()),
            statistics: self.statistics,
        }
    }

    /// Adds what was found of the rows of the same job that follow.
    pub(crate) fn add(&mut self, later: &Kept) {
        self.summary.add_kept(&later.summary);
        self.watch.merge(&later.watch);
        if let (Some(own), Some(later)) = (&mut self.trajectory, &later.trajectory) {
            own.merge(later);
        }
        if let (Some(own), Some(later)) = (&mut self.statistics, &later.statistics) {
            own.merge(later);
        }
    }
}

#[cfg(feature = "parts")]
impl Kept {
    /// How many rows came out how.
    pub(crate) fn statuses(&self) -> std::collections::BTreeMap<String, usize> {
        self.summary.statuses()
    }
}
