//! How far rounding moves the other printed numbers: displacements of all nodes, joint wrenches and
//! the forces at the ends of segments.
//!
//! The estimate of the output (`precision.rs`) takes one unit force a number. For all nodes and
//! joints that would be as many solutions; so their roundings act here together, as random signs say,
//! and what they do is solved and recovered as a state of its own, a few times (the book,
//! "Refinement").

use hyperstat_model::NodeId;
use nalgebra::{Matrix6, Vector6};

use super::precision::{BITS, Columns};
use super::recover::recover;
use crate::answer::solution::State;
use crate::error::SolveError;
use crate::plan::Plan;
use crate::plan::blocks::{dot, read, shift};
use crate::plan::workspace::{LOADS, Workspace};
use crate::posture::Posture;
use crate::state::acting::Acting;

/// Random choices of the signs.
const SAMPLES: u64 = 3;

/// What a state's kinds of numbers are measured by.
struct Scales {
    displacement: [f64; 2],
    wrench: f64,
    end: f64,
}

impl Plan {
    /// The relative error of displacements, joint wrenches and segments' end forces in all states,
    /// each by the largest of its kind: an estimate. `compliance` of the output where it is
    /// independent. Leaves the sets' columns of the workspace spent.
    pub(crate) fn spread(
        &self,
        at: &Posture<'_>,
        workspace: &mut Workspace,
        (pins, compliance): (&[usize], Option<&Matrix6<f64>>),
        states: &[State],
    ) -> Result<f64, SolveError> {
        let n = self.unknowns;
        if n == 0 {
            return Ok(0.0);
        }
        let scales: Vec<Scales> = states.iter().map(Scales::of).collect();
        let mut lost = self.summed_up(at, workspace, &scales);
        // Sizes of what rounds in deformations and in forces: by elements, then states.
        let mut roundings = Vec::with_capacity(self.elements.len());
        for element in &self.elements {
            let sizes = self.operand_sizes(element, at, workspace)?;
            let loaded = Columns {
                values: &workspace.solutions[n * LOADS..],
                initial: Some(&workspace.initial),
            };
            roundings.push(self.parts(element, &sizes, workspace, &loaded));
        }
        workspace.offsets.clear();
        let nothing = Acting::nothing();
        let mut signs = Signs(0x9e37_79b9_7f4a_7c15);
        for _ in 0..SAMPLES {
            workspace.solutions[n * LOADS..].fill(0.0);
            workspace.loads[n * LOADS..].fill(0.0);
            workspace.remainders.fill(0.0);
            for (element, parts) in self.elements.iter().zip(&roundings) {
                let rows = element.rows;
                let operator =
                    &workspace.operators[element.operator_start..][..rows * element.columns.len()];
                for (set, part) in parts.iter().enumerate() {
                    let start = set * self.deformations + element.initial_start;
                    let initial = &mut workspace.initial[start..start + rows];
                    for (entry, size) in initial.iter_mut().zip(&part.summed) {
                        *entry = signs.give(BITS * size);
                    }
                    let sizes = part.weighed.iter();
                    let force: Vec<f64> = sizes.map(|size| signs.give(BITS * size)).collect();
                    for (&idc, column) in element.columns.iter().zip(operator.chunks_exact(rows)) {
                        workspace.loads[(LOADS + set) * n + idc] -= dot(column, &force);
                    }
                }
            }
            for (set, (state, scales)) in states.iter().zip(&scales).enumerate() {
                let column = LOADS + set;
                self.residuals(workspace, column..column + 1);
                self.correct(workspace, pins, column..column + 1);
                if let Some(compliance) = compliance {
                    self.settle(workspace, pins, compliance, column, 0.0);
                } else {
                    self.residuals(workspace, column..column + 1);
                    self.correct(workspace, pins, column..column + 1);
                }
                self.find_remainder(workspace, pins, compliance, column..column + 1);
                let (acting, floor) = (&nothing, &state.floor.of_nothing());
                let output = Vector6::zeros();
                let moved = recover(self, at, workspace, set, (acting, floor), output)?;
                lost = lost.max(scales.share(&moved.state));
            }
        }
        Ok(lost)
    }

    /// The rounding of displacements summed up from those of the IDCs.
    fn summed_up(&self, at: &Posture<'_>, workspace: &Workspace, scales: &[Scales]) -> f64 {
        let Posture {
            model, geometry, ..
        } = *at;
        let n = self.unknowns;
        let mut lost = 0.0_f64;
        for (set, scales) in scales.iter().enumerate() {
            let solution = &workspace.solutions[(LOADS + set) * n..][..n];
            for node in (0..model.nodes().len()).map(NodeId) {
                let carrier = self.topology.carrier_of[node.0];
                let block = self.block(workspace, carrier);
                let mut size = Vector6::zeros();
                for (k, &idc) in self.columns[carrier].iter().enumerate() {
                    size += read(block, 6 * k).abs() * solution[idc].abs();
                }
                let reference = self.topology.carriers[carrier].reference;
                let size = shift(geometry, reference, node).abs() * size;
                lost = lost.max(BITS * scales.displacement(&size));
            }
        }
        lost
    }
}

impl State {
    /// The largest joint wrench \[N\], moments over the size; no less than that of the floor.
    pub(crate) fn largest_wrench(&self) -> f64 {
        let floor = &self.floor;
        let wrenches = self.joint_wrenches.iter().flatten();
        wrenches.fold(floor.least_force(), |most, w| most.max(floor.as_force(w)))
    }
}

impl Scales {
    fn of(state: &State) -> Self {
        let floor = &state.floor;
        let least = floor.least_force();
        let ends = state.segments.iter().flat_map(|s| &s.ends);
        Self {
            displacement: state.scale(),
            wrench: state.largest_wrench(),
            end: ends.fold(least, |most, w| most.max(floor.as_force(w))),
        }
    }

    /// The largest number of a state by these scales.
    fn share(&self, state: &State) -> f64 {
        let floor = &state.floor;
        let displacements = state.displacements.iter().map(|u| self.displacement(u));
        let wrenches = state.joint_wrenches.iter().flatten();
        let wrenches = wrenches.map(|w| floor.as_force(w) / self.wrench);
        let ends = state.segments.iter().flat_map(|s| &s.ends);
        let ends = ends.map(|w| floor.as_force(w) / self.end);
        let all = displacements.chain(wrenches).chain(ends);
        all.filter(|share| share.is_finite()).fold(0.0, f64::max)
    }

    fn displacement(&self, displacement: &Vector6<f64>) -> f64 {
        let shares = displacement.iter().enumerate();
        let shares = shares.map(|(k, u)| u.abs() / self.displacement[k / 3]);
        shares.filter(|share| share.is_finite()).fold(0.0, f64::max)
    }
}

/// Random signs (xorshift), the same in every run.
struct Signs(u64);

impl Signs {
    fn give(&mut self, size: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        if self.0 >> 63 == 0 { size } else { -size }
    }
}
