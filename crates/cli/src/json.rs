//! Reports as JSON.

use serde::Serialize;

use crate::error::CliError;
use crate::terminal::plain_json;

/// Report `value` as JSON. Numbers read back to the same double.
pub(crate) fn json(value: &impl Serialize) -> Result<String, CliError> {
    match serde_json::to_string_pretty(value) {
        Ok(text) => Ok(plain_json(&text).into_owned() + "\n"),
        Err(error) => Err(CliError::Print(error.into())),
    }
}
