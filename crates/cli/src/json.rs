//! Reports as JSON.

use serde::Serialize;

use crate::error::CliError;

/// Report `value` as JSON. Numbers read back to the same double.
pub(crate) fn json(value: &impl Serialize) -> Result<String, CliError> {
    let text = hyperstat_study::plain::json(value);
    text.map_err(|error| CliError::Print(error.into()))
}
