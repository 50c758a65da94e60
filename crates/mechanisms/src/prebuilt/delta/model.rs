//! The delta as a [`Prebuilt`].

use hyperstat_model::{Geometry, Model, ValuePlace};
use nalgebra::Point3;

use super::limb::Limb;
use super::topology::Posed;
use crate::prebuilt::delta::Delta;
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
        construction::model("delta", &self.at(pose)?)
    }

    fn origins(&self, pose: &[f64]) -> Result<Vec<(ValuePlace, String)>, PoseError> {
        Ok(construction::origins(&self.at(pose)?))
    }

    fn place(&self, pose: &[f64], geometry: &mut Geometry) -> Result<[f64; 6], PoseError> {
        construction::place(geometry, &self.at(pose)?)
    }
}

impl Delta {
    /// Checks parameters and pose; the limbs there.
    #[inline]
    fn at(&self, pose: &[f64]) -> Result<Posed<'_>, PoseError> {
        self.check()?;
        let centre = Point3::from(coordinates::<3>(self.kind(), pose)?);
        let limbs = [
            Limb::new(self, 0, &centre)?,
            Limb::new(self, 1, &centre)?,
            Limb::new(self, 2, &centre)?,
        ];
        Ok(Posed {
            delta: self,
            centre,
            limbs,
        })
    }
}
