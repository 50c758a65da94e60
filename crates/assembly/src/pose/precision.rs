//! How many digits a solution has lost: an estimate on the safe side.
//!
//! Refinement takes out what the factorization loses. What it cannot see is rounding in the elements
//! themselves: in their deformations `D U`, where rigid motion cancels, and in their forces `k d`,
//! where a soft direction lies across stiff ones. By virtual work an error δd of the deformations of
//! a state j changes what it does along a state i by `f_iᵀ δd`, and an error δf of its forces by
//! `d_iᵀ δf`, summed over the elements. Both are taken as large as the last bits of what is summed
//! up in them: δd of the displacements of the nodes that D takes off each other, δf of `|k| |d|`
//! (the book, "Refinement").

use nalgebra::{Matrix6, Vector6};

use super::condense::UNITS;
use super::subassembly::subassembly_frame;
use crate::answer::solution::{Output, State};
use crate::error::SolveError;
use crate::plan::Plan;
use crate::plan::blocks::{multiply, read, shift};
use crate::plan::elements::{ElementPlan, Source};
use crate::plan::workspace::{LOADS, Workspace};
use crate::posture::Posture;

/// Last bits by which a sum of a few products is off, with room to spare: measured on random
/// mechanisms against 32 digits (`tests`, `precision.rs`).
pub(crate) const BITS: f64 = 8.0 * f64::EPSILON;

/// Stiffness of the output below this share of the elements' is looked at: energies are off by the
/// square of a double's last bits, 1e-31, and what sizes do to units is far from the rest.
const FAINT: f64 = 1e-20;

/// Displacements of the IDCs in some states.
pub(crate) struct Columns<'a> {
    pub values: &'a [f64],
    /// Deformations that the elements start from, where they do: by states.
    pub initial: Option<&'a [f64]>,
}

/// What an element does in a state.
pub(crate) struct Estimated {
    deformation: Vec<f64>,
    force: Vec<f64>,
    /// Sizes of what is summed up in each.
    pub summed: Vec<f64>,
    pub weighed: Vec<f64>,
}

impl Plan {
    /// The relative error of the output's stiffness and compliance, and of its displacements in all
    /// states by the largest of their kind: an estimate.
    pub(crate) fn lost(
        &self,
        at: &Posture<'_>,
        workspace: &Workspace,
        output: &Output,
        states: &[State],
    ) -> Result<f64, SolveError> {
        let n = self.unknowns;
        let Some(State { floor, .. }) = states.first().filter(|_| n > 0) else {
            return Ok(0.0);
        };
        let units = &workspace.solutions[n * UNITS.start..n * UNITS.end];
        let loaded = Columns {
            values: &workspace.solutions[n * LOADS..],
            initial: Some(&workspace.initial),
        };
        let forced = match &output.compliance {
            Some(compliance) if self.output_is_independent() => combined(units, compliance, n),
            _ => units.to_vec(),
        };
        let at_rest = |values| Columns {
            values,
            initial: None,
        };
        let groups = [at_rest(units), at_rest(&forced), loaded];
        let sets = states.len();
        let mut moved = [[0.0; 6]; 6];
        let mut given = vec![[0.0; 6]; 6 + sets];
        for element in &self.elements {
            let sizes = self.operand_sizes(element, at, workspace)?;
            let [motions, forces, loaded] = groups
                .each_ref()
                .map(|columns| self.parts(element, &sizes, workspace, columns));
            add_errors(&mut moved, &motions);
            for (i, first) in forces.iter().enumerate() {
                for (j, second) in forces.iter().chain(&loaded).enumerate() {
                    given[j][i] += first.error_of(second);
                }
            }
        }
        let mut lost = 0.0_f64;
        let unfree = output.free_motions.len() < 6;
        let stiffness = output.stiffness.as_ref().filter(|_| unfree);
        if let (Some(stiffness), true) = (stiffness, self.output_is_independent()) {
            lost = lost.max(largest(&moved, &floor.stiffness_scales(stiffness)));
        }
        if let Some(compliance) = &output.compliance {
            lost = lost.max(largest(&given[..6], &floor.compliance_scales(compliance)));
            for (state, errors) in states.iter().zip(&given[6..]) {
                let scale = state.scale();
                let relative = errors.iter().enumerate().map(|(k, e)| e / scale[k / 3]);
                lost = relative.filter(|e| e.is_finite()).fold(lost, f64::max);
            }
        }
        Ok(BITS * lost)
    }

    /// Whether the output's stiffness is next to nothing beside that of the elements, so that it may be
    /// the rounding of their energy.
    pub(crate) fn is_faint(&self, workspace: &Workspace, stiffness: &Matrix6<f64>) -> bool {
        let entries = workspace.stiffnesses.iter();
        let stiffest = entries.fold(0.0_f64, |most, entry| most.max(entry.abs()));
        stiffness.diagonal().min() <= FAINT * stiffest
    }

    /// Whether no digit of the output's stiffness is right, each entry by its own row and column: an
    /// estimate. The output's coordinates are independent.
    pub(crate) fn is_rounding(
        &self,
        at: &Posture<'_>,
        workspace: &Workspace,
        stiffness: &Matrix6<f64>,
    ) -> Result<bool, SolveError> {
        let n = self.unknowns;
        let units = Columns {
            values: &workspace.solutions[n * UNITS.start..n * UNITS.end],
            initial: None,
        };
        let mut moved = [[0.0; 6]; 6];
        for element in &self.elements {
            let sizes = self.operand_sizes(element, at, workspace)?;
            add_errors(&mut moved, &self.parts(element, &sizes, workspace, &units));
        }
        Ok(BITS * largest(&moved, &stiffness.diagonal().into()) >= 1.0)
    }

    /// What an element does in some states.
    pub(crate) fn parts(
        &self,
        element: &ElementPlan,
        sizes: &[f64],
        workspace: &Workspace,
        columns: &Columns<'_>,
    ) -> Vec<Estimated> {
        let (rows, n) = (element.rows, self.unknowns);
        let operator =
            &workspace.operators[element.operator_start..][..rows * element.columns.len()];
        let k = &workspace.stiffnesses[element.stiffness_start..][..rows * rows];
        let k_sizes: Vec<f64> = k.iter().map(|entry| entry.abs()).collect();
        let of = |(state, values): (usize, &[f64])| {
            let mut deformation = match columns.initial {
                Some(initial) => {
                    initial[state * self.deformations + element.initial_start..][..rows].to_vec()
                }
                None => vec![0.0; rows],
            };
            let mut summed: Vec<f64> = deformation.iter().map(|entry| entry.abs()).collect();
            let pairs = operator.chunks_exact(rows).zip(sizes.chunks_exact(rows));
            for (&idc, (column, sizes)) in element.columns.iter().zip(pairs) {
                let u = values[idc];
                for row in 0..rows {
                    deformation[row] += u * column[row];
                    summed[row] += u.abs() * sizes[row];
                }
            }
            let mut force = vec![0.0; rows];
            multiply(k, &deformation, rows, &mut force);
            let sizes: Vec<f64> = deformation.iter().map(|entry| entry.abs()).collect();
            let mut weighed = vec![0.0; rows];
            multiply(&k_sizes, &sizes, rows, &mut weighed);
            Estimated {
                deformation,
                force,
                summed,
                weighed,
            }
        };
        columns.values.chunks_exact(n).enumerate().map(of).collect()
    }

    /// As the operator D of an element, with sizes in place of what D sums up.
    pub(crate) fn operand_sizes(
        &self,
        element: &ElementPlan,
        at: &Posture<'_>,
        workspace: &Workspace,
    ) -> Result<Vec<f64>, SolveError> {
        let geometry = at.geometry;
        let rows = element.rows;
        let mut sizes = vec![0.0; rows * element.columns.len()];
        for (r, (node, places)) in element.nodes.iter().enumerate() {
            let carrier = self.topology.carrier_of[node.0];
            let block = self.block(workspace, carrier);
            let column = |k: usize| read(block, 6 * k).abs();
            match element.source {
                Source::Spring(joint) => {
                    let local = at.direction_map(joint).abs();
                    let reference = self.topology.carriers[carrier].reference;
                    let to_node = local * shift(geometry, reference, *node).abs();
                    let springs = self.topology.joints[joint.0].springs;
                    for (k, place) in places.iter().enumerate() {
                        if *place >= element.columns.len() {
                            continue;
                        }
                        let own = to_node * column(k);
                        for (row, dof) in springs.iter().enumerate() {
                            sizes[rows * place + row] += own[dof.index()];
                        }
                    }
                }
                Source::Subassembly(subassembly) => {
                    let subassembly = &self.topology.subassemblies[subassembly];
                    let turn = subassembly_frame(subassembly, geometry)?
                        .matrix()
                        .transpose()
                        .abs();
                    let moved: Vec<(usize, Matrix6<f64>)> = match r {
                        0 => (subassembly.nodes[1..].iter().enumerate())
                            .map(|(other, to)| (other, shift(geometry, *node, *to).abs()))
                            .collect(),
                        _ => vec![(r - 1, Matrix6::identity())],
                    };
                    for (k, place) in places.iter().enumerate() {
                        for (other, carried) in &moved {
                            let own = carried * column(k);
                            let target = &mut sizes[rows * place + 6 * other..][..6];
                            for part in [0, 3] {
                                let turned = turn * own.fixed_rows::<3>(part);
                                for row in 0..3 {
                                    target[part + row] += turned[row];
                                }
                            }
                        }
                    }
                }
            }
        }
        Ok(sizes)
    }
}

impl Estimated {
    /// What an error of `other` does along this one.
    fn error_of(&self, other: &Self) -> f64 {
        let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a.abs() * b).sum() };
        dot(&self.force, &other.summed) + dot(&self.deformation, &other.weighed)
    }
}

impl State {
    /// The largest translation and rotation of any node; no less than those of the floor.
    pub(crate) fn scale(&self) -> [f64; 2] {
        let least = self.floor.least_displacement();
        let largest = |start: usize| {
            let parts = self.displacements.iter();
            parts.fold(0.0, |most: f64, u: &Vector6<f64>| {
                most.max(u.fixed_rows::<3>(start).amax())
            })
        };
        [
            largest(0).max(least),
            largest(3).max(least / self.floor.size),
        ]
    }
}

/// Adds what the roundings of an element do to the output's stiffness; `motions`: the element under
/// unit motions of the output.
fn add_errors(moved: &mut [[f64; 6]; 6], motions: &[Estimated]) {
    for (i, first) in motions.iter().enumerate() {
        for (j, second) in motions.iter().enumerate() {
            moved[j][i] += first.error_of(second) + second.error_of(first);
        }
    }
}

/// Columns combined by the columns of a matrix.
fn combined(columns: &[f64], matrix: &Matrix6<f64>, n: usize) -> Vec<f64> {
    let mut out = vec![0.0; 6 * n];
    for (k, sum) in out.chunks_exact_mut(n).enumerate() {
        for (column, weight) in columns.chunks_exact(n).zip(matrix.column(k).iter()) {
            for (entry, value) in sum.iter_mut().zip(column) {
                *entry += weight * value;
            }
        }
    }
    out
}

/// The largest error over the scales of its row and column.
fn largest(errors: &[[f64; 6]], scales: &[f64; 6]) -> f64 {
    let over = |(j, column): (usize, &[f64; 6])| {
        let relative = |i: usize| column[i] / (scales[i] * scales[j]).sqrt();
        (0..6).map(relative).fold(0.0, f64::max)
    };
    errors.iter().enumerate().map(over).fold(0.0, f64::max)
}
