//! A configuration as a geometry of the model: all parts move with their bodies, and what slides
//! gives way.

use hyperstat_model::{BodyKind, Geometry, Model, NodeId};
use nalgebra::{IsometryMatrix3, Point3, Rotation3, Translation3, Vector3};

use crate::error::ClosureError;
use crate::linkage::Linkage;
use crate::motion::JointMotion;

/// Two points of a joint that are apart by less than this, over the mechanism's size, are one:
/// what redundant loops of typed coordinates leave open.
const ONE_PLACE: f64 = 2e-6;
/// Sine of the angle under which a beam still runs along the travel.
const ALONG: f64 = 1e-6;

/// What stays the same in every configuration.
#[derive(Debug, Clone)]
pub(crate) struct Parts {
    pub model: Model,
    /// Middle of the model at home.
    pub centre: Vector3<f64>,
    pub size: f64,
    /// Direction of every segment's local y at home, the default one too.
    pub y_axes: Vec<Vector3<f64>>,
    /// Of every node, how it may be moved in its body.
    nodes: Vec<Freedom>,
}

/// How a node may be moved in its body without another meaning.
#[derive(Debug, Clone)]
enum Freedom {
    /// Not at all: it has other joints, loads or the output, or its body is one as a whole.
    Held,
    /// In every direction: a point of a rigid body.
    Any,
    /// Along the beam, from the other ends of its segments.
    Along(Vec<NodeId>),
}

/// Room for what is not yet a geometry.
#[derive(Debug, Default, Clone)]
pub(crate) struct Room {
    /// Nodes where their bodies take them.
    rigid: Vec<Point3<f64>>,
    positions: Vec<Point3<f64>>,
    frames: Vec<Rotation3<f64>>,
}

impl Parts {
    /// Of a model whose poses are those of a node. That node and the output are fixed in their bodies.
    pub fn new(
        model: &Model,
        posed: NodeId,
        centre: Vector3<f64>,
        size: f64,
    ) -> Result<Self, ClosureError> {
        let geometry = model.geometry();
        let mut y_axes = Vec::new();
        for (segment, y) in model.segments().iter().zip(&geometry.y_axes) {
            let [a, b] = segment.ends.map(|n| geometry.positions[n.0]);
            let frame = hyperstat_elements::element_frame(&(b - a), y.as_ref())?;
            y_axes.push(y.unwrap_or_else(|| frame.matrix().column(1).into_owned()));
        }
        let mut uses = vec![0; model.nodes().len()];
        let joints = model.joints().iter().flat_map(|j| j.between);
        let loads = model.loads().iter().map(|load| Some(load.node));
        let held = [Some(posed), model.output().filter(|node| *node != posed)];
        for node in joints.chain(loads).chain(held).flatten() {
            uses[node.0] += 1;
        }
        Ok(Self {
            model: model.clone(),
            centre,
            size,
            y_axes,
            nodes: (0..model.nodes().len())
                .map(|node| Freedom::of(model, NodeId(node), uses[node]))
                .collect(),
        })
    }

    /// The other ends of the beams at a node that may be moved along them.
    pub fn along(&self, node: NodeId) -> &[NodeId] {
        match &self.nodes[node.0] {
            Freedom::Along(others) => others,
            Freedom::Held | Freedom::Any => &[],
        }
    }

    /// Writes the bodies' motions from home, in metres from the centre, and the values of all columns
    /// into a geometry of the model, which stays as it was where that fails. Allocates nothing once
    /// `room` has grown.
    pub fn write(
        &self,
        linkage: &Linkage,
        bodies: &[IsometryMatrix3<f64>],
        values: &[f64],
        room: &mut Room,
        geometry: &mut Geometry,
    ) -> Result<(), ClosureError> {
        self.model.check_size(geometry)?;
        let home = self.model.geometry();
        let Room {
            rigid,
            positions,
            frames,
        } = room;
        rigid.clear();
        rigid.extend(home.positions.iter().enumerate().map(|(node, position)| {
            let body = &bodies[self.model.nodes()[node].body.0];
            body * Point3::from(position.coords - self.centre) + self.centre
        }));
        positions.clone_from(rigid);
        frames.clear();
        for (k, joint) in linkage.joints.iter().enumerate() {
            let body = joint.bodies[0].map(|b| &bodies[b]);
            let frame = &home.frames[k];
            let place = joint.home.translation.vector;
            let first = match body {
                Some(body) => IsometryMatrix3::from_parts(
                    Translation3::from((body * Point3::from(place)).coords),
                    body.rotation * frame,
                ),
                None => IsometryMatrix3::from_parts(place.into(), *frame),
            };
            let standing = joint.standing(&first, &values[linkage.starts[k]..]);
            // The frame at home turned with its first body, and then as far as the joint's own motion
            // takes it to where its basis holds.
            frames.push(standing.rotation);
            self.meet(k, joint, &standing, rigid, positions)?;
        }
        geometry.positions.copy_from_slice(positions);
        geometry.frames.copy_from_slice(frames);
        for (k, segment) in self.model.segments().iter().enumerate() {
            geometry.y_axes[k] = Some(bodies[segment.body.0].rotation * self.y_axes[k]);
        }
        for (k, flexible) in self.model.flexibles().iter().enumerate() {
            geometry.rotations[k] = bodies[flexible.body.0].rotation * home.rotations[k];
        }
        Ok(())
    }

    /// Brings the two nodes of a joint to one place.
    fn meet(
        &self,
        index: usize,
        joint: &JointMotion,
        standing: &IsometryMatrix3<f64>,
        rigid: &[Point3<f64>],
        positions: &mut [Point3<f64>],
    ) -> Result<(), ClosureError> {
        let [Some(first), Some(second)] = joint.nodes else {
            return self.meet_ground(joint, standing, rigid, positions);
        };
        let own = [rigid[first.0], rigid[second.0]];
        let origin = Point3::from(standing.translation.vector + self.centre);
        let apart = |p: &Point3<f64>, q: &Point3<f64>| (p - q).norm() > ONE_PLACE * self.size;
        // Along a rail the joint stays with the other body; else it stands on the first.
        let rail =
            |node: NodeId, to: &Point3<f64>| self.runs_on(node, &(to - rigid[node.0]), rigid);
        let preferred = if rail(first, &own[1]) { own[1] } else { own[0] };
        let other = if preferred == own[0] { own[1] } else { own[0] };
        let places = [preferred, other, origin];
        let slides = |node: NodeId, place: &Point3<f64>| {
            let travel = place - rigid[node.0];
            travel == Vector3::zeros() || self.gives_way(node, &travel, rigid)
        };
        let holds = |place: &Point3<f64>| {
            joint.holds_about(&(standing.rotation.inverse() * (place - origin)))
        };
        let fits =
            |place: &&Point3<f64>| slides(first, place) && slides(second, place) && holds(place);
        let stays = |node: NodeId, place: &Point3<f64>| !apart(place, &rigid[node.0]);
        let nearly_fits = |place: &&Point3<f64>| {
            let moves = |node: NodeId| stays(node, place) || slides(node, place);
            moves(first) && moves(second) && holds(place)
        };
        // A travel however small is made; only what cannot be may stay open a little.
        let place = places.iter().find(fits);
        let Some(place) = place.or_else(|| places.iter().find(nearly_fits)) else {
            if !apart(&own[0], &own[1]) && !apart(&own[0], &origin) {
                return Ok(());
            }
            let name = |n: NodeId| {
                let body = self.model.nodes()[n.0].body;
                self.model.bodies()[body.0].name.clone()
            };
            return Err(ClosureError::Slides {
                joint: self.model.joints()[index].name.clone(),
                first: name(first),
                second: name(second),
                travel: (own[1] - own[0]).norm(),
                help: "give one of them the joint at the end of a beam along the travel, or at a \
                       point of a rigid body that no other joint and no load has",
            });
        };
        for node in [first, second] {
            if slides(node, place) {
                positions[node.0] = *place;
            }
        }
        Ok(())
    }

    /// A joint to the ground stands where its body's node is; a rail slides through a bearing
    /// that the ground holds.
    fn meet_ground(
        &self,
        joint: &JointMotion,
        standing: &IsometryMatrix3<f64>,
        rigid: &[Point3<f64>],
        positions: &mut [Point3<f64>],
    ) -> Result<(), ClosureError> {
        let Some(node) = joint.nodes.into_iter().flatten().next() else {
            return Ok(());
        };
        let bearing = joint.home.translation.vector + self.centre;
        let travel = bearing - rigid[node.0].coords;
        let offset =
            standing.rotation.inverse() * (bearing - self.centre - standing.translation.vector);
        let slides = travel != Vector3::zeros() && self.runs_on(node, &travel, rigid);
        if slides && joint.holds_about(&offset) {
            positions[node.0] = bearing.into();
        }
        Ok(())
    }

    /// Whether a node can be moved along its body without another meaning: on a rigid body
    /// where nothing else holds it, on a beam along the beam.
    fn gives_way(&self, node: NodeId, travel: &Vector3<f64>, rigid: &[Point3<f64>]) -> bool {
        match &self.nodes[node.0] {
            Freedom::Held => false,
            Freedom::Any => true,
            Freedom::Along(others) => others.iter().all(|other| {
                let span = rigid[node.0] - rigid[other.0];
                let across = span.cross(travel).norm_squared();
                let whole = span.norm_squared() * travel.norm_squared();
                across <= ALONG * ALONG * whole && span.dot(&(span + travel)) > 0.0
            }),
        }
    }

    /// Whether a beam runs straight on, on both sides of a node, along `travel`.
    fn runs_on(&self, node: NodeId, travel: &Vector3<f64>, rigid: &[Point3<f64>]) -> bool {
        let Freedom::Along(others) = &self.nodes[node.0] else {
            return false;
        };
        let ahead = |other: &NodeId| (rigid[node.0] - rigid[other.0]).dot(travel) > 0.0;
        others.iter().any(ahead)
            && others.iter().any(|other| !ahead(other))
            && self.gives_way(node, travel, rigid)
    }
}

impl Freedom {
    fn of(model: &Model, node: NodeId, uses: usize) -> Self {
        let body = &model.bodies()[model.nodes()[node.0].body.0];
        if uses > 1 {
            return Self::Held;
        }
        match body.kind {
            BodyKind::Rigid => Self::Any,
            BodyKind::Flexible => Self::Held,
            BodyKind::Elastic => {
                let segments = body.segments.iter().map(|s| model.segments()[s.0].ends);
                let others = segments.filter_map(|[a, b]| match (a == node, b == node) {
                    (true, false) => Some(b),
                    (false, true) => Some(a),
                    _ => None,
                });
                Self::Along(others.collect())
            }
        }
    }
}
