//! Results on a disk: files that appear when they are complete, in place of nothing that was read.

mod atomic;
mod destination;
mod error;
mod outputs;
mod room;

pub use atomic::AtomicFile;
pub(crate) use atomic::{LONGER, remove_all_dead};
pub(crate) use destination::Destination;
pub use error::OutputError;
pub use outputs::{refuse, write, write_figure};
pub use room::{LONGEST_NAME, Room};
