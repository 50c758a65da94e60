//! One pose of a sweep.

use hyperstat_model::{Geometry, Model};
use nalgebra::Matrix6;

use super::{ROUNDING, settled};
use crate::answer::forces::Forces;
use crate::answer::pose_result::PoseResult;
use crate::error::SolveError;
use crate::kinematics::diagnosis::Diagnosis;
use crate::plan::Plan;
use crate::plan::fault::Fault;
use crate::plan::workspace::{LOADS, Workspace};
use crate::pose::evaluate;
use crate::pose::recover::recover;
use crate::pose::restraint::{Restraint, SUSPICIOUS_PIVOT, inverse, is_nearly_free};
use crate::posture::Posture;
use crate::state::acting::Acting;
use crate::state::floor::Floor;

/// A sweep stops refining at a correction this small: the next would be of its square.
const ENOUGH_IN_SWEEP: f64 = 1e-8;

/// Pivots below this make the output so uneven that its displacement is refined in a sweep too.
const UNEVEN_PIVOT: f64 = 1e-4;

impl Plan {
    /// Output stiffness and displacement at one pose of a sweep: `geometry` belongs to the
    /// model the plan was made for, `workspace` to this plan.
    ///
    /// # Errors
    /// As [`solve`](crate::solve); a model, geometry or workspace that is not of this plan.
    pub(crate) fn sweep(
        &self,
        model: &Model,
        geometry: &Geometry,
        workspace: &mut Workspace,
    ) -> Result<PoseResult, SolveError> {
        self.check(model, geometry, workspace)?;
        let at = Posture::new(model, geometry);
        let acting = Acting::of_model(&at)?;
        let result = match self.sweep_pose(&at, &acting, workspace) {
            Ok(result) => result,
            Err(Fault::Error(error)) => return Err(error),
            Err(Fault::Changed) => {
                let plan = Self::absorbing(&at, true, &Diagnosis::default())?;
                settled(plan.sweep_pose(&at, &acting, &mut plan.workspace()))?
            }
        };
        match result.is_finite() {
            true => Ok(result),
            false => Err(SolveError::Overflow),
        }
    }

    /// What the model's loads, and those of each of its cases, do at one pose: what
    /// [`solve`](crate::solve) finds. `None` where it has to be looked at first what moves without energy.
    ///
    /// # Errors
    /// As [`Plan::sweep`].
    pub(crate) fn forces(
        &self,
        model: &Model,
        geometry: &Geometry,
        workspace: &mut Workspace,
    ) -> Result<Option<Vec<Forces>>, SolveError> {
        self.check(model, geometry, workspace)?;
        if self.has_idle || !self.output_is_independent() {
            return Ok(None);
        }
        let at = Posture::new(model, geometry);
        let acting = Acting::of_model(&at)?;
        match evaluate(self, &at, &acting, workspace) {
            Ok(()) => {}
            Err(Fault::Error(error)) => return Err(error),
            Err(Fault::Changed) => return Ok(None),
        }
        if self.condense(workspace, &[], ROUNDING).is_err() {
            return Ok(None);
        }
        if self.held(&at, workspace).1.is_none() {
            return Ok(None);
        }
        let at_rest = Floor::at_rest(&at);
        let floors: Vec<Floor> = acting.iter().map(|a| at_rest.under(&at, a)).collect();
        let works: Vec<f64> = floors.iter().map(Floor::least_work).collect();
        let restraint = Restraint::none(at.size);
        let (_, displacements, ..) = self.output(geometry, workspace, &[], &restraint, &works)?;
        let sets = acting.iter().zip(&floors).zip(displacements).enumerate();
        let states = sets.map(|(set, (acting, displacement))| {
            let state = recover(self, &at, workspace, set, acting, displacement)?.state;
            match state.is_finite() {
                true => Ok(state.into()),
                false => Err(SolveError::Overflow),
            }
        });
        states.collect::<Result<_, _>>().map(Some)
    }

    /// The output's stiffness, and its compliance where it is surely held: next to nothing may be nothing, and
    /// is looked at, whatever the plan's own configuration was.
    fn held(
        &self,
        at: &Posture<'_>,
        workspace: &mut Workspace,
    ) -> (Matrix6<f64>, Option<Matrix6<f64>>) {
        let stiffness = self.stiffness_by_energy(workspace);
        let held = !is_nearly_free(&stiffness, at.size) && !self.is_faint(workspace, &stiffness);
        let compliance = inverse(&stiffness, SUSPICIOUS_PIVOT).filter(|_| held);
        (stiffness, compliance)
    }

    fn sweep_pose(
        &self,
        at: &Posture<'_>,
        acting: &[Acting],
        workspace: &mut Workspace,
    ) -> Result<PoseResult, Fault> {
        evaluate(self, at, acting, workspace)?;
        let ready = !self.has_idle && self.output_is_independent();
        let converged = |result| matches!(result, Ok(change) if change < ENOUGH_IN_SWEEP);
        if ready && converged(self.condense(workspace, &[], ENOUGH_IN_SWEEP)) {
            let (stiffness, compliance) = self.held(at, workspace);
            if let Some(compliance) = compliance {
                let even = inverse(&stiffness, UNEVEN_PIVOT).is_some();
                let mut displacement = |column| {
                    if even {
                        compliance * self.output_force(workspace, column)
                    } else {
                        self.settle(workspace, &[], &compliance, column, 0.0);
                        self.output_displacement(workspace, column)
                    }
                };
                return Ok(PoseResult {
                    stiffness: Some(stiffness),
                    displacement: Some(displacement(LOADS)),
                    cases: (1..acting.len()).map(|k| displacement(LOADS + k)).collect(),
                });
            }
        }
        let restraint = Restraint::of(at, self.output)?;
        restraint.check_loads(at, acting)?;
        let pins = restraint.pins(self, at, workspace);
        // A sweep has no place for a warning: what does not settle is refused.
        if !converged(self.condense(workspace, &pins, ENOUGH_IN_SWEEP)) {
            return Err(SolveError::Singular.into());
        }
        // Nothing is said of digits here, so that no work is too small.
        let works = vec![0.0; acting.len()];
        let (output, displacements, ..) =
            self.output(at.geometry, workspace, &pins, &restraint, &works)?;
        let held = output.free_motions.is_empty();
        if let Some(stiffness) = output.stiffness.filter(|_| held)
            && self.output_is_independent()
            && self.is_faint(workspace, &stiffness)
            && self.is_rounding(at, workspace, &stiffness)?
        {
            return Err(SolveError::Singular.into());
        }
        let mut displacements = displacements.into_iter().filter(|_| held);
        Ok(PoseResult {
            stiffness: output.stiffness,
            displacement: displacements.next(),
            cases: displacements.collect(),
        })
    }
}
