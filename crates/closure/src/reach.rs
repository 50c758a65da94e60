//! A target reached in one call: where everything is then, and how far the drives have moved.

use hyperstat_model::Geometry;

use crate::closure::LoopClosure;
use crate::error::ClosureError;
use crate::target::{Drive, Target};

/// A mechanism at a target.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Reached {
    /// Where all parts are: a geometry of the model that the loop closure is made from.
    pub geometry: Geometry,
    /// The output's position x y z (m) and rotation vector rx ry rz (rad) from home, in global axes.
    pub pose: [f64; 6],
    /// The value of every drive relative to home (m or rad), in the order of
    /// [`LoopClosure::drives`]. Directions that have no value of their own, such as a ball joint's, are
    /// left out.
    pub drives: Vec<Drive>,
}

impl LoopClosure {
    /// Puts the mechanism at a target, on the way that begins at home: what is found, and whether,
    /// depends on nothing but the target.
    ///
    /// # Errors
    /// The target is out of reach, singular, or reached only in another assembly mode; and as
    /// [`LoopClosure::reach`] and [`LoopClosure::write`].
    pub fn place_at(&self, target: &Target<'_>) -> Result<Reached, ClosureError> {
        let reached = self.reach(&self.home(), target)?;
        let mut geometry = self.geometry().clone();
        self.write(&reached, &mut geometry)?;
        let drive = |(joint, direction)| {
            let value = self.value(&reached, joint, direction)?;
            Some(Drive {
                joint,
                direction,
                value,
            })
        };
        Ok(Reached {
            geometry,
            pose: self.pose(&reached)?,
            drives: self.drives().filter_map(drive).collect(),
        })
    }
}
