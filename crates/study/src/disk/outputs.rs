//! Outputs: written as a whole, and not where they would destroy something: a file that was read,
//! or one another.

use std::collections::HashMap;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use super::atomic::AtomicFile;
use super::destination::{Destination, folder};
use super::error::OutputError;
use crate::figure::{Drawing, Form};

/// Writes a file as a whole.
///
/// # Errors
/// It cannot be written.
pub fn write(path: &Path, content: &[u8]) -> Result<(), OutputError> {
    AtomicFile::write(path, content).map_err(OutputError::write(path))
}

/// Writes a figure in these forms, as `STEM.svg` and so on; all are drawn before the first is written.
///
/// # Errors
/// One cannot be drawn, or not be written.
pub fn write_figure(
    drawing: &Drawing,
    stem: &Path,
    forms: &[Form],
) -> Result<Vec<PathBuf>, OutputError> {
    let mut drawn = Vec::new();
    for (form, path) in forms.iter().zip(Form::files(stem, forms)) {
        match form.drawn(drawing) {
            Ok(bytes) => drawn.push((path, bytes)),
            Err(source) => return Err(OutputError::Figure { path, source }),
        }
    }
    for (path, bytes) in &drawn {
        write(path, bytes)?;
    }
    Ok(drawn.into_iter().map(|(path, _)| path).collect())
}

/// What makes two paths one file, whatever they are called.
#[cfg(unix)]
type Identity = (u64, u64);
#[cfg(not(unix))]
type Identity = PathBuf;

/// Of a regular file that is there, links followed.
#[cfg(unix)]
fn identity(path: &Path) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt;

    let found = fs::metadata(path).ok().filter(fs::Metadata::is_file)?;
    Some((found.dev(), found.ino()))
}

/// Of a regular file that is there, links followed.
#[cfg(not(unix))]
fn identity(path: &Path) -> Option<Identity> {
    fs::metadata(path).ok().filter(fs::Metadata::is_file)?;
    path.canonicalize().ok()
}

/// Refuses `outputs` of which one is a file that was read, or two are one file.
///
/// # Errors
/// There are such.
pub fn refuse<'p>(
    outputs: impl IntoIterator<Item = &'p Path>,
    read: &[PathBuf],
) -> Result<(), OutputError> {
    let read: HashMap<Identity, &PathBuf> = read
        .iter()
        .filter_map(|path| Some((identity(path)?, path)))
        .collect();
    let mut written: HashMap<(PathBuf, OsString), &Path> = HashMap::new();
    for output in outputs {
        if let Some(input) = identity(output).and_then(|identity| read.get(&identity)) {
            return Err(OutputError::Overwrites {
                output: output.into(),
                input: (*input).clone(),
            });
        }
        if let Some(first) = place(output).and_then(|place| written.insert(place, output)) {
            return Err(OutputError::SameOutput {
                first: first.into(),
                second: output.into(),
            });
        }
    }
    Ok(())
}

/// Folder and name of the file that would be replaced; `None` where none would be.
fn place(output: &Path) -> Option<(PathBuf, OsString)> {
    let Ok(Destination::File(path)) = Destination::of(output) else {
        return None;
    };
    let name = path.file_name()?.to_owned();
    Some((folder(&path)?, name))
}

#[cfg(all(test, unix))]
mod tests {
    use std::fs;
    use std::os::unix::fs::symlink;
    use std::path::Path;

    use super::refuse;

    #[test]
    fn a_file_is_known_by_any_name() {
        let folder = std::env::temp_dir().join(format!("hyperstat-names-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(folder.join("below")).unwrap();
        let at = |name: &str| folder.join(name);
        fs::write(at("read.csv"), "x").unwrap();
        fs::write(at("other.csv"), "x").unwrap();
        fs::hard_link(at("read.csv"), at("hard.csv")).unwrap();
        symlink("read.csv", at("soft.csv")).unwrap();
        symlink("../other.csv", at("below/soft.csv")).unwrap();
        let read = [at("read.csv")];
        for name in ["read.csv", "below/../read.csv", "hard.csv", "soft.csv"] {
            assert!(refuse([&*at(name)], &read).is_err(), "{name}");
        }
        let allowed = [at("other.csv"), at("new.csv"), at("below/new.csv")];
        refuse(allowed.iter().map(|path| &**path), &read).unwrap();
        refuse([Path::new("/dev/null"), Path::new("/dev/null")], &read).unwrap();
        let both = [at("other.csv"), at("below/soft.csv")];
        assert!(refuse(both.iter().map(|path| &**path), &[]).is_err());
        fs::remove_dir_all(folder).unwrap();
    }
}
