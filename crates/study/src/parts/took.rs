//! How long rows take, by some of them.

use std::ops::Range;
use std::time::{Duration, Instant};

use crate::ran::Ran;
use crate::sweep::{Chunk, Sweep, Threads};
use crate::table::{TableFormat, render};

/// How long some rows took.
#[derive(Debug, Clone, Copy)]
pub struct Took {
    /// How many they were.
    pub rows: usize,
    /// Each of them \[s\], on all threads together.
    pub row: f64,
}

/// Places all over the rows at which some are solved.
const PLACES: u32 = 8;

/// Solves some of these rows, all over them, for about so long, and says how long a row takes; all of them where
/// they are few. Writing to a disk is not in it.
pub fn took(
    sweep: &Sweep<'_>,
    threads: &Threads,
    rows: Range<usize>,
    (format, measured): (TableFormat, bool),
    about: Duration,
) -> Took {
    let prepare = |chunk: &mut Chunk| {
        render(format, chunk);
        if measured {
            Ran::measure(chunk);
        }
    };
    let solve = |rows: Range<usize>| {
        let began = Instant::now();
        let take = |_: &mut Chunk| Ok::<(), std::convert::Infallible>(());
        // What takes nothing cannot fail.
        let _ = sweep.run(threads, rows, prepare, take);
        began.elapsed()
    };
    let all = rows.len();
    // Larger blocks until one takes its share of the time.
    let mut block = 64.min(all);
    while block < all && solve(rows.start..rows.start + block) < about / (4 * PLACES) {
        block = (2 * block).min(all);
    }
    let places = match block < all / PLACES as usize {
        true => PLACES as usize,
        false => {
            block = all;
            1
        }
    };
    let mut time = Duration::ZERO;
    for place in 0..places {
        let first = rows.start + (all - block) / places.max(2).saturating_sub(1) * place;
        time += solve(first..first + block);
    }
    let solved = places * block;
    Took {
        rows: solved,
        row: time.as_secs_f64() / solved.max(1) as f64,
    }
}
