//! Bodies: beams and rigid bodies through named points.

use hyperstat_assembly::{BodyId, Model};
use hyperstat_elements::{Beam, ElementError, Material, Section, element_frame};
use nalgebra::{Point3, Vector3};

use crate::error::LoadError;
use crate::fields::Fields;
use crate::fragment::{Entry, Fragment, first_at};
use crate::names;
use crate::table::Table;

/// The name of the fixed body.
pub(crate) const GROUND: &str = "ground";

/// Most elements that a segment may be divided into.
const MOST_ELEMENTS: usize = 1_000_000;

/// What bodies refer to.
pub(crate) struct Tables {
    pub(crate) materials: Table<Material>,
    pub(crate) sections: Table<Section>,
    pub(crate) points: Table<Point3<f64>>,
}

/// A point that a body runs through: its name, where the body says so, and its position.
struct Through<'a> {
    name: String,
    at: Fragment<'a>,
    position: Point3<f64>,
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

/// Adds the body of `entry` to the model.
pub(crate) fn read(
    entry: &Entry<'_>,
    tables: &Tables,
    model: &mut Model,
) -> Result<BodyId, LoadError> {
    const KINDS: [&str; 2] = ["Beam", "Rigid"];
    check_name(entry, "body")?;
    if entry.name == GROUND {
        return Err(entry
            .key
            .error("`ground` is the fixed body and needs no entry")
            .with_help("give this body another name, or remove it"));
    }
    let expected = "a body, `Beam(…)` or `Rigid(…)`";
    let (kind, arguments) = entry.value.variant(expected)?;
    let fields = |known: &[&str]| {
        let owner = format!("body `{}`", entry.name);
        match arguments {
            Some(given) => {
                Ok(Fields::read(given, owner, known, &["temperature"])?.within(entry.value))
            }
            None => Ok(Fields::none(entry.value, owner)),
        }
    };
    match kind.text() {
        "Beam" => {
            let known = ["through", "section", "material", "y_axis", "elements"];
            beam(&entry.name, &fields(&known)?, tables, model)
        }
        "Rigid" => {
            let fields = fields(&["points"])?;
            let points = through(&fields, fields.required("points")?, tables)?;
            model
                .add_rigid(&entry.name, &pairs(&points))
                .map_err(|error| entry.value.error(error.to_string()))
        }
        reserved @ ("Frame" | "Flexible") => {
            Err(kind.error(format!("`{reserved}` is reserved and not supported yet")))
        }
        other => Err(kind
            .error(format!("unknown kind of body `{other}`"))
            .with_help(names::help(other, "kinds of body", KINDS))),
    }
}

fn beam(
    name: &str,
    fields: &Fields<'_>,
    tables: &Tables,
    model: &mut Model,
) -> Result<BodyId, LoadError> {
    let list = fields.required("through")?;
    let points = through(fields, list, tables)?;
    if points.len() < 2 {
        return Err(list
            .error(format!("beam `{name}` runs through fewer than two points"))
            .with_help("a beam has two ends; use `Rigid` for a body of one point"));
    }
    let section = tables.sections.find(fields.required("section")?)?;
    let material = tables.materials.find(fields.required("material")?)?;
    let y_axis = fields.get("y_axis").map(Fragment::direction).transpose()?;
    let elements = fields.get("elements").map_or(Ok(1), elements)?;
    for ends in points.windows(2) {
        let [from, to] = ends else { continue };
        let error = match check_segment(from, to, y_axis.as_ref(), section, material, elements) {
            Ok(()) => continue,
            Err(error) => error,
        };
        let segment = format!("between `{}` and `{}`", from.name, to.name);
        return Err(match error {
            ElementError::NoLength { .. } => to
                .at
                .error(format!("beam `{name}` has no length {segment}"))
                .with_help("give the two points different places, or leave one out"),
            ElementError::AlongBeam { .. } => fields
                .error(
                    "y_axis",
                    format!("`y_axis` lies along beam `{name}` {segment}"),
                )
                .with_help("give a direction across the beam, or leave `y_axis` out"),
            other => to.at.error(format!("beam `{name}` {segment}: {other}")),
        });
    }
    model
        .add_beam(name, &pairs(&points), material, section, y_axis, elements)
        .map_err(|error| list.error(error.to_string()))
}

/// Looks whether the frame and the stiffness of a segment's elements can be formed.
fn check_segment(
    from: &Through<'_>,
    to: &Through<'_>,
    y_axis: Option<&Vector3<f64>>,
    section: &Section,
    material: &Material,
    elements: usize,
) -> Result<(), ElementError> {
    let span = to.position - from.position;
    element_frame(&span, y_axis)?;
    Beam::new(material, section, span.norm() / elements as f64)?;
    Ok(())
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

/// Reads the list of a body's points.
fn through<'a>(
    fields: &Fields<'_>,
    list: Fragment<'a>,
    tables: &Tables,
) -> Result<Vec<Through<'a>>, LoadError> {
    let mut points = Vec::<Through>::new();
    for at in list.list("a list of points, such as `[\"A\", \"B\"]`")? {
        let position = *tables.points.find(at)?;
        let name = at.string()?;
        if let Some(first) = points.iter().find(|other| other.name == name) {
            return Err(at
                .error(format!(
                    "{} runs through point `{name}` twice",
                    fields.owner()
                ))
                .with_help(first_at(first.at)));
        }
        points.push(Through { name, at, position });
    }
    if points.is_empty() {
        return Err(list.error(format!("{} has no point", fields.owner())));
    }
    Ok(points)
}

fn pairs<'p>(points: &'p [Through<'_>]) -> Vec<(&'p str, Point3<f64>)> {
    let pair = |point: &'p Through<'_>| (point.name.as_str(), point.position);
    points.iter().map(pair).collect()
}
