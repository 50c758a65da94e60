//! The budget in what `hyperstat solve --why --format json` printed.

use hyperstat_mechanisms::files;
use hyperstat_study::PlotError;
use hyperstat_study::disk;
use hyperstat_study::figure::{Drawing, Form, Solved};

use super::{Plotted, stem};
use crate::args;
use crate::error::CliError;

/// The figure of the budget.
pub(super) fn figure(args: &args::Plot) -> Result<Plotted, CliError> {
    for (option, given) in [
        ("--along", args.along.is_some()),
        ("--case", args.case.is_some()),
    ] {
        if given {
            return Err(CliError::Answered {
                path: args.file.clone(),
                option,
            });
        }
    }
    let bytes = files::read(&args.file).map_err(|source| PlotError::Read {
        path: args.file.clone(),
        source,
    })?;
    // What is no text is no JSON either.
    let solved = Solved::from_json(&args.file, &String::from_utf8_lossy(&bytes))?;
    let drawing = Drawing::Budget(solved.budget(&args.file, args.title.clone())?);
    let stem = super::stem_of(args, &format!("{}-budget", stem(&args.file)));
    let files = Form::files(&stem, &super::forms(args));
    disk::refuse(
        files.iter().map(|path| &**path),
        std::slice::from_ref(&args.file),
    )?;
    Ok(Plotted { drawing, stem })
}
