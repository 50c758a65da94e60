//! The memory of one thread's pass, one number a pose beside the other.

use aligned_vec::{AVec, ConstAlign};

use crate::lanes::pass::lane::TRIANGLE;
use crate::lanes::pass::results;
use crate::lanes::program::Program;

/// Numbers aligned as the widest registers are.
pub(crate) type Numbers = AVec<f64, ConstAlign<64>>;

/// Buffers of a pass of `width` poses: entry k of pose l is at `k · width + l`.
#[derive(Debug)]
pub(crate) struct Buffers {
    pub width: usize,
    pub inputs: Numbers,
    /// What acts.
    pub acts: Numbers,
    pub screws: Numbers,
    pub errors: Numbers,
    /// Of one front's variables.
    pub local_errors: Numbers,
    /// Of the rows of what acts, of all coordinates and of one front's variables.
    pub load_errors: Numbers,
    pub local_load_errors: Numbers,
    /// Of one hang.
    pub gains: Numbers,
    pub front: Numbers,
    pub panel: Numbers,
    pub rests: Numbers,
    pub blocks: Numbers,
    /// That one chain transmits, and what acts within does.
    pub wrenches: Numbers,
    /// Compliances of one chain's links.
    pub links: Numbers,
    /// Conditions of one loop of rigid bodies, and their scales.
    pub conditions: Numbers,
    pub scales: Numbers,
    /// Displacements by columns, with their relative errors and squared sizes.
    pub columns: Numbers,
    pub results: Numbers,
    /// What forces are found from.
    pub kept: Numbers,
}

impl Buffers {
    pub fn new(program: &Program, width: usize) -> Self {
        let zeros = |count: usize| Numbers::from_iter(64, std::iter::repeat_n(0.0, count * width));
        let fronts = &program.fronts;
        let rows = fronts.rows;
        let [entries, conditions] = program.loops.room();
        Self {
            width,
            inputs: zeros(3 * program.inputs.len()),
            acts: zeros(6 * program.acts.count),
            screws: zeros(6 * program.loops.screws),
            errors: zeros(program.coordinates + rows),
            local_errors: zeros(fronts.largest),
            load_errors: zeros(rows * program.coordinates),
            local_load_errors: zeros(rows * fronts.largest),
            gains: zeros(fronts.largest * fronts.most_targets()),
            front: zeros(fronts.largest * fronts.largest),
            // A column more, since rows are read from any place in it.
            panel: zeros(fronts.largest * (fronts.most_pivots + 1)),
            rests: zeros(fronts.rest_len),
            blocks: zeros(36 * program.most_blocks),
            wrenches: zeros(7 * program.most_ends),
            links: zeros(TRIANGLE * program.most_links),
            conditions: zeros(entries),
            scales: zeros(conditions),
            columns: zeros(8 * program.rows.len()),
            results: zeros(results(program.states.len())),
            kept: zeros(program.recovery.as_ref().map_or(0, |own| own.len)),
        }
    }

    /// Entry `k` of a pose's results.
    pub fn result(&self, k: usize, lane: usize) -> f64 {
        self.results[k * self.width + lane]
    }
}
