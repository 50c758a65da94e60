//! The report of `hyperstat check`.

use std::fmt::Write as _;

use hyperstat_study::CheckReport;

use super::parts::{list, title};

/// The report as text. What is wrong is not in it: that goes to standard error.
pub(crate) fn check(report: &CheckReport) -> String {
    let name = report.name.as_deref().unwrap_or_default();
    let mut text = title(name, report.job.as_deref(), report.design, report.pose);
    text += "\n\n";
    let counts = [
        ("mobility", report.mobility),
        ("over-constraint", report.overconstraint),
        ("unknowns", report.unknowns),
        ("idle motions", report.idle_modes),
    ];
    for (name, count) in counts {
        if let Some(count) = count {
            let _ = writeln!(text, "  {name:<15}  {count}");
        }
    }
    list(&mut text, "Warnings", &report.warnings);
    list(&mut text, "Notes", &report.notes);
    list(&mut text, "Idle motions", &report.idle_motions);
    if report.idle_modes != Some(report.free_motions.len()) {
        list(
            &mut text,
            "Motions that nothing resists, drives locked",
            &report.free_motions,
        );
    }
    let mut groups: Vec<_> = (report.redundant_constraints.iter())
        .map(|group| group.join(" "))
        .collect();
    let more = report
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
        &report.undetermined,
    );
    if report.solvable {
        text += "\nThe mechanism can be solved.\n";
    }
    text
}
