//! The displacement of every carrier as a function of the independent displacement coordinates:
//! the mapping H (Eq. 40), built joint by joint in the global frame.
//!
//! A carrier's block is 6×m, column-major; which coordinates its columns stand for is fixed by
//! the topology, which global component each coordinate is may change from pose to pose.

use hyperstat_joints::{Dof, JointError};
use hyperstat_model::NodeId;
use nalgebra::Matrix6;

use super::blocks::{read, shift, write};
use super::topology::Topology;
use crate::posture::Posture;

/// Blocks over the tree coordinates, before loops are closed.
#[derive(Debug, Clone)]
pub(crate) struct TreeBlocks {
    /// Start of every carrier's block in `values`.
    pub starts: Vec<usize>,
    pub values: Vec<f64>,
    /// Which component of which node's displacement every tree coordinate is.
    pub identities: Vec<(NodeId, Dof)>,
}

impl TreeBlocks {
    /// Buffers for a topology.
    pub fn new(topology: &Topology) -> Self {
        let mut starts = Vec::with_capacity(topology.carriers.len());
        let mut end = 0;
        for carrier in &topology.carriers {
            starts.push(end);
            end += 6 * carrier.coordinates.len();
        }
        Self {
            starts,
            values: vec![0.0; end],
            identities: vec![(NodeId(0), Dof::X); topology.coordinates],
        }
    }

    /// Fills the blocks for a configuration.
    pub fn evaluate(&mut self, topology: &Topology, at: &Posture<'_>) -> Result<(), JointError> {
        let Posture {
            model, geometry, ..
        } = *at;
        for component in &topology.components {
            for &root in component.root.iter().chain(&component.network) {
                let carrier = &topology.carriers[root];
                let start = self.starts[root];
                self.values[start..start + 36].copy_from_slice(Matrix6::identity().as_slice());
                for (k, dof) in Dof::ALL.into_iter().enumerate() {
                    self.identities[carrier.coordinates[k]] = (carrier.reference, dof);
                }
            }
            for tie in &component.ties {
                let joint = &model.joints()[tie.joint.0];
                let moving = topology.joints[tie.joint.0].moving;
                let mapping = joint.joint.mapping(&geometry.frames[tie.joint.0], moving)?;
                let start = self.starts[tie.child];
                let mut column = start;
                if let (Some(parent), Some(node)) = (tie.parent, tie.parent_node) {
                    let reference = topology.carriers[parent].reference;
                    let hand_on = mapping.n_j() * shift(geometry, reference, node);
                    let from = self.starts[parent];
                    for k in 0..topology.carriers[parent].coordinates.len() {
                        let handed = hand_on * read(&self.values, from + 6 * k);
                        write(&mut self.values, column, &handed);
                        column += 6;
                    }
                }
                for own in mapping.n_i() {
                    write(&mut self.values, column, own);
                    column += 6;
                }
                for (coordinate, dof) in tie.coordinates.clone().zip(mapping.idcs().iter()) {
                    self.identities[coordinate] = (tie.child_node, dof);
                }
            }
        }
        Ok(())
    }
}
