//! What a plan takes from a model once, and what later models must have in common with that one.

use hyperstat_joints::DofSet;
use hyperstat_model::{BodyKind, Directions, Geometry, Model, NodeId};
use nalgebra::Matrix6;

use super::workspace::Workspace;
use crate::error::SolveError;
use crate::plan::Plan;

/// Bodies, joints and output of a model: what a plan is made for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Form {
    bodies: Vec<(BodyKind, Vec<NodeId>)>,
    segments: Vec<[NodeId; 2]>,
    joints: Vec<JointForm>,
    output: Option<NodeId>,
}

#[derive(Debug, Clone, PartialEq)]
struct JointForm {
    between: [Option<NodeId>; 2],
    kind: DofSet,
    basis: Matrix6<f64>,
    directions: Directions,
}

impl Form {
    pub fn of(model: &Model) -> Self {
        let bodies = model.bodies().iter();
        let joints = model.joints().iter();
        Self {
            bodies: bodies.map(|body| (body.kind, body.nodes.clone())).collect(),
            segments: model.segments().iter().map(|s| s.ends).collect(),
            joints: joints
                .map(|joint| JointForm {
                    between: joint.between,
                    kind: joint.joint.free(),
                    basis: joint.joint.basis(),
                    directions: Directions::of(joint),
                })
                .collect(),
            output: model.output(),
        }
    }
}

impl Plan {
    /// Refuses a model that is not like the one that the plan was made for.
    pub(crate) fn check_model(&self, model: &Model) -> Result<(), SolveError> {
        if model.revision() == self.revision || Form::of(model) == self.form {
            Ok(())
        } else {
            Err(SolveError::ForeignModel)
        }
    }

    /// Refuses what does not belong to this plan: a model, a geometry of it, and buffers.
    pub(crate) fn check(
        &self,
        model: &Model,
        geometry: &Geometry,
        workspace: &Workspace,
    ) -> Result<(), SolveError> {
        if workspace.plan != self.id {
            return Err(SolveError::ForeignWorkspace);
        }
        self.check_model(model)?;
        Ok(model.check_geometry(geometry, self.one_point)?)
    }
}
