//! Condensation to the output (Eqs. 43–45) and refinement.
//!
//! Columns of the solutions: with the output's six coordinates independent, its unit motions
//! (Eq. 45's T_o); otherwise unit forces on it; and one column a set of loads. Every column starts
//! at zero and is
//! corrected by the factor from residuals formed in the elements' deformations,
//! `Hᵀ F − Dᵀ k (D U + δ₀)`: the first correction is the plain solution, the others are refinement
//! (the book, "Refinement").

use std::ops::Range;

use nalgebra::{Matrix6, Vector6};

use crate::error::SolveError;
use crate::plan::Plan;
use crate::plan::blocks::{dot, multiply, read};
use crate::plan::workspace::{LOADS, Workspace};
use crate::pose::recover::element_forces;

/// Refinement steps at the most.
const MOST_REFINEMENTS: usize = 6;
/// A last correction above this share of the solution is no solution.
const TRUSTED: f64 = 1e-6;

/// The columns of the output's unit motions or unit forces.
pub(crate) const UNITS: Range<usize> = 0..LOADS;

impl Plan {
    /// [Factors](Self::factor) the inner stiffness and [finds](Self::find) all columns.
    pub(crate) fn condense(
        &self,
        workspace: &mut Workspace,
        pins: &[usize],
        enough: f64,
    ) -> Result<f64, SolveError> {
        self.factor(workspace, pins)?;
        self.find(workspace, pins, enough)
    }

    /// Factors the inner stiffness with `pins` held.
    pub(crate) fn factor(
        &self,
        workspace: &mut Workspace,
        pins: &[usize],
    ) -> Result<(), SolveError> {
        for &pin in pins {
            let scale = self.pattern.diagonal(pin, &workspace.values).max(1.0);
            self.pattern.pin(pin, scale, &mut workspace.values);
        }
        self.pattern
            .factorize(&workspace.values, &mut workspace.factor)
            .map_err(|_| SolveError::Singular)
    }

    /// Finds all columns of the solutions by what is factored, refining until a correction is below
    /// `enough` of the solution or no longer shrinks; returns the relative size of the last
    /// correction. Fails where it does not settle.
    pub(crate) fn find(
        &self,
        workspace: &mut Workspace,
        pins: &[usize],
        enough: f64,
    ) -> Result<f64, SolveError> {
        workspace.solutions.fill(0.0);
        if self.output_is_independent() {
            for k in 0..6 {
                workspace.solutions[k * self.unknowns + self.inner + k] = 1.0;
            }
        }
        let all = 0..workspace.columns();
        self.residuals(workspace, all.clone());
        self.correct(workspace, pins, all.clone());
        let mut last = f64::INFINITY;
        for _ in 0..MOST_REFINEMENTS {
            self.residuals(workspace, all.clone());
            let change = self.correct(workspace, pins, all.clone());
            let settled = change < enough || change > 0.5 * last;
            last = change;
            if settled {
                break;
            }
        }
        if last < TRUSTED {
            Ok(last)
        } else {
            Err(SolveError::Singular)
        }
    }

    /// Residuals `Hᵀ F − Dᵀ k (D U + δ₀)` of some columns, and their energies.
    pub(crate) fn residuals(&self, workspace: &mut Workspace, which: Range<usize>) {
        let n = self.unknowns;
        let Workspace {
            operators,
            stiffnesses,
            initial,
            loads,
            solutions,
            residuals,
            energies,
            scratch,
            forces,
            ..
        } = workspace;
        let places = n * which.start..n * which.end;
        residuals[places.clone()].copy_from_slice(&loads[places]);
        energies[which.clone()].fill(0.0);
        for element in &self.elements {
            let (rows, count) = (element.rows, element.columns.len());
            let d = &operators[element.operator_start..element.operator_start + rows * count];
            let k = &stiffnesses[element.stiffness_start..element.stiffness_start + rows * rows];
            let deformations = &mut scratch[..rows * which.len()];
            deformations.fill(0.0);
            for (c, deformation) in which.clone().zip(deformations.chunks_exact_mut(rows)) {
                if let Some(set) = c.checked_sub(LOADS) {
                    let start = set * self.deformations + element.initial_start;
                    deformation.copy_from_slice(&initial[start..start + rows]);
                }
                for (&idc, d_column) in element.columns.iter().zip(d.chunks_exact(rows)) {
                    let u = solutions[c * n + idc];
                    if u != 0.0 {
                        for (sum, entry) in deformation.iter_mut().zip(d_column) {
                            *sum += u * entry;
                        }
                    }
                }
            }
            let forces = &mut forces[..rows * which.len()];
            multiply(k, deformations, rows, forces);
            let parts = deformations
                .chunks_exact(rows)
                .zip(forces.chunks_exact(rows));
            for (c, (deformation, force)) in which.clone().zip(parts) {
                energies[c] += dot(deformation, force);
                for (&idc, d_column) in element.columns.iter().zip(d.chunks_exact(rows)) {
                    residuals[c * n + idc] -= dot(d_column, force);
                }
            }
        }
    }

    /// Corrects the inner part of some columns by their residuals; returns the largest relative
    /// change, coordinates weighted by their stiffness.
    pub(crate) fn correct(
        &self,
        workspace: &mut Workspace,
        pins: &[usize],
        which: Range<usize>,
    ) -> f64 {
        let (n, inner) = (self.unknowns, self.inner);
        if inner == 0 {
            return 0.0;
        }
        let right_sides = &mut workspace.right_sides[..inner * which.len()];
        for (c, target) in which.clone().zip(right_sides.chunks_exact_mut(inner)) {
            target.copy_from_slice(&workspace.residuals[c * n..c * n + inner]);
            for &pin in pins {
                target[pin] = 0.0;
            }
        }
        self.pattern.solve(&mut workspace.factor, right_sides);
        let mut largest = 0.0_f64;
        for (c, steps) in which.zip(right_sides.chunks_exact(inner)) {
            let mut moved = 0.0;
            let mut whole = 0.0;
            for (k, step) in steps.iter().enumerate() {
                let entry = &mut workspace.solutions[c * n + k];
                *entry += step;
                let weight = self.pattern.diagonal(k, &workspace.values);
                moved += weight * step * step;
                whole += weight * *entry * *entry;
            }
            // Where only the output moves, what it does to the elements is the measure.
            let whole = f64::max(whole, workspace.energies[c]);
            if whole > 0.0 {
                largest = largest.max((moved / whole).sqrt());
            }
        }
        largest
    }

    /// `K_o = Σ (D T_o)ᵀ k (D T_o)`: the energy of the output's unit motions, in which errors
    /// of the motions count only squared.
    pub(crate) fn stiffness_by_energy(&self, workspace: &mut Workspace) -> Matrix6<f64> {
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

    /// The force of a set of loads on the output: what holds it where it is, from the residual of
    /// its column with the output clamped.
    pub(crate) fn output_force(&self, workspace: &mut Workspace, column: usize) -> Vector6<f64> {
        self.residuals(workspace, column..column + 1);
        let n = self.unknowns;
        let residual = &workspace.residuals[column * n..(column + 1) * n];
        self.force_on_output(residual, &workspace.solutions)
    }

    /// What a residual asks of the output, directly and through the output's unit `motions`.
    pub(crate) fn force_on_output(&self, residual: &[f64], motions: &[f64]) -> Vector6<f64> {
        let n = self.unknowns;
        let through = |k| dot(&motions[k * n..k * n + self.inner], residual);
        read(residual, self.inner) + Vector6::from_fn(|k, _| through(k))
    }

    /// Finds what the columns of some sets still lack, too small to be added to them: the forces of
    /// the elements take it in, so that they balance at every node to rounding. It is refined like the
    /// columns themselves, each as long as its corrections shrink.
    pub(crate) fn find_remainder(
        &self,
        workspace: &mut Workspace,
        pins: &[usize],
        compliance: Option<&Matrix6<f64>>,
        which: Range<usize>,
    ) {
        let (n, inner) = (self.unknowns, self.inner);
        workspace.remainders[(which.start - LOADS) * n..(which.end - LOADS) * n].fill(0.0);
        // The size of each one's last correction, as long as they shrink.
        let mut last = vec![Some(f64::INFINITY); which.len()];
        let mut inner_steps = vec![0.0; inner * which.len()];
        for _ in 0..MOST_REFINEMENTS {
            for (place, column) in which.clone().enumerate() {
                self.imbalance(workspace, column);
                let step = &mut inner_steps[place * inner..(place + 1) * inner];
                step.copy_from_slice(&workspace.residuals[column * n..column * n + inner]);
                for &pin in pins {
                    step[pin] = 0.0;
                }
            }
            self.pattern.solve(&mut workspace.factor, &mut inner_steps);
            for (place, column) in which.clone().enumerate() {
                let Some(before) = last[place] else { continue };
                let residual = &workspace.residuals[column * n..(column + 1) * n];
                let mut step = vec![0.0; n];
                step[..inner].copy_from_slice(&inner_steps[place * inner..(place + 1) * inner]);
                let moved =
                    compliance.map(|c| c * self.force_on_output(residual, &workspace.solutions));
                for (k, share) in moved.iter().flatten().enumerate() {
                    let motion = &workspace.solutions[k * n..(k + 1) * n];
                    for (entry, motion) in step.iter_mut().zip(motion) {
                        *entry += motion * share;
                    }
                }
                // Work of the residual: positive but for rounding.
                let work = dot(&step, residual).abs();
                last[place] = (work < before).then_some(work);
                if last[place].is_some() {
                    let own = &mut workspace.remainders[(column - LOADS) * n..][..n];
                    for (entry, step) in own.iter_mut().zip(&step) {
                        *entry += step;
                    }
                }
            }
            if last.iter().all(Option::is_none) {
                break;
            }
        }
    }

    /// Residual of a set's column, its remainder included.
    fn imbalance(&self, workspace: &mut Workspace, column: usize) {
        let n = self.unknowns;
        let all = element_forces(self, workspace, column - LOADS);
        let residual = &mut workspace.residuals[column * n..(column + 1) * n];
        residual.copy_from_slice(&workspace.loads[column * n..(column + 1) * n]);
        for (element, forces) in self.elements.iter().zip(&all) {
            let (rows, start) = (element.rows, element.operator_start);
            let d = &workspace.operators[start..start + rows * element.columns.len()];
            for (&idc, d_column) in element.columns.iter().zip(d.chunks_exact(rows)) {
                residual[idc] -= dot(d_column, forces);
            }
        }
    }
}
