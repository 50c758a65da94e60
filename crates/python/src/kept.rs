//! What a mechanism keeps from call to call, and what a process that is forked meanwhile finds of it.

use std::cell::RefCell;
use std::sync::{Mutex, MutexGuard, PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};

use pyo3::prelude::*;

/// Is open while nobody forks: a fork waits until nothing is half made, and nothing is begun meanwhile. Who
/// passes it has released the interpreter.
static GATE: RwLock<()> = RwLock::new(());

thread_local! {
    static CLOSED: RefCell<Option<RwLockWriteGuard<'static, ()>>> = const { RefCell::new(None) };
}

/// Makes something that other threads then share, or takes it from where they look.
pub(crate) fn unforked<T>(make: impl FnOnce() -> T) -> T {
    let _open: RwLockReadGuard<'_, ()> = GATE.read().unwrap_or_else(PoisonError::into_inner);
    make()
}

/// Before this process is forked.
#[pyfunction]
pub(crate) fn before_fork(py: Python<'_>) {
    // Once, however often it is registered.
    if CLOSED.with_borrow(Option::is_some) {
        return;
    }
    py.detach(|| {
        let closed = GATE.write().unwrap_or_else(PoisonError::into_inner);
        CLOSED.set(Some(closed));
    });
}

/// After it was forked, in either.
#[pyfunction]
pub(crate) fn after_fork() {
    CLOSED.set(None);
}

/// What is worked out once and serves one call at a time; calls at once have one each.
pub(crate) struct Kept<T>(Mutex<Vec<T>>);

/// Most that are kept.
const MOST: usize = 64;

impl<T> Kept<T> {
    pub(crate) fn none() -> Self {
        Self(Mutex::new(Vec::new()))
    }

    pub(crate) fn of(own: T) -> Self {
        Self(Mutex::new(vec![own]))
    }

    /// One that is there.
    pub(crate) fn take(&self) -> Option<T> {
        unforked(|| self.all().pop())
    }

    /// One that was taken, or a new one. What a panic leaves half done does not come back.
    pub(crate) fn put(&self, own: T) {
        unforked(|| {
            let mut all = self.all();
            if all.len() < MOST {
                all.push(own);
            }
        });
    }

    fn all(&self) -> MutexGuard<'_, Vec<T>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
