//! Ctrl-C, and the signal by which systems end programs.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// The exit status of a run that was interrupted, as a shell has it for Ctrl-C.
pub(crate) const INTERRUPTED: u8 = 130;

/// Whether somebody wants the program to end.
#[derive(Debug, Default)]
pub(crate) struct Signals(Arc<AtomicBool>);

impl Signals {
    /// From now on the first signal is noted, and the second ends the program at once.
    pub(crate) fn heard() -> Self {
        let signals = Self::default();
        for signal in [SIGINT, SIGTERM] {
            let flag = || Arc::clone(&signals.0);
            // Where signals cannot be heard they do what they always do.
            let _ = flag::register_conditional_shutdown(signal, i32::from(INTERRUPTED), flag());
            let _ = flag::register(signal, flag());
        }
        signals
    }

    /// Whether one came.
    pub(crate) fn came(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
