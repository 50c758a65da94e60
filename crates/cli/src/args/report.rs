//! The options of `hyperstat report`.

use std::path::PathBuf;

use clap::Args;

use super::input::{Dwelling, Input};

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
    #[command(flatten)]
    pub(crate) dwelling: Dwelling,
    /// Number of threads for the jobs of a batch, at most 8 a core; 0 is one a core
    #[arg(
        long,
        value_name = "N",
        allow_negative_numbers = true,
        default_value_t = 0
    )]
    pub(crate) threads: usize,
}
