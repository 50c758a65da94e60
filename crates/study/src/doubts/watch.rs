//! What a sweep tells: its output at every pose, and all of the mechanism at the first that has a
//! result.

use hyperstat_mechanisms::Job;
use nalgebra::Vector6;

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
    first: Option<usize>,
    moved: (f64, Option<(usize, Vector6<f64>)>),
    turned: (f64, Option<(usize, Vector6<f64>)>),
}

impl Watch {
    /// Of a job of which no pose is solved yet.
    pub fn new(job: &Job) -> Self {
        Self {
            poses: job.len(),
            varies: !job.varied().is_empty(),
            first: None,
            moved: (0.0, None),
            turned: (0.0, None),
        }
    }

    /// Sees the output's displacement in a row of the job's table.
    pub fn see(&mut self, row: usize, displacement: &Vector6<f64>) {
        if row < self.poses {
            self.first.get_or_insert(row);
        }
        let parts = [(&mut self.moved, 0), (&mut self.turned, 3)];
        for (largest, first) in parts {
            let size = displacement.fixed_rows::<3>(first).norm();
            if size > largest.0 {
                *largest = (size, Some((row, *displacement)));
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
        for (row, displacement) in [&self.moved.1, &self.turned.1].into_iter().flatten() {
            findings.displaced(displacement, output, &self.at(*row));
        }
        if let Some(pose) = self.first
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
