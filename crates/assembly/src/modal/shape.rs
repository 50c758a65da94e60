//! A mode between the nodes.

use std::sync::Arc;

use hyperstat_elements::{element_frame, rotate_vector6};
use hyperstat_model::{Model, SegmentId};
use nalgebra::Vector6;

use crate::error::SolveError;
use crate::modal::Mode;
use crate::modal::member::Member;

/// What a segment does in a mode, part by part.
#[derive(Debug, Clone)]
pub(super) struct Curve(pub Vec<Part>);

/// What a part of a segment does in a mode.
#[derive(Debug, Clone)]
pub(super) struct Part {
    pub member: Arc<Member>,
    /// Displacements of its ends, element frame.
    pub ends: [Vector6<f64>; 2],
    /// Amounts of its inner shapes.
    pub amounts: Vec<f64>,
}

impl Part {
    /// Displacement at `xi` (0 to 1) along it, element frame.
    fn at(&self, xi: f64) -> Vector6<f64> {
        let (member, [first, second]) = (&self.member, &self.ends);
        let moved = member.beam.displacement(xi, first, second, None);
        if self.amounts.is_empty() || xi == 0.0 || xi == 1.0 {
            return moved;
        }
        let inner = &member.inner;
        moved + inner.displacement(member.beam.straight(), xi, &self.amounts)
    }
}

impl Curve {
    /// Displacement at `xi` (0 to 1) along the segment, element frame.
    pub fn at(&self, xi: f64) -> Vector6<f64> {
        let along = xi * self.0.len() as f64;
        let part = (along.floor().max(0.0) as usize).min(self.0.len() - 1);
        self.0[part].at(along - part as f64)
    }
}

impl Mode {
    /// Displacement of the axis of a segment at `xi` (0 to 1) along it, global axes
    /// \[m/√kg, rad/√kg\]: the mode's own shape where masses are exact; else between the nodes of its
    /// elements the beam's own static curve, which are the shapes that the masses are made with
    /// (cubic for a prismatic beam without shear).
    ///
    /// `model` is the one whose mode it is, in its own configuration.
    ///
    /// # Errors
    /// A segment or model that is not the mode's.
    pub fn segment_displacement(
        &self,
        model: &Model,
        id: SegmentId,
        xi: f64,
    ) -> Result<Vector6<f64>, SolveError> {
        model.check_segment(id)?;
        if self.displacements.len() != model.nodes().len()
            || self.curves.len() != model.segments().len()
        {
            return Err(SolveError::ForeignModel);
        }
        let (segment, geometry) = (&model.segments()[id.0], model.geometry());
        let [start, end] = segment.ends.map(|node| geometry.positions[node.0]);
        let frame = element_frame(&(end - start), geometry.y_axes[id.0].as_ref())?;
        Ok(rotate_vector6(&self.curves[id.0].at(xi), &frame))
    }
}
