//! A mechanism of a file, moved by loop closure.

use std::ops::Range;

use hyperstat_closure::{Lanes, LoopClosure, Target, Work};
use hyperstat_model::{Geometry, LANES, Model};

use super::targets::{Asked, Targets};
use crate::prebuilt::PoseError;

/// What a thread keeps from pose to pose: room for numbers, no results.
#[derive(Debug, Default)]
pub struct Placing {
    lanes: Lanes,
}

impl Placing {
    /// Room for poses whose arithmetic `run` runs: [`Work::run`], in a function that is compiled for the
    /// machine's own instruction set.
    pub fn new(run: fn(Work<'_>)) -> Self {
        Self {
            lanes: Lanes::new(run),
        }
    }

    /// Poses of a mechanism of a file so far that loop closure reached one by one.
    pub fn one_by_one(&self) -> u64 {
        self.lanes.one_by_one()
    }
}

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
        placing: &mut Placing,
    ) -> [Option<Result<[f64; 6], PoseError>>; LANES] {
        let mut placed = [const { None }; LANES];
        let closure = match &self.closure {
            Ok(closure) => closure,
            Err(error) => {
                placed[..range.len()].fill_with(|| Some(Err(error.clone())));
                return placed;
            }
        };
        let count = range.len();
        let mut asked = [const { Asked::Output([None; 6]) }; LANES];
        for (asked, pose) in asked.iter_mut().zip(range) {
            *asked = targets.get(pose);
        }
        let goals = asked.each_ref().map(Asked::target);
        let reached = closure.place_lanes(&goals[..count], geometries, &mut placing.lanes);
        for ((placed, reached), target) in placed.iter_mut().zip(reached).zip(&goals) {
            let whole = |pose| whole(target, pose);
            *placed = reached.map(|reached| reached.map(whole).map_err(PoseError::from));
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
        let closure = self.closure.as_ref().map_err(PoseError::clone)?;
        let asked = targets.get(k);
        let target = asked.target();
        let reached = closure.reach(&closure.home(), &target)?;
        closure.write(&reached, geometry)?;
        Ok(whole(&target, closure.pose(&reached)?))
    }

    /// Brings a geometry of the model to a target; returns the output's whole pose. The numbers are those
    /// of [`Mover::place_lanes`], to the bit.
    pub(crate) fn bring(
        &self,
        target: &Target<'_>,
        geometry: &mut Geometry,
        placing: &mut Placing,
    ) -> Result<[f64; 6], PoseError> {
        let closure = self.closure.as_ref().map_err(PoseError::clone)?;
        let reached = closure.place(target, geometry, &mut placing.lanes)?;
        Ok(whole(target, reached))
    }
}

impl Asked {
    fn target(&self) -> Target<'_> {
        match self {
            Self::Output(asked) => Target::Output(*asked),
            Self::Drives(drives) => Target::Drives(drives),
        }
    }
}

/// A pose that was reached, the asked coordinates as they were asked.
fn whole(target: &Target<'_>, mut pose: [f64; 6]) -> [f64; 6] {
    if let Target::Output(asked) = target {
        for (coordinate, asked) in pose.iter_mut().zip(asked) {
            *coordinate = asked.unwrap_or(*coordinate);
        }
    }
    pose
}
