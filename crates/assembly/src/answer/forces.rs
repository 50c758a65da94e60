//! Forces of a state: what joints and segments carry.

use nalgebra::Vector6;

use super::solution::{SegmentForces, State};
use crate::state::floor::Floor;

/// What joints and segments carry in one state.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Forces {
    /// As [`Solution::joint_wrenches`](crate::Solution::joint_wrenches).
    pub joint_wrenches: Vec<Option<Vector6<f64>>>,
    /// As [`Solution::segments`](crate::Solution::segments).
    pub segments: Vec<SegmentForces>,
    /// As [`Solution::floor`](crate::Solution::floor); in the lanes, that of the plan's configuration.
    pub floor: Floor,
}

impl From<State> for Forces {
    fn from(state: State) -> Self {
        Self {
            joint_wrenches: state.joint_wrenches,
            segments: state.segments,
            floor: state.floor,
        }
    }
}
