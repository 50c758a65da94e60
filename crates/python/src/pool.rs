//! The threads that sweeps run on: one pool, kept for the next sweep.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use hyperstat_study::StudyError;
use hyperstat_study::sweep::Threads;

use crate::kept::unforked;

/// A pool, the process that it is of, and how many threads were asked for.
type Kept = (u32, usize, Arc<Threads>);

static POOL: Mutex<Option<Kept>> = Mutex::new(None);

/// So many threads, 0 is one a core: those of the last sweep where they fit. A process that was forked has
/// none of its parent's.
pub(crate) fn threads(asked: usize) -> Result<Arc<Threads>, StudyError> {
    let process = std::process::id();
    unforked(|| {
        let mut pool = pool();
        if let Some((of, count, threads)) = &*pool
            && (*of, *count) == (process, asked)
        {
            return Ok(Arc::clone(threads));
        }
        let threads = Arc::new(Threads::new(asked)?);
        if let Some((of, _, old)) = pool.replace((process, asked, Arc::clone(&threads)))
            && of != process
        {
            // Its threads are not there to be waited for.
            std::mem::forget(old);
        }
        Ok(threads)
    })
}

/// Leaves the threads to what they are still at: the next sweep has others.
pub(crate) fn leave() {
    let left = unforked(|| pool().take());
    if let Some((of, _, old)) = left
        && of != std::process::id()
    {
        std::mem::forget(old);
    }
}

fn pool() -> MutexGuard<'static, Option<Kept>> {
    POOL.lock().unwrap_or_else(PoisonError::into_inner)
}
