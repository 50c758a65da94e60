//! The report of `hyperstat check`.

use hyperstat_assembly::{Kinematics, Solution, describe_motions};
use serde::Serialize;

use super::{doubts, redundancies};
use crate::doubts::of_model;
use crate::error::{Problem, StudyError};
use crate::near::of_mechanism;
use crate::study::Study;

/// What the check of a file found. Field names are those of the JSON output.
#[derive(Debug, Default, Serialize)]
pub struct CheckReport {
    /// Name of the mechanism; none where the file cannot be read as one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The job that it is from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub job: Option<String>,
    /// Number of the design, of a job that varies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub design: Option<usize>,
    /// Number of the pose.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pose: Option<usize>,
    /// Whether `solve` would end with 0.
    pub solvable: bool,
    /// Independent displacement coordinates that are solved for.
    pub unknowns: Option<usize>,
    /// Instantaneous freedoms of the rigid mechanism.
    pub mobility: Option<usize>,
    /// Redundant constraints.
    pub overconstraint: Option<usize>,
    /// For each degree of over-constraint the joint directions that take part, such as `A1.x`.
    pub redundant_constraints: Vec<Vec<String>>,
    /// Motions without energy that leave the output where it is.
    pub idle_modes: Option<usize>,
    /// Each of these in words.
    pub idle_motions: Vec<String>,
    /// All motions that nothing resists, drives locked: the idle ones and those of the output.
    pub free_motions: Vec<String>,
    /// Joints whose wrenches redundant rigid constraints leave undetermined.
    pub undetermined: Vec<String>,
    /// Remarks on the numbers and on what can hardly be meant.
    pub warnings: Vec<String>,
    /// What is no fault, but may be a slip.
    pub notes: Vec<String>,
    /// Why it cannot be solved, and where the file says so.
    pub problem: Option<Problem>,
}

/// What is no fault in the file of a mechanism, but may be a slip.
fn notes(study: &Study) -> Vec<String> {
    let unused = study.file().map_or(&[][..], |m| m.unused_points());
    match unused {
        [] => Vec::new(),
        [point] => vec![format!("no body runs through point `{point}`")],
        points => {
            let shown = points.iter().take(SHOWN);
            let shown: Vec<_> = shown.map(|point| format!("`{point}`")).collect();
            let more = match points.len().saturating_sub(SHOWN) {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            let shown = shown.join(", ");
            vec![format!("no body runs through the points {shown}{more}")]
        }
    }
}

/// Most points that are named.
const SHOWN: usize = 8;

impl CheckReport {
    /// The report on a file that cannot be read as a mechanism.
    pub fn unreadable(error: &StudyError) -> Self {
        Self {
            problem: Some(error.problem()),
            ..Self::default()
        }
    }

    /// The report on a mechanism: its counts, unless it is too large for them, what its solution
    /// adds, and what is wrong with it.
    pub fn new(
        study: &Study,
        kinematics: Option<&Kinematics>,
        solution: Option<&Solution>,
        error: Option<&StudyError>,
    ) -> Self {
        let model = study.model();
        let mut report = Self {
            name: Some(model.name.clone()),
            job: study.job().map(|(job, _)| job.into()),
            design: study.design(),
            pose: study.job().map(|(_, pose)| pose),
            solvable: error.is_none(),
            mobility: kinematics.map(|kinematics| kinematics.mobility),
            overconstraint: kinematics.map(|kinematics| kinematics.overconstraint),
            redundant_constraints: redundancies(&study.here()),
            free_motions: kinematics.map_or(Vec::new(), |kinematics| {
                describe_motions(&kinematics.motions, model)
            }),
            problem: error.map(StudyError::problem),
            ..Self::default()
        };
        let idle = solution.map(|solution| solution.idle.clone());
        if let Some(idle) = idle.or_else(|| study.idle_motions()) {
            report.idle_modes = Some(idle.len());
            report.idle_motions = describe_motions(&idle, model);
        }
        if let Some(solution) = solution {
            report.unknowns = Some(solution.unknowns);
            report.undetermined = solution
                .undetermined()
                .iter()
                .map(|joint| model.joints()[joint.0].name.clone())
                .collect();
            report.warnings = solution.warnings.iter().map(ToString::to_string).collect();
        }
        report.warnings.extend(study.file().and_then(of_mechanism));
        report.warnings.extend(doubts(model));
        report.warnings.extend(of_model(model));
        report.notes = notes(study);
        report
    }
}
