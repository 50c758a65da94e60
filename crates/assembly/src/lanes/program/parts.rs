//! The links and joints of a mechanism, each by itself, before chains are made of them.

use hyperstat_joints::Dof;
use hyperstat_model::{Directions, Geometry, JointId, Model, NodeId};

use super::chain::{Chain, Link, Release};
use super::columns::Brought;
use super::element::{Element, FlexibleElement, Kind, Moving, NodeMotion, Screw, Shift, Spring};
use super::inputs::{Inputs, Point};
use super::loops::Loops;
use crate::plan::subassemblies::Subassembly;
use crate::plan::topology::Topology;

/// Where a carrier stands.
pub(crate) struct Placed {
    /// First coordinate of its component's root.
    pub root: Option<usize>,
    /// The component's reference point.
    pub reference: NodeId,
}

impl Placed {
    /// By carriers.
    pub fn all(topology: &Topology) -> Vec<Option<Self>> {
        let mut placed: Vec<Option<Self>> = topology.carriers.iter().map(|_| None).collect();
        for component in &topology.components {
            let reference = match (component.root, component.ties.first()) {
                (Some(root), _) => topology.carriers[root].reference,
                (None, Some(tie)) => tie.child_node,
                (None, None) => continue,
            };
            let root = component.root.map(|c| topology.carriers[c].coordinates[0]);
            let children = component.ties.iter().map(|t| t.child);
            for carrier in component.root.into_iter().chain(children) {
                placed[carrier] = Some(Self { root, reference });
            }
        }
        placed
    }
}

/// The screws of all joints that have coordinates of their own.
pub(crate) fn screws(
    model: &Model,
    topology: &Topology,
    placed: &[Option<Placed>],
    inputs: &mut Inputs,
) -> Option<Vec<Screw>> {
    let mut screws = Vec::new();
    let closed = topology
        .components
        .iter()
        .filter(|c| !c.closings.is_empty());
    let closed: Vec<usize> = closed
        .flat_map(|c| c.ties.iter().map(|t| t.child))
        .collect();
    let looped = |carrier: usize| closed.contains(&carrier);
    for tie in topology.components.iter().flat_map(|c| &c.ties) {
        let reference = placed[tie.child].as_ref()?.reference;
        let moving = topology.joints[tie.joint.0].moving;
        for (coordinate, dof) in tie.coordinates.clone().zip(moving.iter()) {
            screws.push(Screw {
                coordinate,
                in_loop: looped(tie.child),
                motion: release(model, tie.joint, dof, tie.child_node, inputs),
                arm: inputs.arm(tie.child_node, reference),
            });
        }
    }
    Some(screws)
}

/// One of a joint's directions, at one of its nodes.
fn release(model: &Model, joint: JointId, dof: Dof, node: NodeId, inputs: &mut Inputs) -> Release {
    let basis = model.joints()[joint.0].joint.basis();
    let direction = basis.column(dof.index());
    let parts = (0..3).map(|c| (c, direction[c], direction[3 + c]));
    let axes = parts
        .filter(|(_, linear, angular)| *linear != 0.0 || *angular != 0.0)
        .map(|(c, linear, angular)| (inputs.frame_column(joint, c), linear, angular))
        .collect();
    Release {
        point: inputs.point(node),
        axes,
    }
}

/// The parts of a mechanism, each by itself.
pub(crate) struct Parts<'a> {
    pub model: &'a Model,
    pub geometry: &'a Geometry,
    pub topology: &'a Topology,
    pub placed: &'a [Option<Placed>],
    /// Loops of rigid bodies.
    pub loops: &'a Loops,
    /// Of the mechanism.
    pub size: f64,
    /// By carriers: what joints' misfits displace them by.
    pub standing: Vec<Vec<Shift>>,
    /// What acts on segments and joints.
    pub brought: Brought,
    pub elements: Vec<Element>,
    pub springs: Vec<Spring>,
}

impl Parts<'_> {
    pub fn motion(&self, node: NodeId, inputs: &mut Inputs) -> Option<NodeMotion> {
        let carrier = self.topology.carrier_of[node.0];
        let placed = self.placed[carrier].as_ref()?;
        let own = &self.topology.carriers[carrier].coordinates;
        let skipped = if placed.root.is_some() { 6 } else { 0 };
        let moves = !own.is_empty();
        Some(NodeMotion {
            root: placed.root,
            screws: match self.loops.of_carrier(carrier) {
                Some(screws) => screws.to_vec(),
                None => {
                    let own = own[skipped..].iter();
                    own.map(|c| Moving {
                        coordinate: *c,
                        screw: *c,
                    })
                    .collect()
                }
            },
            arm: inputs.arm(placed.reference, node).filter(|_| moves),
        })
    }

    fn origin(&self, node: NodeId, inputs: &mut Inputs) -> Option<Point> {
        let placed = self.placed[self.topology.carrier_of[node.0]].as_ref()?;
        Some(inputs.point(placed.reference))
    }

    /// Takes in what acts on segments and joints, before any element is added.
    pub fn take(&mut self, brought: Brought, inputs: &mut Inputs) {
        self.standing = vec![Vec::new(); self.topology.carriers.len()];
        for tie in self.topology.components.iter().flat_map(|c| &c.ties) {
            let mut standing = match tie.parent {
                Some(parent) => self.standing[parent].clone(),
                None => Vec::new(),
            };
            let between = &self.model.joints()[tie.joint.0].between;
            let is_second = between[1] == Some(tie.child_node);
            let sign = if is_second { 1.0 } else { -1.0 };
            let point = inputs.point(tie.child_node);
            standing.extend(brought.by_joint(tie.joint, 0, point, sign));
            self.standing[tie.child] = standing;
        }
        self.brought = brought;
    }

    /// What the misfits between a component's root and these nodes ask of an element.
    fn standing(&self, nodes: &[NodeId]) -> Vec<Shift> {
        let carrier = |node: &NodeId| self.topology.carrier_of[node.0];
        let all: Vec<&Vec<Shift>> = nodes.iter().map(|n| &self.standing[carrier(n)]).collect();
        let mut shifts = Vec::new();
        for (node, own) in all.iter().enumerate() {
            let moves_alone = |s: &&Shift| !all.iter().all(|other| other.contains(s));
            // The element stands where its nodes would be the other way.
            shifts.extend(own.iter().filter(moves_alone).map(|shift| Shift {
                node,
                sign: -shift.sign,
                ..shift.clone()
            }));
        }
        shifts
    }

    /// Adds an element whose nodes move as the model's nodes say, unless it is rigidly held.
    fn add(&mut self, kind: Kind, mut nodes: Vec<NodeMotion>, shifts: Vec<Shift>) {
        drop_shared(&mut nodes);
        if nodes.iter().any(NodeMotion::moves) {
            self.elements.push(Element {
                kind,
                nodes,
                shifts,
                columns: Vec::new(),
                shared: Vec::new(),
            });
        }
    }

    pub fn add_subassembly(
        &mut self,
        subassembly: &Subassembly,
        inputs: &mut Inputs,
    ) -> Option<()> {
        let mut nodes = Vec::new();
        for node in &subassembly.nodes {
            nodes.push(self.motion(*node, inputs)?);
        }
        let mut shifts = self.standing(&subassembly.nodes);
        let kind = match subassembly.flexible {
            Some(id) => {
                let stiffness = self.model.flexibles()[id.0].element.held_stiffness();
                Kind::Flexible(FlexibleElement {
                    points: subassembly.nodes.iter().map(|n| inputs.point(*n)).collect(),
                    axes: [0, 1, 2].map(|c| inputs.rotation(id, c)),
                    stiffness: stiffness.as_slice().to_vec(),
                })
            }
            None => {
                // Without absorbed joints, a run is one segment.
                let [(id, _)] = subassembly.segments.as_slice() else {
                    return None;
                };
                let ends = self.model.segments()[id.0].ends;
                nodes.clear();
                for node in ends {
                    nodes.push(self.motion(node, inputs)?);
                }
                let link = Link::beam(self.model, self.geometry, *id, inputs)?;
                let [a, b] = ends.map(|n| self.origin(n, inputs));
                shifts = self.standing(&ends);
                let second = inputs.point(ends[1]);
                shifts.extend(self.brought.by_segment(*id, 1, second));
                Kind::Chain(Chain::new(link, Vec::new(), [a?, b?]))
            }
        };
        self.add(kind, nodes, shifts);
        Some(())
    }

    /// What an elastic joint adds.
    pub fn add_joint(&mut self, joint: JointId, inputs: &mut Inputs) -> Option<()> {
        let role = &self.topology.joints[joint.0];
        if role.springs.is_empty() {
            return Some(());
        }
        let ties = self.topology.components.iter().flat_map(|c| &c.ties);
        if let Some(tie) = ties.into_iter().find(|t| t.joint == joint) {
            if !role.directions.has_stiffness {
                return None;
            }
            let places = tie.coordinates.clone().zip(role.moving.iter());
            let places: Vec<(usize, Dof)> =
                places.filter(|(_, d)| role.springs.contains(*d)).collect();
            for (k, (a, d)) in places.iter().enumerate() {
                for (b, e) in &places[k..] {
                    let stiffness = role.directions.stiffness[(d.index(), e.index())];
                    if a == b || stiffness != 0.0 {
                        self.springs.push(Spring {
                            coordinates: [*a, *b],
                            stiffness,
                        });
                    }
                }
            }
            return Some(());
        }
        let entry = &self.model.joints()[joint.0];
        let columns = [0, 1, 2].map(|c| inputs.frame_column(joint, c));
        let basis = entry.joint.basis();
        let Directions {
            stiffness,
            has_stiffness,
            compliance,
            ..
        } = &role.directions;
        let mut nodes = Vec::new();
        for node in entry.between.iter().flatten() {
            nodes.push(self.motion(*node, inputs)?);
        }
        let between: Vec<NodeId> = entry.between.iter().flatten().copied().collect();
        let at = between.first()?;
        let mut shifts = self.standing(&between);
        let (own, sign) = match entry.between {
            [None, Some(_)] => (0, 1.0),
            [Some(_), None] => (0, -1.0),
            _ => (1, 1.0),
        };
        let point = inputs.point(*at);
        shifts.extend(self.brought.by_joint(joint, own, point, sign));
        let kind = match compliance {
            Some(compliance) => {
                let own = basis * compliance * basis.transpose();
                let link = Link::joint(joint, &own, *at, columns, self.size, inputs);
                let free = role.directions.free.iter();
                let releases = free.map(|dof| release(self.model, joint, dof, *at, inputs));
                let releases = releases.collect();
                let mut origins = [inputs.point(*at); 2];
                for (origin, node) in origins.iter_mut().zip(entry.between.iter().flatten()) {
                    *origin = self.origin(*node, inputs)?;
                }
                Kind::Chain(Chain::new(link, releases, origins))
            }
            None if *has_stiffness => {
                let inverse = basis.try_inverse()?;
                let stiffness = Box::new(inverse.transpose() * stiffness * inverse);
                Kind::Bushing {
                    point,
                    columns,
                    stiffness,
                }
            }
            None => return None,
        };
        if matches!(kind, Kind::Chain(_)) && nodes.len() == 1 {
            nodes.push(NodeMotion::default());
        }
        self.add(kind, nodes, shifts);
        Some(())
    }
}

/// Takes out what all nodes of an element share: with it they move as one rigid body.
pub(crate) fn drop_shared(nodes: &mut [NodeMotion]) {
    let first = nodes[0].clone();
    if first.root.is_some() && nodes.iter().all(|n| n.root == first.root) {
        for node in nodes.iter_mut() {
            node.root = None;
        }
    }
    for screw in first.screws {
        if nodes.iter().all(|n| n.screws.contains(&screw)) {
            for node in nodes.iter_mut() {
                node.screws.retain(|s| *s != screw);
            }
        }
    }
}
