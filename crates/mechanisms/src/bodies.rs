//! Bodies through named points.

use std::collections::HashMap;

use hyperstat_elements::Material;
use hyperstat_model::{BodyId, Model, ModelError};
use nalgebra::Point3;

use crate::error::LoadError;
use crate::fields::Fields;
use crate::fragment::{Entry, Fragment, first_at};
use crate::materials::Profile;
use crate::table::Table;
use crate::value_names::Given;
use crate::{beams, flexible, names};

/// The name of the fixed body.
pub(crate) const GROUND: &str = "ground";

/// Most elements that a segment may be divided into.
const MOST_ELEMENTS: usize = 1_000_000;

/// What bodies refer to.
pub(crate) struct Tables {
    pub(crate) materials: Table<Material>,
    pub(crate) sections: Table<Profile>,
    pub(crate) points: Table<Point3<f64>>,
}

/// A point that a body runs through: its name, where the body says so, and its position.
#[derive(Debug, Clone)]
pub(crate) struct Through<'a> {
    pub(crate) name: String,
    pub(crate) at: Fragment<'a>,
    pub(crate) position: Point3<f64>,
}

/// Refuses a name of a body, point or joint that could not stand in `body.point`.
pub(crate) fn check_name(entry: &Entry<'_>, what: &str) -> Result<(), LoadError> {
    let wrong = if entry.name.is_empty() {
        format!("a {what} needs a name")
    } else if entry.name.contains('.') {
        format!("the name of a {what} holds no `.`")
    } else {
        return Ok(());
    };
    Err(entry
        .key
        .error(wrong)
        .with_help("results name a body's point `body.point`"))
}

/// Adds the body of `entry` to the model, and to `given` what its segments are given by.
pub(crate) fn read(
    entry: &Entry<'_>,
    tables: &Tables,
    model: &mut Model,
    given: &mut Vec<Given>,
) -> Result<BodyId, LoadError> {
    const KINDS: [&str; 4] = ["Beam", "Rigid", "Frame", "Flexible"];
    check_name(entry, "body")?;
    if entry.name == GROUND {
        return Err(entry
            .key
            .error("`ground` is the fixed body and needs no entry")
            .with_help("give this body another name, or remove it"));
    }
    let expected = "a body, `Beam(…)`, `Rigid(…)`, `Frame(…)` or `Flexible(…)`";
    let (kind, arguments) = entry.value.variant(expected)?;
    let fields = |known: &[&str]| {
        let owner = format!("body `{}`", entry.name);
        match arguments {
            Some(given) => {
                let temperature: &[&str] = &["temperature"];
                let known = [known, temperature].concat();
                Ok(Fields::read(given, owner, &known)?.within(entry.value))
            }
            None => Ok(Fields::none(entry.value, owner)),
        }
    };
    let (body, fields) = match kind.text() {
        "Beam" => {
            let known = ["through", "section", "material", "y_axis", "elements"];
            let fields = fields(&known)?;
            let body = beams::beam(&entry.name, &fields, tables, model, given)?;
            (body, fields)
        }
        "Rigid" => {
            let fields = fields(&["points"])?;
            let points = through(&fields, fields.required("points")?, tables)?;
            let body = model
                .add_rigid(&entry.name, &pairs(&points))
                .map_err(|error| entry.value.error(error.to_string()))?;
            (body, fields)
        }
        "Frame" => {
            let known = ["members", "section", "material", "y_axis", "elements"];
            let fields = fields(&known)?;
            let body = beams::frame(&entry.name, &fields, tables, model, given)?;
            (body, fields)
        }
        "Flexible" => {
            let fields = fields(&["points", "stiffness"])?;
            (flexible::read(&entry.name, &fields, tables, model)?, fields)
        }
        other => {
            return Err(kind
                .error(format!("unknown kind of body `{other}`"))
                .unreadable()
                .with_help(names::help(other, "kinds of body", KINDS)));
        }
    };
    if let Some(given) = fields.get("temperature") {
        temperature(given, body, model)?;
    }
    Ok(body)
}

/// Reads a change of temperature.
fn temperature(given: Fragment<'_>, body: BodyId, model: &mut Model) -> Result<(), LoadError> {
    let change = given.acting()?;
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

/// Reads a number of elements a segment.
pub(crate) fn elements(fragment: Fragment<'_>) -> Result<usize, LoadError> {
    let expected = format!("a whole number of elements from 1 to {MOST_ELEMENTS}");
    let elements = fragment.parse(&expected)?;
    if !(1..=MOST_ELEMENTS).contains(&elements) {
        return Err(fragment.expected(&expected));
    }
    Ok(elements)
}

/// Reads the list of a body's points, each once.
pub(crate) fn through<'a>(
    fields: &Fields<'_>,
    list: Fragment<'a>,
    tables: &Tables,
) -> Result<Vec<Through<'a>>, LoadError> {
    let points = listed(list, tables)?;
    let mut seen = HashMap::with_capacity(points.len());
    for Through { name, at, .. } in &points {
        if let Some(first) = seen.insert(name, *at) {
            return Err(at
                .error(format!(
                    "{} runs through point `{name}` twice",
                    fields.owner()
                ))
                .with_help(first_at(first)));
        }
    }
    if points.is_empty() {
        return Err(list.error(format!("{} has no point", fields.owner())));
    }
    Ok(points)
}

/// Reads a list of points.
pub(crate) fn listed<'a>(
    list: Fragment<'a>,
    tables: &Tables,
) -> Result<Vec<Through<'a>>, LoadError> {
    let mut points = Vec::new();
    for at in list.list("a list of points, such as `[\"A\", \"B\"]`")? {
        points.push(Through {
            position: *tables.points.find(at)?,
            name: at.string()?,
            at,
        });
    }
    Ok(points)
}

pub(crate) fn pairs<'p>(points: &'p [Through<'_>]) -> Vec<(&'p str, Point3<f64>)> {
    let pair = |point: &'p Through<'_>| (point.name.as_str(), point.position);
    points.iter().map(pair).collect()
}
