//! The points that a body runs through.

use std::collections::HashMap;

use hyperstat_elements::Material;
use nalgebra::Point3;

use super::materials::Profile;
use crate::error::LoadError;
use crate::text::fields::Fields;
use crate::text::fragment::{Entry, Fragment, first_at};
use crate::text::table::Table;

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
    // What is mounted has a dot in its name, and none where it is written.
    let written = entry.key.text();
    let wrong = if entry.name.is_empty() {
        format!("a {what} needs a name")
    } else if entry.name.contains('.') && written.contains(['.', '\\']) {
        format!("the name of a {what} holds no `.`")
    } else {
        return Ok(());
    };
    Err(entry
        .key
        .error(wrong)
        .with_help("results name a body's point `body.point`"))
}

/// Reads a number of elements a segment.
pub(crate) fn elements(fragment: Fragment<'_>) -> Result<usize, LoadError> {
    let expected = format!("a whole number of elements from 1 to {MOST_ELEMENTS}");
    let elements = fragment.count(&expected)?;
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

/// Most elements that a segment may be divided into.
pub(crate) const MOST_ELEMENTS: usize = 1_000_000;
