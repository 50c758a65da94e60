//! Calls that may take long: computed on a thread of their own, while the calling one looks after the
//! interpreter, for an interrupt and for progress.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::thread::Builder;
use std::time::Duration;

use hyperstat_study::StudyError;
use pyo3::prelude::*;

use crate::error::{Ended, burst};
use crate::pool;

/// Time between two looks at the interpreter.
const GLANCE: Duration = Duration::from_millis(50);
/// What has been told to stop is waited for so long; it is then left to what it is at.
const GRACE: Duration = Duration::from_millis(150);
/// Room for files that are nested deeply, as the main thread has it.
const STACK: usize = 16 << 20;

/// What a computation tells of itself, and is told.
#[derive(Default)]
pub(crate) struct Watch {
    stop: AtomicBool,
    done: AtomicUsize,
    total: AtomicUsize,
}

impl Watch {
    /// Tells that so many of all rows are done, and asks whether to go on.
    pub(crate) fn at(&self, done: usize, total: usize) -> Result<(), Ended> {
        self.done.store(done, Relaxed);
        self.total.store(total, Relaxed);
        match self.stop.load(Relaxed) {
            true => Err(Ended::Stopped),
            false => Ok(()),
        }
    }

    fn tell(&self, py: Python<'_>, progress: Option<&Py<PyAny>>) -> PyResult<()> {
        match (progress, self.total.load(Relaxed)) {
            (Some(progress), total) if total > 0 => progress
                .call1(py, (self.done.load(Relaxed), total))
                .map(drop),
            _ => Ok(()),
        }
    }
}

/// Computes without the interpreter, which an interrupt or an error of `progress` ends; that is called with
/// the rows that are done, and all.
pub(crate) fn watched<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Py<PyAny>>,
    compute: impl FnOnce(&Watch) -> Result<T, Ended> + Send + 'static,
) -> PyResult<T> {
    let watch = Arc::new(Watch::default());
    let (ended, arrives) = sync_channel(1);
    let own = Arc::clone(&watch);
    let work = move || {
        // Nothing of what a panic may leave half done is used again.
        let outcome = catch_unwind(AssertUnwindSafe(|| compute(&own)));
        // Nobody waits for what was interrupted.
        let _ = ended.send(outcome);
    };
    let shared = &watch;
    let outcome = py.detach(move || {
        let started = Builder::new().stack_size(STACK).spawn(work);
        started.map_err(|error| {
            let why = error.to_string();
            Python::attach(|py| Ended::from(StudyError::Threads { why }).raised(py))
        })?;
        loop {
            match arrives.recv_timeout(GLANCE) {
                Ok(outcome) => return Ok(outcome),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Ok(Err(Box::new("it was lost"))),
            }
            let seen = Python::attach(|py| {
                py.check_signals()?;
                shared.tell(py, progress)
            });
            if let Err(error) = seen {
                shared.stop.store(true, Relaxed);
                if arrives.recv_timeout(GRACE).is_err() {
                    pool::leave();
                }
                return Err(error);
            }
        }
    })?;
    let found = outcome
        .map_err(|panic| burst(py, &*panic))?
        .map_err(|ended| ended.raised(py))?;
    watch.tell(py, progress)?;
    Ok(found)
}
