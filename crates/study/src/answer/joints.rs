//! Joints in the report of `hyperstat solve`: frames, wrenches, misfits and preloads.

use hyperstat_assembly::{JointId, Model};
use nalgebra::Vector6;
use serde::Serialize;

use super::numbers;
use super::solve::axes;

/// What is found of a joint. Field names are those of the JSON output.
#[derive(Debug, Serialize)]
pub struct JointReport {
    /// Where it is and how it lies; told once, not of every case.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame: Option<FrameReport>,
    /// On the second body of `between`, at the joint, in the joint frame.
    pub wrench: Option<[f64; 6]>,
    /// The same on the first body.
    pub first: Option<[f64; 6]>,
    /// What the second body stands off from the first, where it does, in the joint frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub misfit: Option<[f64; 6]>,
    /// What presses on the second body, where anything does, in the joint frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub preload: Option<[f64; 6]>,
}

/// The frame of a joint.
#[derive(Debug, Serialize)]
pub struct FrameReport {
    /// Where the joint is.
    pub origin: [f64; 3],
    /// Its x, y and z in global axes.
    pub axes: [[f64; 3]; 3],
}

impl JointReport {
    /// Of a wrench, where statics determines it.
    pub(super) fn new(wrench: Option<&Vector6<f64>>) -> Self {
        Self {
            frame: None,
            wrench: wrench.map(numbers),
            first: wrench.map(|wrench| numbers(&-wrench)),
            misfit: None,
            preload: None,
        }
    }

    /// With the frame of the joint, and its misfit and preload, where it has any.
    pub(super) fn of(self, model: &Model, id: JointId) -> Self {
        let given = |values: &Vector6<f64>| (*values != Vector6::zeros()).then(|| numbers(values));
        let (geometry, entry) = (model.geometry(), model.misfit(id));
        let node = model.joints()[id.0].between.into_iter().flatten().next();
        Self {
            frame: node.map(|node| FrameReport {
                origin: geometry.positions[node.0].into(),
                axes: axes(&geometry.frames[id.0]),
            }),
            misfit: entry.and_then(|entry| given(&entry.misfit)),
            preload: entry.and_then(|entry| given(&entry.preload)),
            ..self
        }
    }
}
