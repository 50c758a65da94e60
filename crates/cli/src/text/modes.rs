//! Natural frequencies.

use std::fmt::Write as _;

use hyperstat_assembly::larger_first;
use hyperstat_study::{CountReport, ModeReport, ModesReport};

use super::parts::section;
use super::table::{Table, number};

/// Bodies that a table names for a mode.
const SHOWN: usize = 3;

/// A share of the kinetic energy below this is not shown.
const LEAST: f64 = 0.005;

/// Appends the table.
pub(crate) fn write(found: &ModesReport, text: &mut String) {
    let heads = ["mode", "moves most", "frequency", "along x", "y", "z"];
    let mut table = Table::new(2, &heads);
    for (k, mode) in found.modes.iter().enumerate() {
        let effective = mode.effective_mass.map(|mass| shown(mass, found.mass));
        table.row(
            &[&(k + 1).to_string(), &most_moved(mode)],
            [mode.frequency].into_iter().chain(effective),
        );
    }
    section(
        text,
        &format!(
            "Natural frequencies [Hz], shares of bodies in the kinetic energy, effective \
             masses [kg] of {} kg",
            number(found.mass)
        ),
        table,
    );
    if let Some(CountReport {
        below,
        modes,
        found,
    }) = found.counted
    {
        let missed = match modes.saturating_sub(found) {
            0 => "none missed".into(),
            missed => format!("{missed} missed"),
        };
        let below = number(below);
        let _ = writeln!(
            text,
            "  {found} of {modes} modes below {below} Hz, {missed}"
        );
    }
}

/// An effective mass; zero where it is rounding.
fn shown(mass: f64, whole: f64) -> f64 {
    if mass < 1e-12 * whole { 0.0 } else { mass }
}

/// The bodies with most of the kinetic energy, in words.
fn most_moved(mode: &ModeReport) -> String {
    let shares = mode.kinetic_energy.iter();
    let mut shares: Vec<_> = shares.map(|(name, share)| (name, *share)).collect();
    shares.sort_by(|a, b| larger_first(a.1, b.1));
    let shown = shares
        .iter()
        .take(SHOWN)
        .filter(|(_, share)| *share > LEAST);
    let words: Vec<String> = shown
        .map(|(name, share)| format!("{name} {:.0} %", 100.0 * share))
        .collect();
    words.join(", ")
}
