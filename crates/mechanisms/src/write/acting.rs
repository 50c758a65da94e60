//! Loads, cases, gravity and masses.

use std::fmt::Write as _;

use hyperstat_model::{Axes, BodyId, LineLoad, LoadSet, Model, NoBodyFrame};
use nalgebra::{Matrix3, Rotation3, Vector3, Vector6};

use super::error::WriteError;
use super::numbers::{fields, number, vector};
use crate::write::place;

/// Writes what acts on a model, every field of which there is something. Loads that turn with a
/// body are written as they are in this configuration, from which they go on to turn.
pub(super) fn acting(model: &Model, text: &mut String) -> Result<(), WriteError> {
    let loads = set(model, model.load_set())?;
    // Writing to a String cannot fail.
    if !loads.is_empty() {
        let _ = writeln!(text, "    loads: {},", list(&loads, 4));
    }
    if !model.cases().is_empty() {
        *text += "    cases: {\n";
        for case in model.cases() {
            let loads = list(&set(model, &case.loads)?, 8);
            let _ = writeln!(text, "        {:?}: {loads},", case.name);
        }
        *text += "    },\n";
    }
    if *model.gravity() != Vector3::zeros() {
        let _ = writeln!(text, "    gravity: {},", vector(model.gravity()));
    }
    let masses: Vec<_> = (model.masses().iter())
        .map(|entry| {
            let j = entry.mass.inertia();
            let mut given = vec![
                format!("on: {}", place(model, entry.node)),
                format!("mass: {}", number(entry.mass.mass())),
            ];
            if j.amax() > 0.0 {
                let diagonal = [j[(0, 0)], j[(1, 1)], j[(2, 2)]];
                let beside = [j[(0, 1)], j[(0, 2)], j[(1, 2)]];
                let entries = diagonal.into_iter().chain(beside).map(number);
                let entries: Vec<_> = entries.collect();
                given.push(format!("inertia: ({})", entries.join(", ")));
            }
            fields(given, [])
        })
        .collect();
    if !masses.is_empty() {
        let _ = writeln!(text, "    masses: {},", list(&masses, 4));
    }
    Ok(())
}

/// A list, an entry a line.
fn list(entries: &[String], indent: usize) -> String {
    if entries.is_empty() {
        return "[]".into();
    }
    let space = " ".repeat(indent);
    let lines: String = (entries.iter())
        .map(|entry| format!("{space}    {entry},\n"))
        .collect();
    format!("[\n{lines}{space}]")
}

/// The loads of a set.
fn set(model: &Model, set: &LoadSet) -> Result<Vec<String>, WriteError> {
    let mut written = Vec::new();
    for load in &set.nodes {
        let [force, moment] = parts(&load.wrench, &turn(model, &load.axes)?);
        let on = place(model, load.node);
        let frame = frame(model, &load.axes, model.nodes()[load.node.0].body)?;
        written.push(format!(
            "(on: {on}, force: {force}, moment: {moment}{frame})"
        ));
    }
    for load in &set.lines {
        let turn = turn(model, &load.axes)?;
        let on = segment(model, load);
        let frame = frame(model, &load.axes, model.segments()[load.segment.0].body)?;
        let [[from, moment], [to, _]] = load.ends.map(|end| parts(&end, &turn));
        written.push(format!("(on: {on}, from: {from}, to: {to}{frame})"));
        if load.ends[0].fixed_rows::<3>(3).amax() > 0.0 {
            written.push(format!("(on: {on}, moment_per_length: {moment}{frame})"));
        }
    }
    Ok(written)
}

/// The field `frame` of a load on a body, behind others; nothing of one in global axes.
fn frame(model: &Model, axes: &Axes, on: BodyId) -> Result<&'static str, WriteError> {
    let output = model.output().map(|node| model.nodes()[node.0].body);
    match axes {
        Axes::Global => Ok(""),
        Axes::Body { body, .. } if *body == on => Ok(", frame: Body"),
        Axes::Body { body, .. } if Some(*body) == output => Ok(", frame: Output"),
        Axes::Body { body, .. } => Err(WriteError::TurnsWith {
            on: model.bodies()[on.0].name.clone(),
            body: model.bodies()[body.0].name.clone(),
        }),
    }
}

/// Turns below this are rounding: what is stated then stands there as it was stated.
const TURNED: f64 = 1e-14;

/// Rotation of a load's axes from the global ones.
fn turn(model: &Model, axes: &Axes) -> Result<Rotation3<f64>, NoBodyFrame> {
    let turn = axes.rotation(model, model.geometry())?;
    let rounding = (turn.matrix() - Matrix3::identity()).amax() <= TURNED;
    Ok(if rounding {
        Rotation3::identity()
    } else {
        turn
    })
}

/// Force and moment in global axes.
fn parts(wrench: &Vector6<f64>, turn: &Rotation3<f64>) -> [String; 2] {
    [0, 3].map(|k| vector(&(turn * wrench.fixed_rows::<3>(k))))
}

/// `("body", "A", "B")`.
fn segment(model: &Model, load: &LineLoad) -> String {
    let segment = &model.segments()[load.segment.0];
    let body = &model.bodies()[segment.body.0].name;
    let [a, b] = segment.ends.map(|node| &model.nodes()[node.0].point);
    format!("({body:?}, {a:?}, {b:?})")
}
