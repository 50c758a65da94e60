//! How a model lies against its home, in which axes and inertias of a job are stated.

use hyperstat_joints::Dof;
use hyperstat_model::{BodyId, Model};
use nalgebra::{Matrix6, Rotation3};

/// How a model lies: what turns with a body is stated in the home orientation.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Home {
    /// In its home orientation.
    Here,
    /// Its output's body is turned by this from there.
    Output(Rotation3<f64>),
}

/// What would be right where a body has no home orientation.
pub(crate) const NO_HOME: &str = "of a prebuilt mechanism only the output's body has one, and what \
                                  joints keep from turning against it or against the ground";

impl Home {
    /// The rotation of a body from its home orientation; `None` where that is not known: a body
    /// that joints let turn against the ground and against the output's body has its orientation
    /// from the whole pose, and no pose is home.
    pub(crate) fn turn(&self, model: &Model, body: BodyId) -> Option<Rotation3<f64>> {
        let Self::Output(rotation) = self else {
            return Some(Rotation3::identity());
        };
        let with_body = turning_with(model, body);
        let output = model.output().map(|node| model.nodes()[node.0].body);
        if output.is_some_and(|output| with_body.contains(&Some(output))) {
            Some(*rotation)
        } else {
            with_body.contains(&None).then(Rotation3::identity)
        }
    }
}

/// The bodies, the ground (`None`) among them, that joints keep from turning against one.
fn turning_with(model: &Model, body: BodyId) -> Vec<Option<BodyId>> {
    let mut found = vec![Some(body)];
    let mut next = 0;
    while let Some(&from) = found.get(next) {
        next += 1;
        for joint in model.joints() {
            let free = joint.joint.free();
            let turns = [Dof::U, Dof::V, Dof::W]
                .iter()
                .any(|dof| free.contains(*dof));
            if turns || joint.joint.basis() != Matrix6::identity() {
                continue;
            }
            let sides = (joint.between).map(|node| node.map(|node| model.nodes()[node.0].body));
            for (side, other) in [(sides[0], sides[1]), (sides[1], sides[0])] {
                if side == from && !found.contains(&other) {
                    found.push(other);
                }
            }
        }
    }
    found
}
