//! What is too large to be held in memory: every buffer whose size grows faster than the model is
//! counted before it is made.

use crate::error::SolveError;

/// Numbers of one kind of buffer at the most: 1 GiB.
pub(crate) const MOST_NUMBERS: usize = 1 << 27;
/// Numbers of a sparse factor at the most: 8 GiB.
pub(crate) const MOST_FACTORED: usize = 1 << 30;

/// Refuses more `numbers` than `limit`; `what` asks for them.
pub(crate) fn check(what: &'static str, numbers: usize, limit: usize) -> Result<(), SolveError> {
    if numbers <= limit {
        Ok(())
    } else {
        Err(SolveError::TooLarge {
            what,
            numbers,
            limit,
        })
    }
}

/// Numbers of a matrix, or of as many vectors.
pub(crate) fn matrix(rows: usize, columns: usize) -> usize {
    rows.saturating_mul(columns)
}

/// The sum of sizes, none of which can overflow.
pub(crate) fn sum(sizes: impl IntoIterator<Item = usize>) -> usize {
    sizes.into_iter().fold(0, usize::saturating_add)
}
