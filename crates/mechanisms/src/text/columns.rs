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
    /// The error of poses where the mechanism takes none.
    pub(crate) fn takes_none(&self, poses: &Place) -> LoadError {
        let error = poses.error(format!("`{}` takes no poses", self.kind));
        error.with_help("leave `poses` out")
    }

    /// The error of a mechanism without the poses that it needs.
    pub(crate) fn needs_some(&self, mechanism: &Place) -> LoadError {
        let error = mechanism.error(format!("`{}` needs `poses`", self.kind));
        error.with_help("add `poses: List([(x, y, z)])`, `Csv(\"file.csv\")` or `Grid(…)`")
    }

    /// Refuses a coordinate that the mechanism cannot follow.
    pub(crate) fn check(
        &self,
        index: usize,
        value: f64,
        at: impl FnOnce() -> Place,
    ) -> Result<(), LoadError> {
        let follows = |coordinate: &PoseCoordinate| coordinate.index() == index;
        if value == 0.0 || self.coordinates.iter().any(follows) {
            return Ok(());
        }
        let mut pose = ["0"; 6];
        for coordinate in self.coordinates {
            pose[coordinate.index()] = csv::COLUMNS[coordinate.index()];
        }
        Err(at()
            .error(format!("`{}` cannot follow this coordinate", self.kind))
            .with_help(format!("a pose of it is `({})`", pose.join(", "))))
    }
}
