//! What `solve` and `check` find, as plain data: what the JSON is, and what tables are made from.

mod adjust;
mod by_parameter;
mod cases;
mod check;
mod forces;
mod inner;
mod joints;
mod misfits;
mod modes;
mod parameters;
mod sensitivities;
mod solve;
mod why;

use hyperstat_assembly::{Configuration, Model};
use nalgebra::{Matrix6, Vector6};

pub use adjust::{AdjustReport, MovedReport, NumberReport};
pub use cases::{CaseOutput, CaseReport};
pub use check::CheckReport;
pub use forces::{BodyReport, SectionForces, StrainReport, WorstReport};
use inner::inner_displacements;
use inner::inner_displacements_of;
pub(crate) use inner::segment_names;
pub use joints::{FrameReport, JointReport};
pub use misfits::MisfitEffectReport;
pub use modes::{CountReport, ModeReport, ModesReport};
pub use sensitivities::{FrequencyReport, FrequencySensitivityReport, SensitivityReport};
pub use solve::{OutputReport, SegmentReport, SolveReport, StressReport};
pub use why::{
    Asked, BudgetReport, MeasuresReport, PartReport, PrincipalReport, ScrewReport, Sum,
    VirtualWork, Why,
};
pub(crate) use why::{budget, budget_and_measures, shares};

/// A 6×6 matrix by rows.
pub type Rows = [[f64; 6]; 6];

/// The rows of a matrix.
pub fn rows(matrix: &Matrix6<f64>) -> Rows {
    std::array::from_fn(|r| std::array::from_fn(|c| matrix[(r, c)]))
}

fn numbers(vector: &Vector6<f64>) -> [f64; 6] {
    (*vector).into()
}

/// The redundant constraints of a mechanism: joint directions such as `A1.x`, in groups.
fn redundancies(here: &Configuration<'_>) -> Vec<Vec<String>> {
    let redundant = here.redundant_constraints().into_iter();
    redundant.map(|group| group.names(here.model())).collect()
}

/// What a model says that can hardly be meant, in words.
fn doubts(model: &Model) -> impl Iterator<Item = String> {
    model.doubts().into_iter().map(|doubt| doubt.to_string())
}

/// The translation of a displacement.
pub(crate) fn linear(displacement: &Vector6<f64>) -> [f64; 3] {
    [displacement[0], displacement[1], displacement[2]]
}
