//! Poses side by side: the sweep's fast way through.
//!
//! What a topology asks for is worked out once ([`program`], [`fronts`]); the arithmetic of a pose
//! is then the same for every pose, so as many poses as a SIMD register holds go through it
//! together ([`pass`]): AVX-512, AVX2 or NEON where the machine has it, one by one elsewhere. A
//! pose that the lanes cannot vouch for (an estimate of its error too large, a pivot that is none)
//! goes through `Plan::sweep`, which refines; so does every pose of a mechanism that the lanes do
//! not take. No pose's result depends on its neighbours.

// Loops over registers are written by index: an iterator's closure, or a call of memcpy, would not
// be compiled with the instruction set chosen at run time.
#![allow(clippy::needless_range_loop, clippy::manual_memcpy)]

mod beside;
mod carry;
pub(crate) mod forces;
mod pass;
mod program;
#[cfg(test)]
mod random_tests;
pub(crate) mod single;
#[cfg(test)]
mod tests;
pub use beside::Beside;
use hyperstat_model::{Geometry, LANES, Model};
use nalgebra::{Matrix6, Vector6};
use pulp::{Arch, Simd, WithSimd};

use crate::answer::forces::Forces;
use crate::answer::pose_result::PoseResult;
use crate::error::SolveError;
use crate::lanes::carry::room::Room;
use crate::lanes::forces::{Ask, Beyond, Swept, Virtual};
use crate::lanes::pass::buffers::Buffers;
use crate::lanes::pass::reflections::order_chains;
use crate::lanes::pass::{ERROR, Pass, displacement as place_of_displacement, displacement_error};
use crate::lanes::program::Program;
use crate::plan::Plan;
use crate::plan::workspace::Workspace;

/// Relative error that a pose of the lanes may have, by its estimate. That is no bound, and 1e-11 is
/// promised: of 210 600 states of 10 666 random mechanisms the largest error below this was 5.0e-12.
const TRUSTED: f64 = 5e-13;

/// One thread's poses and buffers; made by [`Prepared::lanes`](crate::Prepared::lanes).
#[derive(Debug)]
pub struct Lanes {
    /// The plan and the model that they were made for.
    plan: u64,
    model: [u64; 2],
    geometries: [Geometry; LANES],
    workspace: Workspace,
    arch: Arch,
    engine: Option<Engine>,
    /// By poses: what joints and segments carry, where it is asked for, the lanes found it and it was not
    /// taken yet.
    beyond: [Option<Beyond>; LANES],
    /// Poses that went one by one.
    one_by_one: u64,
}

/// What joints and segments carry at a pose in every state, the same under the wrenches that were asked for, and
/// the pose's geometry.
type CarriedAt<'l> = (Vec<Forces>, Vec<Virtual>, &'l Geometry);

#[derive(Debug)]
struct Engine {
    program: Program,
    buffers: Buffers,
    /// For forces, where they are asked for and can be found.
    room: Option<Room>,
    beside: Beside,
}

/// Numbers in a register of the machine.
struct Width;

impl WithSimd for Width {
    type Output = usize;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> usize {
        S::F64_LANES
    }
}

impl Plan {
    /// Poses and buffers for one thread, for the model that the plan was made for. The poses are in the
    /// model's configuration.
    pub(crate) fn lanes(&self, model: &Model, beside: Beside) -> Lanes {
        self.lanes_on(model, Arch::new(), beside)
    }

    /// The same for poses that all go through `Plan::sweep`, one by one.
    pub(crate) fn lanes_one_by_one(&self, model: &Model) -> Lanes {
        self.lanes_with(model, Arch::new(), None)
    }

    fn lanes_on(&self, model: &Model, arch: Arch, beside: Beside) -> Lanes {
        let width = arch.dispatch(Width).min(LANES);
        let program = Program::new(self, model, model.geometry(), beside);
        let engine = program.map(|mut program| {
            let mut inputs = vec![0.0; 3 * program.inputs.len()];
            program.inputs.read(model, &[model.geometry()], &mut inputs);
            order_chains(&mut program, &inputs);
            let buffers = Buffers::new(&program, width);
            let recovery = program.recovery.as_ref();
            Engine {
                room: recovery.map(|recovery| Room::new(&program, recovery, width)),
                beside,
                buffers,
                program,
            }
        });
        self.lanes_with(model, arch, engine)
    }

    fn lanes_with(&self, model: &Model, arch: Arch, engine: Option<Engine>) -> Lanes {
        Lanes {
            plan: self.id,
            model: model.revisions(),
            geometries: std::array::from_fn(|_| model.geometry().clone()),
            workspace: self.workspace(),
            arch,
            engine,
            beyond: [const { None }; LANES],
            one_by_one: 0,
        }
    }

    /// Output stiffness and displacement at the poses that [`Lanes::geometry_mut`] was brought to,
    /// where `filled` says so: what `Plan::sweep` finds, to 1e-11 of the stiffness's scale
    /// (`√(K_ii K_jj)`) and of the largest component of the displacement, its components times
    /// `√K_ii`. `lanes` were made by this plan for `model`, as it is now; the nodes of a joint stay at
    /// one point; anything else is an error.
    pub(crate) fn sweep_lanes(
        &self,
        model: &Model,
        lanes: &mut Lanes,
        filled: [bool; LANES],
    ) -> [Option<Result<PoseResult, SolveError>>; LANES] {
        self.sweep_lanes_asking(model, lanes, filled, None)
    }

    /// The same with what joints and segments carry under the wrenches that are asked for, in lanes that were
    /// made for it, and of the states in one alone.
    pub(crate) fn sweep_lanes_asking(
        &self,
        model: &Model,
        lanes: &mut Lanes,
        filled: [bool; LANES],
        mut ask: Option<(usize, &mut Ask<'_>)>,
    ) -> [Option<Result<PoseResult, SolveError>>; LANES] {
        let mut results = [const { None }; LANES];
        lanes.forget();
        if let Err(error) = lanes.check(self, model) {
            return filled.map(|filled| filled.then(|| Err(error.clone())));
        }
        let mut taken = filled;
        for (pose, taken) in taken.iter_mut().enumerate().filter(|(_, taken)| **taken) {
            if let Err(error) = model.check_geometry(&lanes.geometries[pose], self.one_point) {
                results[pose] = Some(Err(error.into()));
                *taken = false;
            }
        }
        if let Some(engine) = &mut lanes.engine {
            let width = engine.buffers.width;
            for first in (0..LANES).step_by(width) {
                let range = first..(first + width).min(LANES);
                let Some(other) = range.clone().find(|pose| taken[*pose]) else {
                    continue;
                };
                // What was not taken may be of another size; its lane is read by nobody.
                let geometries: [&Geometry; LANES] = std::array::from_fn(|lane| {
                    let pose = (first + lane).min(LANES - 1);
                    &lanes.geometries[if taken[pose] { pose } else { other }]
                });
                let geometries = &geometries[..range.len()];
                engine.solve(model, geometries, lanes.arch);
                let mut vouched = [false; LANES];
                for (lane, pose) in range.clone().enumerate() {
                    if taken[pose] && engine.vouches(lane) {
                        results[pose] = Some(Ok(engine.found(lane)));
                        vouched[lane] = true;
                    }
                }
                let swept = Swept {
                    model,
                    geometries,
                    wanted: vouched,
                    first,
                    state: ask.as_ref().map(|(state, _)| *state),
                    arch: lanes.arch,
                };
                let ask = ask.as_mut().map(|(_, ask)| &mut **ask);
                let mut beyond = engine.carried(&swept, ask);
                for (lane, pose) in range.enumerate() {
                    lanes.beyond[pose] = beyond[lane].take();
                }
            }
        }
        for (pose, result) in results.iter_mut().enumerate() {
            if taken[pose] && result.is_none() {
                lanes.one_by_one += 1;
                let geometry = &lanes.geometries[pose];
                *result = Some(self.sweep(model, geometry, &mut lanes.workspace));
            }
        }
        results
    }
}

impl Lanes {
    /// The configuration of a pose, to be changed.
    ///
    /// # Panics
    /// If `pose` is not below [`LANES`].
    pub fn geometry_mut(&mut self, pose: usize) -> &mut Geometry {
        self.beyond[pose] = None;
        &mut self.geometries[pose]
    }

    /// The configurations of all poses, to be changed.
    pub fn geometries_mut(&mut self) -> &mut [Geometry; LANES] {
        self.forget();
        &mut self.geometries
    }

    /// Whether they were made by a plan for a model as it is now.
    fn check(&self, plan: &Plan, model: &Model) -> Result<(), SolveError> {
        if self.plan != plan.id {
            return Err(SolveError::ForeignWorkspace);
        }
        match self.model == model.revisions() {
            true => Ok(()),
            false => Err(SolveError::ForeignModel),
        }
    }

    fn forget(&mut self) {
        self.beyond = [const { None }; LANES];
    }

    /// What joints and segments carry at a pose in every state, and under the wrenches that were asked for, with
    /// its geometry, where the lanes found both and they were not taken yet.
    pub(crate) fn found(
        &mut self,
        plan: &Plan,
        model: &Model,
        pose: usize,
    ) -> Result<Option<CarriedAt<'_>>, SolveError> {
        self.check(plan, model)?;
        let found = self.beyond[pose].take();
        let found = found.filter(|found| !found.virtuals.is_empty());
        Ok(found.map(|found| (found.forces, found.virtuals, &self.geometries[pose])))
    }

    /// What joints and segments carry at a pose that was swept: as the lanes found it, else by the numeric
    /// pass, as [`Plan::forces`] has it.
    pub(crate) fn forces(
        &mut self,
        plan: &Plan,
        model: &Model,
        pose: usize,
    ) -> Result<Option<Vec<Forces>>, SolveError> {
        self.check(plan, model)?;
        match self.beyond[pose].take() {
            Some(found) => Ok(Some(found.forces)),
            None => plan.forces(model, &self.geometries[pose], &mut self.workspace),
        }
    }

    /// Whether the mechanism goes through the lanes at all.
    pub fn is_parallel(&self) -> bool {
        self.engine.is_some()
    }

    /// Poses so far that went one by one.
    pub fn one_by_one(&self) -> u64 {
        self.one_by_one
    }

    /// Multiplications, each with an addition, that a pose's factorization takes; zero where chains
    /// leave nothing to be factored, and where the mechanism goes one by one.
    pub fn factor_operations(&self) -> usize {
        let engine = self.engine.as_ref();
        engine.map_or(0, |engine| engine.program.fronts.operations())
    }
}

/// Place of an entry of the stiffness's upper triangle by rows.
const fn upper(row: usize, column: usize) -> usize {
    row * (11 - row) / 2 + column
}

impl Engine {
    /// Sends geometries through the pass, as many as go side by side.
    #[inline(always)]
    fn solve(&mut self, model: &Model, geometries: &[&Geometry], arch: Arch) {
        let Self {
            program, buffers, ..
        } = self;
        program.inputs.read(model, geometries, &mut buffers.inputs);
        arch.dispatch(Pass { program, buffers });
    }

    /// The result of a pose; `None` where the lanes cannot vouch for it, or where it asks for a look at the
    /// mechanism's freedom.
    #[inline(always)]
    fn result(&self, lane: usize) -> Option<PoseResult> {
        self.vouches(lane).then(|| self.found(lane))
    }

    #[inline(always)]
    fn vouches(&self, lane: usize) -> bool {
        let at = |k: usize| self.buffers.result(k, lane);
        // What is not a number is not trusted.
        let trusted = |state: usize| at(displacement_error(state)) <= TRUSTED;
        !at(ERROR).is_nan() && (0..self.program.states.len()).all(trusted)
    }

    /// The numbers of a pose.
    #[inline(always)]
    fn found(&self, lane: usize) -> PoseResult {
        let at = |k: usize| self.buffers.result(k, lane);
        let states = self.program.states.len();
        let displacement = |state: usize| {
            let first = place_of_displacement(state);
            Vector6::from_fn(|k, _| at(first + k))
        };
        let stiffness = Matrix6::from_fn(|row, column| at(upper(row.min(column), row.max(column))));
        PoseResult {
            stiffness: Some(stiffness),
            displacement: (states > 0).then(|| displacement(0)),
            cases: (1..states).map(displacement).collect(),
        }
    }
}
