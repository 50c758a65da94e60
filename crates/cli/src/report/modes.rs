//! Natural frequencies and modes in the report of `hyperstat solve`.

use hyperstat_assembly::{Mode, Model, Modes, larger_first};
use serde::Serialize;

use super::inner::segment_names;
use super::{Entries, Table, numbers, section};

/// Bodies that a table names for a mode.
const SHOWN: usize = 3;
/// A share of the kinetic energy below this is not shown.
const LEAST: f64 = 0.005;

/// The lowest natural modes. Field names are those of the JSON output.
#[derive(Debug, Serialize)]
pub(crate) struct ModesReport {
    modes: Vec<ModeReport>,
    /// Mass of all beams and nodes [kg].
    mass: f64,
    #[serde(skip)]
    remarks: Vec<String>,
}

#[derive(Debug, Serialize)]
struct ModeReport {
    /// [Hz]
    frequency: f64,
    /// Displacement of every node, of unit modal mass [m/√kg, rad/√kg].
    shape: Entries<[f64; 6]>,
    /// In a translation of the ground along x, y and z [kg].
    effective_mass: [f64; 3],
    /// Share of every body in the kinetic energy.
    kinetic_energy: Entries<f64>,
}

impl ModesReport {
    /// Collects what is to be reported; `all`: the nodes inside segments too.
    pub(crate) fn new(model: &Model, found: &Modes, wanted: usize, all: bool) -> Self {
        let mut remarks = Vec::new();
        if found.modes.len() < wanted {
            remarks.push(format!(
                "there are {} modes only: no more coordinates have mass (more elements a segment \
                 make more)",
                found.modes.len()
            ));
        }
        if found.idle > 0 {
            remarks.push(format!(
                "idle motions with mass, of frequency zero, are left out: {}",
                found.idle
            ));
        }
        let free = found.modes.iter().filter(|mode| mode.frequency == 0.0);
        match free.count() {
            0 => {}
            free => remarks.push(format!(
                "the output moves freely: frequencies that are zero: {free}"
            )),
        }
        if !found.complete {
            remarks.push(
                "the number of frequencies could not be counted: one of several equal ones may be \
                 missing"
                    .into(),
            );
        }
        let residuals = found.modes.iter().map(|mode| mode.residual);
        let worst = residuals.fold(0.0, f64::max);
        if worst > UNSETTLED {
            let good = match worst < 1.0 {
                true => format!("modes are good to about {worst:.0e} only"),
                false => "no digit of the modes is right".into(),
            };
            remarks.push(format!("parts of very different stiffness: {good}"));
        }
        let mode = |mode| ModeReport::new(model, mode, all);
        Self {
            modes: found.modes.iter().map(mode).collect(),
            mass: found.mass,
            remarks,
        }
    }

    /// What the user should know about the modes.
    pub(crate) fn remarks(&self) -> &[String] {
        &self.remarks
    }

    /// Appends the table.
    pub(crate) fn write(&self, text: &mut String) {
        let heads = ["mode", "moves most", "frequency", "along x", "y", "z"];
        let mut table = Table::new(2, &heads);
        for (k, mode) in self.modes.iter().enumerate() {
            let effective = mode.effective_mass.map(|mass| shown(mass, self.mass));
            table.row(
                &[&(k + 1).to_string(), &mode.most_moved()],
                [mode.frequency].into_iter().chain(effective),
            );
        }
        section(
            text,
            &format!(
                "Natural frequencies [Hz], shares of bodies in the kinetic energy, effective \
                 masses [kg] of {} kg",
                super::number(self.mass)
            ),
            table,
        );
    }
}

/// A residual above this is worth a remark.
const UNSETTLED: f64 = 1e-6;

/// An effective mass; zero where it is rounding.
fn shown(mass: f64, whole: f64) -> f64 {
    if mass < 1e-12 * whole { 0.0 } else { mass }
}

impl ModeReport {
    fn new(model: &Model, mode: &Mode, all: bool) -> Self {
        let nodes = (0..model.nodes().len()).map(hyperstat_assembly::NodeId);
        let named = nodes.map(|node| {
            let displacement = &mode.displacements[node.0];
            (model.node_name(node), numbers(displacement))
        });
        let segments = segment_names(model).into_iter().zip(&mode.inner);
        let inner = segments.filter(|_| all).flat_map(|(name, inner)| {
            let inner = inner.iter().enumerate();
            inner.map(move |(k, u)| (format!("{name}.{}", k + 1), numbers(u)))
        });
        let bodies = model.bodies().iter().zip(&mode.kinetic);
        Self {
            frequency: mode.frequency,
            shape: named.chain(inner).collect(),
            effective_mass: mode.effective_mass,
            kinetic_energy: bodies.map(|(b, share)| (b.name.clone(), *share)).collect(),
        }
    }

    /// The bodies with most of the kinetic energy, in words.
    fn most_moved(&self) -> String {
        let mut shares: Vec<_> = self.kinetic_energy.0.iter().collect();
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
}
