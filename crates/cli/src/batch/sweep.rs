//! A job's poses, solved on all threads, with their results handed out in order.

use std::ops::Range;

use hyperstat_assembly::{Geometry, Model, Plan, SolveError, Workspace};
use hyperstat_mechanisms::{Job, PoseError};
use rayon::prelude::*;

use super::row::{self, Failure, Found, Record};

/// Most poses that a thread solves before results are handed out.
const PART: usize = 256;

/// A job whose topology is worked out.
#[derive(Debug)]
pub(crate) struct Sweep<'a> {
    job: &'a Job,
    /// The model in some configuration and its plan; an error where no pose can be reached.
    ready: Result<(Model, Plan), PoseError>,
}

/// One thread's solver, and what it found in its part of a block.
struct Worker<'a> {
    /// An error where no pose can be reached.
    solver: Result<Solver<'a>, PoseError>,
    records: Vec<Record>,
    text: String,
}

/// The sweep's model and plan with one thread's own buffers.
struct Solver<'a> {
    model: &'a Model,
    plan: &'a Plan,
    geometry: Geometry,
    workspace: Workspace,
}

impl<'a> Sweep<'a> {
    /// Works out the topology of a job.
    ///
    /// # Errors
    /// The model, and why no pose of it can be solved.
    pub(crate) fn new(job: &'a Job) -> Result<Self, Box<(Model, SolveError)>> {
        let ready = match job.model() {
            Err(error) => Err(error),
            Ok(model) => match Plan::new(&model) {
                Err(error) => return Err(Box::new((model, error))),
                Ok(plan) => Ok((model, plan)),
            },
        };
        Ok(Self { job, ready })
    }

    /// The job.
    pub(crate) fn job(&self) -> &'a Job {
        self.job
    }

    /// Solves all poses. `take` gets, in the order of the poses, a few poses' records and their
    /// lines of CSV at a time; memory does not grow with the number of poses.
    ///
    /// # Errors
    /// The first error of `take`, which ends the sweep.
    pub(crate) fn run<E>(
        &self,
        mut take: impl FnMut(&[Record], &str) -> Result<(), E>,
    ) -> Result<(), E> {
        let count = self.job.len();
        let threads = rayon::current_num_threads();
        let part = count.div_ceil(threads).clamp(1, PART);
        let mut workers: Vec<_> = (0..threads).map(|_| self.worker()).collect();
        for start in (0..count).step_by(part * threads) {
            workers.par_iter_mut().enumerate().for_each(|(k, worker)| {
                let first = (start + k * part).min(count);
                let last = (first + part).min(count);
                worker.solve(self.job, first..last);
            });
            for worker in &workers {
                take(&worker.records, &worker.text)?;
            }
        }
        Ok(())
    }

    fn worker(&self) -> Worker<'_> {
        let solver = self.ready.as_ref().map(|(model, plan)| Solver {
            model,
            plan,
            geometry: model.geometry().clone(),
            workspace: plan.workspace(),
        });
        Worker {
            solver: solver.map_err(PoseError::clone),
            records: Vec::new(),
            text: String::new(),
        }
    }
}

impl Worker<'_> {
    fn solve(&mut self, job: &Job, poses: Range<usize>) {
        self.records.clear();
        self.text.clear();
        for pose in poses {
            let record = self.solve_pose(job, pose).unwrap_or_else(|error| Record {
                pose: job.target(pose),
                result: Err(Failure::Pose(error)),
            });
            row::append(&mut self.text, pose, &record);
            self.records.push(record);
        }
    }

    fn solve_pose(&mut self, job: &Job, pose: usize) -> Result<Record, PoseError> {
        let solver = self.solver.as_mut().map_err(|error| error.clone())?;
        let placed = job.place(pose, &mut solver.geometry)?;
        let result = solver
            .plan
            .sweep(solver.model, &solver.geometry, &mut solver.workspace);
        Ok(Record {
            pose: placed,
            result: result.map_err(Failure::Solve).and_then(Found::try_from),
        })
    }
}
