//! The report of `hyperstat solve`.

use hyperstat_assembly::{
    JointId, Model, Segment, SegmentForces, SegmentId, Solution, SolveError, describe_motions,
};
use hyperstat_elements::stress::{largest_stress, section_stress, stress_along};
use hyperstat_elements::{BeamLoad, Taper};
use nalgebra::{Rotation3, Vector6};
use serde::Serialize;

use super::cases::{CaseReport, cases};
use super::forces::{BodyReport, SectionForces, bodies, section_forces, write_worst};
use super::joints::{JointReport, joint_table};
use super::loads::loads;
use super::misfits::write_misfits;
use super::why::Why;
use super::{
    DISPLACEMENT, Entries, FrequencyReport, ModesReport, Rounding, Rows, Table, WRENCH,
    displacement_table, doubts, heads, inner_displacements, list, matrix_table, numbers,
    output_table, redundancies, rows, section, stiffness_table,
};
use crate::case::Case;
use crate::plausibility::{of_model, of_solution};
use crate::verification::Verification;

/// Everything that one solve found. Field names are those of the JSON output.
#[derive(Debug, Serialize)]
pub(crate) struct SolveReport {
    pub(super) name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) job: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) design: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) pose: Option<usize>,
    pub(super) unknowns: usize,
    pub(super) mobility: usize,
    pub(super) overconstraint: usize,
    pub(super) redundant_constraints: Vec<Vec<String>>,
    pub(super) idle_modes: usize,
    pub(super) idle_motions: Vec<String>,
    pub(super) output: OutputReport,
    pub(super) displacements: Entries<[f64; 6]>,
    pub(super) joints: Entries<JointReport>,
    pub(super) undetermined: Vec<String>,
    pub(super) segments: Vec<SegmentReport>,
    pub(super) warnings: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) verification: Option<Verification>,
    #[serde(flatten)]
    pub(super) modes: Option<ModesReport>,
    pub(super) bodies: Entries<BodyReport>,
    #[serde(flatten)]
    pub(super) why: Option<Why>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) frequency_sensitivities: Vec<FrequencyReport>,
    #[serde(skip_serializing_if = "Entries::is_empty")]
    pub(super) cases: Entries<CaseReport>,
    /// The loads in words and tables, for the text only.
    #[serde(skip)]
    pub(super) loads: String,
}

#[derive(Debug, Serialize)]
pub(super) struct OutputReport {
    pub(super) node: String,
    pub(super) position: [f64; 3],
    pub(super) stiffness: Option<Rows>,
    pub(super) compliance: Option<Rows>,
    pub(super) displacement: [f64; 6],
    pub(super) rigid_directions: Vec<[f64; 6]>,
    pub(super) free_motions: Vec<[f64; 6]>,
}

#[derive(Debug, Serialize)]
pub(super) struct SegmentReport {
    body: String,
    /// Names of the points at its first and second node.
    points: [String; 2],
    length: f64,
    /// Local x, y and z in global axes.
    axes: [[f64; 3]; 3],
    /// Wrench on the segment at its first and second node, in the element frame.
    end_forces: [[f64; 6]; 2],
    /// The same in global axes (Eq. 38).
    end_forces_global: [[f64; 6]; 2],
    stress: Option<StressReport>,
    section_forces: Vec<SectionForces>,
}

/// Largest stresses over the segment [Pa].
#[derive(Debug, Serialize)]
struct StressReport {
    normal: f64,
    shear: f64,
    von_mises: f64,
}

/// The heading over idle motions.
pub(super) const IDLE: &str =
    "Idle motions (the displacements of these bodies are defined only up to them)";

/// What is said of derivatives of frequencies that could not be counted.
const UNCOUNTED: &str = "sensitivities of frequencies: not all frequencies could be counted; where one \
                         of several equal ones is missing, their derivatives are not right";

impl SolveReport {
    /// Collects what is to be reported of a solution.
    pub(crate) fn new(
        case: &Case,
        solution: &Solution,
        verification: Option<Verification>,
    ) -> Self {
        let model = case.model();
        let nodes = 0..model.nodes().len();
        let joints = model.joints().iter().zip(&solution.joint_wrenches);
        let segments = model.segments().iter().zip(&solution.segments);
        Self {
            name: model.name.clone(),
            job: case.job().map(|(job, _)| job.into()),
            design: case.design(),
            pose: case.job().map(|(_, pose)| pose),
            unknowns: solution.unknowns,
            mobility: solution.mobility,
            overconstraint: solution.overconstraint,
            redundant_constraints: redundancies(&case.here()),
            idle_modes: solution.idle.len(),
            idle_motions: describe_motions(&solution.idle, model),
            output: OutputReport::new(model, solution),
            displacements: nodes
                .map(hyperstat_assembly::NodeId)
                .map(|node| (model.node_name(node), &solution.displacements[node.0]))
                .map(|(name, displacement)| (name, numbers(displacement)))
                .collect(),
            joints: joints
                .enumerate()
                .map(|(k, (joint, wrench))| {
                    let report = JointReport::new(wrench.as_ref());
                    (joint.name.clone(), report.of(model, JointId(k)))
                })
                .collect(),
            undetermined: solution
                .undetermined()
                .iter()
                .map(|joint| model.joints()[joint.0].name.clone())
                .collect(),
            segments: segments
                .enumerate()
                .map(|(k, (segment, forces))| {
                    SegmentReport::new(model, SegmentId(k), segment, forces)
                })
                .collect(),
            warnings: (solution.warnings.iter().map(ToString::to_string))
                .chain(doubts(model))
                .chain(verification.iter().flat_map(Verification::warnings))
                .chain(of_model(model))
                .chain(of_solution(model, solution))
                .collect(),
            verification,
            modes: None,
            bodies: bodies(model, |body| solution.worst_point(model, body)),
            why: None,
            frequency_sensitivities: Vec::new(),
            cases: cases(model, solution),
            loads: loads(model),
        }
    }

    /// Adds what is soft and why.
    pub(crate) fn add_why(&mut self, why: Why) {
        self.warnings.extend(why.remarks());
        self.why = Some(why);
    }

    /// Adds what changes natural frequencies; `complete`: all of them were counted.
    pub(crate) fn add_frequencies(&mut self, frequencies: Vec<FrequencyReport>, complete: bool) {
        self.frequency_sensitivities = frequencies;
        if !complete {
            self.warnings.push(UNCOUNTED.into());
        }
    }

    /// Adds the displacements of the nodes inside segments, of all states.
    ///
    /// # Errors
    /// A segment that cannot be formed, which no segment of a solved model is.
    pub(crate) fn add_inner_displacements(
        &mut self,
        model: &Model,
        solution: &Solution,
    ) -> Result<(), SolveError> {
        let inner = inner_displacements(model, solution)?;
        self.displacements.0.extend(inner.0);
        for ((_, case), solved) in self.cases.0.iter_mut().zip(&solution.cases) {
            case.add_inner(model, &solved.state)?;
        }
        Ok(())
    }

    /// Adds natural frequencies and modes.
    pub(crate) fn add_modes(&mut self, modes: ModesReport) {
        self.warnings.extend_from_slice(modes.remarks());
        self.modes = Some(modes);
    }

    /// Everything as tables; [`SolveReport::answer`] is the first page.
    pub(crate) fn full(&self) -> String {
        let mut text = self.counts();
        list(&mut text, "Warnings", &self.warnings);
        list(&mut text, IDLE, &self.idle_motions);
        text += &self.loads;
        self.output.write(&self.displacements, &mut text);

        let table = displacement_table(&self.displacements);
        section(&mut text, "Displacements of the nodes [m, rad]", table);

        self.write_joints(&mut text);
        self.write_segments(&mut text);
        write_worst(&self.bodies, "Worst point", &mut text);
        for (name, case) in &self.cases.0 {
            case.write(name, &mut text);
        }
        self.write_asked(&mut text);
        text
    }

    /// The title and the counts.
    pub(super) fn counts(&self) -> String {
        let title = super::title(&self.name, self.job.as_deref(), self.design, self.pose);
        format!(
            "{title}\n\n  mobility         {}\n  over-constraint  {}\n  unknowns         {}\n  \
             idle motions     {}\n",
            self.mobility, self.overconstraint, self.unknowns, self.idle_modes
        )
    }

    /// What an option asked for: modes, what is soft and why, verification.
    pub(super) fn write_asked(&self, text: &mut String) {
        if let Some(modes) = &self.modes {
            modes.write(text);
        }
        if let Some(why) = &self.why {
            why.write(text);
        }
        for frequencies in &self.frequency_sensitivities {
            frequencies.write(text);
        }
        self.write_verification(text);
    }

    fn write_verification(&self, text: &mut String) {
        let Some(verification) = &self.verification else {
            return;
        };
        let mut table = Table::new(1, &["", "largest relative difference"]);
        for (name, difference) in verification.differences() {
            table.row(&[&name], [difference]);
        }
        section(text, "Verification by the independent solver", table);
    }

    fn write_joints(&self, text: &mut String) {
        if self.joints.0.is_empty() {
            return;
        }
        write_misfits(&self.joints, text);
        let table = joint_table(&self.joints, heads(&["joint"], WRENCH));
        section(
            text,
            "Joint wrenches, on the second body, at the joint, in the joint frame [N, N·m]",
            table,
        );
        if !self.undetermined.is_empty() {
            *text += "  Redundant rigid constraints leave the wrenches that are not determined \
                      open:\n  any of many solutions balances the loads. Make a body or a joint \
                      elastic to find them.\n";
        }
    }

    fn write_segments(&self, text: &mut String) {
        if self.segments.is_empty() {
            return;
        }
        let (forces, stresses) = segment_tables(&self.segments);
        section(
            text,
            "Forces on the ends of segments, in the element frame [N, N·m]",
            forces,
        );
        section(text, "Largest stresses of segments [Pa]", stresses);
    }
}

/// The forces on the ends of segments and their largest stresses as tables.
pub(super) fn segment_tables(segments: &[SegmentReport]) -> (Table, Table) {
    let mut forces = Table::new(3, &heads(&["body", "segment", "at"], WRENCH));
    let mut stresses = Table::new(2, &["body", "segment", "normal", "shear", "von Mises"]);
    let rounding = Rounding::of(segments.iter().flat_map(|segment| &segment.end_forces));
    for segment in segments {
        let name = segment.points.join("-");
        for (point, wrench) in segment.points.iter().zip(segment.end_forces) {
            forces.row(&[&segment.body, &name, point], rounding.shown(&wrench));
        }
        match &segment.stress {
            Some(stress) => stresses.row(
                &[&segment.body, &name],
                [stress.normal, stress.shear, stress.von_mises],
            ),
            None => stresses.remark(&[&segment.body, &name], "not found for this section"),
        }
    }
    (forces, stresses)
}

/// The axes of a frame, each in global axes.
pub(super) fn axes(frame: &Rotation3<f64>) -> [[f64; 3]; 3] {
    std::array::from_fn(|axis| frame.matrix().column(axis).into_owned().into())
}

/// A wrench of a frame in global axes.
fn global(wrench: &Vector6<f64>, frame: &Rotation3<f64>) -> [f64; 6] {
    let (force, moment) = (wrench.fixed_rows::<3>(0), wrench.fixed_rows::<3>(3));
    let [force, moment] = [force, moment].map(|part| frame * part.into_owned());
    [force.x, force.y, force.z, moment.x, moment.y, moment.z]
}

impl OutputReport {
    fn new(model: &Model, solution: &Solution) -> Self {
        let output = &solution.output;
        let (node, position) = match model.output() {
            Some(node) => (
                model.node_name(node),
                model.geometry().positions[node.0].into(),
            ),
            None => (String::new(), [0.0; 3]),
        };
        Self {
            node,
            position,
            stiffness: output.stiffness.as_ref().map(rows),
            compliance: output.compliance.as_ref().map(rows),
            displacement: numbers(&output.displacement),
            rigid_directions: output.rigid_directions.iter().map(numbers).collect(),
            free_motions: output.free_motions.iter().map(numbers).collect(),
        }
    }

    fn write(&self, nodes: &Entries<[f64; 6]>, text: &mut String) {
        let table = output_table(&self.displacement, nodes);
        section(text, &self.heading(), table);
        self.write_stiffness(text);
        match &self.compliance {
            Some(compliance) => section(
                text,
                "Compliance of the output [m/N, 1/N; rad/N, rad/(N·m)]",
                matrix_table(DISPLACEMENT, WRENCH, compliance),
            ),
            None => self.write_free_motions(text),
        }
    }

    /// What stands over the displacement of the output.
    pub(super) fn heading(&self) -> String {
        let [x, y, z] = self.position.map(super::number);
        format!(
            "Output {} at ({x}, {y}, {z}) m: displacement [m, rad]",
            self.node
        )
    }

    pub(super) fn write_free_motions(&self, text: &mut String) {
        section(
            text,
            "Compliance of the output: none that is finite, it moves freely in these directions",
            twists(&self.free_motions),
        );
    }

    pub(super) fn write_stiffness(&self, text: &mut String) {
        match &self.stiffness {
            Some(stiffness) => section(
                text,
                "Stiffness of the output [N/m, N/rad; N, N·m/rad]",
                stiffness_table(stiffness),
            ),
            None => section(
                text,
                "Stiffness of the output: none that is finite, it is held rigidly in these directions",
                twists(&self.rigid_directions),
            ),
        }
    }
}

impl SegmentReport {
    pub(super) fn new(
        model: &Model,
        id: SegmentId,
        segment: &Segment,
        forces: &SegmentForces,
    ) -> Self {
        Self {
            body: model.bodies()[segment.body.0].name.clone(),
            points: segment.ends.map(|node| model.nodes()[node.0].point.clone()),
            length: forces.length,
            axes: axes(&forces.frame),
            end_forces: forces.ends.each_ref().map(numbers),
            end_forces_global: (forces.ends.each_ref()).map(|wrench| global(wrench, &forces.frame)),
            stress: StressReport::new(segment, forces),
            section_forces: section_forces(model, id, forces),
        }
    }
}

impl StressReport {
    /// Where the section does not change and no load acts between the ends, the largest stresses
    /// lie at an end: moments are linear, and all three stresses are convex in the section's
    /// wrench. Else they are searched for.
    fn new(segment: &Segment, forces: &SegmentForces) -> Option<Self> {
        let ends = &forces.ends;
        if forces.load != BeamLoad::none() {
            let taper = segment.change_of_section().ok()?;
            let taper = taper.unwrap_or_else(|| Taper::constant(segment.section.clone()));
            let largest = stress_along(&taper, forces.length, &ends[1], &forces.load)?;
            return Some(Self {
                normal: largest.normal.value,
                shear: largest.torsional.value,
                von_mises: largest.von_mises.value,
            });
        }
        if let Ok(Some(taper)) = segment.change_of_section() {
            let largest = largest_stress(&taper, forces.length, &ends[1])?;
            return Some(Self {
                normal: largest.normal,
                shear: largest.shear,
                von_mises: largest.von_mises,
            });
        }
        let first = section_stress(&segment.section, &-ends[0])?;
        let second = section_stress(&segment.section, &ends[1])?;
        Some(Self {
            normal: first.normal.max(second.normal),
            shear: first.shear.max(second.shear),
            von_mises: first.von_mises.max(second.von_mises),
        })
    }
}

fn twists(twists: &[[f64; 6]]) -> Table {
    let mut table = Table::new(0, &DISPLACEMENT);
    for twist in twists {
        table.row(&[], *twist);
    }
    table
}
