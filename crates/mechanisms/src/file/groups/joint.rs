//! A joint of a group in a copy that is turned or mirrored.
//!
//! The frame turns with the copy, also where it follows from the axis alone. In a mirror x and y are
//! mirrored and z = x × y, so that of a displacement in the joint's axes z, u and v change their sign, the
//! others not: what is stated in these axes means the same in the mirror image.

use hyperstat_joints::frame_from_axis;
use nalgebra::Vector3;

use super::copy::{DIRECTION, vector};
use super::placement::Placement;
use crate::error::LoadError;
use crate::text::fragment::Fragment;
use crate::text::tree::Node;

/// Directions of the joint's frame whose sense is turned round in a mirror.
const TURNED_ROUND: [bool; 6] = [false, false, true, true, true, false];
/// Names of these directions.
const NAMES: [&str; 6] = ["x", "y", "z", "u", "v", "w"];

/// The joint as the copy turns it.
pub(super) fn turned(joint: &Node, placement: &Placement) -> Result<Node, LoadError> {
    let mut made = match joint.get("kind") {
        Some(kind) => framed(joint, kind, placement)?,
        None => joint.clone(),
    };
    if placement.is_mirrored() {
        for field in ["misfit", "preload"] {
            if let Some(given) = joint.get(field) {
                made = made.with_field(field, mirrored(given, &NAMES, &TURNED_ROUND)?);
            }
        }
        if let Some(stiffness) = joint.get("stiffness").filter(|own| own.kind().is_some()) {
            made = made.with_field("stiffness", mirrored_matrix(stiffness)?);
        }
    }
    Ok(made)
}

/// The joint with its frame turned.
fn framed(joint: &Node, kind: &Node, placement: &Placement) -> Result<Node, LoadError> {
    let turn = |node: &Node| vector(node, DIRECTION, |v| placement.direction(v));
    let x_axis = joint.get("x_axis");
    let mut made = joint.clone();
    let mut own = kind.clone();
    let axis = kind.get("axis").or(kind.get("normal"));
    if let Some(axes) = kind.get("axes") {
        // What is no vector is told where joints are read.
        let pair = axes.map_items(|axis| turn(axis).unwrap_or(axis.clone()));
        own = own.with_field("axes", pair);
    } else if let Some(axis) = axis {
        let name = if kind.get("axis").is_some() {
            "axis"
        } else {
            "normal"
        };
        own = own.with_field(name, turn(axis)?);
        if x_axis.is_none() {
            let direction = Fragment::of_node(axis).direction()?;
            // An axis that has no frame is told where joints are read.
            if let Ok(frame) = frame_from_axis(Some(&direction), None) {
                let x = placement.direction(&frame.matrix().column(0).into_owned());
                made = made.with_field("x_axis", axis.numbers_in_place(x.as_slice()));
            }
        }
    } else if matches!(kind.kind().or(kind.as_text()), Some("Fixed" | "Spherical")) {
        let numbers = |v: Vector3<f64>| kind.numbers_in_place(placement.direction(&v).as_slice());
        own = own.with_field("axis", numbers(Vector3::y()));
        if x_axis.is_none() {
            made = made.with_field("x_axis", numbers(Vector3::x()));
        }
    } else {
        let error =
            "a copy of this joint cannot be turned: its kind has no `axis`, `axes` or `normal`";
        return Err((Fragment::of_node(kind).error(error)).with_help("write each joint by itself"));
    }
    if let Some(x_axis) = x_axis {
        made = made.with_field("x_axis", turn(x_axis)?);
    }
    if placement.is_mirrored() && kind.get("pitch").is_some() {
        own = mirrored(&own, &["pitch"], &[true])?;
    }
    Ok(made.with_field("kind", own))
}

/// Fields with other signs, where they are given.
fn mirrored(fields: &Node, names: &[&str], turned_round: &[bool]) -> Result<Node, LoadError> {
    let mut made = fields.clone();
    for (name, _) in names
        .iter()
        .zip(turned_round)
        .filter(|(_, turned)| **turned)
    {
        if let Some(given) = fields.get(name) {
            let number = Fragment::of_node(given).number()?;
            made = made.with_field(name, given.number_in_place(-number));
        }
    }
    Ok(made)
}

/// `Matrix([…])` with the signs of its rows and columns.
fn mirrored_matrix(stiffness: &Node) -> Result<Node, LoadError> {
    let mut entries = Vec::new();
    for row in stiffness.items().iter().flat_map(Node::items) {
        match row.items() {
            [] => entries.push(row),
            items => entries.extend(items),
        }
    }
    let sign = |k: usize| if TURNED_ROUND[k] { -1.0 } else { 1.0 };
    let mut made = Vec::with_capacity(entries.len());
    // What is no 6×6 is told where joints are read.
    for (k, entry) in entries.iter().enumerate().take(36) {
        let number = Fragment::of_node(entry).number()?;
        made.push(entry.number_in_place(sign(k / 6) * sign(k % 6) * number));
    }
    match entries.len() {
        36 => Ok(stiffness.map_items(|list| list.list_in_place(made.clone()))),
        _ => Ok(stiffness.clone()),
    }
}
