//! The masses of nodes in other configurations.

use crate::model::Model;
use crate::orientation::turn;
use crate::parts::{Geometry, NodeMass};

impl Model {
    /// The masses of the nodes in another configuration: their inertia turns with their bodies.
    pub fn masses_at(&self, geometry: &Geometry) -> Vec<NodeMass> {
        let masses = self.masses.iter();
        masses
            .map(|mass| {
                if mass.mass.inertia().iter().all(|entry| *entry == 0.0) {
                    return mass.clone();
                }
                let turn = turn(self, geometry, self.nodes[mass.node.0].body);
                NodeMass {
                    node: mass.node,
                    mass: mass.mass.turned(&turn),
                }
            })
            .collect()
    }
}
