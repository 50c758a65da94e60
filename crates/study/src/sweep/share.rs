//! Chunks shared out among threads, and taken in order.

use std::ops::Range;

use super::chunk::Chunk;
use super::threads::Threads;

#[cfg(feature = "threads")]
impl Threads {
    /// Computes a chunk for each of `rows`, each thread with what it keeps for itself, and has them
    /// taken in order on the calling thread.
    pub(super) fn share<S: Send, E>(
        &self,
        mut rows: impl Iterator<Item = Range<usize>>,
        empty: impl Fn() -> Chunk,
        compute: impl Fn(&mut Option<S>, &mut Chunk) + Sync,
        mut take: impl FnMut(&mut Chunk) -> Result<(), E>,
    ) -> Result<(), E> {
        use std::collections::VecDeque;
        use std::sync::{Mutex, PoisonError};

        let pool = &self.pool;
        // On a thread of the pool itself nobody would be left to compute what it waits for.
        if pool.current_thread_index().is_some() {
            return in_turn(rows, empty, compute, take);
        }
        let threads = pool.current_num_threads();
        let own: Vec<Mutex<Option<S>>> = (0..threads).map(|_| Mutex::new(None)).collect();
        let compute = |chunk: &mut Chunk| {
            // A thread of the pool has its own: nobody waits.
            let thread = pool.current_thread_index().unwrap_or(0);
            let mut own = own[thread].lock().unwrap_or_else(PoisonError::into_inner);
            compute(&mut own, chunk);
        };
        pool.in_place_scope(|scope| {
            let ahead = rows.by_ref().take(2 * threads + 2);
            let mut under_way: VecDeque<_> = ahead
                .map(|rows| start(scope, &compute, Chunk { rows, ..empty() }))
                .collect();
            // Nothing arrives where a thread has panicked; the scope then goes on with its panic.
            while let Some(Ok(mut chunk)) = under_way.pop_front().map(|chunk| chunk.recv()) {
                take(&mut chunk)?;
                if let Some(rows) = rows.next() {
                    chunk.rows = rows;
                    under_way.push_back(start(scope, &compute, chunk));
                }
            }
            Ok(())
        })
    }
}

/// Has a thread compute a chunk, which then arrives at the end that is returned.
#[cfg(feature = "threads")]
fn start<'s>(
    scope: &rayon::Scope<'s>,
    compute: &'s (impl Fn(&mut Chunk) + Sync),
    mut chunk: Chunk,
) -> std::sync::mpsc::Receiver<Chunk> {
    let (done, arrives) = std::sync::mpsc::sync_channel(1);
    scope.spawn(move |_| {
        compute(&mut chunk);
        // Nobody waits for it where the sweep has ended.
        let _ = done.send(chunk);
    });
    arrives
}

/// Computes a chunk for each of `rows` and has it taken, on the calling thread.
fn in_turn<S, E>(
    rows: impl Iterator<Item = Range<usize>>,
    empty: impl Fn() -> Chunk,
    compute: impl Fn(&mut Option<S>, &mut Chunk),
    mut take: impl FnMut(&mut Chunk) -> Result<(), E>,
) -> Result<(), E> {
    let (mut own, mut chunk) = (None, empty());
    for rows in rows {
        chunk.rows = rows;
        compute(&mut own, &mut chunk);
        take(&mut chunk)?;
    }
    Ok(())
}

#[cfg(not(feature = "threads"))]
impl Threads {
    /// Computes a chunk for each of `rows` and has it taken.
    pub(super) fn share<S: Send, E>(
        &self,
        rows: impl Iterator<Item = Range<usize>>,
        empty: impl Fn() -> Chunk,
        compute: impl Fn(&mut Option<S>, &mut Chunk) + Sync,
        take: impl FnMut(&mut Chunk) -> Result<(), E>,
    ) -> Result<(), E> {
        in_turn(rows, empty, compute, take)
    }
}
