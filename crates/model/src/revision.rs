//! Numbers that tell whether a model has changed.

use std::sync::atomic::{AtomicU64, Ordering};

/// A number that no other model or plan has.
pub fn fresh_revision() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    NEXT.fetch_add(1, Ordering::Relaxed)
}
