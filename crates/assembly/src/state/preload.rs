//! Preloads of joints, and what misfits do to springs.

use hyperstat_joints::DofSet;
use hyperstat_model::{Directions, JointId, Misfit, Model, rotation6, to_directions};
use nalgebra::{Rotation3, Vector6};

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

/// That part as a wrench on the joint's second body, in the joint's frame.
pub(crate) fn loose_wrench(model: &Model, entry: &Misfit) -> Vector6<f64> {
    let joint = &model.joints()[entry.joint.0];
    let preload = loose_preload(&Directions::of(joint), entry);
    to_directions(&joint.joint.basis(), &Rotation3::identity()).transpose() * preload
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
