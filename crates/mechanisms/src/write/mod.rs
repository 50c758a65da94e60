//! A model as a mechanism file, RON or JSON: the text that loads as the same model.

mod acting;
mod bodies;
mod error;
mod joints;
mod numbers;

use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::Path;

use hyperstat_model::{JointId, Model, NodeId};
use nalgebra::Point3;

use crate::file::registry::Registry;
use crate::layout;
use crate::text::as_json::as_json;
use crate::text::files::MemoryFiles;
use crate::text::source::Source;
use crate::write::bodies::Shared;
pub use crate::write::error::WriteError;
use crate::write::numbers::vector;

/// Nodes of one point's name may lie this far apart, over the mechanism's size.
const SAME_PLACE: f64 = 1e-12;

/// Writes `model`, as it stands, as a mechanism file. Numbers read back to the same double; axes
/// that loading makes normal to each other may change in their last digit.
///
/// # Errors
/// [`WriteError`]: what a mechanism file cannot say.
pub fn write(model: &Model, registry: &Registry) -> Result<String, WriteError> {
    let undotted = undotted(model);
    let model = undotted.as_ref().unwrap_or(model);
    let mut parts = Shared::default();
    let points = points(model)?;
    let written_bodies: Vec<_> = (model.bodies().iter())
        .map(|body| Ok((&*body.name, bodies::body(model, body, &mut parts)?)))
        .collect::<Result<_, WriteError>>()?;
    let written_joints: Vec<_> = (model.joints().iter())
        .enumerate()
        .map(|(k, joint)| Ok((&*joint.name, joints::joint(model, JointId(k), registry)?)))
        .collect::<Result<_, WriteError>>()?;
    let output = model.output().ok_or(WriteError::NoOutput)?;

    let mut text = String::from("(\n");
    // Writing to a String cannot fail.
    let _ = writeln!(text, "    name: {:?},", model.name);
    map(&mut text, "materials", &parts.materials());
    map(&mut text, "sections", &parts.sections());
    map(&mut text, "points", &points);
    map(&mut text, "bodies", &written_bodies);
    map(&mut text, "joints", &written_joints);
    acting::acting(model, &mut text)?;
    let _ = writeln!(text, "    output: {},\n)", place(model, output));
    Ok(text)
}

/// The model with other signs in the place of the dots that mounting puts into names, which a file cannot have; `None`
/// where there are none.
fn undotted(model: &Model) -> Option<Model> {
    let bodies = model.bodies().iter().map(|body| &body.name);
    let joints = model.joints().iter().map(|joint| &joint.name);
    let points = model.nodes().iter().map(|node| &node.point);
    let mut names = bodies.chain(joints).chain(points);
    if !names.any(|name| name.contains('.')) {
        return None;
    }
    let mut signs = (1..).map(|count| "_".repeat(count));
    signs.find_map(|sign| model.renamed(|name| name.replace('.', &sign)))
}

/// [`write()`], in JSON: the same names and the same numbers.
///
/// # Errors
/// As there.
pub fn write_json(model: &Model, registry: &Registry) -> Result<String, WriteError> {
    let text = write(model, registry)?;
    let source = Source::new(Path::new(""), &text, &MemoryFiles::new());
    Ok(layout::laid_out(&as_json(&source), true))
}

/// Writes the map `field`, an entry a line; nothing where it is empty and may be left out.
fn map(text: &mut String, field: &str, entries: &[(impl AsRef<str>, String)]) {
    if entries.is_empty() && matches!(field, "materials" | "sections") {
        return;
    }
    let _ = writeln!(text, "    {field}: {{");
    for (name, value) in entries {
        let _ = writeln!(text, "        {:?}: {value},", name.as_ref());
    }
    *text += "    },\n";
}

/// The points of all bodies, each name once.
fn points(model: &Model) -> Result<Vec<(&str, String)>, WriteError> {
    let positions = &model.geometry().positions;
    let size = positions
        .iter()
        .fold(0.0_f64, |size, p| size.max(p.coords.amax()));
    let mut written = Vec::new();
    let mut known: HashMap<&str, Point3<f64>> = HashMap::new();
    for (node, position) in model.nodes().iter().zip(positions) {
        match known.get(&*node.point) {
            None => {
                known.insert(&node.point, *position);
                written.push((&*node.point, vector(&position.coords)));
            }
            Some(first) if (first - position).norm() <= SAME_PLACE * size => {}
            Some(_) => {
                return Err(WriteError::TwoPlaces {
                    point: node.point.clone(),
                    body: model.bodies()[node.body.0].name.clone(),
                });
            }
        }
    }
    Ok(written)
}

/// `("body", "point")` of a node.
fn place(model: &Model, node: NodeId) -> String {
    let node = &model.nodes()[node.0];
    format!("({:?}, {:?})", model.bodies()[node.body.0].name, node.point)
}
