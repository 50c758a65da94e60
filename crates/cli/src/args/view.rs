//! The options of `hyperstat view`.

use std::path::PathBuf;

use clap::Args;

use super::input::Input;

pub(super) const VIEW_HELP: &str = "\
One file that opens in any browser, from the disk, and fetches nothing: the mechanism in space, deformed under its
loads and in its modes, coloured by stress, with its text and its numbers.

A program that was built with the feature `live` puts the core into the page: drag the output, move the drives,
change values or the text, and it answers. Any other writes a page of what it has worked out beforehand, all
load cases, modes, some poses and maps, and that page says so. The live program, from a clone:
  just web
  cargo install --locked --path crates/cli --features live

Examples:
  hyperstat view portal.ron                  Writes portal.html
  hyperstat view paper.ron --job delta --pose 12 --out delta.html";

/// `hyperstat view`
#[derive(Debug, Args)]
pub(crate) struct View {
    #[command(flatten)]
    pub(crate) input: Input,
    /// File to write [default: the name of the file, with `.html`, in this folder]
    #[arg(long, value_name = "FILE.html")]
    pub(crate) out: Option<PathBuf>,
}
