//! The budget in the JSON of a solved mechanism.

use std::path::Path;

use hyperstat_figures::BarFigure;
use hyperstat_mechanisms::Location;
use serde::{Deserialize, Deserializer};

use super::budget::budget;
use crate::answer::BudgetReport;
use crate::plot_error::PlotError;
use crate::title::title;

/// What of the JSON is drawn.
#[derive(Debug, Deserialize)]
pub struct Solved {
    name: String,
    job: Option<String>,
    design: Option<usize>,
    pose: Option<usize>,
    output: OutputNode,
    /// Not there, `null`, or a budget.
    #[serde(default, deserialize_with = "given")]
    budget: Option<Option<BudgetReport>>,
}

#[derive(Debug, Deserialize)]
struct OutputNode {
    node: String,
}

/// Reads a field that is there, `null` or not.
fn given<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Option<BudgetReport>>, D::Error> {
    Deserialize::deserialize(deserializer).map(Some)
}

impl Solved {
    /// Reads what `solve --why` found, as JSON, from the file of this name.
    ///
    /// # Errors
    /// It is no such JSON, with the place.
    pub fn from_json(path: &Path, text: &str) -> Result<Self, PlotError> {
        serde_json::from_str(text).map_err(|error| {
            // The message ends with the place, which is told by the location.
            let message = error.to_string();
            let end = message.rfind(" at line ").unwrap_or(message.len());
            PlotError::NoSolve {
                location: Box::new(Location {
                    path: path.into(),
                    line: error.line().max(1),
                    column: error.column().max(1),
                    width: 1,
                    text: (text.lines().nth(error.line().saturating_sub(1)))
                        .unwrap_or_default()
                        .into(),
                }),
                message: message[..end].into(),
            }
        })
    }

    /// The figure of its budget, with this title or one that says what is drawn.
    ///
    /// # Errors
    /// There is no budget, or nothing has a share in it.
    pub fn budget(&self, path: &Path, own_title: Option<String>) -> Result<BarFigure, PlotError> {
        let path = || path.into();
        let found = self.budget.as_ref();
        let found = found.ok_or_else(|| PlotError::NoBudget { path: path() })?;
        let found = found
            .as_ref()
            .ok_or_else(|| PlotError::Free { path: path() })?;
        let name = self.job.as_ref().unwrap_or(&self.name);
        let title =
            own_title.unwrap_or_else(|| title(name, self.design, self.pose, found.case.as_deref()));
        budget(found, &self.output.node, title).ok_or_else(|| PlotError::NoShares { path: path() })
    }
}
