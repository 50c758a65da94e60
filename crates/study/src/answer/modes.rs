//! Natural frequencies and modes in the report of `hyperstat solve`.

use hyperstat_assembly::{BeamMass, ModalOptions, Mode, Model, Modes};
use serde::Serialize;

use super::inner::segment_names;
use super::numbers;
use crate::entries::Entries;

/// The lowest natural modes. Field names are those of the JSON output.
#[derive(Debug, Serialize)]
pub struct ModesReport {
    /// The modes, ascending.
    pub modes: Vec<ModeReport>,
    /// Mass of all beams and nodes \[kg\].
    pub mass: f64,
    /// How many frequencies there are below which, by a count of them.
    pub counted: Option<CountReport>,
    /// What the user should know about them; told among the warnings.
    #[serde(skip)]
    pub remarks: Vec<String>,
}

/// A count of frequencies.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct CountReport {
    /// The frequency \[Hz\] below which they were counted.
    pub below: f64,
    /// Their number, idle motions apart.
    pub modes: usize,
    /// How many of them were found, be they listed or not: none is missing where it is the same.
    pub found: usize,
}

/// A natural mode.
#[derive(Debug, Serialize)]
pub struct ModeReport {
    /// Natural frequency \[Hz\].
    pub frequency: f64,
    /// Displacement of every node, of unit modal mass \[m/√kg, rad/√kg\].
    pub shape: Entries<[f64; 6]>,
    /// In a translation of the ground along x, y and z \[kg\].
    pub effective_mass: [f64; 3],
    /// Share of every body in the kinetic energy.
    pub kinetic_energy: Entries<f64>,
}

impl ModesReport {
    /// Collects what is to be reported; `all`: the nodes inside segments too.
    pub fn new(model: &Model, found: &Modes, options: &ModalOptions, all: bool) -> Self {
        let (wanted, mass) = (options.count, options.mass);
        let mut remarks = Vec::new();
        if found.modes.len() < wanted {
            remarks.push(format!(
                "there are {} modes only: no more coordinates have mass{}",
                found.modes.len(),
                match mass {
                    BeamMass::Exact => "",
                    _ => " (more elements a segment make more)",
                }
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
            counted: found.counted.map(|counted| CountReport {
                below: counted.below,
                modes: counted.modes,
                found: counted.found,
            }),
            remarks,
        }
    }

    /// What the user should know about the modes.
    pub fn remarks(&self) -> &[String] {
        &self.remarks
    }
}

/// A residual above this is worth a remark.
const UNSETTLED: f64 = 1e-6;

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
}
