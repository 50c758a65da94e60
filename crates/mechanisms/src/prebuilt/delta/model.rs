//! The delta as a [`Prebuilt`].

use hyperstat_model::{Geometry, LANES, Model, ValuePlace};

use super::topology::Posed;
use crate::prebuilt::delta::Delta;
use crate::prebuilt::wide::{Wide, side_by_side};
use crate::prebuilt::{PoseCoordinate, PoseError, Prebuilt, ROTATION, construction, coordinates};

impl Prebuilt for Delta {
    fn kind(&self) -> &str {
        "Delta"
    }

    fn coordinates(&self) -> &'static [PoseCoordinate] {
        &[PoseCoordinate::X, PoseCoordinate::Y, PoseCoordinate::Z]
    }

    fn zero_coordinates(&self) -> &'static [PoseCoordinate] {
        ROTATION
    }

    fn model(&self, pose: &[f64]) -> Result<Model, PoseError> {
        construction::model("delta", &self.alone(pose)?.at(0)?)
    }

    fn origins(&self, pose: &[f64]) -> Result<Vec<(ValuePlace, String)>, PoseError> {
        Ok(construction::origins(&self.alone(pose)?.at(0)?))
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        construction::place(geometry, &self.alone(pose)?.at(0)?)
    }

    fn place_lanes(
        &self,
        poses: &[[f64; 6]],
        geometries: &mut [Geometry],
    ) -> [Option<Result<[f64; 6], PoseError>>; LANES] {
        let checked = self.check();
        let posed = Posed::<LANES>::new(self, side_by_side(poses));
        let mut placed = [const { None }; LANES];
        for (k, pose) in poses.iter().enumerate() {
            let geometry = &mut geometries[k];
            let mut place = || {
                checked.clone()?;
                coordinates::<3>(self.kind(), &pose[..3])?;
                construction::place(geometry, &posed.at(k)?)
            };
            placed[k] = Some(place());
        }
        placed
    }
}

impl Delta {
    /// Checks parameters and pose; the limbs there.
    #[inline]
    fn alone(&self, pose: &[f64]) -> Result<Posed<'_, 1>, PoseError> {
        self.check()?;
        let centre = coordinates::<3>(self.kind(), pose)?;
        Ok(Posed::new(self, centre.map(Wide::of)))
    }
}
