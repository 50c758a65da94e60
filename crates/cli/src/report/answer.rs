//! The first page of `hyperstat solve`: the answer, without the tables of every part.

use super::forces::write_worst_of;
use super::misfits::write_misfits;
use super::solve::{IDLE, SolveReport};
use super::{DISPLACEMENT, Rounding, Table, heads, list, output_table, section};

/// Rows of a list that are told.
const TOLD: usize = 8;
/// Lines of what acts that are told.
const ACTING: usize = 14;
/// The name of the state that is no case.
const BASE: &str = "(no case)";

impl SolveReport {
    /// Counts, warnings, what acts, the output's displacement in every case, its stiffness, the
    /// worst points, and what an option asked for.
    pub(crate) fn answer(&self) -> String {
        let mut text = self.counts();
        list(&mut text, "Warnings", &first(&self.warnings));
        list(&mut text, IDLE, &first(&self.idle_motions));
        let mut acting = self.loads.clone();
        write_misfits(&self.joints, &mut acting);
        text += &first_lines(&acting);
        self.write_displacements(&mut text);
        self.output.write_stiffness(&mut text);
        if self.output.compliance.is_none() {
            self.output.write_free_motions(&mut text);
        }
        let cases = self.cases.iter().map(|(name, case)| (name, &case.bodies));
        let states: Vec<_> = std::iter::once((BASE, &self.bodies)).chain(cases).collect();
        write_worst_of(&states, "Worst point", TOLD, &mut text);
        if !self.undetermined.is_empty() {
            let names = first(&self.undetermined).join(", ");
            let body = format!("  {names}\n");
            section(&mut text, "Joint wrenches that statics leaves open", body);
        }
        self.write_asked(&mut text);
        text += "\nDisplacements of all nodes, joint wrenches, forces and stresses of all segments: \
                 --full\n";
        text
    }

    fn write_displacements(&self, text: &mut String) {
        let base = &self.output.displacement;
        let table = if self.cases.is_empty() {
            output_table(base, &self.displacements).to_string()
        } else {
            let mut table = Table::new(1, &heads(&["case"], DISPLACEMENT));
            let cases = self.cases.iter();
            let cases =
                cases.map(|(name, case)| (name, &case.output.displacement, &case.displacements));
            let base = (BASE, base, &self.displacements);
            let mut states = std::iter::once(base).chain(cases);
            for (name, displacement, nodes) in states.by_ref().take(TOLD) {
                let rounding = Rounding::of(nodes.0.iter().map(|(_, row)| row));
                table.row(&[name], rounding.shown(displacement));
            }
            format!("{table}{}", more(states.count()))
        };
        section(text, &self.output.heading(), table);
    }
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
