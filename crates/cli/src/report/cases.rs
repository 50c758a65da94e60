//! The cases of a mechanism in the report of `hyperstat solve`: each with what the base state has.

use hyperstat_assembly::{CaseSolution, Model, NodeId, SegmentId, Solution, SolveError, State};
use serde::Serialize;

use super::forces::{BodyReport, bodies, write_worst};
use super::joints::{JointReport, joint_table};
use super::solve::{SegmentReport, segment_tables};
use super::{
    Entries, WRENCH, displacement_table, heads, inner_displacements_of, numbers, output_table,
    section,
};

/// What a case does. Field names are those of the JSON output.
#[derive(Debug, Serialize)]
pub(super) struct CaseReport {
    pub(super) output: Output,
    pub(super) displacements: Entries<[f64; 6]>,
    joints: Entries<JointReport>,
    segments: Vec<SegmentReport>,
    pub(super) bodies: Entries<BodyReport>,
}

#[derive(Debug, Serialize)]
pub(super) struct Output {
    pub(super) displacement: [f64; 6],
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
            output: Output {
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

    /// The case as tables.
    pub(super) fn write(&self, name: &str, text: &mut String) {
        let title = |what: &str| format!("Case `{name}`: {what}");
        let table = output_table(&self.output.displacement, &self.displacements);
        section(text, &title("displacement of the output [m, rad]"), table);
        let table = displacement_table(&self.displacements);
        section(text, &title("displacements of the nodes [m, rad]"), table);
        if !self.joints.0.is_empty() {
            let table = joint_table(&self.joints, heads(&["joint"], WRENCH));
            let heading =
                "joint wrenches, on the second body, at the joint, in the joint frame [N, N·m]";
            section(text, &title(heading), table);
        }
        if !self.segments.is_empty() {
            let (forces, stresses) = segment_tables(&self.segments);
            section(
                text,
                &title("forces on the ends of segments, in the element frame [N, N·m]"),
                forces,
            );
            section(text, &title("largest stresses of segments [Pa]"), stresses);
        }
        write_worst(&self.bodies, &title("worst point"), text);
    }
}
