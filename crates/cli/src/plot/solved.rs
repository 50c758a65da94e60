//! The budget in what `hyperstat solve --why --format json` printed.

use hyperstat_mechanisms::{Location, files};
use serde::{Deserialize, Deserializer};

use super::{PlotError, Plotted, stem};
use crate::args;
use crate::drawing::{self, Drawing};
use crate::error::CliError;
use crate::outputs;
use crate::report::BudgetReport;

/// What of the JSON is drawn.
#[derive(Debug, Deserialize)]
struct Solved {
    name: String,
    job: Option<String>,
    design: Option<usize>,
    pose: Option<usize>,
    output: Output,
    /// Not there, `null`, or a budget.
    #[serde(default, deserialize_with = "given")]
    budget: Option<Option<BudgetReport>>,
}

#[derive(Debug, Deserialize)]
struct Output {
    node: String,
}

/// Reads a field that is there, `null` or not.
fn given<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Option<BudgetReport>>, D::Error> {
    Deserialize::deserialize(deserializer).map(Some)
}

/// The figure of the budget.
pub(super) fn figure(args: &args::Plot) -> Result<Plotted, CliError> {
    let path = || args.file.clone();
    for (option, given) in [
        ("--along", args.along.is_some()),
        ("--case", args.case.is_some()),
    ] {
        if given {
            return Err(CliError::Plot(PlotError::Answered {
                path: path(),
                option,
            }));
        }
    }
    let bytes = files::read(&args.file).map_err(|source| PlotError::Read {
        path: path(),
        source,
    })?;
    // What is no text is no JSON either.
    let text = String::from_utf8_lossy(&bytes);
    let solved: Solved = serde_json::from_str(&text).map_err(|error| {
        // The message ends with the place, which is told by the location.
        let message = error.to_string();
        let end = message.rfind(" at line ").unwrap_or(message.len());
        PlotError::NoSolve {
            location: Box::new(Location {
                path: path(),
                line: error.line().max(1),
                column: error.column().max(1),
                width: 1,
                text: (text.lines().nth(error.line().saturating_sub(1)))
                    .unwrap_or_default()
                    .into(),
            }),
            message: message[..end].into(),
        }
    })?;
    let budget = solved
        .budget
        .ok_or_else(|| PlotError::NoBudget { path: path() })?;
    let budget = budget.ok_or_else(|| PlotError::Free { path: path() })?;
    let name = solved.job.as_ref().unwrap_or(&solved.name);
    let title = args.title.clone();
    let title = title.unwrap_or_else(|| {
        drawing::title(name, solved.design, solved.pose, budget.case.as_deref())
    });
    let stem = super::stem_of(args, &format!("{}-budget", stem(&args.file)));
    outputs::refuse(drawing::files(&stem).iter().map(|path| &**path), &[path()])?;
    let figure = drawing::budget(&budget, &solved.output.node, title);
    Ok(Plotted {
        drawing: Drawing::Budget(figure.ok_or_else(|| PlotError::NoShares { path: path() })?),
        stem,
    })
}
