//! One pose at a time: the lanes' pass for who cannot wait until a register is full.

use hyperstat_model::{Geometry, LANES, Model};
use pulp::Arch;

use super::forces::Swept;
use super::{Beside, Lanes};
use crate::answer::pose_result::PoseResult;
use crate::error::SolveError;
use crate::plan::Plan;

/// One pose and its buffers; made by [`Prepared::single`](crate::Prepared::single).
#[derive(Debug)]
pub struct Single {
    lanes: Lanes,
}

impl Plan {
    /// A pose and its buffers, for the model that the plan was made for. The pose is in the model's
    /// configuration.
    pub(crate) fn single(&self, model: &Model, beside: Beside) -> Single {
        Single {
            lanes: self.lanes_on(model, narrow(), beside),
        }
    }

    /// What [`Plan::sweep_lanes`] finds at the pose that [`Single::geometry_mut`] was brought to, to the
    /// last bit; `single` was made by this plan for `model`, as it is now.
    pub(crate) fn sweep_single(
        &self,
        model: &Model,
        single: &mut Single,
    ) -> Result<PoseResult, SolveError> {
        let lanes = &mut single.lanes;
        lanes.forget();
        lanes.check(self, model)?;
        let [geometry, ..] = &lanes.geometries;
        model.check_geometry(geometry, self.one_point)?;
        if let Some(engine) = &mut lanes.engine {
            // Every lane has the pose; the first is read.
            let width = engine.buffers.width;
            let geometries = &[geometry; LANES][..width];
            engine.solve(model, geometries, lanes.arch);
            if let Some(result) = engine.result(0) {
                let first = std::array::from_fn(|lane| lane == 0);
                let swept = Swept {
                    model,
                    geometries,
                    wanted: first,
                    first: 0,
                    state: None,
                    arch: lanes.arch,
                };
                let [found, ..] = engine.carried(&swept, None);
                lanes.beyond[0] = found;
                return Ok(result);
            }
        }
        lanes.one_by_one += 1;
        self.sweep(model, geometry, &mut lanes.workspace)
    }
}

impl Single {
    /// The configuration of the pose, to be changed.
    pub fn geometry_mut(&mut self) -> &mut Geometry {
        self.lanes.geometry_mut(0)
    }

    /// The lanes whose pose 0 it is.
    pub fn lanes_mut(&mut self) -> &mut Lanes {
        &mut self.lanes
    }

    /// Whether the mechanism goes through the lanes' pass at all.
    pub fn is_parallel(&self) -> bool {
        self.lanes.is_parallel()
    }

    /// Poses so far that went through [`Prepared::sweep`](crate::Prepared::sweep).
    pub fn one_by_one(&self) -> u64 {
        self.lanes.one_by_one()
    }
}

/// Registers that do in less time for one pose what the sweep's widest do for eight, with the same
/// operations: both fuse a multiplication with an addition, or neither does.
fn narrow() -> Arch {
    match Arch::new() {
        #[cfg(target_arch = "x86_64")]
        Arch::V4(widest) => Arch::V3(*widest),
        own => own,
    }
}
