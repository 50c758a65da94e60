//! A mechanism's size.

use nalgebra::Vector3;

use crate::parts::Geometry;

/// Diagonal of the box around all nodes (m); 1 where they coincide.
pub fn characteristic_length(geometry: &Geometry) -> f64 {
    let first = geometry
        .positions
        .first()
        .map_or(Vector3::zeros(), |p| p.coords);
    let (mut low, mut high) = (first, first);
    for p in &geometry.positions {
        // Every pose of a sweep comes here: comparisons alone, not what `min` says of NaN.
        low = low.zip_map(&p.coords, |low, c| if c < low { c } else { low });
        high = high.zip_map(&p.coords, |high, c| if c > high { c } else { high });
    }
    let diagonal = (high - low).norm();
    if diagonal > 0.0 { diagonal } else { 1.0 }
}
