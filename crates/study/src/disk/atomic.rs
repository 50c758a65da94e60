//! A file that appears under its name only when it is complete.

use std::ffi::{OsStr, OsString};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

use super::destination::{self, Destination};

/// A file being written under a temporary name in the folder of its final one. A link stays, and what
/// it leads to is replaced; what is no regular file is written to as it is.
///
/// [`AtomicFile::commit`] gives it its name; dropped before that, it is removed. The temporary file is
/// locked as long as it is written, so that those of dead runs can be told and are removed.
#[derive(Debug)]
pub struct AtomicFile(BufWriter<Target>);

/// What is written to.
#[derive(Debug)]
enum Target {
    /// A file that will replace what is at the path.
    Temporary(NamedTempFile, PathBuf),
    /// What is no regular file.
    Stream(File),
}

/// What a temporary name is longer than its final one: `.`, `.`, random letters and digits, `.part`.
pub(crate) const LONGER: usize = 2 + RANDOM + PART.len();

/// Random letters and digits in a temporary name.
const RANDOM: usize = 13;

const PART: &str = ".part";

/// Temporary files that are tried before another run is believed to take each for dead.
const TRIES: usize = 99;

impl AtomicFile {
    /// Opens the temporary file for `path`, which must name a file, not a folder.
    ///
    /// # Errors
    /// It cannot be made, or a folder is at `path`.
    pub fn create(path: &Path) -> io::Result<Self> {
        let target = match Destination::of(path)? {
            Destination::Stream(path) => Target::Stream(destination::open(&path)?),
            Destination::File(path) => Target::Temporary(temporary(&path)?, path),
        };
        Ok(Self(BufWriter::new(target)))
    }

    /// Opens a temporary file beside `path`, whatever is there: [`AtomicFile::commit_as`] gives it its name.
    pub(crate) fn draft(path: &Path) -> io::Result<Self> {
        let target = Target::Temporary(temporary(path)?, path.into());
        Ok(Self(BufWriter::new(target)))
    }

    /// Puts a draft, which is complete, at `path`, as [`AtomicFile::commit`] puts what was opened for it.
    pub(crate) fn commit_as(self, path: &Path) -> io::Result<()> {
        let target = self.0.into_inner().map_err(|error| error.into_error())?;
        let Target::Temporary(file, _) = target else {
            return Ok(());
        };
        file.as_file().sync_all()?;
        let file = match Destination::of(path)? {
            Destination::File(path) => match file.persist(&path) {
                Ok(_) => return sync_folder(&path),
                // A link leads to another disk.
                Err(failed) if failed.error.kind() == io::ErrorKind::CrossesDevices => failed.file,
                Err(failed) => return Err(failed.error),
            },
            Destination::Stream(_) => file,
        };
        let mut copy = Self::create(path)?;
        io::copy(&mut File::open(file.path())?, &mut copy)?;
        copy.commit()
    }

    /// Writes a whole file.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(path: &Path, content: &[u8]) -> io::Result<()> {
        let mut file = Self::create(path)?;
        file.write_all(content)?;
        file.commit()
    }

    /// Puts the complete file in place of what had its name before.
    ///
    /// # Errors
    /// It cannot have it, or not all of it could be written.
    pub fn commit(self) -> io::Result<()> {
        let target = self.0.into_inner().map_err(|error| error.into_error())?;
        if let Target::Temporary(file, path) = target {
            file.as_file().sync_all()?;
            file.persist(path)?;
        }
        Ok(())
    }
}

/// Has the name of a new file survive a power cut.
fn sync_folder(path: &Path) -> io::Result<()> {
    // What is no folder to be opened, as on Windows, keeps its names by itself.
    if let Some(Ok(folder)) = destination::folder(path).map(File::open) {
        let _ = folder.sync_all();
    }
    Ok(())
}

/// Removes the temporary files of dead runs from a folder that is of nothing else.
pub(crate) fn remove_all_dead(folder: &Path) {
    let names = fs::read_dir(folder).into_iter().flatten().flatten();
    for entry in names {
        let name = entry.file_name();
        let name = name.as_encoded_bytes();
        let rest = name
            .strip_prefix(b".")
            .and_then(|name| name.strip_suffix(PART.as_bytes()));
        let is_random = |id: &[u8]| id.len() == RANDOM && id.iter().all(u8::is_ascii_alphanumeric);
        if rest.is_some_and(|rest| rest.rsplit(|b| *b == b'.').next().is_some_and(is_random)) {
            remove_if_dead(&entry.path());
        }
    }
}

/// Removes a temporary file that nobody writes: it is locked as long as somebody does.
fn remove_if_dead(path: &Path) {
    let file = OpenOptions::new().write(true).open(path);
    if file.is_ok_and(|file| file.try_lock().is_ok()) {
        let _ = fs::remove_file(path);
    }
}

/// Opens a new file to become `path`, locked; those of dead runs are removed before.
fn temporary(path: &Path) -> io::Result<NamedTempFile> {
    let name = path
        .file_name()
        .ok_or(io::Error::from(io::ErrorKind::InvalidFilename))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    remove_dead(path, name);
    let mut prefix = OsString::from(".");
    prefix.push(name);
    prefix.push(".");
    let mut builder = Builder::new();
    builder.prefix(&prefix).suffix(PART).rand_bytes(RANDOM);
    for _ in 0..TRIES {
        // Opened here, with the permissions of any new file; the crate's own are for its owner alone.
        let file = builder.make_in(folder, |path| {
            OpenOptions::new().write(true).create_new(true).open(path)
        })?;
        // Where a file system has no locks, nobody else can take it for dead either.
        let taken = matches!(file.as_file().try_lock(), Err(TryLockError::WouldBlock));
        // Another run may have taken it for dead before it was locked.
        if !taken && file.path().exists() {
            return Ok(file);
        }
    }
    Err(io::ErrorKind::AlreadyExists.into())
}

/// Removes the temporary files of runs that ended before they completed `path`. What cannot be
/// removed stays.
fn remove_dead(path: &Path, name: &OsStr) {
    let Some(folder) = destination::folder(path) else {
        return;
    };
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let regular = entry.file_type().is_ok_and(|kind| kind.is_file());
        if !regular || !is_temporary(&entry.file_name(), name) {
            continue;
        }
        remove_if_dead(&entry.path());
    }
}

/// Whether a file has a temporary name of the file `name`, of this version or of one before, which had
/// the number of the process in it.
fn is_temporary(file: &OsStr, name: &OsStr) -> bool {
    let file = file.as_encoded_bytes().strip_prefix(b".");
    let rest = file.and_then(|file| file.strip_prefix(name.as_encoded_bytes()));
    let id = rest.and_then(|rest| rest.strip_prefix(b".")?.strip_suffix(PART.as_bytes()));
    id.is_some_and(|id| {
        let random = id.len() == RANDOM && id.iter().all(u8::is_ascii_alphanumeric);
        let numbers = id.iter().all(|b| b.is_ascii_digit() || *b == b'-');
        random || (numbers && !id.is_empty())
    })
}

impl Target {
    /// The open file; what fails in it does not name the temporary one.
    fn file(&mut self) -> &mut File {
        match self {
            Self::Temporary(file, _) => file.as_file_mut(),
            Self::Stream(file) => file,
        }
    }
}

impl Write for Target {
    fn write(&mut self, content: &[u8]) -> io::Result<usize> {
        self.file().write(content)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file().flush()
    }
}

impl Write for AtomicFile {
    fn write(&mut self, content: &[u8]) -> io::Result<usize> {
        self.0.write(content)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

#[cfg(test)]
mod tests {
    use std::ffi::OsStr;
    use std::fs;
    use std::io::Write;
    use std::path::{Path, PathBuf};

    use super::{AtomicFile, LONGER, is_temporary};

    /// A folder of the test `name`.
    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("hyperstat-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<_> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn what_dead_runs_left_is_removed_and_what_lives_stays() {
        let folder = folder("dead");
        let path = folder.join("a.csv");
        for left in [
            ".a.csv.1.part",
            ".a.csv.99999-3.part",
            ".b.csv.1.part",
            ".a.csv.x.part",
        ] {
            fs::write(folder.join(left), "half").unwrap();
        }
        let mut first = AtomicFile::create(&path).unwrap();
        // A second run of the same name leaves the first one's alone, though its process is the same.
        AtomicFile::write(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        first.write_all(b"first").unwrap();
        first.commit().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"first");
        assert_eq!(names(&folder), [".a.csv.x.part", ".b.csv.1.part", "a.csv"]);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn temporary_names_are_told_from_others() {
        let is = |file: &str| is_temporary(OsStr::new(file), OsStr::new("a.csv"));
        assert!(is(".a.csv.12.part") && is(".a.csv.12-3.part") && is(".a.csv.k3Jh5Gd8sKq2a.part"));
        for other in [
            "a.csv.12.part",
            ".a.csv..part",
            ".a.csv.part",
            ".b.csv.12.part",
            ".a.csv.1",
        ] {
            assert!(!is(other), "{other}");
        }
        assert_eq!("..k3Jh5Gd8sKq2a.part".len(), LONGER);
    }

    #[test]
    fn a_file_is_hidden_until_it_is_complete_and_gone_where_it_never_is() {
        let folder = folder("hidden");
        let path = folder.join("a.csv");
        fs::write(&path, "before").unwrap();
        let mut file = AtomicFile::create(&path).unwrap();
        file.write_all(b"half").unwrap();
        file.flush().unwrap();
        let [temporary, kept] = &names(&folder)[..] else {
            panic!("{:?}", names(&folder));
        };
        assert!(is_temporary(OsStr::new(temporary), OsStr::new("a.csv")));
        assert_eq!(
            (temporary.len(), &**kept),
            ("a.csv".len() + LONGER, "a.csv")
        );
        drop(file);
        assert_eq!(names(&folder), ["a.csv"]);
        assert_eq!(fs::read(&path).unwrap(), b"before");
        fs::remove_dir_all(folder).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn a_file_has_the_permissions_of_any_new_one() {
        use std::os::unix::fs::PermissionsExt;

        let folder = folder("permissions");
        fs::write(folder.join("any"), "").unwrap();
        AtomicFile::write(&folder.join("ours"), b"").unwrap();
        let mode = |name: &str| {
            fs::metadata(folder.join(name))
                .unwrap()
                .permissions()
                .mode()
        };
        assert_eq!(mode("ours"), mode("any"));
        fs::remove_dir_all(folder).unwrap();
    }
}
