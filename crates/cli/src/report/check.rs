//! The report of `hyperstat check`.

use std::fmt::Write as _;

use hyperstat_assembly::{Kinematics, Solution, describe_motions};
use serde::Serialize;

use super::{doubts, list, redundancies};
use crate::case::Case;
use crate::error::CliError;
use crate::plausibility::of_model;

/// What the check of a file found. Field names are those of the JSON output.
#[derive(Debug, Default, Serialize)]
pub(crate) struct CheckReport {
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    job: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    design: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pose: Option<usize>,
    /// Whether `solve` would end with 0.
    solvable: bool,
    unknowns: Option<usize>,
    mobility: Option<usize>,
    overconstraint: Option<usize>,
    redundant_constraints: Vec<Vec<String>>,
    idle_modes: Option<usize>,
    idle_motions: Vec<String>,
    /// All motions that nothing resists, drives locked: the idle ones and those of the output.
    free_motions: Vec<String>,
    undetermined: Vec<String>,
    warnings: Vec<String>,
    /// What is no fault, but may be a slip.
    notes: Vec<String>,
    problem: Option<Problem>,
}

/// Why a file cannot be solved, and where it says so.
#[derive(Debug, Serialize)]
pub(crate) struct Problem {
    pub(crate) message: String,
    pub(crate) help: Option<String>,
    pub(crate) path: Option<String>,
    pub(crate) line: Option<usize>,
    pub(crate) column: Option<usize>,
}

/// What is no fault in the file of a mechanism, but may be a slip.
fn notes(case: &Case) -> Vec<String> {
    let unused = case.mechanism().map_or(&[][..], |m| m.unused_points());
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
    pub(crate) fn unreadable(error: &CliError) -> Self {
        Self {
            problem: Some(error.problem()),
            ..Self::default()
        }
    }

    /// The report on a mechanism: its counts, unless it is too large for them, what its solution
    /// adds, and what is wrong with it.
    pub(crate) fn new(
        case: &Case,
        kinematics: Option<&Kinematics>,
        solution: Option<&Solution>,
        error: Option<&CliError>,
    ) -> Self {
        let model = case.model();
        let mut report = Self {
            name: Some(model.name.clone()),
            job: case.job().map(|(job, _)| job.into()),
            design: case.design(),
            pose: case.job().map(|(_, pose)| pose),
            solvable: error.is_none(),
            mobility: kinematics.map(|kinematics| kinematics.mobility),
            overconstraint: kinematics.map(|kinematics| kinematics.overconstraint),
            redundant_constraints: redundancies(&case.here()),
            free_motions: kinematics.map_or(Vec::new(), |kinematics| {
                describe_motions(&kinematics.motions, model)
            }),
            problem: error.map(CliError::problem),
            ..Self::default()
        };
        let idle = solution.map(|solution| solution.idle.clone());
        if let Some(idle) = idle.or_else(|| case.idle_motions()) {
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
        report.warnings.extend(doubts(model));
        report.warnings.extend(of_model(model));
        report.notes = notes(case);
        report
    }

    /// The report as text. What is wrong is not in it: that goes to standard error.
    pub(crate) fn text(&self) -> String {
        let name = self.name.as_deref().unwrap_or_default();
        let mut text = super::title(name, self.job.as_deref(), self.design, self.pose);
        text += "\n\n";
        let counts = [
            ("mobility", self.mobility),
            ("over-constraint", self.overconstraint),
            ("unknowns", self.unknowns),
            ("idle motions", self.idle_modes),
        ];
        for (name, count) in counts {
            if let Some(count) = count {
                let _ = writeln!(text, "  {name:<15}  {count}");
            }
        }
        list(&mut text, "Warnings", &self.warnings);
        list(&mut text, "Notes", &self.notes);
        list(&mut text, "Idle motions", &self.idle_motions);
        if self.idle_modes != Some(self.free_motions.len()) {
            list(
                &mut text,
                "Motions that nothing resists, drives locked",
                &self.free_motions,
            );
        }
        let mut groups: Vec<_> = (self.redundant_constraints.iter())
            .map(|group| group.join(" "))
            .collect();
        let more = self
            .overconstraint
            .unwrap_or(0)
            .saturating_sub(groups.len());
        if more > 0 {
            groups.push(format!("… and {more} more"));
        }
        list(
            &mut text,
            "Redundant constraints (of each line any one direction can be freed, and nothing moves)",
            &groups,
        );
        list(
            &mut text,
            "Joints whose wrenches redundant rigid constraints leave undetermined",
            &self.undetermined,
        );
        if self.solvable {
            text += "\nThe mechanism can be solved.\n";
        }
        text
    }
}
