//! The loads of a mechanism in the report of `hyperstat solve`: without them nobody knows what the
//! deflections are of.

use hyperstat_assembly::{Axes, Body, LoadSet, Model};

use super::parts::{WRENCH, heads, section};
use super::table::{Table, number};

/// What acts on a model, and the loads of its cases, as sections of the report.
pub(super) fn loads(model: &Model) -> String {
    let mut text = String::new();
    let every = match model.cases() {
        [] => "",
        _ => ", in every case too",
    };
    let gravity = model.gravity();
    if gravity.iter().any(|component| *component != 0.0) {
        let [x, y, z] = [gravity.x, gravity.y, gravity.z].map(number);
        let body = format!("  ({x}, {y}, {z}) m/s² on all masses{every}\n");
        section(&mut text, "Gravity", body);
    }
    let mut warm = Table::new(1, &["body", "change"]);
    let changed = |body: &&Body| body.temperature != 0.0;
    for body in model.bodies().iter().filter(changed) {
        warm.row(&[&body.name], [body.temperature]);
    }
    if model.bodies().iter().any(|body| changed(&body)) {
        section(&mut text, &format!("Temperature [K]{every}"), warm);
    }
    write(model, model.load_set(), "Loads", &mut text);
    for case in model.cases() {
        let title = format!("Loads of case `{}`", case.name);
        write(model, &case.loads, &title, &mut text);
    }
    text
}

fn write(model: &Model, loads: &LoadSet, title: &str, text: &mut String) {
    if loads.nodes.is_empty() && loads.lines.is_empty() {
        section(text, title, "  none\n");
    }
    if !loads.nodes.is_empty() {
        let mut table = Table::new(2, &heads(&["on", "axes"], WRENCH));
        for load in &loads.nodes {
            let node = model.node_name(load.node);
            let wrench: [f64; 6] = load.wrench.into();
            table.row(&[&node, &axes(model, &load.axes)], wrench);
        }
        section(text, &format!("{title} [N, N·m]"), table);
    }
    if !loads.lines.is_empty() {
        let mut table = Table::new(3, &heads(&["along", "at", "axes"], WRENCH));
        for load in &loads.lines {
            let segment = &model.segments()[load.segment.0];
            let body = &model.bodies()[segment.body.0].name;
            let points = segment.ends.map(|node| &*model.nodes()[node.0].point);
            let name = format!("{body}.{}", points.join("-"));
            for (point, wrench) in points.iter().zip(load.ends) {
                let wrench: [f64; 6] = wrench.into();
                table.row(&[&name, point, &axes(model, &load.axes)], wrench);
            }
        }
        section(text, &format!("{title}, along beams [N/m, N]"), table);
    }
}

/// The axes that a load is given in.
fn axes(model: &Model, axes: &Axes) -> String {
    match axes {
        Axes::Global => "global".into(),
        Axes::Body { body, .. } => format!("of {}", model.bodies()[body.0].name),
    }
}
