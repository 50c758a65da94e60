//! Studies of mechanisms: everything that a front end needs, as a library.
//!
#![doc = include_str!("../README.md")]

mod answer;
mod ask;
#[cfg(feature = "figures")]
mod digits;
mod doubts;
mod drives;
mod entries;
mod error;
#[cfg(feature = "figures")]
pub mod figure;
pub mod files;
mod measures;
mod near;
#[cfg(feature = "figures")]
mod plot_error;
mod schema;
mod source;
mod study;
pub mod sweep;
pub mod table;
mod title;
mod verification;
mod vtu;

pub use answer::{
    AdjustReport, Asked, BodyReport, BudgetReport, CaseOutput, CaseReport, CheckReport,
    CountReport, FrameReport, FrequencyReport, FrequencySensitivityReport, JointReport,
    MeasuresReport, MisfitEffectReport, ModeReport, ModesReport, MovedReport, NumberReport,
    OutputReport, PartReport, PrincipalReport, Rows, ScrewReport, SectionForces, SegmentReport,
    SensitivityReport, SolveReport, StrainReport, StressReport, Sum, VirtualWork, Why, WorstReport,
};
pub use ask::{Answered, Question};
pub use doubts::Watch;
pub use drives::MissingDrives;
pub use entries::Entries;
pub use error::{Problem, StudyError};
#[cfg(feature = "fs")]
pub use hyperstat_mechanisms::Disk;
pub use hyperstat_mechanisms::{
    Along, Batch, Dependence, Drive, Files, Input, Job, JobLoad, JobMechanism, JobPoses, LoadError,
    Location, Mechanism, MemoryFiles, PoseError, Registry, Target, Value,
};
#[cfg(feature = "figures")]
pub use plot_error::PlotError;
pub use study::{Selection, Study};
pub use verification::{StateDifferences, Verification};
