//! The output: its stiffness, compliance and displacements, from the condensed columns.

use hyperstat_model::Geometry;
use nalgebra::{DMatrix, Matrix6, Vector6};

use crate::answer::solution::Output;
use crate::error::SolveError;
use crate::plan::Plan;
use crate::plan::blocks::{read, shift};
use crate::plan::workspace::{LOADS, Workspace};
use crate::pose::condense::UNITS;
use crate::pose::node_displacement;
use crate::pose::restraint::{Restraint, inverse, scale_of, scaled};
use crate::rank::dense::Elimination;
use crate::rank::echelon::echelon;

/// Corrections of the output, once its stiffness is known.
const CORRECTIONS: usize = 3;

/// What is found of the output: itself, its displacements in all sets, the relative size of their
/// last correction, and the compliance that corrects it where its coordinates are independent.
pub(crate) type OutputFound = (Output, Vec<Vector6<f64>>, f64, Option<Matrix6<f64>>);

impl Plan {
    /// The output's stiffness and its displacement under the first set of loads, its compliance where
    /// its coordinates are not independent; its displacements under all sets; and the relative size
    /// of the last correction of these, by `works`: one a set, the least that a correction's work is
    /// measured by. Completes the sets' columns.
    pub(crate) fn output(
        &self,
        geometry: &Geometry,
        workspace: &mut Workspace,
        pins: &[usize],
        restraint: &Restraint,
        works: &[f64],
    ) -> Result<OutputFound, SolveError> {
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
                self.find_remainder(workspace, pins, None, column..column + 1);
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
            self.find_remainder(workspace, pins, Some(&compliance), column..column + 1);
        }
        let output = Output {
            stiffness: Some(stiffness),
            compliance: None,
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
    pub(crate) fn output_displacement(&self, workspace: &Workspace, column: usize) -> Vector6<f64> {
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
    /// six forces go together, in the columns of the unit motions; their own columns come with it.
    pub(crate) fn refined_compliance(
        &self,
        workspace: &mut Workspace,
        pins: &[usize],
        inverse: &Matrix6<f64>,
    ) -> (Matrix6<f64>, Vec<f64>) {
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
        let columns = workspace.solutions[kept.clone()].to_vec();
        workspace.solutions[kept.clone()].copy_from_slice(&motions);
        workspace.loads[kept].copy_from_slice(&loads);
        ((compliance + compliance.transpose()) * 0.5, columns)
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
        let to_output = shift(geometry, reference, self.output);
        let mut rows = DMatrix::zeros(self.columns[carrier].len(), 6);
        for (k, &idc) in self.columns[carrier].iter().enumerate() {
            let (_, dof) = workspace.identities[idc];
            let twist =
                scaled(&(to_output * read(block, 6 * k)), size) * scale_of(dof.index(), size);
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
