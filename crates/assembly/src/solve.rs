//! Condensation to the output (Eqs. 43–45), refinement, and the two ways in: one full solve, and
//! one pose of a sweep.
//!
//! Columns of the solutions: with the output's six coordinates independent, its unit motions
//! (Eq. 45's T_o); otherwise unit forces on it; and the loads. Every column starts at zero and is
//! corrected by the factor from residuals formed in the elements' deformations,
//! `Hᵀ F − Dᵀ k (D U + δ₀)`: the first correction is the plain solution, the others are refinement
//! (paper-notes, "Digits go in rigid-motion cancellation").

use nalgebra::{Cholesky, DMatrix, Matrix6, Vector6};

use crate::coordinates::read;
use crate::elimination::Elimination;
use crate::error::SolveError;
use crate::kinematics::echelon;
use crate::model::{Geometry, Model};
use crate::numeric::{Fault, add_load, dot, evaluate, multiply, node_displacement};
use crate::plan::{COLUMNS, Plan, Workspace};
use crate::recover::recover;
use crate::restraint::{Restraint, scaled};
use crate::solution::{Output, Solution, Warning};

/// Corrections of a full solve at the most; it stops where they no longer shrink.
const MOST_CORRECTIONS: usize = 6;
/// Corrections of a sweep's pose: the solution and one refinement.
const SWEEP_CORRECTIONS: usize = 2;
/// A last correction above this share of the solution is worth a warning.
const LOST_DIGITS: f64 = 1e-10;
/// Pivots of the scaled output stiffness below this ask for a look at the mechanism's freedom.
const SUSPICIOUS_PIVOT: f64 = 1e-9;
/// Column of the model's loads.
pub(crate) const LOADS: usize = COLUMNS - 1;

/// What a sweep finds at a pose.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct PoseResult {
    /// Output stiffness K_o; `None` where the output is held rigidly in some direction.
    pub stiffness: Option<Matrix6<f64>>,
    /// Displacement of the output under the loads; `None` where the output moves freely.
    pub displacement: Option<Vector6<f64>>,
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
    /// Everything about the model's own configuration. The model has the topology that the plan
    /// was made for.
    ///
    /// # Errors
    /// As [`solve`].
    pub fn solve(&self, model: &Model) -> Result<Solution, SolveError> {
        let geometry = model.geometry();
        let mut workspace = self.workspace();
        match self.solve_full(model, geometry, &mut workspace) {
            Ok(solution) => Ok(solution),
            Err(Fault::Error(error)) => Err(error),
            Err(Fault::Changed) => {
                let plan = Self::at(model, geometry)?;
                let mut workspace = plan.workspace();
                settled(plan.solve_full(model, geometry, &mut workspace))
            }
        }
    }

    /// Output stiffness and displacement at one pose of a sweep: `geometry` belongs to the
    /// model the plan was made for, `workspace` to this plan.
    ///
    /// # Errors
    /// As [`solve`].
    pub fn sweep(
        &self,
        model: &Model,
        geometry: &Geometry,
        workspace: &mut Workspace,
    ) -> Result<PoseResult, SolveError> {
        match self.sweep_pose(model, geometry, workspace) {
            Ok(result) => Ok(result),
            Err(Fault::Error(error)) => Err(error),
            Err(Fault::Changed) => {
                let plan = Self::at(model, geometry)?;
                settled(plan.sweep_pose(model, geometry, &mut plan.workspace()))
            }
        }
    }

    fn solve_full(
        &self,
        model: &Model,
        geometry: &Geometry,
        workspace: &mut Workspace,
    ) -> Result<Solution, Fault> {
        let restraint = Restraint::new(model, geometry, self.output);
        restraint.check_loads(model, geometry)?;
        evaluate(self, model, geometry, workspace)?;
        let pins = restraint.pins(self, model, geometry, workspace);
        let lost = self.condense(geometry, workspace, &pins, MOST_CORRECTIONS)?;
        let mut warnings = Vec::new();
        if let Some(value) = restraint.kinematics.doubtful {
            warnings.push(Warning::NearSingular { value });
        }
        if lost > LOST_DIGITS {
            warnings.push(Warning::LostDigits { residual: lost });
        }
        let output = self.output(geometry, workspace, &pins, &restraint)?;
        let recovered = recover(self, model, geometry, workspace)?;
        Ok(Solution {
            unknowns: self.unknowns,
            mobility: restraint.kinematics.mobility,
            overconstraint: restraint.kinematics.overconstraint,
            idle: restraint.idle,
            output,
            displacements: recovered.displacements,
            joint_wrenches: recovered.joint_wrenches,
            segments: recovered.segments,
            warnings,
        })
    }

    fn sweep_pose(
        &self,
        model: &Model,
        geometry: &Geometry,
        workspace: &mut Workspace,
    ) -> Result<PoseResult, Fault> {
        evaluate(self, model, geometry, workspace)?;
        let ready = !self.has_idle && self.output_is_independent();
        if ready
            && self
                .condense(geometry, workspace, &[], SWEEP_CORRECTIONS)
                .is_ok()
        {
            let stiffness = self.stiffness_by_energy(workspace);
            if let Some(compliance) = inverse(&stiffness, SUSPICIOUS_PIVOT) {
                return Ok(PoseResult {
                    stiffness: Some(stiffness),
                    displacement: Some(compliance * self.output_force(workspace)),
                });
            }
        }
        let restraint = Restraint::new(model, geometry, self.output);
        restraint.check_loads(model, geometry)?;
        let pins = restraint.pins(self, model, geometry, workspace);
        self.condense(geometry, workspace, &pins, SWEEP_CORRECTIONS)?;
        let output = self.output(geometry, workspace, &pins, &restraint)?;
        let held = output.free_motions.is_empty();
        Ok(PoseResult {
            stiffness: output.stiffness,
            displacement: held.then_some(output.displacement),
        })
    }

    /// Factors the inner stiffness with `pins` held and finds all columns of the solutions;
    /// returns the relative size of the last correction.
    fn condense(
        &self,
        geometry: &Geometry,
        workspace: &mut Workspace,
        pins: &[usize],
        corrections: usize,
    ) -> Result<f64, SolveError> {
        let n = self.unknowns;
        for &pin in pins {
            let scale = self.pattern.diagonal(pin, &workspace.values).max(1.0);
            self.pattern.pin(pin, scale, &mut workspace.values);
        }
        self.pattern
            .factorize(&workspace.values, &mut workspace.factor)
            .map_err(|_| SolveError::Singular)?;
        workspace.solutions.fill(0.0);
        for k in 0..6 {
            if self.output_is_independent() {
                workspace.solutions[k * n + self.inner + k] = 1.0;
            } else {
                let mut unit = Vector6::zeros();
                unit[k] = 1.0;
                add_load(self, geometry, workspace, k, self.output, &unit);
            }
        }
        let mut last = f64::INFINITY;
        for correction in 0..corrections {
            self.residuals(workspace);
            let change = self.correct(workspace, pins);
            let refining = correction > 0;
            if refining && (change < 1e-15 || change > 0.5 * last) {
                return Ok(change);
            }
            if refining {
                last = change;
            }
        }
        Ok(last)
    }

    /// Residuals `Hᵀ F − Dᵀ k (D U + δ₀)` of all columns.
    fn residuals(&self, workspace: &mut Workspace) {
        let n = self.unknowns;
        let Workspace {
            operators,
            stiffnesses,
            initial,
            loads,
            solutions,
            residuals,
            scratch,
            forces,
            ..
        } = workspace;
        residuals.copy_from_slice(loads);
        for element in &self.elements {
            let (rows, count) = (element.rows, element.columns.len());
            let d = &operators[element.operator_start..element.operator_start + rows * count];
            let k = &stiffnesses[element.stiffness_start..element.stiffness_start + rows * rows];
            let deformations = &mut scratch[..rows * COLUMNS];
            deformations.fill(0.0);
            deformations[rows * LOADS..]
                .copy_from_slice(&initial[element.initial_start..element.initial_start + rows]);
            for (c, deformation) in deformations.chunks_exact_mut(rows).enumerate() {
                for (&idc, d_column) in element.columns.iter().zip(d.chunks_exact(rows)) {
                    let u = solutions[c * n + idc];
                    if u != 0.0 {
                        for (sum, entry) in deformation.iter_mut().zip(d_column) {
                            *sum += u * entry;
                        }
                    }
                }
            }
            let forces = &mut forces[..rows * COLUMNS];
            multiply(k, deformations, rows, forces);
            for (c, force) in forces.chunks_exact(rows).enumerate() {
                for (&idc, d_column) in element.columns.iter().zip(d.chunks_exact(rows)) {
                    residuals[c * n + idc] -= dot(d_column, force);
                }
            }
        }
    }

    /// Corrects the inner part of all columns by their residuals; returns the largest relative
    /// change, coordinates weighted by their stiffness.
    fn correct(&self, workspace: &mut Workspace, pins: &[usize]) -> f64 {
        let (n, inner) = (self.unknowns, self.inner);
        if inner == 0 {
            return 0.0;
        }
        for c in 0..COLUMNS {
            let target = &mut workspace.right_sides[c * inner..(c + 1) * inner];
            target.copy_from_slice(&workspace.residuals[c * n..c * n + inner]);
            for &pin in pins {
                target[pin] = 0.0;
            }
        }
        self.pattern
            .solve(&mut workspace.factor, &mut workspace.right_sides);
        let mut largest = 0.0_f64;
        for c in 0..COLUMNS {
            let (mut moved, mut whole) = (0.0, 0.0);
            for k in 0..inner {
                let step = workspace.right_sides[c * inner + k];
                let entry = &mut workspace.solutions[c * n + k];
                *entry += step;
                let weight = self.pattern.diagonal(k, &workspace.values);
                moved += weight * step * step;
                whole += weight * *entry * *entry;
            }
            if whole > 0.0 {
                largest = largest.max((moved / whole).sqrt());
            }
        }
        largest
    }

    /// `K_o = Σ (D T_o)ᵀ k (D T_o)`: the energy of the output's unit motions, in which errors
    /// of the motions count only squared.
    fn stiffness_by_energy(&self, workspace: &mut Workspace) -> Matrix6<f64> {
        let n = self.unknowns;
        let Workspace {
            operators,
            stiffnesses,
            solutions,
            scratch,
            forces,
            ..
        } = workspace;
        let mut stiffness = Matrix6::zeros();
        for element in &self.elements {
            let (rows, count) = (element.rows, element.columns.len());
            let d = &operators[element.operator_start..element.operator_start + rows * count];
            let k = &stiffnesses[element.stiffness_start..element.stiffness_start + rows * rows];
            let deformations = &mut scratch[..rows * 6];
            deformations.fill(0.0);
            for (c, deformation) in deformations.chunks_exact_mut(rows).enumerate() {
                for (&idc, d_column) in element.columns.iter().zip(d.chunks_exact(rows)) {
                    let u = solutions[c * n + idc];
                    for (sum, entry) in deformation.iter_mut().zip(d_column) {
                        *sum += u * entry;
                    }
                }
            }
            let forces = &mut forces[..rows * 6];
            multiply(k, deformations, rows, forces);
            for b in 0..6 {
                for a in 0..=b {
                    let deformation = &deformations[rows * a..rows * (a + 1)];
                    stiffness[(a, b)] += dot(deformation, &forces[rows * b..rows * (b + 1)]);
                }
            }
        }
        stiffness.fill_lower_triangle_with_upper_triangle();
        stiffness
    }

    /// The loads' force on the output: what holds it where it is, from the residual of the loads'
    /// column with the output clamped.
    fn output_force(&self, workspace: &mut Workspace) -> Vector6<f64> {
        self.residuals(workspace);
        let n = self.unknowns;
        let residual = &workspace.residuals[LOADS * n..(LOADS + 1) * n];
        let on_output = read(residual, self.inner);
        let through =
            Vector6::from_fn(|k, _| dot(&workspace.solutions[k * n..k * n + self.inner], residual));
        on_output + through
    }

    /// The output's stiffness, compliance and displacement; completes the loads' column.
    fn output(
        &self,
        geometry: &Geometry,
        workspace: &mut Workspace,
        pins: &[usize],
        restraint: &Restraint,
    ) -> Result<Output, SolveError> {
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
            let displacement = node_displacement(self, geometry, workspace, LOADS, self.output);
            self.find_remainder(workspace, pins, None);
            return Ok(Output {
                stiffness,
                compliance: (!free).then_some(compliance),
                displacement,
                rigid_directions,
                free_motions,
            });
        }
        let stiffness = self.stiffness_by_energy(workspace);
        let mut held = stiffness;
        if free {
            // A spring along each free twist, which no load works on, makes the rest solvable.
            let level = (0..6).map(|k| stiffness[(k, k)] * scale_of(k, size).powi(2));
            let level = level.sum::<f64>().max(f64::MIN_POSITIVE);
            for twist in &restraint.free_twists {
                let force = scaled(twist, size);
                held += force * force.transpose() * level;
            }
        }
        let compliance = inverse(&held, 0.0).ok_or(SolveError::Singular)?;
        let n = self.unknowns;
        for _ in 0..3 {
            // One correction of the output, then of the rest (the first finds the displacement).
            let force = self.output_force(workspace);
            let step = compliance * force;
            for k in 0..6 {
                for row in 0..n {
                    let motion = workspace.solutions[k * n + row];
                    workspace.solutions[LOADS * n + row] += motion * step[k];
                }
            }
            self.residuals(workspace);
            self.correct(workspace, pins);
        }
        let displacement = read(&workspace.solutions[LOADS * n..], self.inner);
        self.find_remainder(workspace, pins, Some(&compliance));
        Ok(Output {
            stiffness: Some(stiffness),
            compliance: (!free).then_some(compliance),
            displacement,
            rigid_directions: Vec::new(),
            free_motions,
        })
    }

    /// Finds what the loads' column still lacks, too small to be added to it: the forces of the
    /// elements take it in, so that they balance at every node to rounding.
    fn find_remainder(
        &self,
        workspace: &mut Workspace,
        pins: &[usize],
        compliance: Option<&Matrix6<f64>>,
    ) {
        let (n, inner) = (self.unknowns, self.inner);
        let step = compliance.map(|c| c * self.output_force(workspace));
        if step.is_none() {
            self.residuals(workspace);
        }
        let right_side = &mut workspace.right_sides[..inner];
        right_side.copy_from_slice(&workspace.residuals[LOADS * n..LOADS * n + inner]);
        for &pin in pins {
            right_side[pin] = 0.0;
        }
        self.pattern.solve(&mut workspace.factor, right_side);
        workspace.remainder.fill(0.0);
        workspace.remainder[..inner].copy_from_slice(right_side);
        for (k, step) in step.iter().flatten().enumerate() {
            let motion = &workspace.solutions[k * n..(k + 1) * n];
            for (entry, motion) in workspace.remainder.iter_mut().zip(motion) {
                *entry += motion * step;
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
        let shift = crate::coordinates::shift(geometry, reference, self.output);
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

/// Length scale of a component: the mechanism's size for translations, 1 for rotations.
fn scale_of(component: usize, size: f64) -> f64 {
    if component < 3 { size } else { 1.0 }
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
