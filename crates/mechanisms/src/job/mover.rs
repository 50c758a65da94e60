//! A mechanism of a file, moved by loop closure.

use std::sync::{Arc, Mutex, PoisonError};

use hyperstat_closure::{Configuration, LoopClosure, Target};
use hyperstat_model::{Geometry, Model};

use super::targets::{Asked, Targets};
use crate::prebuilt::PoseError;

/// Poses in a block: each is reached from the first of its block.
const BLOCK: usize = 32;
/// First configurations of blocks that are kept.
const KEPT: usize = 64;

/// A mechanism that is moved from pose to pose.
///
/// The way to a pose begins in the first pose of its block of [`BLOCK`], and the way to that in the
/// file's configuration. So a pose does not depend on which other poses are asked for, nor on
/// the number of threads that ask.
#[derive(Debug)]
pub(crate) struct Mover {
    closure: Result<LoopClosure, PoseError>,
    /// The last blocks used, each where its number modulo [`KEPT`] is.
    blocks: Vec<Mutex<Option<Block>>>,
}

/// Number of a block, and where the ways to its poses begin.
type Block = (usize, Arc<Configuration>);

impl Mover {
    pub(crate) fn new(model: &Model) -> Self {
        Self {
            closure: LoopClosure::new(model).map_err(PoseError::from),
            blocks: (0..KEPT).map(|_| Mutex::new(None)).collect(),
        }
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
        let home = closure.home();
        let reached = if k.is_multiple_of(BLOCK) {
            reach(closure, &home, &asked)
        } else {
            let start = self.start(closure, targets, k / BLOCK);
            reach(closure, &start, &asked).or_else(|error| match *start == home {
                true => Err(error),
                // Another way may lead where this one does not.
                false => reach(closure, &home, &asked),
            })
        }?;
        closure.write(&reached, geometry)?;
        let mut pose = closure.pose(&reached)?;
        if let Asked::Output(asked) = asked {
            for (coordinate, asked) in pose.iter_mut().zip(asked) {
                *coordinate = asked.unwrap_or(*coordinate);
            }
        }
        Ok(pose)
    }

    /// Where the ways to the poses of a block begin: in its first pose, or at home if that cannot
    /// be reached.
    fn start(&self, closure: &LoopClosure, targets: &Targets, block: usize) -> Arc<Configuration> {
        let kept = &self.blocks[block % KEPT];
        let lock = || kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((number, start)) = &*lock()
            && *number == block
        {
            return Arc::clone(start);
        }
        // Not under the lock: other threads may want other blocks of this place.
        let home = closure.home();
        let first = reach(closure, &home, &targets.get(block * BLOCK));
        let start = Arc::new(first.unwrap_or(home));
        *lock() = Some((block, Arc::clone(&start)));
        start
    }
}

fn reach(
    closure: &LoopClosure,
    from: &Configuration,
    asked: &Asked,
) -> Result<Configuration, PoseError> {
    let target = match asked {
        Asked::Output(asked) => Target::Output(*asked),
        Asked::Drives(drives) => Target::Drives(drives),
    };
    Ok(closure.reach(from, &target)?)
}
