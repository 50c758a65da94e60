//! What must belong together: the ids, the geometry and the joints of one model.

use nalgebra::Vector3;

use crate::error::ModelError;
use crate::loads::{Axes, LoadSet};
use crate::model::Model;
use crate::parts::{BodyId, Geometry, JointId, NodeId, SegmentId};
use crate::size::characteristic_length;

/// Two nodes of a joint that are no farther apart, over the mechanism's size, are one point:
/// coordinates are typed to six digits or more, and redundant loops of such coordinates leave a few
/// units of the sixth digit open, which is more of the size of a mechanism that is folded.
const ONE_POINT: f64 = 1e-5;

impl Model {
    /// Whether the model is one whole: its output and the nodes of its masses are its own, and the
    /// two nodes of every joint lie at one point (to 1e-5 of the mechanism's size). Whatever solves
    /// a model asks this first.
    ///
    /// # Errors
    /// What is not.
    pub fn check(&self) -> Result<(), ModelError> {
        let masses = self.masses.iter().map(|mass| mass.node);
        for node in masses.chain(self.output) {
            self.check_node(node)?;
        }
        self.check_joints(&self.geometry, self.one_point())
    }

    /// A number of this model's bodies, joints and output: the same in clones, until they change.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// The same with a number of what acts on it.
    pub fn revisions(&self) -> [u64; 2] {
        [self.revision, self.acting]
    }

    /// How far apart (m) two nodes of a joint may lie.
    pub fn one_point(&self) -> f64 {
        ONE_POINT * characteristic_length(&self.geometry)
    }

    /// Refuses a geometry that is not one of this model, or in which the two nodes of a joint lie
    /// farther apart than `one_point` (m).
    pub fn check_geometry(&self, geometry: &Geometry, one_point: f64) -> Result<(), ModelError> {
        self.check_size(geometry)?;
        self.check_joints(geometry, one_point)
    }

    /// Refuses a geometry of another size.
    ///
    /// # Errors
    /// [`ModelError::ForeignGeometry`].
    pub fn check_size(&self, geometry: &Geometry) -> Result<(), ModelError> {
        let (expected, found) = (self.geometry.counts(), geometry.counts());
        if expected == found {
            Ok(())
        } else {
            Err(ModelError::ForeignGeometry { expected, found })
        }
    }

    fn check_joints(&self, geometry: &Geometry, one_point: f64) -> Result<(), ModelError> {
        // Most often they are the same to the last bit; every pose of a sweep comes here. NaN is no point.
        let positions = &*geometry.positions;
        let mut apart = Vector3::zeros();
        for [first, second] in &self.joined {
            let between = positions[first.0] - positions[second.0];
            apart += between.component_mul(&between);
        }
        if apart == Vector3::zeros() {
            return Ok(());
        }
        for joint in &self.joints {
            let [Some(first), Some(second)] = joint.between else {
                continue;
            };
            let [p, q] = [first, second].map(|node| geometry.positions[node.0]);
            let distance = (p - q).norm();
            if distance > one_point || distance.is_nan() {
                return Err(ModelError::Apart {
                    joint: joint.name.clone(),
                    first: self.node_name(first),
                    second: self.node_name(second),
                    distance,
                });
            }
        }
        Ok(())
    }

    pub(crate) fn check_body(&self, body: BodyId) -> Result<(), ModelError> {
        own("body", body.0, self.bodies.len())
    }

    pub(crate) fn check_node(&self, node: NodeId) -> Result<(), ModelError> {
        own("node", node.0, self.nodes.len())
    }

    pub(crate) fn check_joint(&self, joint: JointId) -> Result<(), ModelError> {
        own("joint", joint.0, self.joints.len())
    }

    /// Refuses a segment that is not one of this model.
    pub fn check_segment(&self, segment: SegmentId) -> Result<(), ModelError> {
        own("segment", segment.0, self.segments.len())
    }

    /// Refuses loads that are not finite, or on what is not of this model.
    pub fn check_loads(&self, loads: &LoadSet) -> Result<(), ModelError> {
        let wrenches = loads.nodes.iter().map(|load| &load.wrench);
        let lines = loads.lines.iter().flat_map(|load| &load.ends);
        if !wrenches.chain(lines).flatten().all(|c| c.is_finite()) {
            return Err(ModelError::NotFinite { what: "a load" });
        }
        for load in &loads.nodes {
            self.check_node(load.node)?;
        }
        for load in &loads.lines {
            self.check_segment(load.segment)?;
        }
        let axes = loads.nodes.iter().map(|load| &load.axes);
        for axes in axes.chain(loads.lines.iter().map(|load| &load.axes)) {
            if let Axes::Body { body, .. } = axes {
                self.check_body(*body)?;
            }
        }
        Ok(())
    }
}

impl Geometry {
    /// Numbers of nodes, segments, joints and flexible bodies.
    pub fn counts(&self) -> [usize; 4] {
        [
            self.positions.len(),
            self.y_axes.len(),
            self.frames.len(),
            self.rotations.len(),
        ]
    }
}

/// Refuses an id beyond those of a model.
fn own(what: &'static str, index: usize, count: usize) -> Result<(), ModelError> {
    if index < count {
        Ok(())
    } else {
        Err(ModelError::ForeignId { what, index, count })
    }
}
