//! The memory of one thread's pass, one number a pose beside the other.

use aligned_vec::{AVec, ConstAlign};

use super::pass::RESULTS;
use super::program::{Element, Program};

/// Numbers aligned as the widest registers are.
pub(super) type Numbers = AVec<f64, ConstAlign<64>>;

/// Buffers of a pass of `width` poses: entry k of pose l is at `k · width + l`.
#[derive(Debug)]
pub(super) struct Buffers {
    pub width: usize,
    pub inputs: Numbers,
    pub screws: Numbers,
    pub errors: Numbers,
    /// Of one front's variables.
    pub local_errors: Numbers,
    /// Of one hang.
    pub gains: Numbers,
    pub front: Numbers,
    pub panel: Numbers,
    pub rests: Numbers,
    pub blocks: Numbers,
    /// The same of an element that some poses form anew, and what that needs.
    pub formed: Numbers,
    pub forming: Numbers,
    pub results: Numbers,
}

impl Buffers {
    pub fn new(program: &Program, width: usize) -> Self {
        let zeros = |count: usize| Numbers::from_iter(64, std::iter::repeat_n(0.0, count * width));
        let held = program.elements.iter().filter_map(Element::held);
        let forming = held.map(|h| h.form.workspace(h.points.len() - 1));
        let fronts = &program.fronts;
        Self {
            width,
            inputs: zeros(3 * program.inputs.len()),
            screws: zeros(6 * program.coordinates),
            errors: zeros(program.coordinates),
            local_errors: zeros(fronts.largest),
            gains: zeros(fronts.largest * fronts.most_targets()),
            front: zeros(fronts.largest * fronts.largest),
            panel: zeros(fronts.largest * fronts.most_pivots),
            rests: zeros(fronts.rest_len),
            blocks: zeros(36 * program.most_blocks),
            formed: zeros(36 * program.most_blocks),
            forming: zeros(forming.max().unwrap_or(0)),
            results: zeros(RESULTS),
        }
    }

    /// Entry `k` of a pose's results.
    pub fn result(&self, k: usize, lane: usize) -> f64 {
        self.results[k * self.width + lane]
    }
}
