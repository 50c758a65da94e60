//! What the lanes do at every pose, worked out once a topology.
//!
//! The lanes take other coordinates than the one-by-one path: the root of every component keeps
//! its six global components, and a joint's own coordinates are its relative motions q along the
//! moving directions, `u_i = u_j + S q`. They are as independent as the IDCs of Eqs. 17–36 and
//! span the same motions, so the condensed output is the same; and no choice of axes that could
//! differ from lane to lane is left (the book, "Lanes").
//!
//! Every carrier moves as a rigid body by `root + Σ screw · q`, with the twists of root and screws
//! taken at one reference point a component. An element is thus its stiffness over its nodes,
//! carried to those points, and nothing else.

use hyperstat_elements::Beam;
use hyperstat_elements::subassembly::ElasticJoint;
use hyperstat_joints::Dof;
use nalgebra::{DVector, Matrix6, Vector6};

use crate::cluster::{SegmentBeam, cluster_frame, local_joints, unit_beam};
use crate::model::{FlexibleId, Geometry, JointId, Model, NodeId, SegmentId};
use crate::numeric::evaluate;
use crate::plan::{Plan, Source};
use crate::restraint::{Restraint, scaled};
use crate::topology::Cluster;

use super::form::{Body, FactorColumn, Form, SegmentForm, TaperedElement};
use super::fronts::{Fronts, Group};
use super::hang::{hang, late_roots};
use super::inputs::{Inputs, Point};
use super::scatter::Scatter;

/// Most coordinates that a mechanism may have: beyond, a factorization is worth more than lanes.
const MOST_COORDINATES: usize = 600;
/// Nodes of a joint farther apart than this share of the mechanism's size are no one point.
const APART: f64 = 1e-9;
/// Entries of idle motions below this are none.
const STILL: f64 = 1e-9;

/// The work of a pose.
#[derive(Debug)]
pub(super) struct Program {
    pub inputs: Inputs,
    pub screws: Vec<Screw>,
    pub elements: Vec<Element>,
    /// Constant stiffnesses between two coordinates.
    pub springs: Vec<Spring>,
    /// Loads on nodes.
    pub loads: Vec<NodeLoad>,
    pub fronts: Fronts,
    /// All coordinates, the loads' row included.
    pub coordinates: usize,
    /// Blocks that the largest element needs, 36 entries each.
    pub most_blocks: usize,
}

/// The relative motion that a joint's coordinate stands for: a twist at the joint, carried to the
/// component's reference point.
#[derive(Debug)]
pub(super) struct Screw {
    pub coordinate: usize,
    /// Columns of the joint frame (places in the inputs), with what each gives to the translation
    /// and to the rotation.
    pub axes: Vec<(usize, f64, f64)>,
    /// From the joint to the reference point, where they differ.
    pub arm: Option<[Point; 2]>,
}

/// How a node of an element moves.
#[derive(Debug, Clone, Default)]
pub(super) struct NodeMotion {
    /// First of the six coordinates of its component's root.
    pub root: Option<usize>,
    /// Coordinates of the joints between root and node.
    pub screws: Vec<usize>,
    /// From the component's reference point to the node, where they differ.
    pub arm: Option<[Point; 2]>,
}

impl NodeMotion {
    /// Whether it moves at all.
    pub fn moves(&self) -> bool {
        self.root.is_some() || !self.screws.is_empty()
    }

    fn coordinates(&self) -> impl Iterator<Item = usize> {
        let root = self.root.into_iter().flat_map(|start| start..start + 6);
        root.chain(self.screws.iter().copied())
    }
}

/// An element: what it is, and how its nodes move.
#[derive(Debug)]
pub(super) struct Element {
    pub kind: Kind,
    pub nodes: Vec<NodeMotion>,
}

/// Where an element's stiffness comes from.
#[derive(Debug)]
pub(super) enum Kind {
    /// A prismatic beam between two points.
    Beam(BeamElement),
    /// A stiffness over nodes 1..=m with node 0 held, in axes that turn with the body.
    Held(HeldElement),
    /// A stiffness between two nodes at one point, in a joint's frame (its columns' places).
    Bushing {
        columns: [usize; 3],
        stiffness: Box<Matrix6<f64>>,
    },
}

/// A prismatic beam by its rigidities.
#[derive(Debug)]
pub(super) struct BeamElement {
    pub ends: [Point; 2],
    /// Direction of local y (a place in the inputs); `None` where it bends alike in all directions.
    pub y_axis: Option<usize>,
    pub axial: f64,
    pub torsional: f64,
    /// Bending about local y and z.
    pub bending: [f64; 2],
    /// `12 E I / G A_s` of deflection along z and y.
    pub shear: [f64; 2],
}

/// A body's stiffness as it is in the plan's own configuration, what it depends on, and how it is
/// formed where that changes.
#[derive(Debug)]
pub(super) struct HeldElement {
    pub points: Vec<Point>,
    pub axes: Axes,
    /// Stiffness over nodes 1..=m, column-major.
    pub stiffness: Vec<f64>,
    pub form: Form,
    /// Where the stiffness changes with the pose: from node 0 to the others in the body's axes.
    pub arms: Vec<[f64; 3]>,
    /// Over the largest component of these.
    pub per_length: f64,
    pub joints: Vec<HeldJoint>,
}

/// Axes of a held element.
#[derive(Debug, Clone, Copy)]
pub(super) enum Axes {
    /// Those of the segment from point 0 to point 1, with the place of its local y's direction.
    Segment(usize),
    /// The rotation of a flexible body (places of its columns).
    Flexible([usize; 3]),
}

/// An absorbed joint of a held element.
#[derive(Debug)]
pub(super) struct HeldJoint {
    /// Places of its frame's columns.
    pub columns: [usize; 3],
    /// Compliance in the joint's frame, and turned to the body's axes.
    pub own: Matrix6<f64>,
    pub turned: Matrix6<f64>,
    /// The parts of the compliance that are not zero.
    pub parts: Vec<CompliancePart>,
    /// Its node in the element, and the loads inside it.
    pub node: usize,
    pub load: Vector6<f64>,
}

/// A 3×3 part of a compliance.
#[derive(Debug)]
pub(super) struct CompliancePart {
    /// Its first row and column.
    pub place: (usize, usize),
    /// Over the size of its entries.
    pub per_size: f64,
}

impl CompliancePart {
    fn all_of(own: &Matrix6<f64>) -> Vec<Self> {
        let largest = |first: usize| (first..first + 3).map(|k| own[(k, k)]).fold(0.0, f64::max);
        let parts = [(0, 0), (0, 3), (3, 3)].map(|(i, j)| Self {
            place: (i, j),
            per_size: 1.0 / f64::sqrt(largest(i) * largest(j)),
        });
        parts
            .into_iter()
            .filter(|p| p.per_size.is_finite())
            .collect()
    }
}

/// A constant entry of the stiffness.
#[derive(Debug)]
pub(super) struct Spring {
    pub coordinates: [usize; 2],
    pub stiffness: f64,
}

/// A load on a node.
#[derive(Debug)]
pub(super) struct NodeLoad {
    pub node: NodeMotion,
    pub wrench: Vector6<f64>,
}

/// Where the carriers of a component stand.
struct Placed {
    /// First coordinate of the root.
    root: Option<usize>,
    reference: NodeId,
}

impl Program {
    /// The program of a plan; `None` where the lanes do not take it: closed loops of rigid bodies
    /// whose elimination depends on the pose, an output that does not move in all six ways,
    /// motions of the output without energy, too many coordinates.
    pub fn new(plan: &Plan, model: &Model, geometry: &Geometry) -> Option<Self> {
        let topology = &plan.topology;
        if !plan.closed.is_empty()
            || !plan.output_is_independent()
            || topology.coordinates > MOST_COORDINATES
        {
            return None;
        }
        let mut inputs = Inputs::new(model, geometry, APART)?;
        let mut placed: Vec<Option<Placed>> = topology.carriers.iter().map(|_| None).collect();
        let mut screws = Vec::new();
        for component in &topology.components {
            let reference = match (component.root, component.ties.first()) {
                (Some(root), _) => topology.carriers[root].reference,
                (None, Some(tie)) => tie.child_node,
                (None, None) => continue,
            };
            let root = component.root.map(|c| topology.carriers[c].coordinates[0]);
            let members = component
                .root
                .into_iter()
                .chain(component.ties.iter().map(|t| t.child));
            for carrier in members {
                placed[carrier] = Some(Placed { root, reference });
            }
            for tie in &component.ties {
                let moving = topology.joints[tie.joint.0].moving;
                let basis = model.joints()[tie.joint.0].joint.basis();
                for (coordinate, dof) in tie.coordinates.clone().zip(moving.iter()) {
                    screws.push(Screw {
                        coordinate,
                        axes: axes_of(&basis, dof, tie.joint, &mut inputs),
                        arm: inputs.arm(tie.child_node, reference),
                    });
                }
            }
        }
        let motion = |node: NodeId, inputs: &mut Inputs| {
            let carrier = topology.carrier_of[node.0];
            let placed = placed[carrier].as_ref()?;
            let own = &topology.carriers[carrier].coordinates;
            let skipped = if placed.root.is_some() { 6 } else { 0 };
            let moves = !own.is_empty();
            Some(NodeMotion {
                root: placed.root,
                screws: own[skipped..].to_vec(),
                arm: inputs.arm(placed.reference, node).filter(|_| moves),
            })
        };

        let mut workspace = plan.workspace();
        evaluate(plan, model, geometry, &[], &mut workspace).ok()?;
        let mut elements = Vec::new();
        let mut springs = Vec::new();
        let mut weights = Vec::new();
        for element in &plan.elements {
            let mut nodes: Vec<NodeMotion> = Vec::new();
            for (node, _) in &element.nodes {
                nodes.push(motion(*node, &mut inputs)?);
            }
            let kind = match element.source {
                Source::Cluster(k) => {
                    let cluster = &topology.clusters[k];
                    let beam = beam_element(cluster, model, &mut inputs);
                    match beam {
                        Some(beam) => Kind::Beam(beam),
                        None => {
                            let size = element.rows * element.rows;
                            let start = element.stiffness_start;
                            let stiffness = workspace.stiffnesses[start..start + size].to_vec();
                            let held = Held {
                                plan,
                                model,
                                geometry,
                                cluster,
                            };
                            Kind::Held(held.element(stiffness, &mut inputs)?)
                        }
                    }
                }
                Source::Spring(joint) => {
                    let role = &topology.joints[joint.0];
                    let tie = topology.components.iter().flat_map(|c| &c.ties);
                    let tie = tie.into_iter().find(|t| t.joint == joint);
                    if let Some(tie) = tie {
                        let places = tie.coordinates.clone().zip(role.moving.iter());
                        let places: Vec<(usize, Dof)> =
                            places.filter(|(_, d)| role.springs.contains(*d)).collect();
                        for (k, (a, d)) in places.iter().enumerate() {
                            for (b, e) in &places[k..] {
                                springs.push(Spring {
                                    coordinates: [*a, *b],
                                    stiffness: role.directions.stiffness[(d.index(), e.index())],
                                });
                            }
                        }
                        continue;
                    }
                    let mut stiffness = role.directions.stiffness;
                    for dof in role.springs.complement().iter() {
                        stiffness.row_mut(dof.index()).fill(0.0);
                        stiffness.column_mut(dof.index()).fill(0.0);
                    }
                    let basis = model.joints()[joint.0].joint.basis();
                    let inverse = basis.try_inverse()?;
                    Kind::Bushing {
                        columns: [0, 1, 2].map(|c| inputs.frame_column(joint, c)),
                        stiffness: Box::new(inverse.transpose() * stiffness * inverse),
                    }
                }
            };
            drop_shared(&mut nodes);
            if nodes.iter().any(NodeMotion::moves) {
                let rows = element.rows;
                let diagonal =
                    |k: usize| workspace.stiffnesses[element.stiffness_start + k * (rows + 1)];
                weights.push((0..rows.min(3)).map(diagonal).sum());
                elements.push(Element { kind, nodes });
            }
        }
        let mut loads = Vec::new();
        for load in model.loads() {
            let wrench = load.wrench;
            let node = motion(load.node, &mut inputs)?;
            if node.moves() && wrench != Vector6::zeros() {
                loads.push(NodeLoad { node, wrench });
            }
        }
        let idle = idle_coordinates(plan, model, geometry, &placed)?;
        let output = topology.output_start..topology.output_start + 6;
        let inner_load = elements.iter().any(has_inner_load)
            || loads
                .iter()
                .any(|l| l.node.root != Some(output.start) || !l.node.screws.is_empty());
        let loads_row = inner_load.then_some(topology.coordinates);
        let mut groups: Vec<Group> = Vec::new();
        for (k, element) in elements.iter().enumerate() {
            let loaded = loads_row.filter(|_| has_inner_load(element));
            let own = element.nodes.iter().flat_map(NodeMotion::coordinates);
            groups.push(Group::element(k, own.chain(loaded).collect()));
        }
        for (k, spring) in springs.iter().enumerate() {
            groups.push(Group::spring(k, spring.coordinates.to_vec()));
        }
        for (k, load) in loads.iter().enumerate() {
            groups.push(Group::load(
                k,
                load.node.coordinates().chain(loads_row).collect(),
            ));
        }
        let unknowns = topology.coordinates;
        let references = placed
            .iter()
            .flatten()
            .filter_map(|p| Some((p.root?, p.reference)));
        let references = references.collect();
        let late = late_roots(&elements, &weights, &references);
        let late = |c: usize| late.iter().any(|root| (*root..*root + 6).contains(&c));
        let mut fronts = Fronts::new(unknowns, groups, &idle, output, loads_row, late)?;
        hang(
            &mut fronts,
            &mut elements,
            &weights,
            &references,
            &mut inputs,
        );
        for front in &mut fronts.list {
            front.scatter = Scatter::new(front, &elements);
        }
        let blocks = |e: &Element| e.nodes.len() * (e.nodes.len() + 1) / 2;
        Some(Self {
            most_blocks: elements.iter().map(blocks).max().unwrap_or(0),
            inputs,
            screws,
            elements,
            springs,
            loads,
            fronts,
            coordinates: unknowns + usize::from(loads_row.is_some()),
        })
    }
}

/// Whether loads inside an element's absorbed joints strain it.
fn has_inner_load(element: &Element) -> bool {
    matches!(&element.kind, Kind::Held(held) if held.joints.iter().any(|j| j.load != Vector6::zeros()))
}

/// The columns of a joint's frame that make up one of its directions.
fn axes_of(
    basis: &Matrix6<f64>,
    dof: Dof,
    joint: JointId,
    inputs: &mut Inputs,
) -> Vec<(usize, f64, f64)> {
    let direction = basis.column(dof.index());
    let parts = (0..3).map(|c| (c, direction[c], direction[3 + c]));
    parts
        .filter(|(_, linear, angular)| *linear != 0.0 || *angular != 0.0)
        .map(|(c, linear, angular)| (inputs.frame_column(joint, c), linear, angular))
        .collect()
}

/// The beam of a cluster that is one prismatic segment without absorbed joints.
fn beam_element(cluster: &Cluster, model: &Model, inputs: &mut Inputs) -> Option<BeamElement> {
    let [(id, _)] = cluster.segments.as_slice() else {
        return None;
    };
    if cluster.joints.iter().any(Option::is_some) {
        return None;
    }
    let SegmentBeam::Prismatic(beam) = unit_beam(model, *id)? else {
        return None;
    };
    let ends = [cluster.nodes[0], cluster.nodes[1]];
    Some(BeamElement::new(&beam, *id, ends, inputs))
}

impl BeamElement {
    /// A segment of any length, run through from one node to the other.
    fn new(beam: &Beam, id: SegmentId, ends: [NodeId; 2], inputs: &mut Inputs) -> Self {
        let section = beam.section_compliance();
        let (shear_y, shear_z) = (section[1], section[2]);
        let bending = [beam.bending_rigidity_y(), beam.bending_rigidity_z()];
        let mut element = Self {
            ends: ends.map(|n| inputs.point(n)),
            y_axis: None,
            axial: beam.axial_rigidity(),
            torsional: beam.torsional_rigidity(),
            bending,
            shear: [12.0 * bending[0] * shear_z, 12.0 * bending[1] * shear_y],
        };
        let [across, upwards] = element.bending;
        if across != upwards || element.shear[0] != element.shear[1] {
            element.y_axis = Some(inputs.y_axis(id, ends));
        }
        element
    }
}

/// A cluster about to become a held element.
struct Held<'a> {
    plan: &'a Plan,
    model: &'a Model,
    geometry: &'a Geometry,
    cluster: &'a Cluster,
}

impl Held<'_> {
    fn element(&self, stiffness: Vec<f64>, inputs: &mut Inputs) -> Option<HeldElement> {
        let Self {
            plan,
            model,
            geometry,
            cluster,
        } = self;
        let to_local = cluster_frame(cluster, geometry).ok()?.inverse();
        let base = geometry.positions[cluster.nodes[0].0];
        let mut arms: Vec<[f64; 3]> = cluster.nodes[1..]
            .iter()
            .map(|n| (to_local * (geometry.positions[n.0] - base)).into())
            .collect();
        if cluster.flexible.is_some() {
            arms.clear();
        }
        let longest = arms.iter().flatten().fold(0.0_f64, |m, a| m.max(a.abs()));
        let rotation =
            |id: FlexibleId, inputs: &mut Inputs| [0, 1, 2].map(|c| inputs.rotation(id, c));
        let joints = local_joints(plan, model, geometry, cluster, &to_local);
        Some(HeldElement {
            form: self.form(&joints, inputs)?,
            points: cluster.nodes.iter().map(|n| inputs.point(*n)).collect(),
            axes: match cluster.flexible {
                Some(id) => Axes::Flexible(rotation(id, inputs)),
                None => {
                    let ends = [cluster.nodes[0], cluster.nodes[1]];
                    Axes::Segment(inputs.y_axis(cluster.segments[0].0, ends))
                }
            },
            stiffness,
            arms,
            per_length: 1.0 / longest,
            joints: joints
                .into_iter()
                .map(|(node, joint, elastic)| HeldJoint {
                    columns: [0, 1, 2].map(|c| inputs.frame_column(joint, c)),
                    own: elastic.compliance,
                    parts: CompliancePart::all_of(&elastic.compliance),
                    turned: elastic.turned_compliance(),
                    node,
                    load: model.node_load(cluster.nodes[node]),
                })
                .collect(),
        })
    }
}

impl Held<'_> {
    /// How its stiffness is formed.
    fn form(&self, joints: &[(usize, JointId, ElasticJoint)], inputs: &mut Inputs) -> Option<Form> {
        let Self { model, cluster, .. } = self;
        let body = match cluster.flexible {
            Some(id) => {
                let held = model.flexibles()[id.0].element.held_stiffness();
                Body::Given(held.as_slice().to_vec())
            }
            None => {
                let mut segments = Vec::new();
                for (k, (id, reversed)) in cluster.segments.iter().enumerate() {
                    let ends = [cluster.nodes[k], cluster.nodes[k + 1]];
                    segments.push(match unit_beam(model, *id)? {
                        SegmentBeam::Prismatic(beam) => {
                            SegmentForm::Prismatic(BeamElement::new(&beam, *id, ends, inputs))
                        }
                        SegmentBeam::Tapered(beam) => {
                            let y_axis = inputs.y_axis(*id, ends);
                            let ends = ends.map(|n| inputs.point(n));
                            SegmentForm::Tapered(TaperedElement::new(
                                &beam, *reversed, ends, y_axis,
                            ))
                        }
                    });
                }
                Body::Run(segments)
            }
        };
        let columns = joints.iter().flat_map(|(node, joint, elastic)| {
            let frame = [0, 1, 2].map(|c| inputs.frame_column(*joint, c));
            FactorColumn::all_of(*node, &elastic.compliance, frame)
        });
        Some(Form {
            columns: columns.collect(),
            body,
        })
    }
}

/// Takes out what all nodes of an element share: with it they move as one rigid body.
fn drop_shared(nodes: &mut [NodeMotion]) {
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

/// One coordinate an idle motion: those with the largest minor. `None` where the output moves
/// without energy.
fn idle_coordinates(
    plan: &Plan,
    model: &Model,
    geometry: &Geometry,
    placed: &[Option<Placed>],
) -> Option<Vec<usize>> {
    if !plan.has_idle {
        return Some(Vec::new());
    }
    let restraint = Restraint::new(model, geometry, plan.output);
    if !restraint.moving.is_empty() {
        return None;
    }
    let topology = &plan.topology;
    let mut columns: Vec<DVector<f64>> = Vec::new();
    for motion in &restraint.idle {
        let twist = |node: NodeId| crate::kinematics::node_twist(motion, model, geometry, node.0);
        let mut column = DVector::zeros(topology.coordinates);
        for placed in placed.iter().flatten() {
            if let Some(root) = placed.root {
                let at = scaled(&twist(placed.reference), restraint.size);
                column.fixed_rows_mut::<6>(root).copy_from(&at);
            }
        }
        for tie in topology.components.iter().flat_map(|c| &c.ties) {
            let joint = &model.joints()[tie.joint.0];
            let at = |node: Option<NodeId>| node.map_or(Vector6::zeros(), twist);
            let relative = at(joint.between[0]) - at(joint.between[1]);
            let frame = &geometry.frames[tie.joint.0];
            let along = crate::directions::to_directions(&joint.joint.basis(), frame) * relative;
            let moving = topology.joints[tie.joint.0].moving;
            for (coordinate, dof) in tie.coordinates.clone().zip(moving.iter()) {
                let unit = if dof.index() < 3 { restraint.size } else { 1.0 };
                column[coordinate] = along[dof.index()] / unit;
            }
        }
        columns.push(column);
    }
    Some(crate::restraint::largest_minor(columns, STILL))
}
