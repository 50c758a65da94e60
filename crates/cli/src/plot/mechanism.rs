//! Figures of a mechanism, solved as by `hyperstat solve`: deformed, in a natural mode, and what its
//! deflection comes from.

use hyperstat_mechanisms::{Along, Disk, Noted, Registry};
use hyperstat_study::disk;
use hyperstat_study::figure::{Form, Labels, Look};
use hyperstat_study::{Asked, Selection, Study};

use super::{Plotted, forms, magnified, stem};
use crate::args;
use crate::error::CliError;

/// The figure that is asked for.
pub(super) fn figure(args: &args::Plot, registry: &Registry) -> Result<Plotted, CliError> {
    let selection = Selection {
        job: args.job.clone(),
        design: args.design,
        pose: match args.pose {
            Some(args::Pose::Number(number)) => Some(number),
            _ => None,
        },
    };
    let at = match &args.pose {
        Some(args::Pose::At(at)) => Some(at),
        _ => None,
    };
    let study = match at {
        Some(at) => Study::open_at(&args.file, &selection, at, &Disk, registry)?,
        // Poses that run begin where one can be taken.
        None if args.animate && args.kind.deformed => {
            Study::open_first(&args.file, &selection, &Disk, registry)?
        }
        None => Study::open(&args.file, &selection, &Disk, registry)?,
    };
    let name = study
        .job()
        .map_or_else(|| stem(&args.file), |(job, _)| job.into());
    let kind = match args.kind.mode {
        _ if args.kind.deformed => "deformed".to_string(),
        Some(number) => format!("mode-{number}"),
        None => "budget".to_string(),
    };
    let moving = if args.animate { "-moving" } else { "" };
    let stem = super::stem_of(args, &format!("{name}-{kind}{moving}"));
    let files = Form::files(&stem, &forms(args));
    disk::refuse(files.iter().map(|path| &**path), study.files())?;
    let title = args.title.clone();
    let mut shown = args.show.clone();
    // A pose that was asked for by its coordinates is told by them.
    if at.is_some() && !shown.contains(&Noted::Pose) {
        shown.push(Noted::Pose);
    }
    let look = || -> Result<Look, CliError> {
        Ok(Look {
            scale: magnified(args.scale.as_ref())?,
            title: args.title.clone(),
            look: hyperstat_mechanisms::Look {
                view: args.view,
                shown: shown.clone(),
            },
            labels: Labels(args.label.clone()),
        })
    };
    let drawing = if args.kind.deformed {
        let case = args.case.as_deref();
        let poses = match args.animate && args.pose.is_none() {
            true => study.through_poses(case, &look()?)?,
            false => None,
        };
        match poses {
            Some(poses) => poses,
            None => study.deformed(case, args.verify, look()?)?,
        }
    } else if let Some(number) = args.kind.mode {
        study.mode(&args.file, number.into(), look()?)?
    } else {
        let asked = Asked {
            case: args.case.clone(),
            along: args.along.unwrap_or(Along::Displacement),
        };
        study.budget_figure(&args.file, &asked, title)?
    };
    let drawing = match args.animate {
        true => drawing.moving(),
        false => drawing,
    };
    Ok(Plotted { drawing, stem })
}
