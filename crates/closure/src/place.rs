//! A configuration as a geometry of the model: all parts move with their bodies, and what slides
//! gives way.

use hyperstat_model::{BodyKind, Geometry, Model, NodeId};
use nalgebra::{Isometry3, Point3, Rotation3, Vector3};

use crate::error::ClosureError;
use crate::linkage::{Configuration, Linkage};
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
    /// Nodes that hold still in their body: with other joints, loads or the output.
    uses: Vec<usize>,
}

impl Parts {
    pub fn new(model: &Model, centre: Vector3<f64>, size: f64) -> Result<Self, ClosureError> {
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
        for node in joints.chain(loads).chain([model.output()]).flatten() {
            uses[node.0] += 1;
        }
        Ok(Self {
            model: model.clone(),
            centre,
            size,
            y_axes,
            uses,
        })
    }

    /// Writes a configuration into a geometry of the model.
    pub fn write(
        &self,
        linkage: &Linkage,
        configuration: &Configuration,
        geometry: &mut Geometry,
    ) -> Result<(), ClosureError> {
        self.model.check_size(geometry)?;
        let posture = linkage.posture(configuration);
        let home = self.model.geometry();
        let mut placed = home.clone();
        for (node, position) in placed.positions.iter_mut().enumerate() {
            let body = posture.bodies[self.model.nodes()[node].body.0];
            let moved = body * Point3::from(home.positions[node].coords - self.centre);
            *position = moved + self.centre;
        }
        for (k, segment) in self.model.segments().iter().enumerate() {
            let body = posture.bodies[segment.body.0];
            placed.y_axes[k] = Some(body.rotation * self.y_axes[k]);
        }
        for (k, flexible) in self.model.flexibles().iter().enumerate() {
            let turn = posture.bodies[flexible.body.0].rotation;
            placed.rotations[k] = turn.to_rotation_matrix() * home.rotations[k];
        }
        let rigid = placed.positions.clone();
        for (k, joint) in linkage.joints.iter().enumerate() {
            let body = joint.bodies[0].map_or(Isometry3::identity(), |b| posture.bodies[b]);
            let first = body * joint.home;
            let values = linkage.values(k, configuration);
            let standing = joint.standing(&first, values);
            placed.frames[k] = turned(&body, &first, &standing, &home.frames[k]);
            self.meet(k, joint, &standing, &rigid, &mut placed.positions)?;
        }
        *geometry = placed;
        Ok(())
    }

    /// Brings the two nodes of a joint to one place.
    fn meet(
        &self,
        index: usize,
        joint: &JointMotion,
        standing: &Isometry3<f64>,
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
        let places = [preferred, own[0], own[1], origin];
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
        standing: &Isometry3<f64>,
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
        let body = self.model.nodes()[node.0].body;
        self.uses[node.0] <= 1
            && match self.model.bodies()[body.0].kind {
                BodyKind::Rigid => true,
                BodyKind::Elastic => self.spans(node, rigid).all(|span| {
                    let along = span.cross(travel).norm() <= ALONG * span.norm() * travel.norm();
                    along && span.dot(&(span + travel)) > 0.0
                }),
                BodyKind::Flexible => false,
            }
    }

    /// Whether a beam runs straight on, on both sides of a node, along `travel`.
    fn runs_on(&self, node: NodeId, travel: &Vector3<f64>, rigid: &[Point3<f64>]) -> bool {
        let sides = self.spans(node, rigid).map(|span| span.dot(travel) > 0.0);
        let (ahead, behind): (Vec<bool>, Vec<bool>) = sides.partition(|side| *side);
        !ahead.is_empty() && !behind.is_empty() && self.gives_way(node, travel, rigid)
    }

    /// From the other ends of a node's segments to the node.
    fn spans<'a>(
        &'a self,
        node: NodeId,
        rigid: &'a [Point3<f64>],
    ) -> impl Iterator<Item = Vector3<f64>> + 'a {
        let body = self.model.nodes()[node.0].body;
        let segments = self.model.bodies()[body.0].segments.iter();
        segments.filter_map(move |s| {
            let [a, b] = self.model.segments()[s.0].ends;
            let other = match (a == node, b == node) {
                (true, false) => b,
                (false, true) => a,
                _ => return None,
            };
            Some(rigid[node.0] - rigid[other.0])
        })
    }
}

/// The joint's frame: that at home turned with its first body, and then as far as the joint's
/// own motion takes it to where its basis holds.
fn turned(
    body: &Isometry3<f64>,
    first: &Isometry3<f64>,
    standing: &Isometry3<f64>,
    home: &Rotation3<f64>,
) -> Rotation3<f64> {
    let own = standing.rotation * first.rotation.inverse();
    (own * body.rotation).to_rotation_matrix() * home
}
