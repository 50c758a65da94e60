//! What depends on the topology alone: carriers of displacement, absorbed joints, the spanning
//! trees along which joints hand on displacements, and the subassemblies of segments.
//!
//! A *carrier* is what has six displacement coordinates: a node of an elastic body, or a whole
//! rigid body. Joints tie carriers into trees; a joint that would close a loop gives conditions
//! instead (the book, "Overall model").

use hyperstat_model::{Geometry, Model, NodeId};

use super::roles::{JointRole, roles};
use super::subassemblies::{Subassembly, subassemblies};
use super::trees::{Carrier, Component, carriers, components};

/// Topology of a model.
#[derive(Debug, Clone)]
pub(crate) struct Topology {
    pub carriers: Vec<Carrier>,
    /// Carrier of every node.
    pub carrier_of: Vec<usize>,
    pub joints: Vec<JointRole>,
    pub components: Vec<Component>,
    pub subassemblies: Vec<Subassembly>,
    /// Number of tree coordinates.
    pub coordinates: usize,
    /// First of the output carrier's six tree coordinates.
    pub output_start: usize,
}

impl Topology {
    /// The topology of a model; `absorbs`: elastic joints go into the subassemblies where they
    /// can, else each keeps coordinates of its own.
    pub fn new(model: &Model, geometry: &Geometry, output: NodeId, absorbs: bool) -> Self {
        let (mut carriers, carrier_of) = carriers(model, output);
        let joints = roles(model, geometry, output, absorbs);
        let subassemblies = subassemblies(model, &joints);
        let mut coordinates = 0;
        let (components, output_start) = components(
            model,
            &joints,
            &mut carriers,
            &carrier_of,
            carrier_of[output.0],
            &mut coordinates,
        );
        Self {
            carriers,
            carrier_of,
            joints,
            components,
            subassemblies,
            coordinates,
            output_start,
        }
    }

    /// Whether another topology is the same but for the joints' stiffness.
    pub fn is_like(&self, other: &Self) -> bool {
        self.carriers == other.carriers
            && self.carrier_of == other.carrier_of
            && self.components == other.components
            && self.subassemblies == other.subassemblies
            && self.joints.len() == other.joints.len()
            && (self.joints.iter().zip(&other.joints)).all(|(own, other)| own.is_like(other))
    }
}
