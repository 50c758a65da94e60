//! The cases of a mechanism in the report of `hyperstat solve`: each with what the base state has.

use hyperstat_assembly::{CaseSolution, Model, NodeId, SegmentId, Solution, SolveError, State};
use serde::Serialize;

use super::forces::{BodyReport, bodies};
use super::joints::JointReport;
use super::solve::SegmentReport;
use super::{inner_displacements_of, numbers};
use crate::entries::Entries;

/// What a case does. Field names are those of the JSON output.
#[derive(Debug, Serialize)]
pub struct CaseReport {
    /// The output in it.
    pub output: CaseOutput,
    /// Displacements of the nodes by name, `body.point`: x y z \[m\], rx ry rz \[rad\], global.
    pub displacements: Entries<[f64; 6]>,
    /// Joints by name; their frames are told with the state that is no case.
    pub joints: Entries<JointReport>,
    /// Beam segments in the order of the model.
    pub segments: Vec<SegmentReport>,
    /// Bodies by name.
    pub bodies: Entries<BodyReport>,
}

/// The output in a case.
#[derive(Debug, Serialize)]
pub struct CaseOutput {
    /// x y z \[m\], rx ry rz \[rad\], global.
    pub displacement: [f64; 6],
}

/// The cases of a solution by name.
pub(super) fn cases(model: &Model, solution: &Solution) -> Entries<CaseReport> {
    let report = |case: &CaseSolution| (case.name.clone(), CaseReport::new(model, &case.state));
    solution.cases.iter().map(report).collect()
}

impl CaseReport {
    fn new(model: &Model, state: &State) -> Self {
        let nodes = (0..model.nodes().len()).map(NodeId);
        let named = nodes.map(|node| {
            let displacement = &state.displacements[node.0];
            (model.node_name(node), numbers(displacement))
        });
        let joints = model.joints().iter().zip(&state.joint_wrenches);
        let segments = model.segments().iter().zip(&state.segments);
        Self {
            output: CaseOutput {
                displacement: numbers(&state.output),
            },
            displacements: named.collect(),
            joints: joints
                .map(|(joint, wrench)| (joint.name.clone(), JointReport::new(wrench.as_ref())))
                .collect(),
            segments: segments
                .enumerate()
                .map(|(k, (segment, forces))| {
                    SegmentReport::new(model, SegmentId(k), segment, forces)
                })
                .collect(),
            bodies: bodies(model, |body| state.worst_point(model, body)),
        }
    }

    /// Adds the displacements of the nodes inside segments.
    ///
    /// # Errors
    /// A segment that cannot be formed, which no segment of a solved model is.
    pub(super) fn add_inner(&mut self, model: &Model, state: &State) -> Result<(), SolveError> {
        let inner = inner_displacements_of(model, |id| state.inner_displacements(model, id))?;
        self.displacements.0.extend(inner.0);
        Ok(())
    }
}
