//! The report of `hyperstat solve` in full.

use hyperstat_assembly::Model;
use hyperstat_study::{Entries, OutputReport, SolveReport};

use super::cases::write as write_case;
use super::forces::write_worst;
use super::joints::joint_table;
use super::loads::loads;
use super::misfits::write_misfits;
use super::modes::write as write_modes;
use super::parts::{
    DISPLACEMENT, WRENCH, displacement_table, heads, list, matrix_table, output_table, section,
    stiffness_table, title,
};
use super::segments::segment_tables;
use super::sensitivities::write_frequencies;
use super::table::{Table, number};
use super::why::write as write_why;

/// The heading over idle motions.
pub(super) const IDLE: &str =
    "Idle motions (the displacements of these bodies are defined only up to them)";

/// Everything as tables; [`answer`](super::answer::answer) is the first page.
pub(crate) fn full(report: &SolveReport, model: &Model) -> String {
    let mut text = counts(report);
    list(&mut text, "Warnings", &report.warnings);
    list(&mut text, IDLE, &report.idle_motions);
    text += &loads(model);
    write_output(&report.output, &report.displacements, &mut text);

    let table = displacement_table(&report.displacements);
    section(&mut text, "Displacements of the nodes [m, rad]", table);

    write_joints(report, &mut text);
    write_segments(report, &mut text);
    write_worst(&report.bodies, "Worst point", &mut text);
    for (name, case) in report.cases.iter() {
        write_case(case, name, &mut text);
    }
    write_asked(report, &mut text);
    text
}

/// The title and the counts.
pub(super) fn counts(report: &SolveReport) -> String {
    let title = title(
        &report.name,
        report.job.as_deref(),
        report.design,
        report.pose,
    );
    format!(
        "{title}\n\n  mobility         {}\n  over-constraint  {}\n  unknowns         {}\n  \
         idle motions     {}\n",
        report.mobility, report.overconstraint, report.unknowns, report.idle_modes
    )
}

/// What an option asked for: modes, what is soft and why, verification.
pub(super) fn write_asked(report: &SolveReport, text: &mut String) {
    if let Some(modes) = &report.modes {
        write_modes(modes, text);
    }
    if let Some(why) = &report.why {
        write_why(why, text);
    }
    for frequencies in &report.frequency_sensitivities {
        write_frequencies(frequencies, text);
    }
    write_verification(report, text);
}

fn write_verification(report: &SolveReport, text: &mut String) {
    let Some(verification) = &report.verification else {
        return;
    };
    let mut table = Table::new(1, &["", "largest relative difference"]);
    for (name, difference) in verification.differences() {
        table.row(&[&name], [difference]);
    }
    section(text, "Verification by the independent solver", table);
}

fn write_joints(report: &SolveReport, text: &mut String) {
    if report.joints.is_empty() {
        return;
    }
    write_misfits(&report.joints, text);
    let table = joint_table(&report.joints, heads(&["joint"], WRENCH));
    section(
        text,
        "Joint wrenches, on the second body, at the joint, in the joint frame [N, N·m]",
        table,
    );
    if !report.undetermined.is_empty() {
        *text += "  Redundant rigid constraints leave the wrenches that are not determined \
                  open:\n  any of many solutions balances the loads. Make a body or a joint \
                  elastic to find them.\n";
    }
}

fn write_segments(report: &SolveReport, text: &mut String) {
    if report.segments.is_empty() {
        return;
    }
    let (forces, stresses) = segment_tables(&report.segments);
    section(
        text,
        "Forces on the ends of segments, in the element frame [N, N·m]",
        forces,
    );
    section(text, "Largest stresses of segments [Pa]", stresses);
}

fn write_output(output: &OutputReport, nodes: &Entries<[f64; 6]>, text: &mut String) {
    let table = output_table(&output.displacement, nodes);
    section(text, &heading(output), table);
    write_stiffness(output, text);
    match &output.compliance {
        Some(compliance) => section(
            text,
            "Compliance of the output [m/N, 1/N; rad/N, rad/(N·m)]",
            matrix_table(DISPLACEMENT, WRENCH, compliance),
        ),
        None => write_free_motions(output, text),
    }
}

/// What stands over the displacement of the output.
pub(super) fn heading(output: &OutputReport) -> String {
    let [x, y, z] = output.position.map(number);
    format!(
        "Output {} at ({x}, {y}, {z}) m: displacement [m, rad]",
        output.node
    )
}

pub(super) fn write_free_motions(output: &OutputReport, text: &mut String) {
    section(
        text,
        "Compliance of the output: none that is finite, it moves freely in these directions",
        twists(&output.free_motions),
    );
}

pub(super) fn write_stiffness(output: &OutputReport, text: &mut String) {
    match &output.stiffness {
        Some(stiffness) => section(
            text,
            "Stiffness of the output [N/m, N/rad; N, N·m/rad]",
            stiffness_table(stiffness),
        ),
        None => section(
            text,
            "Stiffness of the output: none that is finite, it is held rigidly in these directions",
            twists(&output.rigid_directions),
        ),
    }
}

fn twists(twists: &[[f64; 6]]) -> Table {
    let mut table = Table::new(0, &DISPLACEMENT);
    for twist in twists {
        table.row(&[], *twist);
    }
    table
}
