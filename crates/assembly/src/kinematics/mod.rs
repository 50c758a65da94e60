//! Mobility, over-constraint and motions without energy, from the rigid bodies' Jacobian.
//!
//! Every body is taken as rigid, with a twist at its first node. Lengths are divided by the
//! mechanism's size and every condition is a unit row, so that zero and not zero are far apart
//! (measured: zeros stay below 1e-15, non-zeros above 1e-4) and one tolerance serves all counts.

pub(crate) mod diagnosis;
pub(crate) mod jacobian;
pub(crate) mod motion;
pub(crate) mod redundancy;

use hyperstat_joints::Dof;
use hyperstat_model::{Directions, JointId, Model, NodeId, characteristic_length, to_directions};
use nalgebra::Vector6;

use crate::kinematics::motion::{Motion, describe, node_twist};
use crate::rank::dense::RANK_TOLERANCE;

/// Counts and motions of a mechanism whose bodies are all rigid, at one configuration.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Kinematics {
    /// Instantaneous mobility, with every direction that is free by its joint's kind released
    /// (locked or elastic though it may be), and those that a stiffness of zero frees; idle motions
    /// included.
    pub mobility: usize,
    /// Constraints less their rank.
    pub overconstraint: usize,
    /// A basis of the motions that need no energy: drives locked, springs at rest.
    pub motions: Vec<Motion>,
    /// A pivot between zero and not zero (1e-12 to 1e-4), where there is one: the counts are then
    /// those of a geometry that is only nearly the one meant.
    pub doubtful: Option<f64>,
    /// Where that is among the conditions of the held mechanism: the motion that they only
    /// nearly prevent, the softest of the mechanism.
    pub nearly_free: Option<Motion>,
}

impl Motion {
    /// The motion in words, such as "`rod3` turns about (0, 0.6, 0.8) through rod3.B".
    pub fn describe(&self, model: &Model) -> String {
        let geometry = model.geometry();
        describe(self, model, geometry, characteristic_length(geometry))
    }

    /// The free directions of joints along which the motion goes, in the order of the joints. A
    /// drive that holds any one of them stops this motion.
    pub fn free_directions(&self, model: &Model) -> Vec<(JointId, Dof)> {
        let geometry = model.geometry();
        let size = characteristic_length(geometry);
        let at = |node: Option<NodeId>| {
            node.map_or(Vector6::zeros(), |n| node_twist(self, model, geometry, n.0))
        };
        let mut moved = Vec::new();
        for (k, joint) in model.joints().iter().enumerate() {
            let relative = at(joint.between[0]) - at(joint.between[1]);
            let along = to_directions(&joint.joint.basis(), &geometry.frames[k]) * relative;
            for dof in Directions::of(joint).free.iter() {
                let unit = if dof.index() < 3 { size } else { 1.0 };
                if along[dof.index()].abs() > RANK_TOLERANCE * unit {
                    moved.push((JointId(k), dof));
                }
            }
        }
        moved
    }
}
