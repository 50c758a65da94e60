//! What a file system has room for.

use std::path::Path;

/// Of the file system that a path is on, or will be on.
#[derive(Debug, Clone, Copy)]
pub struct Room {
    /// Bytes that are left for whoever asks.
    pub free: u64,
    /// Longest name of a file \[bytes\].
    pub longest_name: u64,
}

impl Room {
    /// The file system of `path`, or of the nearest folder above it that is there; `None` where it
    /// does not say.
    #[cfg(unix)]
    pub fn of(path: &Path) -> Option<Self> {
        let path = std::path::absolute(path).ok()?;
        let found = path
            .ancestors()
            .find_map(|path| rustix::fs::statvfs(path).ok())?;
        Some(Self {
            free: found.f_bavail.saturating_mul(found.f_frsize),
            longest_name: found.f_namemax,
        })
    }

    /// Nobody is asked here.
    #[cfg(not(unix))]
    pub fn of(_: &Path) -> Option<Self> {
        None
    }
}

/// Longest name of a file on nearly all file systems.
pub const LONGEST_NAME: u64 = 255;

#[cfg(all(test, unix))]
mod tests {
    use super::{LONGEST_NAME, Room};

    #[test]
    fn the_file_system_of_what_is_not_there_yet_is_asked() {
        let folder = std::env::temp_dir().join("hyperstat-none/there/yet");
        let disk = Room::of(&folder).unwrap();
        assert!(disk.free > 0 && disk.longest_name <= LONGEST_NAME);
    }
}
