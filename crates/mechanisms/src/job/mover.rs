//! A mechanism of a file, moved by loop closure.

use std::ops::Range;

use hyperstat_closure::{Lanes, LoopClosure, Target, Work};
use hyperstat_model::{Geometry, LANES};

use super::targets::{Asked, Targets};
use crate::file::mechanism::Mechanism;
use crate::prebuilt::{Following, PoseError};

/// What a thread keeps from pose to pose: room for numbers, no results.
#[derive(Debug, Default)]
pub struct Placing {
    lanes: Lanes,
    /// Values of the drives in the poses of the last call, where they are kept.
    drives: Option<Box<Kept>>,
}

/// Values of the drives.
#[derive(Debug, Default)]
struct Kept {
    /// In every lane, where they are known.
    values: [Option<Vec<f64>>; LANES],
    /// Room for poses of prebuilt mechanisms.
    room: Vec<Geometry>,
}

impl Placing {
    /// Room for poses whose arithmetic `run` runs: [`Work::run`], in a function that is compiled for the
    /// machine's own instruction set.
    pub fn new(run: fn(Work<'_>)) -> Self {
        Self {
            lanes: Lanes::new(run),
            drives: None,
        }
    }

    /// Keeps the values of the drives in the poses from now on.
    pub fn keep_drives(&mut self) {
        self.lanes.keep_drives();
        self.drives.get_or_insert_default();
    }

    /// Values of the drives (m, rad) in a pose of the last call by its lane, in the order of
    /// [`Model::drives`](hyperstat_model::Model::drives), relative to the configuration of [`Design::model`](crate::Design::model); `None`
    /// where they are not kept, or not known.
    pub fn drives(&self, lane: usize) -> Option<&[f64]> {
        self.drives.as_ref()?.values.get(lane)?.as_deref()
    }

    /// Whether the values of the drives are kept.
    pub(super) fn keeps_drives(&self) -> bool {
        self.drives.is_some()
    }

    /// Forgets those of other poses.
    pub(super) fn forget_drives(&mut self) {
        self.keep(|_, _| None);
    }

    /// Keeps zeros, those of so many drives in the poses that are placed.
    pub(super) fn keep_home(&mut self, placed: &Placed, count: usize) {
        self.keep(|_, lane| matches!(placed[lane], Some(Ok(_))).then(|| vec![0.0; count]));
    }

    /// Keeps what loop closure has found in the poses that are placed.
    pub(super) fn keep_found(&mut self, placed: &Placed) {
        self.keep(|lanes, lane| {
            let found = matches!(placed[lane], Some(Ok(_)));
            found.then(|| lanes.drives(lane).to_vec())
        });
    }

    /// Keeps what loop closure finds on the way to the poses that are placed, or what is measured in them
    /// where it finds none.
    pub(super) fn keep_followed(
        &mut self,
        placed: &Placed,
        geometries: &[Geometry],
        following: &Following,
    ) {
        let found = |lane: &usize| matches!(placed[*lane], Some(Ok(_)));
        let reached: Vec<usize> = (0..geometries.len().min(LANES)).filter(found).collect();
        let pose = |lane: &usize| match &placed[*lane] {
            Some(Ok(pose)) => *pose,
            _ => [0.0; 6],
        };
        let poses: Vec<_> = reached.iter().map(pose).collect();
        let geometries: Vec<_> = reached.iter().map(|lane| &geometries[*lane]).collect();
        let Some(kept) = &mut self.drives else { return };
        let same = following.follow(&poses, &geometries, &mut self.lanes, &mut kept.room);
        self.keep(|lanes, lane| {
            let place = reached.iter().position(|own| *own == lane)?;
            match same[place] {
                true => Some(lanes.drives(place).to_vec()),
                false => following.measured(geometries[place]),
            }
        });
    }

    fn keep(&mut self, values: impl Fn(&Lanes, usize) -> Option<Vec<f64>>) {
        if let Some(kept) = &mut self.drives {
            kept.values = std::array::from_fn(|lane| values(&self.lanes, lane));
        }
    }

    /// Poses of a mechanism of a file so far that loop closure reached one by one.
    pub fn one_by_one(&self) -> u64 {
        self.lanes.one_by_one()
    }
}

/// The output's whole poses, or why they are not reached.
pub(super) type Placed = [Option<Result<[f64; 6], PoseError>>; LANES];

/// A mechanism that is moved from pose to pose.
///
/// The way to every pose begins in the file's configuration, never in another pose: what is found,
/// and whether, depends on nothing but the pose.
#[derive(Debug)]
pub(crate) struct Mover {
    closure: Result<LoopClosure, PoseError>,
}

impl Mover {
    pub(crate) fn new(mechanism: &Mechanism) -> Self {
        Self {
            closure: mechanism.loops(),
        }
    }

    /// Its loop closure, where it can be moved.
    pub(crate) fn closure(&self) -> Option<&LoopClosure> {
        self.closure.as_ref().ok()
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
