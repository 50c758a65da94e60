//! Displacements between the nodes of a segment.

use hyperstat_elements::{BeamLoad, rotate_vector6};
use hyperstat_model::{Geometry, Model, SegmentId, segment_beam};
use nalgebra::Vector6;

use crate::error::SolveError;

/// Displacement of the axis of a segment at `xi` (0 to 1) along it, global axes: its elastic
/// curve between the displacements of its ends, under the load between them (`None`: no load).
///
/// # Errors
/// A segment that cannot be formed; a segment, geometry or displacements of another model.
pub fn segment_displacement(
    model: &Model,
    geometry: &Geometry,
    displacements: &[Vector6<f64>],
    segment: SegmentId,
    load: Option<&BeamLoad>,
    xi: f64,
) -> Result<Vector6<f64>, SolveError> {
    let mut curve = curve(model, geometry, displacements, segment, load, [xi])?;
    Ok(curve.pop().unwrap_or_default())
}

/// Displacements of the nodes inside a segment, between its elements, in their order along it.
pub(crate) fn inner_displacements(
    model: &Model,
    geometry: &Geometry,
    displacements: &[Vector6<f64>],
    segment: SegmentId,
    load: &BeamLoad,
) -> Result<Vec<Vector6<f64>>, SolveError> {
    model.check_segment(segment)?;
    let elements = model.segments()[segment.0].elements;
    let places = (1..elements).map(|k| k as f64 / elements as f64);
    curve(model, geometry, displacements, segment, Some(load), places)
}

/// Displacements at several places (0 to 1) along a segment, global axes.
pub(crate) fn curve(
    model: &Model,
    geometry: &Geometry,
    displacements: &[Vector6<f64>],
    segment: SegmentId,
    load: Option<&BeamLoad>,
    places: impl IntoIterator<Item = f64>,
) -> Result<Vec<Vector6<f64>>, SolveError> {
    model.check_segment(segment)?;
    model.check_size(geometry)?;
    if displacements.len() != model.nodes().len() {
        return Err(SolveError::ForeignModel);
    }
    let load = load.filter(|load| **load != BeamLoad::none());
    let (beam, frame, _) = segment_beam(model, geometry, segment)?;
    let to_local = frame.inverse();
    let ends = model.segments()[segment.0].ends;
    let [first, second] = ends.map(|node| rotate_vector6(&displacements[node.0], &to_local));
    let at = |xi| rotate_vector6(&beam.displacement(xi, &first, &second, load), &frame);
    Ok(places.into_iter().map(at).collect())
}
