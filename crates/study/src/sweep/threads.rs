//! The threads that sweeps run on.

use crate::error::StudyError;

/// Most threads a core: more would wait for each other.
#[cfg(feature = "threads")]
const THREADS_A_CORE: usize = 8;

/// Threads that solve. Results are the same with any number of them.
#[derive(Debug)]
pub struct Threads {
    #[cfg(feature = "threads")]
    pub(super) pool: rayon::ThreadPool,
}

impl Threads {
    /// So many threads, at most 8 a core; 0 is one a core. Without the feature `threads` it is the
    /// calling thread, whatever is asked for.
    ///
    /// # Errors
    /// The threads cannot be started.
    pub fn new(asked: usize) -> Result<Self, StudyError> {
        #[cfg(feature = "threads")]
        {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads(asked))
                .build();
            let pool = pool.map_err(|error| StudyError::Threads {
                why: error.to_string(),
            })?;
            Ok(Self { pool })
        }
        #[cfg(not(feature = "threads"))]
        {
            let _ = asked;
            Ok(Self {})
        }
    }

    /// What is made of every number of a range, in order.
    pub fn each<R: Send>(
        &self,
        numbers: std::ops::Range<usize>,
        make: impl Fn(usize) -> R + Sync + Send,
    ) -> Vec<R> {
        #[cfg(feature = "threads")]
        {
            use rayon::iter::{IntoParallelIterator, ParallelIterator};
            self.install(|| numbers.into_par_iter().map(make).collect())
        }
        #[cfg(not(feature = "threads"))]
        {
            numbers.map(make).collect()
        }
    }

    /// Has what follows run on them.
    pub fn install<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        #[cfg(feature = "threads")]
        {
            self.pool.install(work)
        }
        #[cfg(not(feature = "threads"))]
        {
            work()
        }
    }
}

/// The number of threads for so many that are asked for; 0 is one a core.
#[cfg(feature = "threads")]
fn threads(asked: usize) -> usize {
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    asked.min(cores.saturating_mul(THREADS_A_CORE))
}

#[cfg(all(test, feature = "threads"))]
mod tests {
    use super::threads;

    #[test]
    fn threads_are_as_many_as_make_sense() {
        let cores = std::thread::available_parallelism().unwrap().get();
        assert_eq!((threads(0), threads(1)), (0, 1));
        assert_eq!(threads(8 * cores), 8 * cores);
        assert_eq!(threads(usize::MAX), 8 * cores);
    }
}
