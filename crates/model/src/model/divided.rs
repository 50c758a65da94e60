//! The model with the nodes inside its segments made nodes of their own.

use nalgebra::Vector3;

use crate::model::Model;
use crate::parts::{Geometry, Node, NodeId, Segment, SegmentId, Tapering};
use crate::revision::fresh_revision;
use crate::segment_beam::segment_beam;
use hyperstat_elements::ElementError;

impl Model {
    /// The same model without loads, every segment made as many segments as `parts` says of it.
    /// Nodes keep their ids; the new ones follow them, segment by segment, each from the first end
    /// on. The parts of a segment stand together, in the order of the segments.
    ///
    /// # Errors
    /// A segment that cannot be formed.
    pub fn divided(&self, parts: &[usize]) -> Result<Self, ElementError> {
        let mut whole = self.clone();
        whole.revision = fresh_revision();
        whole.clear_loads();
        whole.segments.clear();
        for body in &mut whole.bodies {
            body.segments.clear();
        }
        for (segment, &count) in self.segments.iter().zip(parts) {
            let place = |k: usize| k as f64 / count as f64;
            let mut first = segment.ends[0];
            for k in 0..count {
                let last = if k + 1 == count {
                    segment.ends[1]
                } else {
                    whole.add_inner_node(segment, k + 1)
                };
                let taper = segment.taper.as_ref().map(|whole| Tapering {
                    to: whole.to.clone(),
                    part: [k, k + 1].map(|k| whole.along(place(k))),
                });
                let id = SegmentId(whole.segments.len());
                whole.bodies[segment.body.0].segments.push(id);
                whole.segments.push(Segment {
                    body: segment.body,
                    ends: [first, last],
                    material: segment.material.clone(),
                    section: segment.section.clone(),
                    taper,
                    elements: 1,
                    y_axis_given: segment.y_axis_given,
                });
                first = last;
            }
        }
        whole.geometry = self.divided_geometry(&self.geometry, parts)?;
        Ok(whole)
    }

    fn add_inner_node(&mut self, segment: &Segment, k: usize) -> NodeId {
        let [from, to] = segment.ends.map(|node| &self.nodes[node.0].point);
        let point = format!("{from}-{to}.{k}");
        let id = NodeId(self.nodes.len());
        self.nodes.push(Node {
            body: segment.body,
            point,
        });
        self.bodies[segment.body.0].nodes.push(id);
        id
    }

    /// The geometry of [`Model::divided`] from one of this model.
    ///
    /// # Errors
    /// A segment that cannot be formed.
    pub fn divided_geometry(
        &self,
        geometry: &Geometry,
        parts: &[usize],
    ) -> Result<Geometry, ElementError> {
        let mut positions = geometry.positions.clone();
        let mut y_axes = Vec::new();
        for (k, (segment, &count)) in self.segments.iter().zip(parts).enumerate() {
            // All parts have the axes of the whole.
            let (_, frame, span) = segment_beam(self, geometry, SegmentId(k))?;
            let y_axis: Vector3<f64> = frame.matrix().column(1).into_owned();
            let first = geometry.positions[segment.ends[0].0];
            positions.extend((1..count).map(|k| first + span * (k as f64 / count as f64)));
            y_axes.resize(y_axes.len() + count, Some(y_axis));
        }
        Ok(Geometry {
            positions,
            y_axes,
            frames: geometry.frames.clone(),
            rotations: geometry.rotations.clone(),
        })
    }
}
