//! Preloads of joints, and what misfits do to springs.

use hyperstat_joints::DofSet;
use hyperstat_model::{Directions, JointId, Misfit, NodeId, rotation6};
use nalgebra::Vector6;

use crate::posture::Posture;

/// The part of `values` along some directions.
pub(crate) fn along(values: &Vector6<f64>, directions: DofSet) -> Vector6<f64> {
    let mut part = Vector6::zeros();
    for direction in directions.iter() {
        part[direction.index()] = values[direction.index()];
    }
    part
}

/// What the springs of a joint's elastic directions start from: its misfit along them, and what
/// its preload comes to.
pub(crate) fn spring_misfit(directions: &Directions, entry: &Misfit) -> Vector6<f64> {
    let misfit = along(&entry.misfit, directions.elastic);
    match &directions.compliance {
        Some(compliance) => misfit + compliance * entry.preload,
        None => misfit,
    }
}

/// The part of a joint's preload that is a pair of wrenches: along free directions, and along
/// elastic ones that no compliance can be given for.
pub(crate) fn loose_preload(directions: &Directions, entry: &Misfit) -> Vector6<f64> {
    match directions.compliance {
        Some(_) => along(&entry.preload, directions.free),
        None => entry.preload,
    }
}

/// The wrenches on nodes, global axes, that preloads of joints make.
pub(crate) fn preloads(at: &Posture<'_>) -> Vec<(JointId, (NodeId, Vector6<f64>))> {
    let model = at.model;
    let mut wrenches = Vec::new();
    for entry in model.misfits() {
        let joint = &model.joints()[entry.joint.0];
        let preload = loose_preload(&Directions::of(joint), entry);
        if preload == Vector6::zeros() {
            continue;
        }
        let local = at.direction_map(entry.joint);
        let on_second = local.transpose() * preload;
        let sides = joint.between.iter().zip([-on_second, on_second]);
        wrenches.extend(sides.filter_map(|(node, wrench)| Some((entry.joint, ((*node)?, wrench)))));
    }
    wrenches
}

/// Displacement of a joint's second body from its first, global axes, of a misfit by directions.
pub(crate) fn displacement_by_misfit(
    at: &Posture<'_>,
    joint: JointId,
    misfit: &Vector6<f64>,
) -> Vector6<f64> {
    let Posture {
        model, geometry, ..
    } = *at;
    let basis = model.joints()[joint.0].joint.basis();
    rotation6(&geometry.frames[joint.0]) * (basis * misfit)
}
