//! Where a figure in space is seen from.

/// Where a figure in space is seen from: from far away, so that parallel lines stay parallel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewpoint {
    /// Angle about z from +x to the eye, in the plane x y \[degrees\].
    pub azimuth: f64,
    /// Angle from this plane up to the eye, −90 to 90 \[degrees\].
    pub elevation: f64,
}

impl Default for Viewpoint {
    /// From the side of +x, −y and +z: x runs to the right on the page, y to the right and back, z up.
    fn default() -> Self {
        Self {
            azimuth: -62.0,
            elevation: 22.0,
        }
    }
}
