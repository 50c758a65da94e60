//! Coordinates that a table of poses gives.

use super::source::Place;
use crate::error::LoadError;
use crate::prebuilt::PoseCoordinate;
use crate::text::csv;

/// What poses a mechanism can be given.
pub(crate) struct Given<'k> {
    /// The mechanism's kind.
    pub(crate) kind: &'k str,
    /// The coordinates that it is given; the others stay zero in a file.
    pub(crate) coordinates: &'static [PoseCoordinate],
}

impl Given<'_> {
    /// Refuses a coordinate that the mechanism cannot follow.
    pub(crate) fn check(&self, index: usize, value: f64, at: &Place) -> Result<(), LoadError> {
        let follows = |coordinate: &PoseCoordinate| coordinate.index() == index;
        if value == 0.0 || self.coordinates.iter().any(follows) {
            return Ok(());
        }
        let mut pose = ["0"; 6];
        for coordinate in self.coordinates {
            pose[coordinate.index()] = csv::COLUMNS[coordinate.index()];
        }
        Err(at
            .error(format!("`{}` cannot follow this coordinate", self.kind))
            .with_help(format!("a pose of it is `({})`", pose.join(", "))))
    }
}
