//! Joints.

use std::fmt::Write as _;

use hyperstat_joints::{Dof, DofSet};
use hyperstat_model::{Connection, JointId, JointStiffness, Model, NodeId};
use nalgebra::{Rotation3, Vector6};

use super::error::WriteError;
use super::numbers::{fields, number, vector};
use crate::file::registry::{Argument, Registry};
use crate::terms::bodies::GROUND;

/// Writes a joint.
///
/// # Errors
/// A joint between points of two names, or of a kind without a writer.
pub(super) fn joint(model: &Model, id: JointId, registry: &Registry) -> Result<String, WriteError> {
    let joint: &Connection = &model.joints()[id.0];
    let frame: &Rotation3<f64> = &model.geometry().frames[id.0];
    let point = |node: Option<NodeId>| node.map(|node| &*model.nodes()[node.0].point);
    let at = match joint.between.map(point) {
        [Some(first), Some(second)] if first != second => {
            return Err(WriteError::TwoPoints {
                joint: joint.name.clone(),
                first: first.into(),
                second: second.into(),
            });
        }
        [first, second] => first.or(second).unwrap_or_default(),
    };
    let [first, second] = joint.between.map(|node| match node {
        Some(node) => &*model.bodies()[model.nodes()[node.0].body.0].name,
        None => GROUND,
    });
    let kind = joint.joint.kind();
    let arguments = registry
        .arguments(joint.joint.as_ref(), frame)
        .ok_or_else(|| WriteError::UnknownKind {
            joint: joint.name.clone(),
            kind: kind.into(),
        })?;
    let written: Vec<_> = (arguments.iter())
        .map(|(name, argument)| format!("{name}: {}", self::argument(argument)))
        .collect();
    let written = match &written[..] {
        [] => String::new(),
        some => format!("({})", some.join(", ")),
    };
    let mut text = format!("(at: {at:?}, between: ({first:?}, {second:?}), kind: {kind}{written}");
    if (arguments.iter()).any(|(_, argument)| matches!(argument, Argument::Direction(_))) {
        let x = frame.matrix().column(0).into_owned();
        let _ = write!(text, ", x_axis: {}", vector(&x));
    }
    if !joint.locked.is_empty() {
        let _ = write!(
            text,
            ", locked: {}",
            locked(joint.locked, joint.joint.free())
        );
    }
    if let Some(stiffness) = stiffness(&joint.stiffness) {
        let _ = write!(text, ", stiffness: {stiffness}");
    }
    if let Some(entry) = model.misfit(id) {
        for (name, values) in [("misfit", &entry.misfit), ("preload", &entry.preload)] {
            if *values != Vector6::zeros() {
                let _ = write!(text, ", {name}: {}", directions(values));
            }
        }
    }
    Ok(text + ")")
}

/// Numbers by direction, without the zeros.
fn directions(values: &Vector6<f64>) -> String {
    let given = Dof::ALL.into_iter().zip(values.iter());
    let given = given.filter(|(_, value)| **value != 0.0);
    let given: Vec<_> = given.map(|(dof, value)| (dof.name(), *value)).collect();
    fields(Vec::new(), given)
}

fn argument(argument: &Argument) -> String {
    match argument {
        Argument::Number(value) => number(*value),
        Argument::Direction(direction) => vector(direction),
        Argument::TwoDirections([a, b]) => format!("({}, {})", vector(a), vector(b)),
    }
}

fn locked(locked: DofSet, free: DofSet) -> String {
    if locked == free {
        return "true".into();
    }
    let directions: Vec<_> = locked.iter().map(Dof::name).collect();
    format!("[{}]", directions.join(", "))
}

fn stiffness(stiffness: &JointStiffness) -> Option<String> {
    match stiffness {
        JointStiffness::Directions(values) => {
            let given = Dof::ALL.into_iter().zip(values);
            let given: Vec<_> = given
                .filter_map(|(dof, value)| Some((dof.name(), (*value)?)))
                .collect();
            (!given.is_empty()).then(|| fields(Vec::new(), given))
        }
        JointStiffness::Matrix(matrix) => {
            let rows: Vec<_> = (matrix.row_iter())
                .map(|row| {
                    let entries: Vec<_> = row.iter().map(|entry| number(*entry)).collect();
                    format!("[{}]", entries.join(", "))
                })
                .collect();
            Some(format!("Matrix([{}])", rows.join(", ")))
        }
    }
}
