//! The memory of one thread's pass, one number a pose beside the other.

use aligned_vec::{AVec, ConstAlign};

use crate::lanes::pass::RESULTS;
use crate::lanes::program::Program;

/// Numbers aligned as the widest registers are.
pub(crate) type Numbers = AVec<f64, ConstAlign<64>>;

/// Buffers of a pass of `width` poses: entry k of pose l is at `k · width + l`.
#[derive(Debug)]
pub(crate) struct Buffers {
    pub width: usize,
    pub inputs: Numbers,
    pub screws: Numbers,
    pub errors: Numbers,
    /// Of one front's variables.
    pub local_errors: Numbers,
    /// Of the loads' row, of all coordinates and of one front's variables; none without a row.
    pub load_errors: Numbers,
    pub local_load_errors: Numbers,
    /// Of one hang.
    pub gains: Numbers,
    pub front: Numbers,
    pub panel: Numbers,
    pub rests: Numbers,
    pub blocks: Numbers,
    /// That one chain transmits, and what loads within do.
    pub wrenches: Numbers,
    pub results: Numbers,
}

impl Buffers {
    pub fn new(program: &Program, width: usize) -> Self {
        let zeros = |count: usize| Numbers::from_iter(64, std::iter::repeat_n(0.0, count * width));
        let fronts = &program.fronts;
        let loaded = fronts.loaded;
        Self {
            width,
            inputs: zeros(3 * program.inputs.len()),
            screws: zeros(6 * program.coordinates),
            errors: zeros(program.coordinates),
            local_errors: zeros(fronts.largest),
            load_errors: zeros(if loaded { program.coordinates } else { 0 }),
            local_load_errors: zeros(if loaded { fronts.largest } else { 0 }),
            gains: zeros(fronts.largest * fronts.most_targets()),
            front: zeros(fronts.largest * fronts.largest),
            panel: zeros(fronts.largest * fronts.most_pivots),
            rests: zeros(fronts.rest_len),
            blocks: zeros(36 * program.most_blocks),
            wrenches: zeros(7 * program.most_ends),
            results: zeros(RESULTS),
        }
    }

    /// Entry `k` of a pose's results.
    pub fn result(&self, k: usize, lane: usize) -> f64 {
        self.results[k * self.width + lane]
    }
}
