//! hyperstat for Python: the core of the package `hyperstat`, as thin as it can be. What users see is in
//! `python/hyperstat`; everything that is computed is in `hyperstat-study`.

mod arrays;
mod error;
mod given;
mod gradient;
mod joint;
mod kept;
mod mechanism;
mod pool;
mod pose;
mod run;
mod sweep;
mod view;
mod watched;

use hyperstat_study::{Measure, Registry, files};
use pyo3::prelude::*;

/// The JSON Schema of files.
#[pyfunction]
fn schema() -> String {
    files::schema(&Registry::builtin())
}

/// Name, unit and words of every measure.
#[pyfunction]
fn measures() -> Vec<(&'static str, &'static str, &'static str)> {
    let all = Measure::all().iter();
    all.map(|own| (own.name, own.unit, own.words)).collect()
}

/// Unit and words of a column of a table.
#[pyfunction]
fn column(name: &str) -> (&'static str, String) {
    use hyperstat_study::table::{unit, words};
    (unit(name), words(name))
}

#[pymodule]
mod _hyperstat {
    #[pymodule_export]
    use super::column;
    #[pymodule_export]
    use super::joint::JointKind;
    #[pymodule_export]
    use super::kept::{after_fork, before_fork};
    #[pymodule_export]
    use super::measures;
    #[pymodule_export]
    use super::mechanism::{Core, load, parse, prebuilt};
    #[pymodule_export]
    use super::pose::{Pose, pose_again};
    #[pymodule_export]
    use super::run::{begin_run, lasts, merge_run, run_share};
    #[pymodule_export]
    use super::schema;
    #[pymodule_export]
    use super::sweep::{Found, measure};
    #[pymodule_export]
    use super::view::view;

    /// Whether pages have the core in them.
    #[pymodule_export]
    #[allow(non_upper_case_globals)]
    const live: bool = super::view::LIVE;

    /// Version of the package.
    #[pymodule_export]
    #[allow(non_upper_case_globals)]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
