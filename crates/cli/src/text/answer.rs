//! The first page of `hyperstat solve`: the answer, without the tables of every part.

use hyperstat_assembly::Model;
use hyperstat_study::SolveReport;

use super::forces::write_worst_of;
use super::loads::loads;
use super::misfits::write_misfits;
use super::parts::{DISPLACEMENT, Rounding, heads, list, output_table, section};
use super::solve::{IDLE, counts, heading, write_asked, write_free_motions, write_stiffness};
use super::table::Table;

/// Rows of a list that are told.
const TOLD: usize = 8;
/// Lines of what acts that are told.
const ACTING: usize = 14;
/// The name of the state that is no case.
const BASE: &str = "(no case)";

/// Counts, warnings, what acts, the output's displacement in every case, its stiffness, the
/// worst points, and what an option asked for.
pub(crate) fn answer(report: &SolveReport, model: &Model) -> String {
    let mut text = counts(report);
    list(&mut text, "Warnings", &first(&report.warnings));
    list(&mut text, IDLE, &first(&report.idle_motions));
    let mut acting = loads(model);
    write_misfits(&report.joints, &mut acting);
    text += &first_lines(&acting);
    write_displacements(report, &mut text);
    write_stiffness(&report.output, &mut text);
    if report.output.compliance.is_none() {
        write_free_motions(&report.output, &mut text);
    }
    let cases = report.cases.iter().map(|(name, case)| (name, &case.bodies));
    let states: Vec<_> = std::iter::once((BASE, &report.bodies))
        .chain(cases)
        .collect();
    write_worst_of(&states, "Worst point", TOLD, &mut text);
    if !report.undetermined.is_empty() {
        let names = first(&report.undetermined).join(", ");
        let body = format!("  {names}\n");
        section(&mut text, "Joint wrenches that statics leaves open", body);
    }
    write_asked(report, &mut text);
    text += "\nDisplacements of all nodes, joint wrenches, forces and stresses of all segments: \
             --full\n";
    text
}

fn write_displacements(report: &SolveReport, text: &mut String) {
    let base = &report.output.displacement;
    let table = if report.cases.is_empty() {
        output_table(base, &report.displacements).to_string()
    } else {
        let mut table = Table::new(1, &heads(&["case"], DISPLACEMENT));
        let cases = report.cases.iter();
        let cases =
            cases.map(|(name, case)| (name, &case.output.displacement, &case.displacements));
        let base = (BASE, base, &report.displacements);
        let mut states = std::iter::once(base).chain(cases);
        for (name, displacement, nodes) in states.by_ref().take(TOLD) {
            let rounding = Rounding::of(nodes.iter().map(|(_, row)| row));
            table.row(&[name], rounding.shown(displacement));
        }
        format!("{table}{}", more(states.count()))
    };
    section(text, &heading(&report.output), table);
}

/// The first of a list, and how many more there are.
fn first(items: &[String]) -> Vec<String> {
    let mut told: Vec<_> = items.iter().take(TOLD).cloned().collect();
    if items.len() > TOLD {
        told.push(format!("… and {} more", items.len() - TOLD));
    }
    told
}

/// The first lines of tables.
fn first_lines(text: &str) -> String {
    let lines: Vec<_> = text.lines().collect();
    let told = lines.iter().take(ACTING);
    let told: String = told.map(|line| format!("{line}\n")).collect();
    told + &more(lines.len().saturating_sub(ACTING))
}

/// The line that says how many more there are.
fn more(count: usize) -> String {
    match count {
        0 => String::new(),
        count => format!("  … and {count} more\n"),
    }
}
