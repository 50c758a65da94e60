//! A mechanism of a file, moved by loop closure.

use std::ops::Range;

use hyperstat_closure::{LoopClosure, Target};
use hyperstat_model::{Geometry, LANES, Model};

use super::targets::{Asked, Targets};
use crate::prebuilt::PoseError;

/// What a thread keeps from pose to pose: room for numbers, no results.
#[derive(Debug, Default)]
pub struct Placing {}

/// A mechanism that is moved from pose to pose.
///
/// The way to every pose begins in the file's configuration, never in another pose: what is found,
/// and whether, depends on nothing but the pose.
#[derive(Debug)]
pub(crate) struct Mover {
    closure: Result<LoopClosure, PoseError>,
}

impl Mover {
    pub(crate) fn new(model: &Model) -> Self {
        Self {
            closure: LoopClosure::new(model).map_err(PoseError::from),
        }
    }

    /// Brings geometries of the model to these poses; returns the output's whole poses.
    pub(crate) fn place_lanes(
        &self,
        targets: &Targets,
        range: Range<usize>,
        geometries: &mut [Geometry],
        _placing: &mut Placing,
    ) -> [Option<Result<[f64; 6], PoseError>>; LANES] {
        let mut placed = [const { None }; LANES];
        for (lane, pose) in range.enumerate() {
            placed[lane] = Some(self.place(targets, pose, &mut geometries[lane]));
        }
        placed
    }

    /// Brings a geometry of the model to pose `k`; returns the output's whole pose.
    pub(crate) fn place(
        &self,
        targets: &Targets,
        k: usize,
        geometry: &mut Geometry,
    ) -> Result<[f64; 6], PoseError> {
        let asked = targets.get(k);
        let target = match &asked {
            Asked::Output(asked) => Target::Output(*asked),
            Asked::Drives(drives) => Target::Drives(drives),
        };
        self.bring(&target, geometry)
    }

    /// Brings a geometry of the model to a target; returns the output's whole pose.
    pub(crate) fn bring(
        &self,
        target: &Target<'_>,
        geometry: &mut Geometry,
    ) -> Result<[f64; 6], PoseError> {
        let closure = self.closure.as_ref().map_err(PoseError::clone)?;
        let reached = closure.reach(&closure.home(), target)?;
        closure.write(&reached, geometry)?;
        let mut pose = closure.pose(&reached)?;
        if let Target::Output(asked) = target {
            for (coordinate, asked) in pose.iter_mut().zip(asked) {
                *coordinate = asked.unwrap_or(*coordinate);
            }
        }
        Ok(pose)
    }
}
