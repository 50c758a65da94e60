//! What a sweep tells: its output at every pose, and all of the mechanism at the first that has a
//! result.

use hyperstat_mechanisms::Job;
use nalgebra::Vector6;
use serde::{Deserialize, Serialize};

use super::of_model;
use super::result::Findings;
use crate::near::of_mechanism;
use crate::study::job_model;

/// The largest displacement of a job's output, and the first pose of the first design that has a
/// result.
#[derive(Debug)]
pub struct Watch {
    /// Rows of a design.
    poses: usize,
    /// Whether rows are of several designs.
    varies: bool,
    seen: Seen,
}

/// What of rows is needed for warnings; that of parts of the rows merges to that of the whole.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct Seen {
    first: Option<usize>,
    /// The largest sizes, and the first rows that have them with their displacements.
    moved: (f64, Option<(usize, [f64; 6])>),
    turned: (f64, Option<(usize, [f64; 6])>),
}

impl Watch {
    /// Of a job of which no pose is solved yet.
    pub fn new(job: &Job) -> Self {
        Self {
            poses: job.len(),
            varies: !job.varied().is_empty(),
            seen: Seen::default(),
        }
    }

    /// What was seen so far.
    #[cfg(feature = "parts")]
    pub(crate) fn seen(&self) -> &Seen {
        &self.seen
    }

    /// Adds what was seen of later rows of the same job.
    #[cfg(feature = "parts")]
    pub(crate) fn merge(&mut self, later: &Seen) {
        let own = &mut self.seen;
        own.first = own.first.or(later.first);
        for (largest, other) in [
            (&mut own.moved, &later.moved),
            (&mut own.turned, &later.turned),
        ] {
            if other.0 > largest.0 {
                *largest = *other;
            }
        }
    }

    /// Sees the output's displacement in a row of the job's table.
    pub fn see(&mut self, row: usize, displacement: &Vector6<f64>) {
        if row < self.poses {
            self.seen.first.get_or_insert(row);
        }
        let parts = [(&mut self.seen.moved, 0), (&mut self.seen.turned, 3)];
        for (largest, first) in parts {
            let size = displacement.fixed_rows::<3>(first).norm();
            if size > largest.0 {
                *largest = (size, Some((row, (*displacement).into())));
            }
        }
    }

    /// What is hardly as it was meant in the job, a sentence each.
    pub fn warnings(&self, job: &Job) -> Vec<String> {
        let Ok(model) = job.model() else {
            return Vec::new();
        };
        let near = job.mechanism().and_then(of_mechanism);
        let mut told: Vec<String> = near.into_iter().chain(of_model(&model)).collect();
        let mut findings = Findings::of(&model);
        let output = || {
            let output = model.output().map(|node| model.node_name(node));
            format!("`{}`", output.unwrap_or_default())
        };
        let largest = [self.seen.moved.1, self.seen.turned.1];
        for (row, displacement) in largest.into_iter().flatten() {
            findings.displaced(&Vector6::from(displacement), output, &self.at(row));
        }
        if let Some(pose) = self.seen.first
            && let Ok(model) = job_model(job, pose)
            && let Ok(solution) = hyperstat_assembly::solve(&model)
        {
            findings.add(&model, &solution, &self.at(pose));
        }
        told.extend(findings.in_words());
        told
    }

    /// A row in words.
    fn at(&self, row: usize) -> String {
        let (design, pose) = (row / self.poses, row % self.poses);
        match (self.varies, self.poses) {
            (true, _) => format!(" in design {design}, pose {pose}"),
            (false, 1) => String::new(),
            (false, _) => format!(" in pose {pose}"),
        }
    }
}
