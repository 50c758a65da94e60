//! Figures of a mechanism, solved as by `hyperstat solve`: deformed, in a natural mode, and what its
//! deflection comes from.

use hyperstat_mechanisms::{Along, Disk, Registry};
use hyperstat_study::figure::Look;
use hyperstat_study::{Asked, Selection, Study};

use super::{Plotted, files, magnified, stem};
use crate::args;
use crate::error::CliError;
use crate::outputs;

/// The figure that is asked for.
pub(super) fn figure(args: &args::Plot, registry: &Registry) -> Result<Plotted, CliError> {
    let selection = Selection {
        job: args.job.clone(),
        design: args.design,
        pose: args.pose,
    };
    let study = Study::open(&args.file, &selection, &Disk, registry)?;
    let name = study
        .job()
        .map_or_else(|| stem(&args.file), |(job, _)| job.into());
    let kind = match args.kind.mode {
        _ if args.kind.deformed => "deformed".to_string(),
        Some(number) => format!("mode-{number}"),
        None => "budget".to_string(),
    };
    let stem = super::stem_of(args, &format!("{name}-{kind}"));
    outputs::refuse(files(&stem).iter().map(|path| &**path), study.files())?;
    let title = args.title.clone();
    let look = || -> Result<Look, CliError> {
        Ok(Look {
            scale: magnified(args.scale.as_ref())?,
            title: args.title.clone(),
            look: hyperstat_mechanisms::Look {
                view: args.view,
                shown: args.show.clone(),
            },
        })
    };
    let drawing = if args.kind.deformed {
        study.deformed(args.case.as_deref(), args.verify, look()?)?
    } else if let Some(number) = args.kind.mode {
        study.mode(&args.file, number.into(), look()?)?
    } else {
        let asked = Asked {
            case: args.case.clone(),
            along: args.along.unwrap_or(Along::Displacement),
        };
        study.budget_figure(&args.file, &asked, title)?
    };
    Ok(Plotted { drawing, stem })
}
