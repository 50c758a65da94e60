//! A thread's room for the forces of as many poses as go through the pass together.

use crate::lanes::pass::buffers::Numbers;
use crate::lanes::program::Program;
use crate::lanes::program::recovery::Recovery;

/// Numbers that are known of a segment in every state: its axes by rows, and its length.
pub(crate) const OF_SEGMENT: usize = 10;
/// Numbers of a segment in a state: the wrenches at its first and second node, in its own axes.
pub(crate) const ENDS: usize = 12;

/// Entry k of pose l is at `k · width + l`.
#[derive(Debug)]
pub(crate) struct Room {
    pub width: usize,
    /// What a state is: displacement of the output, and the wrench on it beside what acts.
    pub asked: Numbers,
    /// The mechanism's size.
    pub size: Numbers,
    /// Displacements by coordinates.
    pub moved: Numbers,
    /// The same, of a component that hangs relative to its neighbour.
    pub relative: Numbers,
    /// By coordinates: forces, and the sum of their terms' sizes.
    pub balance: Numbers,
    /// By chains: the point that its wrenches are about.
    pub origins: Numbers,
    /// Wrenches in chains, about the chains' origins.
    pub cuts: Numbers,
    /// By segments: what is the same in every state.
    pub segments: Numbers,
    /// What the segments carry, then what the joints do.
    pub carried: Numbers,
    /// Above zero, or no number, where the state is not to be trusted.
    pub doubt: Numbers,
    /// By rows of what acts: whether it is of the state.
    pub rows: Vec<bool>,
}

impl Room {
    pub fn new(program: &Program, recovery: &Recovery, width: usize) -> Self {
        let zeros = |count: usize| Numbers::from_iter(64, std::iter::repeat_n(0.0, count * width));
        Self {
            width,
            asked: zeros(12),
            size: zeros(1),
            moved: zeros(program.coordinates),
            relative: zeros(program.coordinates),
            balance: zeros(2 * program.coordinates),
            origins: zeros(3 * recovery.chains.len()),
            cuts: zeros(6 * recovery.cuts),
            segments: zeros(OF_SEGMENT * recovery.segments.len()),
            carried: zeros(ENDS * recovery.segments.len() + 6 * recovery.joints.len()),
            doubt: zeros(1),
            rows: vec![false; program.fronts.rows],
        }
    }

    /// What a pose has in one of these.
    pub fn of<'a>(&self, numbers: &'a Numbers, lane: usize) -> impl Fn(usize) -> f64 + Copy + 'a {
        let width = self.width;
        move |k| numbers[k * width + lane]
    }
}
