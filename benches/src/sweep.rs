//! A job's poses by every method that there is.

use std::hint::black_box;
use std::time::{Duration, Instant};

use hyperstat_assembly::{Geometry, LANES, Lanes, Model, Prepared, Workspace};
use hyperstat_mechanisms::{Design, Job, Placing};
use hyperstat_reference::{TraditionalForm, TraditionalOptions, traditional};
use hyperstat_study::sweep::{Poser, placing};
use hyperstat_study::{Study, Target};

/// Springs for what is rigid or free, as good as they get on the delta.
const SPRINGS: TraditionalOptions = TraditionalOptions {
    form: TraditionalForm::Penalty,
    joint_stiffness: 1e13,
    angular_stiffness: 1e13,
    free_stiffness: 1e-7,
};

/// A job made ready. Every method starts from the pose's numbers and ends with the output's
/// stiffness and displacement; inverse kinematics is a part of it.
pub struct Sweep<'a> {
    job: &'a Job,
    model: Model,
    prepared: Prepared,
    geometry: Geometry,
    workspace: Workspace,
    lanes: Lanes,
    design: Design,
    placing: Placing,
    poser: Poser,
}

impl<'a> Sweep<'a> {
    /// Works out the topology.
    ///
    /// # Panics
    /// Where the job has no model or no plan.
    pub fn new(job: &'a Job) -> Self {
        Self::of(job, job.model().expect("a pose within reach"))
    }

    /// The same with other loads.
    ///
    /// # Panics
    /// Where the model has no plan.
    pub fn of(job: &'a Job, model: Model) -> Self {
        let prepared = Prepared::new(model.clone());
        let study = Study::of_job(job.clone(), 0, 0).expect("a pose within reach");
        Self {
            job,
            geometry: model.geometry().clone(),
            workspace: prepared.workspace().expect("a plan"),
            lanes: prepared.lanes().expect("a plan"),
            design: job.design(0).expect("a job of one design"),
            placing: placing(),
            poser: study.poser().expect("a plan"),
            model,
            prepared,
        }
    }

    /// Number of independent coordinates.
    pub fn unknowns(&self) -> usize {
        self.prepared.unknowns().expect("a plan")
    }

    /// Multiplications with an addition of the factorization of a pose in the lanes; zero where
    /// nothing is left to be factored, and where the mechanism goes one by one.
    pub fn factor_operations(&self) -> usize {
        self.lanes.factor_operations()
    }

    /// How many of the job's poses the lanes hand on to the one-by-one path.
    ///
    /// # Panics
    /// Where a pose has no result.
    pub fn handed_on(&mut self) -> u64 {
        let before = self.lanes.one_by_one();
        for first in (0..self.job.len()).step_by(LANES) {
            self.in_lanes(first);
        }
        self.lanes.one_by_one() - before
    }

    /// [`LANES`] poses from `first` on together, by `Prepared::sweep_lanes`.
    ///
    /// # Panics
    /// Where a pose has no result.
    pub fn in_lanes(&mut self, first: usize) {
        self.place_lanes(first);
        self.solve_lanes();
    }

    /// What [`Sweep::in_lanes`] does first: inverse kinematics into the lanes.
    ///
    /// # Panics
    /// As there.
    pub fn place_lanes(&mut self, first: usize) {
        let geometries = self.lanes.geometries_mut();
        let poses = first..first + LANES;
        let placed = self
            .design
            .place_lanes(poses, geometries, &mut self.placing);
        assert!(placed.iter().all(|pose| matches!(pose, Some(Ok(_)))));
        black_box(placed);
    }

    /// What [`Sweep::in_lanes`] does then.
    ///
    /// # Panics
    /// As there.
    pub fn solve_lanes(&mut self) {
        let results = self.prepared.sweep_lanes(&mut self.lanes, [true; LANES]);
        for result in results {
            black_box(result.expect("a filled lane").expect("a result"));
        }
    }

    /// One pose by `Poser::at`, as a program asks for it that has no other to go with it.
    ///
    /// # Panics
    /// Where the pose has no result.
    pub fn from_program(&mut self, pose: usize) {
        let found = self.poser.at(&Target::Output(self.job.target(pose)));
        black_box(found.result.expect("a result"));
    }

    /// One pose by `Prepared::sweep`, faer's sparse Cholesky in it.
    ///
    /// # Panics
    /// Where the pose has no result.
    pub fn one_by_one(&mut self, pose: usize) {
        let placed = self.job.place(pose, &mut self.geometry);
        black_box(placed.expect("a pose within reach"));
        let found = self.prepared.sweep(&self.geometry, &mut self.workspace);
        black_box(found.expect("a result"));
    }

    /// One pose by the traditional method: all nodes' coordinates, rigid bodies by Lagrange
    /// multipliers, joints by springs, one dense LU.
    ///
    /// # Panics
    /// Where the pose has no result.
    pub fn dense(&mut self, pose: usize) {
        let placed = self.job.place(pose, &mut self.geometry);
        black_box(placed.expect("a pose within reach"));
        self.model
            .set_geometry(self.geometry.clone())
            .expect("a geometry of this model");
        let found = traditional(&self.model, &SPRINGS);
        black_box(found.expect("a result"));
    }

    /// Time that `poses` poses take, [`LANES`] at a time through `solve`, which is given the
    /// number of the first: a multiple of [`LANES`]. The job's poses come in turn.
    pub fn time(&mut self, poses: u64, mut solve: impl FnMut(&mut Self, usize)) -> Duration {
        let groups = poses.div_ceil(LANES as u64);
        let own = (self.job.len() / LANES) as u64;
        let start = Instant::now();
        for group in 0..groups {
            solve(self, (group % own) as usize * LANES);
        }
        let solved = groups * LANES as u64;
        start.elapsed().mul_f64(poses as f64 / solved as f64)
    }
}
