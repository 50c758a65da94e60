//! The model: bodies, nodes, joints, loads and the output, and how they are put together.

pub(crate) mod checks;
pub(crate) mod divided;
pub(crate) mod doubts;
mod known;
pub(crate) mod misfits;
mod renamed;
pub(crate) mod turn;
pub(crate) mod values;

use std::collections::{HashMap, HashSet};

use hyperstat_elements::{FlexibleBody, Material, RigidMass, Section, element_frame};
use hyperstat_joints::Dof;
use nalgebra::{DMatrix, Point3, Rotation3, Vector3, Vector6};

use crate::error::ModelError;
use crate::loads::{Axes, Load, LoadCase, LoadSet};
use crate::parts::ValuePlace;
use crate::parts::{
    Body, BodyId, BodyKind, Connection, Flexible, FlexibleId, Geometry, JointId, Member, Misfit,
    Node, NodeId, NodeMass, Segment, SegmentId,
};
pub(crate) use crate::revision::fresh_revision;
use crate::stiffness::{check_semidefinite, check_stiffness};

/// A mechanism in one configuration.
#[derive(Debug, Clone)]
pub struct Model {
    /// Name.
    pub name: String,
    bodies: Vec<Body>,
    nodes: Vec<Node>,
    segments: Vec<Segment>,
    flexibles: Vec<Flexible>,
    joints: Vec<Connection>,
    /// The two nodes of every joint between two bodies.
    pub(crate) joined: Vec<[NodeId; 2]>,
    loads: LoadSet,
    cases: Vec<LoadCase>,
    masses: Vec<NodeMass>,
    /// In the joints' order.
    misfits: Vec<Misfit>,
    gravity: Vector3<f64>,
    output: Option<NodeId>,
    geometry: Geometry,
    body_names: HashMap<String, BodyId>,
    joint_names: HashSet<String>,
    /// Nodes of every body by the name of their point, sorted.
    by_point: Vec<Vec<NodeId>>,
    value_names: HashMap<ValuePlace, String>,
    /// Parts of bodies, which are bodies themselves.
    known_as: HashMap<BodyId, Vec<BodyId>>,
    /// Changes with what plans depend on: models of one revision have the same bodies, joints and
    /// output.
    revision: u64,
    /// Changes with what acts on the model.
    acting: u64,
}

impl Model {
    /// A model without bodies.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            bodies: Vec::new(),
            nodes: Vec::new(),
            segments: Vec::new(),
            flexibles: Vec::new(),
            joints: Vec::new(),
            joined: Vec::new(),
            loads: LoadSet::default(),
            cases: Vec::new(),
            masses: Vec::new(),
            misfits: Vec::new(),
            gravity: Vector3::zeros(),
            output: None,
            geometry: Geometry {
                positions: Vec::new(),
                y_axes: Vec::new(),
                frames: Vec::new(),
                rotations: Vec::new(),
            },
            body_names: HashMap::new(),
            joint_names: HashSet::new(),
            by_point: Vec::new(),
            value_names: HashMap::new(),
            known_as: HashMap::new(),
            revision: fresh_revision(),
            acting: fresh_revision(),
        }
    }

    /// Adds a rigid body through `points` (name, position (m)).
    ///
    /// # Errors
    /// A repeated body name or point, no point, a position that is not finite.
    pub fn add_rigid(
        &mut self,
        name: &str,
        points: &[(&str, Point3<f64>)],
    ) -> Result<BodyId, ModelError> {
        self.add_body(name, BodyKind::Rigid, points)
    }

    /// Adds an elastic body through `points`, made of `members` between them.
    ///
    /// # Errors
    /// As [`Model::add_rigid`]; fewer than two points; a member without length, with its
    /// `y_axis` along it, with ends out of range, or with a section that cannot taper as it says;
    /// a point that the members do not connect with the first.
    pub fn add_elastic(
        &mut self,
        name: &str,
        points: &[(&str, Point3<f64>)],
        members: &[Member],
    ) -> Result<BodyId, ModelError> {
        if points.len() < 2 || members.is_empty() {
            return Err(ModelError::TooFewPoints { body: name.into() });
        }
        for (k, member) in members.iter().enumerate() {
            if member.elements == 0 {
                return Err(ModelError::NoElements {
                    body: name.into(),
                    segment: k,
                });
            }
            let [a, b] = member.ends;
            let (Some(a), Some(b)) = (points.get(a), points.get(b)) else {
                return Err(ModelError::TooFewPoints { body: name.into() });
            };
            element_frame(&(b.1 - a.1), member.y_axis.as_ref())
                .and_then(|_| member.change_of_section())
                .map_err(|source| ModelError::Segment {
                    body: name.into(),
                    segment: k,
                    source,
                })?;
        }
        if let Some(loose) = loose_point(points.len(), members) {
            return Err(ModelError::Loose {
                body: name.into(),
                point: points[loose].0.into(),
            });
        }
        let body = self.add_body(name, BodyKind::Elastic, points)?;
        for member in members {
            let nodes = &self.bodies[body.0].nodes;
            let ends = member.ends.map(|k| nodes[k]);
            let id = SegmentId(self.segments.len());
            self.segments.push(Segment {
                body,
                ends,
                material: member.material.clone(),
                section: member.section.clone(),
                taper: member.taper.clone(),
                elements: member.elements,
                y_axis_given: member.y_axis.is_some(),
            });
            self.geometry.y_axes.push(member.y_axis);
            self.bodies[body.0].segments.push(id);
        }
        Ok(body)
    }

    /// Adds a beam: a chain of segments through `points`, all of one section and material.
    ///
    /// # Errors
    /// As [`Model::add_elastic`].
    pub fn add_beam(
        &mut self,
        name: &str,
        points: &[(&str, Point3<f64>)],
        material: &Material,
        section: &Section,
        y_axis: Option<Vector3<f64>>,
        elements: usize,
    ) -> Result<BodyId, ModelError> {
        let members: Vec<_> = (1..points.len())
            .map(|k| Member {
                ends: [k - 1, k],
                material: material.clone(),
                section: section.clone(),
                taper: None,
                y_axis,
                elements,
            })
            .collect();
        self.add_elastic(name, points, &members)
    }

    /// Adds an elastic body through `points`, given by its stiffness over them: 6n×6n, six rows
    /// and columns a point in their order, linear part first, global axes at these positions
    /// (N/m, N, N·m). It turns with the body where a pose turns it ([`Geometry::rotations`]).
    ///
    /// # Errors
    /// As [`Model::add_rigid`], and whatever [`FlexibleBody::new`] finds wrong with the stiffness.
    pub fn add_flexible(
        &mut self,
        name: &str,
        points: &[(&str, Point3<f64>)],
        stiffness: &DMatrix<f64>,
    ) -> Result<BodyId, ModelError> {
        let positions: Vec<_> = points.iter().map(|(_, position)| *position).collect();
        let element = FlexibleBody::new(&positions, stiffness);
        let element = element.map_err(|source| ModelError::Flexible {
            body: name.into(),
            source,
        })?;
        let body = self.add_body(name, BodyKind::Flexible, points)?;
        self.bodies[body.0].flexible = Some(FlexibleId(self.flexibles.len()));
        self.flexibles.push(Flexible { body, element });
        self.geometry.rotations.push(Rotation3::identity());
        Ok(body)
    }

    fn add_body(
        &mut self,
        name: &str,
        kind: BodyKind,
        points: &[(&str, Point3<f64>)],
    ) -> Result<BodyId, ModelError> {
        if points.is_empty() {
            return Err(ModelError::NoPoints { body: name.into() });
        }
        if self.body_names.contains_key(name) {
            return Err(ModelError::RepeatedName { name: name.into() });
        }
        let mut seen = HashSet::with_capacity(points.len());
        for (point, position) in points {
            if !seen.insert(*point) {
                return Err(ModelError::RepeatedPoint {
                    body: name.into(),
                    point: (*point).into(),
                });
            }
            if !position.coords.iter().all(|c| c.is_finite()) {
                return Err(ModelError::NotFinite { what: "a position" });
            }
        }
        self.revision = fresh_revision();
        let body = BodyId(self.bodies.len());
        let mut nodes = Vec::with_capacity(points.len());
        for (point, position) in points {
            nodes.push(NodeId(self.nodes.len()));
            self.nodes.push(Node {
                body,
                point: (*point).into(),
            });
            self.geometry.positions.push(*position);
        }
        self.body_names.insert(name.into(), body);
        let mut sorted = nodes.clone();
        sorted.sort_unstable_by_key(|n: &NodeId| &self.nodes[n.0].point);
        self.by_point.push(sorted);
        self.bodies.push(Body {
            name: name.into(),
            kind,
            nodes,
            segments: Vec::new(),
            flexible: None,
            temperature: 0.0,
        });
        Ok(body)
    }

    /// Adds a point to a rigid body, at this position (m). Its node is the last of the model.
    ///
    /// # Errors
    /// A body that is not one of this model or not rigid, a point that it has already, a position that is
    /// not finite.
    pub fn add_point(
        &mut self,
        body: BodyId,
        point: &str,
        position: Point3<f64>,
    ) -> Result<NodeId, ModelError> {
        self.check_body(body)?;
        let own = &self.bodies[body.0];
        let name = || own.name.clone();
        if own.kind != BodyKind::Rigid {
            return Err(ModelError::NotRigid { body: name() });
        }
        if self.node_of(body, point).is_some() {
            let point = point.into();
            return Err(ModelError::RepeatedPoint {
                body: name(),
                point,
            });
        }
        if !position.coords.iter().all(|c| c.is_finite()) {
            return Err(ModelError::NotFinite { what: "a position" });
        }
        self.revision = fresh_revision();
        let node = NodeId(self.nodes.len());
        self.nodes.push(Node {
            body,
            point: point.into(),
        });
        self.geometry.positions.push(position);
        self.bodies[body.0].nodes.push(node);
        let sorted = &mut self.by_point[body.0];
        let place = sorted.partition_point(|own| &*self.nodes[own.0].point < point);
        sorted.insert(place, node);
        Ok(node)
    }

    /// Adds a joint whose frame (columns x, y, z in global axes) is `frame`.
    ///
    /// # Errors
    /// A repeated joint name, a node that is not one of this model, a joint of a body with itself, a
    /// stiffness that is not finite, not symmetric or not positive semidefinite. That the two nodes
    /// lie at one point is checked once the model is whole: [`Model::check`].
    pub fn add_joint(
        &mut self,
        connection: Connection,
        frame: Rotation3<f64>,
    ) -> Result<JointId, ModelError> {
        let joint = || connection.name.clone();
        if self.joint_names.contains(&connection.name) {
            return Err(ModelError::RepeatedName { name: joint() });
        }
        for node in connection.between.into_iter().flatten() {
            self.check_node(node)?;
        }
        let body = |n: Option<NodeId>| n.map(|n| self.nodes[n.0].body);
        if body(connection.between[0]) == body(connection.between[1]) {
            return Err(ModelError::SelfJoined { joint: joint() });
        }
        check_stiffness(&connection.stiffness)
            .and_then(|()| match connection.joint.compliance() {
                Some(own) => check_semidefinite(&own),
                None => Ok(()),
            })
            .map_err(|what| ModelError::Stiffness {
                joint: joint(),
                what,
            })?;
        self.revision = fresh_revision();
        self.joint_names.insert(connection.name.clone());
        if let [Some(first), Some(second)] = connection.between {
            self.joined.push([first, second]);
        }
        self.joints.push(connection);
        self.geometry.frames.push(frame);
        Ok(JointId(self.joints.len() - 1))
    }

    /// Adds a load: a wrench (force (N), moment (N·m), global axes) on a node.
    ///
    /// # Errors
    /// A wrench that is not finite, a node that is not one of this model.
    pub fn add_load(&mut self, node: NodeId, wrench: Vector6<f64>) -> Result<(), ModelError> {
        let load = LoadSet::on(node, wrench);
        self.check_loads(&load)?;
        self.acting = fresh_revision();
        self.loads.nodes.extend(load.nodes);
        Ok(())
    }

    /// Puts loads in place of the model's own.
    ///
    /// # Errors
    /// A load that is not finite, a node, segment or body that is not one of this model.
    pub fn set_loads(&mut self, loads: LoadSet) -> Result<(), ModelError> {
        self.check_loads(&loads)?;
        self.acting = fresh_revision();
        self.loads = loads;
        Ok(())
    }

    /// Takes all loads off; cases stay.
    pub fn clear_loads(&mut self) {
        self.acting = fresh_revision();
        self.loads = LoadSet::default();
    }

    /// Adds a case: loads that act together, beside the model's own loads and without them.
    ///
    /// # Errors
    /// A repeated name, a load that is not finite, a node, segment or body that is not one of this
    /// model.
    pub fn add_case(&mut self, case: LoadCase) -> Result<(), ModelError> {
        if self.cases.iter().any(|other| other.name == case.name) {
            return Err(ModelError::RepeatedName { name: case.name });
        }
        self.check_loads(&case.loads)?;
        self.acting = fresh_revision();
        self.cases.push(case);
        Ok(())
    }

    /// Takes all cases off.
    pub fn clear_cases(&mut self) {
        self.acting = fresh_revision();
        self.cases.clear();
    }

    /// Adds a mass at a node, beside the mass that beams have by their density: its inertia in
    /// global axes, the model being in the configuration it is in now. That the node is one of this
    /// model is checked once the model is whole: [`Model::check`].
    pub fn add_mass(&mut self, node: NodeId, mass: RigidMass) {
        self.acting = fresh_revision();
        self.masses.push(NodeMass { node, mass });
    }

    /// Takes all masses off.
    pub fn clear_masses(&mut self) {
        self.acting = fresh_revision();
        self.masses.clear();
    }

    /// Makes gravity this acceleration (m/s², global axes): beams weigh by their density, and the
    /// masses of nodes weigh. It acts in every case.
    ///
    /// # Errors
    /// One that is not finite; a beam whose material has no density, where it is not zero.
    pub fn set_gravity(&mut self, acceleration: Vector3<f64>) -> Result<(), ModelError> {
        if !acceleration.iter().all(|a| a.is_finite()) {
            return Err(ModelError::NotFinite { what: "gravity" });
        }
        let weightless = |s: &&Segment| s.material.density().is_none();
        if let Some(segment) = self.segments.iter().find(weightless)
            && acceleration != Vector3::zeros()
        {
            return Err(ModelError::NoDensity {
                body: self.bodies[segment.body.0].name.clone(),
            });
        }
        self.acting = fresh_revision();
        self.gravity = acceleration;
        Ok(())
    }

    /// Changes the temperature of a body of beams by `change` (K), all over; it acts in every case.
    ///
    /// # Errors
    /// A change that is not finite; a body that is not made of beams, or whose material has no
    /// coefficient of expansion; a body that is not one of this model.
    pub fn set_temperature(&mut self, body: BodyId, change: f64) -> Result<(), ModelError> {
        if !change.is_finite() {
            let what = "a temperature";
            return Err(ModelError::NotFinite { what });
        }
        self.check_body(body)?;
        let entry = &self.bodies[body.0];
        let body_name = || entry.name.clone();
        if entry.kind != BodyKind::Elastic {
            return Err(ModelError::NotOfBeams { body: body_name() });
        }
        let mut materials = entry.segments.iter().map(|s| &self.segments[s.0].material);
        if materials.any(|material| material.expansion().is_none()) {
            return Err(ModelError::NoExpansion { body: body_name() });
        }
        self.acting = fresh_revision();
        self.bodies[body.0].temperature = change;
        Ok(())
    }

    /// Makes `node` the output. That it is one of this model is checked once the model is whole:
    /// [`Model::check`].
    pub fn set_output(&mut self, node: NodeId) {
        self.revision = fresh_revision();
        self.output = Some(node);
    }

    /// Puts the mechanism into another configuration of the same topology: `geometry` has as
    /// many positions, directions and frames as the model's own.
    /// Masses of nodes turn with their bodies.
    ///
    /// # Errors
    /// A geometry of another size, a mass on a node that is not one of this model; the model is
    /// then as it was.
    pub fn set_geometry(&mut self, geometry: Geometry) -> Result<(), ModelError> {
        self.check_size(&geometry)?;
        for mass in &self.masses {
            self.check_node(mass.node)?;
        }
        self.masses = self.masses_at(&geometry);
        self.geometry = geometry;
        Ok(())
    }

    /// All bodies.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }
    /// All nodes.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }
    /// All segments.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }
    /// All flexible bodies.
    pub fn flexibles(&self) -> &[Flexible] {
        &self.flexibles
    }
    /// All joints.
    pub fn joints(&self) -> &[Connection] {
        &self.joints
    }

    /// The drives of all joints, in their order ([`Connection::drives`]).
    pub fn drives(&self) -> impl Iterator<Item = (JointId, Dof)> {
        let joints = self.joints.iter().enumerate();
        joints.flat_map(|(k, joint)| joint.drives().iter().map(move |dof| (JointId(k), dof)))
    }
    /// The loads on nodes.
    pub fn loads(&self) -> &[Load] {
        &self.loads.nodes
    }
    /// All loads.
    pub fn load_set(&self) -> &LoadSet {
        &self.loads
    }
    /// All cases.
    pub fn cases(&self) -> &[LoadCase] {
        &self.cases
    }
    /// Acceleration of gravity (m/s²), global axes.
    pub fn gravity(&self) -> &Vector3<f64> {
        &self.gravity
    }
    /// Whether nothing acts but loads on nodes in global axes, cases and misfits apart.
    pub fn has_plain_loads(&self) -> bool {
        let global = |load: &Load| load.axes == Axes::Global;
        self.loads.lines.is_empty()
            && self.loads().iter().all(global)
            && self.gravity == Vector3::zeros()
            && self.bodies.iter().all(|body| body.temperature == 0.0)
    }
    /// All masses of nodes.
    pub fn masses(&self) -> &[NodeMass] {
        &self.masses
    }
    /// The output node, once it is set.
    pub fn output(&self) -> Option<NodeId> {
        self.output
    }
    /// The configuration the model was built in.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }
    /// The body of this name.
    pub fn body(&self, name: &str) -> Option<BodyId> {
        self.body_names.get(name).copied()
    }
    /// The node of `body` at `point`.
    pub fn node(&self, body: &str, point: &str) -> Option<NodeId> {
        self.node_of(self.body(body)?, point)
    }
    /// The node of a body at `point`, or of what is known as a part of it ([`Model::know_as`]); `None` where there is
    /// none, or no such body.
    pub fn node_of(&self, body: BodyId, point: &str) -> Option<NodeId> {
        let nodes = self.by_point.get(body.0)?;
        let name = |n: &NodeId| self.nodes[n.0].point.as_str();
        match nodes.binary_search_by(|n| name(n).cmp(point)) {
            Ok(place) => Some(nodes[place]),
            Err(_) => {
                let mut parts = self.parts_of(body).iter();
                parts.find_map(|part| self.node_of(*part, point))
            }
        }
    }
    /// `body.point` of a node; its number where it is not one of this model.
    pub fn node_name(&self, node: NodeId) -> String {
        match self.nodes.get(node.0) {
            Some(node) => format!("{}.{}", self.bodies[node.body.0].name, node.point),
            None => format!("node {}", node.0),
        }
    }
}

/// A point that no chain of members connects with the first.
fn loose_point(points: usize, members: &[Member]) -> Option<usize> {
    let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); points];
    for member in members {
        let [a, b] = member.ends;
        neighbours[a].push(b);
        neighbours[b].push(a);
    }
    let mut connected = vec![false; points];
    let mut reached = vec![0];
    while let Some(point) = reached.pop() {
        if !std::mem::replace(&mut connected[point], true) {
            reached.extend(&neighbours[point]);
        }
    }
    connected.iter().position(|connected| !connected)
}
