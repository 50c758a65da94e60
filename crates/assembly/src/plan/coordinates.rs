//! The displacement of every carrier as a function of the independent displacement coordinates:
//! the mapping H (Eq. 40), built joint by joint in the global frame.
//!
//! A carrier's block is 6×m, column-major; which coordinates its columns stand for is fixed by
//! the topology, which global component each coordinate is may change from pose to pose.

use hyperstat_joints::{Dof, JointError};
use hyperstat_model::{NodeId, condition_rows};
use nalgebra::{DMatrix, Matrix6};

use super::blocks::{read, shift, write};
use super::topology::Topology;
use super::trees::Component;
use crate::posture::Posture;
use crate::rank::dense::Elimination;

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
            if let Some(root) = component.root {
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

    /// Solves the closing joints of a component; columns are its coordinates.
    pub fn close(
        &self,
        component: &Component,
        topology: &Topology,
        at: &Posture<'_>,
        spared: usize,
    ) -> Elimination {
        let conditions = self.closing_conditions(component, topology, at);
        let size = at.size;
        let first = component.coordinates.start;
        let scale = |coordinate| self.scale(coordinate, size);
        let mut solved = Elimination::new(conditions, spared);
        let count = component.coordinates.len();
        for (c, k) in (0..count).flat_map(|c| (0..solved.independent.len()).map(move |k| (c, k))) {
            solved.map[(c, k)] *= scale(first + c) / scale(first + solved.independent[k]);
        }
        solved
    }

    /// The length that a tree coordinate is divided by in conditions: `size` for a translation.
    pub fn scale(&self, coordinate: usize, size: f64) -> f64 {
        if self.identities[coordinate].1.index() < 3 {
            size
        } else {
            1.0
        }
    }

    /// The conditions that a component's closing joints put on its scaled coordinates, a row a
    /// rigid or absorbed direction.
    pub fn closing_conditions(
        &self,
        component: &Component,
        topology: &Topology,
        at: &Posture<'_>,
    ) -> DMatrix<f64> {
        let Posture {
            model,
            geometry,
            size,
            ..
        } = *at;
        let first = component.coordinates.start;
        let count = component.coordinates.len();
        let (mut rows, mut height) = (Vec::new(), 0);
        for joint in &component.closings {
            let entry = &model.joints()[joint.0];
            let local = at.direction_map(*joint);
            let rigid = topology.joints[joint.0].moving.complement();
            for condition in condition_rows(&local, rigid, size) {
                let mut row = vec![0.0; count];
                for (node, sign) in entry.between.iter().zip([1.0, -1.0]) {
                    let Some(node) = node else { continue };
                    let carrier = topology.carrier_of[node.0];
                    let entry = &topology.carriers[carrier];
                    let shift = shift(geometry, entry.reference, *node);
                    for (k, &coordinate) in entry.coordinates.iter().enumerate() {
                        let mut u = shift * read(&self.values, self.starts[carrier] + 6 * k);
                        for t in 0..3 {
                            u[t] /= size;
                        }
                        row[coordinate - first] +=
                            sign * (condition * u)[0] * self.scale(coordinate, size);
                    }
                }
                rows.extend(row);
                height += 1;
            }
        }
        DMatrix::from_row_slice(height, count, &rows)
    }
}
