//! A mode between the nodes.

use hyperstat_elements::{element_frame, rotate_vector6};
use hyperstat_model::{Model, SegmentBeam, SegmentId};
use nalgebra::Vector6;

use crate::error::SolveError;
use crate::modal::Mode;

impl Mode {
    /// Displacement of the axis of a segment at `xi` (0 to 1) along it, global axes
    /// \[m/√kg, rad/√kg\]: between the nodes of its elements the beam's own static curve, which are
    /// the shapes that the masses are made with (cubic for a prismatic beam without shear).
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
            || self.inner.len() != model.segments().len()
        {
            return Err(SolveError::ForeignModel);
        }
        let (segment, geometry) = (&model.segments()[id.0], model.geometry());
        let [start, end] = segment.ends.map(|node| geometry.positions[node.0]);
        let span = end - start;
        let frame = element_frame(&span, geometry.y_axes[id.0].as_ref())?;
        let inner = &self.inner[id.0];
        let count = inner.len() + 1;
        let along = xi * count as f64;
        let element = (along.floor().max(0.0) as usize).min(count - 1);
        let place = |k: usize| k as f64 / count as f64;
        let taper = segment.change_of_section()?;
        let beam = SegmentBeam::new(
            &segment.material,
            &segment.section,
            taper
                .map(|taper| taper.part(place(element), place(element + 1)))
                .as_ref(),
            span.norm() / count as f64,
        )?;
        let at = |k: usize| match k {
            0 => &self.displacements[segment.ends[0].0],
            k if k == count => &self.displacements[segment.ends[1].0],
            k => &inner[k - 1],
        };
        let to_local = frame.inverse();
        let [first, second] = [element, element + 1].map(|k| rotate_vector6(at(k), &to_local));
        let moved = beam.displacement(along - element as f64, &first, &second, None);
        Ok(rotate_vector6(&moved, &frame))
    }
}
