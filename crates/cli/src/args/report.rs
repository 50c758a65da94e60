//! The options of `hyperstat report`.

use std::path::PathBuf;

use clap::Args;
use hyperstat_mechanisms::Along;

use super::input::{Input, along};

pub(super) const REPORT_HELP: &str = "\
One self-contained page: nothing is fetched when it is read, and nothing in it changes from run to run. Print
it from a browser for a PDF.
Of a mechanism file: the mechanism drawn, its displacement, stiffness, measures, what is soft, natural
frequencies where all that moves has mass, worst points, wrenches, the file itself, and definitions.
Of a batch file: every job, or the one of --job, is run, with the measures over its poses and its figures;
then the mechanism at one of its poses as above.

Examples:
  hyperstat report portal.ron --out portal.html
  hyperstat report paper.ron --job delta --pose 12 --out delta.html";

/// `hyperstat report`
#[derive(Debug, Args)]
pub(crate) struct Report {
    #[command(flatten)]
    pub(crate) input: Input,
    /// File to write; standard output without it
    #[arg(long, value_name = "FILE.html")]
    pub(crate) out: Option<PathBuf>,
    /// Title of the page [default: the name of the file]
    #[arg(long, value_name = "TEXT")]
    pub(crate) title: Option<String>,
    /// Direction of the budget, as of `solve --why`
    #[arg(
        long,
        value_name = "DIRECTION",
        value_parser = along,
        default_value = "displacement",
        allow_hyphen_values = true
    )]
    pub(crate) along: Along,
    /// The case whose displacement is drawn and explained [default: the loads of no case]
    #[arg(long, value_name = "NAME")]
    pub(crate) case: Option<String>,
    /// Tell the N lowest natural frequencies [default: a job's `modes`, or 3 where all that moves has mass]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=100))]
    pub(crate) modes: Option<u16>,
    /// Number of threads for the jobs of a batch, at most 8 a core; 0 is one a core
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) threads: usize,
}
