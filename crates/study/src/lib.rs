//! Studies of mechanisms: everything that a front end needs, as a library.
//!
#![doc = include_str!("../README.md")]

mod answer;
mod ask;
mod compare;
#[cfg(feature = "figures")]
mod contrast;
mod differences;
#[cfg(feature = "figures")]
mod digits;
#[cfg(all(feature = "fs", feature = "parts"))]
pub mod disk;
mod doubts;
mod drives;
mod entries;
mod error;
#[cfg(feature = "figures")]
pub mod figure;
pub mod files;
mod gradient;
mod measures;
mod near;
mod number;
#[cfg(feature = "figures")]
mod page;
#[cfg(feature = "parts")]
pub mod parts;
pub mod plain;
#[cfg(feature = "figures")]
mod plot_error;
#[cfg(feature = "figures")]
mod ran;
pub mod scene;
mod schema;
mod selection;
pub mod session;
mod source;
mod steps;
mod study;
pub mod sweep;
pub mod table;
mod title;
mod verification;
#[cfg(feature = "view")]
mod view;
mod vtu;

pub use answer::{
    AdjustReport, Asked, BodyReport, BudgetReport, CaseOutput, CaseReport, CheckReport,
    CountReport, FrameReport, FrequencyReport, FrequencySensitivityReport, JointReport,
    MeasuresReport, MisfitEffectReport, ModeReport, ModesReport, MovedReport, NumberReport,
    OutputReport, PartReport, PrincipalReport, Rows, ScrewReport, SectionForces, SegmentReport,
    SensitivityReport, SolveReport, StrainReport, StressReport, Sum, VirtualWork, Why, WorstReport,
};
pub use ask::{Answered, Focus, Question};
pub use compare::{BudgetComparison, Comparison, InputDifference, Pair, PartDifference, Results};
#[cfg(feature = "figures")]
pub use contrast::{
    ColumnDifference, Furthest, Matched, Ratios, StatusCount, TableComparison,
    tables as compare_tables,
};
pub use differences::Gradient;
pub use doubts::Watch;
pub use drives::MissingDrives;
pub use entries::Entries;
pub use error::{Problem, StudyError};
pub use gradient::Quantity;
pub use hyperstat_assembly::BeamMass;
pub use hyperstat_joints::{Dof, DofSet, Joint};
#[cfg(feature = "fs")]
pub use hyperstat_mechanisms::Disk;
pub use hyperstat_mechanisms::{
    Along, Arguments, Batch, Dependence, Drive, Files, Input, Job, JobLoad, JobMechanism, JobPoses,
    LoadError, Location, Mechanism, MemoryFiles, Orientation, ParsedJoint, PoseError, Registry,
    Target, Value, load, load_batch, load_str,
};
pub use measures::Measure;
pub use number::{ROUNDING, Rounding, number, without_rounding};
#[cfg(feature = "figures")]
pub use page::Page;
#[cfg(feature = "figures")]
pub use plot_error::PlotError;
#[cfg(feature = "figures")]
pub use ran::Ran;
pub use selection::Selection;
pub use study::Study;
pub use verification::{StateDifferences, Verification};
#[cfg(feature = "view")]
pub use view::View;
