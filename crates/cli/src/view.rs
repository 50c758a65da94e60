//! `hyperstat view`: a page to look at.

use std::path::{Path, PathBuf};

use hyperstat_mechanisms::{Disk, Registry};
use hyperstat_study::View;
use hyperstat_study::disk;

use crate::args;
use crate::error::CliError;

/// Writes the page; returns what is told of it.
pub(crate) fn run(args: &args::View, registry: &Registry) -> Result<String, CliError> {
    let path = &args.input.file;
    let view = View::of_file(path, &args.input.selection(), &Disk, registry)?;
    let out = args.out.clone().unwrap_or_else(|| beside(path));
    disk::refuse(Some(&*out), view.read())?;
    disk::write(&out, view.html(registry)?.as_bytes())?;
    let kind = match View::LIVE {
        true => "",
        false => {
            " (worked out beforehand; `hyperstat view --help` says how to get one that answers)"
        }
    };
    Ok(format!("{}{kind}\n", out.display()))
}

/// The page of a file, in the folder that the program was called in: `portal.html` of `robots/portal.ron`.
fn beside(path: &Path) -> PathBuf {
    PathBuf::from(path.file_name().unwrap_or_default()).with_extension("html")
}
