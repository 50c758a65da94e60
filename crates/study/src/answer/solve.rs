//! Everything that one solve found.

use hyperstat_assembly::{
    JointId, Model, Segment, SegmentForces, SegmentId, Solution, SolveError, describe_motions,
};
use hyperstat_elements::stress::{largest_stress, section_stress, stress_along};
use hyperstat_elements::{BeamLoad, Taper};
use nalgebra::{Rotation3, Vector6};
use serde::Serialize;

use super::cases::{CaseReport, cases};
use super::forces::{BodyReport, SectionForces, bodies, section_forces};
use super::joints::JointReport;
use super::why::Why;
use super::{
    FrequencyReport, ModesReport, Rows, doubts, inner_displacements, numbers, redundancies, rows,
};
use crate::doubts::{of_model, of_solution};
use crate::entries::Entries;
use crate::near::of_mechanism;
use crate::study::Study;
use crate::verification::Verification;

/// Everything that one solve found. Field names are those of the JSON output.
#[derive(Debug, Serialize)]
pub struct SolveReport {
    /// Name of the mechanism.
    pub name: String,
    /// The job that it is from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub job: Option<String>,
    /// Number of the design, of a job that varies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub design: Option<usize>,
    /// Number of the pose.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pose: Option<usize>,
    /// Independent displacement coordinates that were solved for.
    pub unknowns: usize,
    /// Instantaneous freedoms of the rigid mechanism.
    pub mobility: usize,
    /// Redundant constraints.
    pub overconstraint: usize,
    /// For each degree of over-constraint the joint directions that take part, such as `A1.x`.
    pub redundant_constraints: Vec<Vec<String>>,
    /// Motions without energy that leave the output where it is.
    pub idle_modes: usize,
    /// Each of these in words.
    pub idle_motions: Vec<String>,
    /// The output node.
    pub output: OutputReport,
    /// Displacements of the nodes by name, `body.point`: x y z \[m\], rx ry rz \[rad\], global.
    pub displacements: Entries<[f64; 6]>,
    /// Joints by name.
    pub joints: Entries<JointReport>,
    /// Joints whose wrenches redundant rigid constraints leave undetermined.
    pub undetermined: Vec<String>,
    /// Beam segments in the order of the model.
    pub segments: Vec<SegmentReport>,
    /// Remarks on the numbers and on what can hardly be meant.
    pub warnings: Vec<String>,
    /// Differences from the independent solver, where asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verification: Option<Verification>,
    /// Natural frequencies and modes, where asked for.
    #[serde(flatten)]
    pub modes: Option<ModesReport>,
    /// Bodies by name, with their worst points.
    pub bodies: Entries<BodyReport>,
    /// What is soft and why, where asked for.
    #[serde(flatten)]
    pub why: Option<Why>,
    /// What changes natural frequencies, where asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub frequency_sensitivities: Vec<FrequencyReport>,
    /// Load cases by name.
    #[serde(skip_serializing_if = "Entries::is_empty")]
    pub cases: Entries<CaseReport>,
}

/// The output of a solved mechanism.
#[derive(Debug, Serialize)]
pub struct OutputReport {
    /// Its name, `body.point`.
    pub node: String,
    /// Where it is \[m\], global.
    pub position: [f64; 3],
    /// Stiffness \[N/m, N/rad; N, N·m/rad\] by rows; none where it is held rigidly in some direction.
    pub stiffness: Option<Rows>,
    /// Compliance \[m/N, 1/N; rad/N, rad/(N·m)\] by rows; none where it moves freely.
    pub compliance: Option<Rows>,
    /// x y z \[m\], rx ry rz \[rad\], global.
    pub displacement: [f64; 6],
    /// Twists that it cannot take.
    pub rigid_directions: Vec<[f64; 6]>,
    /// Twists that nothing resists.
    pub free_motions: Vec<[f64; 6]>,
}

/// A beam segment and what it carries: forces \[N\], moments \[N·m\].
#[derive(Debug, Serialize)]
pub struct SegmentReport {
    /// Name of its body.
    pub body: String,
    /// Names of the points at its first and second node.
    pub points: [String; 2],
    /// Length \[m\].
    pub length: f64,
    /// Local x, y and z in global axes.
    pub axes: [[f64; 3]; 3],
    /// Wrench on the segment at its first and second node, in the element frame.
    pub end_forces: [[f64; 6]; 2],
    /// The same in global axes (Eq. 38).
    pub end_forces_global: [[f64; 6]; 2],
    /// Largest stresses, where the section has them.
    pub stress: Option<StressReport>,
    /// Forces along it.
    pub section_forces: Vec<SectionForces>,
}

/// Largest stresses over the segment \[Pa\].
#[derive(Debug, Serialize)]
pub struct StressReport {
    /// Largest normal stress, in size.
    pub normal: f64,
    /// Largest shear stress of torsion.
    pub shear: f64,
    /// Largest equivalent stress.
    pub von_mises: f64,
}

/// What is said of derivatives of frequencies that could not be counted.
const UNCOUNTED: &str = "sensitivities of frequencies: not all frequencies could be counted; where one \
                         of several equal ones is missing, their derivatives are not right";

impl SolveReport {
    /// Collects what is to be reported of a solution.
    pub fn new(study: &Study, solution: &Solution, verification: Option<Verification>) -> Self {
        let model = study.model();
        let nodes = 0..model.nodes().len();
        let joints = model.joints().iter().zip(&solution.joint_wrenches);
        let segments = model.segments().iter().zip(&solution.segments);
        Self {
            name: model.name.clone(),
            job: study.job().map(|(job, _)| job.into()),
            design: study.design(),
            pose: study.job().map(|(_, pose)| pose),
            unknowns: solution.unknowns,
            mobility: solution.mobility,
            overconstraint: solution.overconstraint,
            redundant_constraints: redundancies(&study.here()),
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
                .chain(study.file().and_then(of_mechanism))
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
        }
    }

    /// Adds what is soft and why.
    pub fn add_why(&mut self, why: Why) {
        self.warnings.extend(why.remarks());
        self.why = Some(why);
    }

    /// Adds what changes natural frequencies; `complete`: all of them were counted.
    pub fn add_frequencies(&mut self, frequencies: Vec<FrequencyReport>, complete: bool) {
        self.frequency_sensitivities = frequencies;
        if !complete {
            self.warnings.push(UNCOUNTED.into());
        }
    }

    /// Adds the displacements of the nodes inside segments, of all states.
    ///
    /// # Errors
    /// A segment that cannot be formed, which no segment of a solved model is.
    pub fn add_inner_displacements(
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
    pub fn add_modes(&mut self, modes: ModesReport) {
        self.warnings.extend_from_slice(modes.remarks());
        self.modes = Some(modes);
    }
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
