//! The two ways in, one full solve and one pose of a sweep, and what is said of the output.

use hyperstat_model::{Geometry, LoadSet, Model, characteristic_length};
use nalgebra::{Cholesky, DMatrix, Matrix6, Vector6};

use crate::answer::pose_result::PoseResult;
use crate::answer::solution::{CaseSolution, Output, Solution, State, Warning};
use crate::error::SolveError;
use crate::plan::Plan;
use crate::plan::blocks::read;
use crate::plan::fault::Fault;
use crate::plan::workspace::{LOADS, Workspace};
use crate::pose::condense::UNITS;
use crate::pose::recover::{check_recovery, recover};
use crate::pose::restraint::{Restraint, SUSPICIOUS_PIVOT, is_nearly_free, scale_of, scaled};
use crate::pose::{evaluate, node_displacement};
use crate::rank::dense::Elimination;
use crate::rank::echelon::echelon;
use crate::state::acting::Acting;
use crate::state::floor::Floor;

/// A full solve refines down to rounding.
const ROUNDING: f64 = 1e-15;
/// A sweep stops refining at a correction this small: the next would be of its square.
const ENOUGH_IN_SWEEP: f64 = 1e-8;
/// An error above this, or a last correction above this share of the solution, is worth a warning.
const LOST_DIGITS: f64 = 1e-10;

/// Pivots below this make the output so uneven that its displacement is refined in a sweep too.
const UNEVEN_PIVOT: f64 = 1e-4;

/// Corrections of the output, once its stiffness is known.
const CORRECTIONS: usize = 3;

/// What is found of the output: itself, its displacements in all sets, the relative size of their
/// last correction, and the compliance that corrects it where its coordinates are independent.
type Found = (Output, Vec<Vector6<f64>>, f64, Option<Matrix6<f64>>);

/// Whether a full solve estimates its precision, for a warning.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Precision {
    Stated,
    Left,
}

/// What a full solve finds.
struct Solved {
    restraint: Restraint,
    output: Output,
    /// One a set of loads.
    states: Vec<State>,
    warnings: Vec<Warning>,
}

/// Solves a model in its own configuration: the shortest way through.
///
/// # Errors
/// No output, bodies that nothing holds, a load on a motion that nothing resists, numbers of too
/// different size.
pub fn solve(model: &Model) -> Result<Solution, SolveError> {
    Plan::new(model)?.solve(model)
}

impl Plan {
    /// Everything about the model's own configuration. The model is the one that the plan was made
    /// for, or one with the same bodies, joints and output.
    ///
    /// # Errors
    /// As [`solve`]; [`SolveError::ForeignModel`].
    pub fn solve(&self, model: &Model) -> Result<Solution, SolveError> {
        model.check()?;
        self.check_model(model)?;
        let geometry = model.geometry();
        let acting = Acting::of_model(model, geometry)?;
        let solved = self.solve_all(model, geometry, &acting, Precision::Stated)?;
        let mut states = solved.states.into_iter();
        let base = states.next().ok_or(SolveError::Singular)?;
        let cases = model.cases().iter().zip(states);
        let restraint = solved.restraint;
        Ok(Solution {
            unknowns: self.unknowns,
            mobility: restraint.kinematics.mobility,
            overconstraint: restraint.kinematics.overconstraint,
            idle: restraint.idle,
            output: solved.output,
            displacements: base.displacements,
            joint_wrenches: base.joint_wrenches,
            segments: base.segments,
            floor: base.floor,
            cases: cases
                .map(|(case, state)| CaseSolution {
                    name: case.name.clone(),
                    state,
                })
                .collect(),
            warnings: solved.warnings,
        })
    }

    /// What each of these sets of loads alone does in the model's own configuration: without the
    /// model's loads, weight and temperatures. One factorization serves all of them.
    ///
    /// # Errors
    /// As [`Plan::solve`]; loads on what is not of the model.
    pub fn respond(&self, model: &Model, sets: &[LoadSet]) -> Result<Vec<State>, SolveError> {
        model.check()?;
        self.check_model(model)?;
        for set in sets {
            model.check_loads(set)?;
        }
        let geometry = model.geometry();
        let acting: Result<Vec<_>, _> = sets
            .iter()
            .map(|set| Acting::new(model, geometry, set))
            .collect();
        let solved = self.solve_all(model, geometry, &acting?, Precision::Left)?;
        Ok(solved.states)
    }

    fn solve_all(
        &self,
        model: &Model,
        geometry: &Geometry,
        acting: &[Acting],
        precision: Precision,
    ) -> Result<Solved, SolveError> {
        let mut workspace = self.workspace();
        match self.solve_full(model, geometry, acting, &mut workspace, precision) {
            Ok(solved) => Ok(solved),
            Err(Fault::Error(error)) => Err(error),
            Err(Fault::Changed) => {
                let plan = Self::at(model, geometry)?;
                let mut workspace = plan.workspace();
                settled(plan.solve_full(model, geometry, acting, &mut workspace, precision))
            }
        }
    }

    /// Output stiffness and displacement at one pose of a sweep: `geometry` belongs to the
    /// model the plan was made for, `workspace` to this plan.
    ///
    /// # Errors
    /// As [`solve`]; a model, geometry or workspace that is not of this plan.
    pub fn sweep(
        &self,
        model: &Model,
        geometry: &Geometry,
        workspace: &mut Workspace,
    ) -> Result<PoseResult, SolveError> {
        self.check(model, geometry, workspace)?;
        let acting = Acting::of_model(model, geometry)?;
        let result = match self.sweep_pose(model, geometry, &acting, workspace) {
            Ok(result) => result,
            Err(Fault::Error(error)) => return Err(error),
            Err(Fault::Changed) => {
                let plan = Self::at(model, geometry)?;
                settled(plan.sweep_pose(model, geometry, &acting, &mut plan.workspace()))?
            }
        };
        match result.is_finite() {
            true => Ok(result),
            false => Err(SolveError::Overflow),
        }
    }

    fn solve_full(
        &self,
        model: &Model,
        geometry: &Geometry,
        acting: &[Acting],
        workspace: &mut Workspace,
        precision: Precision,
    ) -> Result<Solved, Fault> {
        check_recovery(self, model)?;
        let restraint = Restraint::new(model, geometry, self.output)?;
        restraint.check_loads(model, geometry, acting)?;
        evaluate(self, model, geometry, acting, workspace)?;
        let pins = restraint.pins(self, model, geometry, workspace);
        let condensed = self.condense(workspace, &pins, ROUNDING)?;
        let at_rest = Floor::at_rest(model, geometry);
        let floors = acting.iter().map(|a| at_rest.under(model, geometry, a));
        let floors: Vec<Floor> = floors.collect();
        let works: Vec<f64> = floors.iter().map(Floor::least_work).collect();
        let (mut output, displacements, settled, compliance) =
            self.output(geometry, workspace, &pins, &restraint, &works)?;
        let mut warnings = Vec::new();
        let mut doubtful = restraint.kinematics.doubtful.or(workspace.doubtful);
        let mut states = Vec::with_capacity(acting.len());
        let mut off = 0.0_f64;
        let each = acting.iter().zip(&floors).zip(displacements);
        for (set, (acting, displacement)) in each.enumerate() {
            let recovered = recover(self, model, geometry, workspace, set, acting, displacement)?;
            doubtful = doubtful.or(recovered.doubtful);
            let state = recovered.state;
            let scale = state.largest_wrench();
            if recovered.off > 0.0 && scale > 0.0 {
                off = off.max(recovered.off / scale);
            }
            if !state.is_finite() {
                return Err(SolveError::Overflow.into());
            }
            states.push(state);
        }
        if !output.is_finite() {
            return Err(SolveError::Overflow.into());
        }
        if let Some(value) = doubtful {
            let nearly_free = restraint.kinematics.nearly_free.as_ref();
            warnings.push(Warning::NearSingular {
                value,
                motion: nearly_free.map(|motion| motion.describe(model)),
            });
        }
        if let Some(first) = states.first() {
            output.displacement = first.output;
        }
        if precision == Precision::Stated {
            let lost = self.lost(model, geometry, workspace, &output, &states)?;
            let held = (&*pins, compliance.as_ref());
            let spread = self.spread(model, geometry, workspace, held, &states)?;
            let error = lost.max(condensed).max(settled).max(spread).max(off);
            if error > LOST_DIGITS {
                warnings.push(Warning::LostDigits { error });
            }
        }
        Ok(Solved {
            restraint,
            output,
            states,
            warnings,
        })
    }

    fn sweep_pose(
        &self,
        model: &Model,
        geometry: &Geometry,
        acting: &[Acting],
        workspace: &mut Workspace,
    ) -> Result<PoseResult, Fault> {
        evaluate(self, model, geometry, acting, workspace)?;
        let ready = !self.has_idle && self.output_is_independent();
        let converged = |result| matches!(result, Ok(change) if change < ENOUGH_IN_SWEEP);
        if ready && converged(self.condense(workspace, &[], ENOUGH_IN_SWEEP)) {
            let stiffness = self.stiffness_by_energy(workspace);
            // Next to nothing may be nothing: then it is looked at, whatever the plan's own
            // configuration was.
            let held = !is_nearly_free(&stiffness, characteristic_length(geometry));
            if let Some(compliance) = inverse(&stiffness, SUSPICIOUS_PIVOT).filter(|_| held) {
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
        let restraint = Restraint::new(model, geometry, self.output)?;
        restraint.check_loads(model, geometry, acting)?;
        let pins = restraint.pins(self, model, geometry, workspace);
        // A sweep has no place for a warning: what does not settle is refused.
        if !converged(self.condense(workspace, &pins, ENOUGH_IN_SWEEP)) {
            return Err(SolveError::Singular.into());
        }
        // Nothing is said of digits here, so that no work is too small.
        let works = vec![0.0; acting.len()];
        let (output, displacements, ..) =
            self.output(geometry, workspace, &pins, &restraint, &works)?;
        let held = output.free_motions.is_empty();
        let mut displacements = displacements.into_iter().filter(|_| held);
        Ok(PoseResult {
            stiffness: output.stiffness,
            displacement: displacements.next(),
            cases: displacements.collect(),
        })
    }

    /// The output's stiffness, compliance and displacement under the first set of loads; its
    /// displacements under all sets; and the relative size of the last correction of these, by
    /// `works`: one a set, the least that a correction's work is measured by.
    /// Completes the sets' columns.
    fn output(
        &self,
        geometry: &Geometry,
        workspace: &mut Workspace,
        pins: &[usize],
        restraint: &Restraint,
        works: &[f64],
    ) -> Result<Found, SolveError> {
        let sets = LOADS..workspace.columns();
        let size = restraint.size;
        let free_motions = restraint
            .free_twists
            .iter()
            .map(|t| unscaled(t, size))
            .collect();
        let free = !restraint.free_twists.is_empty();
        if !self.output_is_independent() {
            let columns =
                (0..6).map(|k| node_displacement(self, geometry, workspace, k, self.output));
            let compliance = Matrix6::from_columns(&columns.collect::<Vec<_>>());
            let compliance = (compliance + compliance.transpose()) * 0.5;
            let rigid_directions = self.rigid_directions(geometry, workspace, size);
            let stiffness = if rigid_directions.is_empty() && !free {
                inverse(&compliance, 0.0)
            } else {
                None
            };
            let displacements: Vec<_> = sets
                .clone()
                .map(|column| node_displacement(self, geometry, workspace, column, self.output))
                .collect();
            for column in sets {
                self.find_remainder(workspace, pins, None, column);
            }
            let output = Output {
                stiffness,
                compliance: (!free).then_some(compliance),
                displacement: displacements.first().copied().unwrap_or_default(),
                rigid_directions,
                free_motions,
            };
            return Ok((output, displacements, 0.0, None));
        }
        let stiffness = self.stiffness_by_energy(workspace);
        let mut held = stiffness;
        if free {
            // A spring along each free twist, which no load works on, makes the rest solvable.
            let level = (0..6).map(|k| stiffness[(k, k)] * scale_of(k, size).powi(2));
            let level = Some(level.sum::<f64>()).filter(|l| *l > 0.0).unwrap_or(1.0);
            for twist in &restraint.free_twists {
                let force = scaled(twist, size);
                held += force * force.transpose() * level;
            }
        }
        let compliance = match restraint.free_twists.len() {
            // All its motions are free: its stiffness is rounding, and it stays where it is.
            6 => Matrix6::zeros(),
            _ => inverse(&held, 0.0).ok_or(SolveError::Singular)?,
        };
        let mut last = 0.0_f64;
        let mut displacements = Vec::with_capacity(sets.len());
        for (column, least) in sets.zip(works) {
            last = last.max(self.settle(workspace, pins, &compliance, column, *least));
            for twist in &restraint.free_twists {
                self.remove_free_motion(workspace, twist, size, column);
            }
            displacements.push(self.output_displacement(workspace, column));
            self.find_remainder(workspace, pins, Some(&compliance), column);
        }
        let refined = (!free).then(|| self.refined_compliance(workspace, pins, &compliance));
        let output = Output {
            stiffness: Some(stiffness),
            compliance: refined,
            displacement: displacements.first().copied().unwrap_or_default(),
            rigid_directions: Vec::new(),
            free_motions,
        };
        Ok((output, displacements, last, Some(compliance)))
    }

    /// Takes a free twist of the output (orthonormal, translations over `size`) out of a set's
    /// column: no load works on it, so what is there is rounding over next to no stiffness.
    fn remove_free_motion(
        &self,
        workspace: &mut Workspace,
        twist: &Vector6<f64>,
        size: f64,
        column: usize,
    ) {
        let n = self.unknowns;
        let share = scaled(&self.output_displacement(workspace, column), size).dot(twist);
        let twist = unscaled(twist, size);
        let (motions, loads) = workspace.solutions.split_at_mut(LOADS * n);
        let loads = &mut loads[(column - LOADS) * n..][..n];
        self.add_motions(loads, motions, &(-twist * share));
    }

    /// Displacement of the output, its coordinates being independent, in a set's column.
    fn output_displacement(&self, workspace: &Workspace, column: usize) -> Vector6<f64> {
        read(&workspace.solutions[column * self.unknowns..], self.inner)
    }

    /// Completes a set's column, found with the output clamped: corrections of the output
    /// first (the first finds its displacement), each followed by one of the rest. Returns the
    /// relative size of the output's last correction, by the work it does: over that of its
    /// displacement, and where this is rounding beside what acts over `least`.
    pub(crate) fn settle(
        &self,
        workspace: &mut Workspace,
        pins: &[usize],
        compliance: &Matrix6<f64>,
        column: usize,
        least: f64,
    ) -> f64 {
        let n = self.unknowns;
        let (mut first, mut last) = (0.0_f64, 0.0);
        for correction in 0..CORRECTIONS {
            let force = self.output_force(workspace, column);
            let step = compliance * force;
            last = force.dot(&step).abs();
            if correction == 0 {
                first = last;
            }
            let (motions, loads) = workspace.solutions.split_at_mut(LOADS * n);
            let loads = &mut loads[(column - LOADS) * n..][..n];
            self.add_motions(loads, motions, &step);
            self.residuals(workspace, column..column + 1);
            self.correct(workspace, pins, column..column + 1);
        }
        let first = first.max(least);
        if first > 0.0 {
            (last / first).sqrt()
        } else {
            0.0
        }
    }

    /// The compliance from unit forces on the output, refined as displacements are: where the
    /// output is stiff one way and soft another, the inverse of the stiffness loses digits. The
    /// six forces go together, in the columns of the unit motions.
    fn refined_compliance(
        &self,
        workspace: &mut Workspace,
        pins: &[usize],
        inverse: &Matrix6<f64>,
    ) -> Matrix6<f64> {
        let n = self.unknowns;
        let kept = UNITS.start * n..UNITS.end * n;
        let motions = workspace.solutions[kept.clone()].to_vec();
        let loads = workspace.loads[kept.clone()].to_vec();
        workspace.solutions[kept.clone()].fill(0.0);
        workspace.loads[kept.clone()].fill(0.0);
        for k in UNITS {
            workspace.loads[k * n + self.inner + k] = 1.0;
        }
        for _ in 0..CORRECTIONS {
            self.residuals(workspace, UNITS);
            for k in UNITS {
                let own = k * n..(k + 1) * n;
                let force = self.force_on_output(&workspace.residuals[own.clone()], &motions);
                let step = inverse * force;
                self.add_motions(&mut workspace.solutions[own], &motions, &step);
            }
            self.residuals(workspace, UNITS);
            self.correct(workspace, pins, UNITS);
        }
        let mut compliance = Matrix6::zeros();
        for k in UNITS {
            let column = read(&workspace.solutions[k * n..], self.inner);
            compliance.set_column(k, &column);
        }
        workspace.solutions[kept.clone()].copy_from_slice(&motions);
        workspace.loads[kept].copy_from_slice(&loads);
        (compliance + compliance.transpose()) * 0.5
    }

    /// Adds the output's unit motions, by their share, to a column of solutions.
    fn add_motions(&self, column: &mut [f64], motions: &[f64], shares: &Vector6<f64>) {
        for (motion, share) in motions.chunks_exact(self.unknowns).zip(shares.iter()) {
            for (entry, motion) in column.iter_mut().zip(motion) {
                *entry += motion * share;
            }
        }
    }

    /// Twists of the output that no IDC gives it.
    fn rigid_directions(
        &self,
        geometry: &Geometry,
        workspace: &Workspace,
        size: f64,
    ) -> Vec<Vector6<f64>> {
        let carrier = self.topology.carrier_of[self.output.0];
        let block = self.block(workspace, carrier);
        let reference = self.topology.carriers[carrier].reference;
        let shift = crate::plan::blocks::shift(geometry, reference, self.output);
        let mut rows = DMatrix::zeros(self.columns[carrier].len(), 6);
        for (k, &idc) in self.columns[carrier].iter().enumerate() {
            let (_, dof) = workspace.identities[idc];
            let twist = scaled(&(shift * read(block, 6 * k)), size) * scale_of(dof.index(), size);
            rows.row_mut(k).copy_from(&twist.transpose());
        }
        let basis = echelon(Elimination::new(rows, 0).null_space());
        basis
            .iter()
            .map(|v| unscaled(&Vector6::from_column_slice(v.as_slice()), size))
            .collect()
    }
}

/// A twist with translations over `size`, in metres again.
fn unscaled(twist: &Vector6<f64>, size: f64) -> Vector6<f64> {
    Vector6::from_fn(|k, _| twist[k] * scale_of(k, size))
}

/// Inverse of a symmetric matrix scaled to a unit diagonal; `None` where a pivot is not above
/// `least` (or zero).
fn inverse(matrix: &Matrix6<f64>, least: f64) -> Option<Matrix6<f64>> {
    let scale = matrix.diagonal().map(f64::sqrt);
    if !scale.iter().all(|s| *s > 0.0 && s.is_finite()) {
        return None;
    }
    let unit = Matrix6::from_fn(|r, c| matrix[(r, c)] / (scale[r] * scale[c]));
    let factor = Cholesky::new(unit)?;
    if factor.l_dirty().diagonal().iter().any(|p| p * p <= least) {
        return None;
    }
    let inverse = factor.inverse();
    Some(Matrix6::from_fn(|r, c| {
        inverse[(r, c)] / (scale[r] * scale[c])
    }))
}

/// A fault of a plan made for this very configuration.
fn settled<T>(result: Result<T, Fault>) -> Result<T, SolveError> {
    result.map_err(|fault| match fault {
        Fault::Error(error) => error,
        Fault::Changed => SolveError::Singular,
    })
}
