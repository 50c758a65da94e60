//! A mechanism's size.

use nalgebra::Vector3;

use crate::parts::Geometry;

/// Diagonal of the box around all nodes (m); 1 where they coincide.
pub fn characteristic_length(geometry: &Geometry) -> f64 {
    let first = geometry
        .positions
        .first()
        .map_or(Vector3::zeros(), |p| p.coords);
    // Every pose of a sweep comes here: comparisons alone, not what `min` says of NaN, of every other
    // point beside its neighbour.
    let (mut low, mut high) = ([first; 2], [first; 2]);
    for points in geometry.positions.chunks(2) {
        for (k, p) in points.iter().enumerate() {
            low[k] = lower(&low[k], &p.coords);
            high[k] = higher(&high[k], &p.coords);
        }
    }
    let [low, other] = low;
    let low = lower(&low, &other);
    let [high, other] = high;
    let diagonal = (higher(&high, &other) - low).norm();
    if diagonal > 0.0 { diagonal } else { 1.0 }
}

#[inline]
fn lower(low: &Vector3<f64>, other: &Vector3<f64>) -> Vector3<f64> {
    low.zip_map(other, |low, c| if c < low { c } else { low })
}

#[inline]
fn higher(high: &Vector3<f64>, other: &Vector3<f64>) -> Vector3<f64> {
    high.zip_map(other, |high, c| if c > high { c } else { high })
}
