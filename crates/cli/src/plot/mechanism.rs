//! Figures of a mechanism, solved as by `hyperstat solve`: deformed, in a natural mode, and what its
//! deflection comes from.

use hyperstat_mechanisms::{Along, Registry};

use super::{PlotError, Plotted, magnified, stem};
use crate::args;
use crate::case::Case;
use crate::drawing::{self, Drawing};
use crate::error::CliError;
use crate::outputs;
use crate::report::Asked;

/// The figure that is asked for.
pub(super) fn figure(args: &args::Plot, registry: &Registry) -> Result<Plotted, CliError> {
    let input = args::Input {
        file: args.file.clone(),
        job: args.job.clone(),
        design: args.design,
        pose: args.pose,
    };
    let case = Case::load(&input, registry)?;
    let name = case
        .job()
        .map_or_else(|| stem(&args.file), |(job, _)| job.into());
    let kind = match args.kind.mode {
        _ if args.kind.deformed => "deformed".to_string(),
        Some(number) => format!("mode-{number}"),
        None => "budget".to_string(),
    };
    let stem = super::stem_of(args, &format!("{name}-{kind}"));
    outputs::refuse(
        drawing::files(&stem).iter().map(|path| &**path),
        &case.files,
    )?;
    let drawing = if args.kind.deformed {
        deformed(args, &case)?
    } else if let Some(number) = args.kind.mode {
        mode(args, &case, number.into())?
    } else {
        budget(args, &case)?
    };
    Ok(Plotted { drawing, stem })
}

/// The title that is asked for, or one that says what is drawn.
fn title(args: &args::Plot, case: &Case, of_case: Option<&str>) -> String {
    args.title.clone().unwrap_or_else(|| case.title(of_case))
}

fn deformed(args: &args::Plot, case: &Case) -> Result<Drawing, CliError> {
    let model = case.model();
    let solution = case.solve_held()?;
    let loaded = case.under(&solution, args.case.as_deref(), &args.file)?;
    let title = title(args, case, args.case.as_deref());
    let scale = magnified(args.scale.as_ref())?;
    let mut figure =
        drawing::deformed(model, &loaded, title, scale).map_err(|error| case.unsolvable(error))?;
    if args.verify {
        let reference = case.reference()?;
        drawing::compare(&mut figure, model, &solution, &reference);
    }
    Ok(Drawing::Deformed(figure))
}

fn mode(args: &args::Plot, case: &Case, number: usize) -> Result<Drawing, CliError> {
    let options = case.modal_options(Some(number), false);
    let modal = options.as_ref().map(|options| case.modal(options));
    let modes = modal.transpose()?.map(|modal| case.modes(&modal));
    let modes = modes
        .transpose()?
        .map(|found| found.modes)
        .unwrap_or_default();
    let mode = modes.get(number - 1).ok_or_else(|| PlotError::NoMode {
        path: args.file.clone(),
        number,
        count: modes.len(),
    })?;
    let title = title(args, case, None);
    let scale = magnified(args.scale.as_ref())?;
    let figure = drawing::mode(case.model(), mode, number, title, scale)
        .map_err(|error| case.unsolvable(error))?;
    Ok(Drawing::Deformed(figure))
}

fn budget(args: &args::Plot, case: &Case) -> Result<Drawing, CliError> {
    let model = case.model();
    let solution = case.solve_held()?;
    let loaded = case.under(&solution, args.case.as_deref(), &args.file)?;
    let asked = Asked {
        case: args.case.as_deref(),
        along: args.along.unwrap_or(Along::Displacement),
    };
    let budget = crate::report::budget(&case.here(), &loaded, asked);
    let budget = budget.map_err(|error| case.unsolvable(error))?;
    let budget = budget.ok_or_else(|| PlotError::Free {
        path: args.file.clone(),
    })?;
    let output = model.output().map(|node| model.node_name(node));
    let title = title(args, case, asked.case);
    let figure = drawing::budget(&budget, &output.unwrap_or_default(), title);
    Ok(Drawing::Budget(figure.ok_or_else(|| {
        PlotError::NoShares {
            path: args.file.clone(),
        }
    })?))
}
