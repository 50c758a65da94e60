//! A model in one configuration, with what follows from the two alone: its size, the beams of its
//! segments, the maps of its joints.

use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

use hyperstat_elements::{ElementError, element_frame};
use hyperstat_model::{
    Geometry, JointId, Model, SegmentBeam, SegmentId, characteristic_length, segment_beam,
    to_directions,
};
use nalgebra::{Matrix6, Rotation3, Vector3};

/// A segment's beam where a configuration puts it.
#[derive(Debug, Clone)]
pub(crate) struct PlacedBeam {
    pub beam: SegmentBeam,
    /// Its element frame.
    pub frame: Rotation3<f64>,
    /// From its first node to its second (m).
    pub span: Vector3<f64>,
}

/// The beams of all segments, worked out when the first of them is asked for.
#[derive(Debug, Default)]
pub(crate) struct Beams(OnceLock<Result<Arc<[PlacedBeam]>, ElementError>>);

/// A model in one configuration.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Posture<'a> {
    pub model: &'a Model,
    pub geometry: &'a Geometry,
    /// The mechanism's size (m).
    pub size: f64,
    beams: Option<&'a Beams>,
}

impl<'a> Posture<'a> {
    /// One that is looked at once, as a pose of a sweep is: it keeps nothing, and allocates nothing.
    pub fn new(model: &'a Model, geometry: &'a Geometry) -> Self {
        Self {
            model,
            geometry,
            size: characteristic_length(geometry),
            beams: None,
        }
    }

    /// One whose beams are kept.
    pub fn keeping(model: &'a Model, geometry: &'a Geometry, size: f64, beams: &'a Beams) -> Self {
        Self {
            model,
            geometry,
            size,
            beams: Some(beams),
        }
    }

    /// The beams of all segments.
    pub fn beams(&self) -> Result<Arc<[PlacedBeam]>, ElementError> {
        let all = || {
            let segments = (0..self.model.segments().len()).map(SegmentId);
            segments.map(|id| self.place(id)).collect()
        };
        match self.beams {
            Some(beams) => beams.0.get_or_init(all).clone(),
            None => all(),
        }
    }

    /// Mean length of the arms from the bodies' first nodes to their joints (m), which keeps the
    /// conditions of a small part of a large mechanism far from zero; the mechanism's size where
    /// there are none.
    pub fn arm_length(&self) -> f64 {
        let Posture {
            model, geometry, ..
        } = *self;
        let nodes = model.joints().iter().flat_map(|joint| joint.between);
        let arms = nodes.flatten().map(|node| {
            let origin = model.bodies()[model.nodes()[node.0].body.0].nodes[0];
            (geometry.positions[node.0] - geometry.positions[origin.0]).norm()
        });
        let (sum, count) = arms
            .filter(|arm| *arm > 0.0)
            .fold((0.0, 0.0), |(sum, count), arm| (sum + arm, count + 1.0));
        if sum > 0.0 { sum / count } else { self.size }
    }

    /// The beam of a segment.
    pub fn beam(&self, id: SegmentId) -> Result<Cow<'a, PlacedBeam>, ElementError> {
        let Some(beams) = self.beams else {
            return self.place(id).map(Cow::Owned);
        };
        let all = beams.0.get_or_init(|| {
            Posture {
                beams: None,
                ..*self
            }
            .beams()
        });
        match all {
            Ok(all) => Ok(Cow::Borrowed(&all[id.0])),
            Err(error) => Err(error.clone()),
        }
    }

    fn place(&self, id: SegmentId) -> Result<PlacedBeam, ElementError> {
        let (beam, frame, span) = segment_beam(self.model, self.geometry, id)?;
        Ok(PlacedBeam { beam, frame, span })
    }

    /// The frame of a segment, without its beam.
    pub fn segment_frame(&self, id: SegmentId) -> Result<Rotation3<f64>, ElementError> {
        let [a, b] = self.model.segments()[id.0].ends;
        let span = self.geometry.positions[b.0] - self.geometry.positions[a.0];
        element_frame(&span, self.geometry.y_axes[id.0].as_ref())
    }

    /// From a twist in global axes to a joint's directions.
    pub fn direction_map(&self, joint: JointId) -> Matrix6<f64> {
        let basis = self.model.joints()[joint.0].joint.basis();
        to_directions(&basis, &self.geometry.frames[joint.0])
    }
}
