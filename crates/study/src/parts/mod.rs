//! Runs in parts: rows of every job that know their place in the whole, survive what ends a run before its
//! last row, and come together to the bytes of a run that was neither divided nor interrupted.
//!
//! A run writes its rows in **pieces**, each a whole table of some of a job's rows with a **manifest**: which rows
//! they are, the hash of all that was read and asked for ([`Origin`]), how the rows came out, what of them is
//! needed for the summary and the figures, and the hash of the table. What is computed is what no piece has;
//! a table of all rows is joined from pieces. So an undivided run, one that goes on, a shard of one and the
//! merging of shards are the same ([`Work::run`]), with more or less to compute.
//!
//! ```text
//! DIR/map.csv                                    the table
//! DIR/parts/_run-<hash>.json                     all that was read and asked for
//! DIR/parts/map/000000000000-000000065536.csv    rows 0 to 65535 of the job `map`
//! DIR/parts/map/_000000000000-000000065536.json  their manifest
//! ```

mod error;
#[cfg(feature = "fs")]
mod folder;
mod manifest;
mod missing;
mod origin;
mod part;
mod pieces;
mod plan;
mod reading;
#[cfg(feature = "fs")]
mod results;
mod shelf;
mod took;
mod work;

pub use error::PartsError;
#[cfg(feature = "fs")]
pub use folder::Folder;
pub use missing::Missing;
pub use origin::{Options, Origin};
pub use part::{Part, Share};
pub use pieces::hashes;
pub use reading::Reading;
#[cfg(feature = "fs")]
pub use results::{Outcome, Results};
pub use shelf::{Draft, Shelf};
pub use took::{Took, took};
pub use work::{Done, Found, Work, sweeps_of};
