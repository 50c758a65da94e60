//! Bodies through named points.

use hyperstat_model::{BodyId, Model, ModelError};

use super::through::{Tables, check_name, pairs, through};
use super::value_names::Given;
use crate::error::LoadError;
use crate::file::{beams, flexible};
use crate::terms::bodies::{BODY, GROUND};
use crate::text::dimension::Dimension;
use crate::text::fields::Fields;
use crate::text::fragment::{Entry, Fragment};
use crate::text::names;

/// Adds the body of `entry` to the model, and to `given` what its segments are given by.
pub(crate) fn read(
    entry: &Entry<'_>,
    tables: &Tables,
    model: &mut Model,
    given: &mut Vec<Given>,
) -> Result<BodyId, LoadError> {
    check_name(entry, "body")?;
    if entry.name == GROUND {
        return Err(entry
            .key
            .error("`ground` is the fixed body and needs no entry")
            .with_help("give this body another name, or remove it"));
    }
    let expected = "a body, `Beam(…)`, `Rigid(…)`, `Frame(…)` or `Flexible(…)`";
    let (kind, arguments) = entry.value.variant(expected)?;
    let known = BODY.fields(kind.text()).unwrap_or_default();
    let fields = || {
        let owner = format!("body `{}`", entry.name);
        match arguments {
            Some(given) => Ok(Fields::read(given, owner, &known)?.within(entry.value)),
            None => Ok(Fields::none(entry.value, owner)),
        }
    };
    let first = model.bodies().len();
    let (body, fields) = match kind.text() {
        "Beam" => {
            let fields = fields()?;
            let body = beams::beam(&entry.name, &fields, tables, model, given)?;
            (body, fields)
        }
        "Rigid" => {
            let fields = fields()?;
            let points = through(&fields, fields.required("points")?, tables)?;
            let body = model
                .add_rigid(&entry.name, &pairs(&points))
                .map_err(|error| entry.value.error(error.to_string()))?;
            (body, fields)
        }
        "Frame" => {
            let fields = fields()?;
            let body = beams::frame(&entry.name, &fields, tables, model, given)?;
            (body, fields)
        }
        "Flexible" => {
            let fields = fields()?;
            (flexible::read(&entry.name, &fields, tables, model)?, fields)
        }
        other => {
            return Err(kind
                .error(format!("unknown kind of body `{other}`"))
                .unreadable()
                .with_help(names::help(other, "kinds of body", BODY.names())));
        }
    };
    if let Some(given) = fields.get("temperature") {
        let of_frame = (first..model.bodies().len()).map(BodyId);
        let beams =
            of_frame.filter(|own| *own == body || !model.bodies()[own.0].segments.is_empty());
        for own in beams.collect::<Vec<_>>() {
            temperature(given, own, model)?;
        }
    }
    Ok(body)
}

/// Reads a change of temperature.
fn temperature(given: Fragment<'_>, body: BodyId, model: &mut Model) -> Result<(), LoadError> {
    let change = given.acting("`temperature`", Dimension::TEMPERATURE)?;
    model.set_temperature(body, change).map_err(|error| {
        let refused = given.error(error.to_string());
        match error {
            ModelError::NoExpansion { .. } => {
                refused.with_help("give its material an `expansion`, in 1/K")
            }
            _ => refused.with_help("only a `Beam` or a `Frame` can be heated"),
        }
    })
}
