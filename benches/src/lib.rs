//! Shared parts of the benches: mechanisms in many poses, and what is done with a pose.

mod sweep;

use std::path::Path;

use hyperstat_mechanisms::{Disk, Job, Registry, load_batch};

pub use sweep::Sweep;

/// Position of the delta's platform where one pose is measured \[m\].
pub const POSE: [f64; 3] = [-0.2, -0.2, 0.5];

/// The jobs of `benches/mechanisms.ron`: prebuilt mechanisms, each in 64 poses, the paper's delta
/// with rigid and with elastic joints (1e8 N/m and 1e5 N·m/rad) first.
///
/// # Panics
/// Where the file cannot be used.
pub fn mechanisms() -> Vec<Job> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms.ron");
    let batch =
        load_batch(&path, &Disk, &Registry::builtin()).unwrap_or_else(|error| panic!("{error}"));
    batch.jobs
}

/// The job of `benches/mechanisms.ron` with this name.
///
/// # Panics
/// Where there is none.
pub fn mechanism(name: &str) -> Job {
    let mut jobs = mechanisms().into_iter();
    let found = jobs.find(|job| job.name == name);
    found.unwrap_or_else(|| panic!("no mechanism `{name}`"))
}
