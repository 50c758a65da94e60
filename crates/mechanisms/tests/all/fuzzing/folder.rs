//! A folder that holds what files under test name, and the texts to begin with.

use std::fs;
use std::path::{Path, PathBuf};

use super::mutator::{group, tokens};

/// Folders of the repository whose files name each other.
const FOLDERS: [&str; 4] = [
    "tests/reference",
    "examples",
    "examples/own-joints",
    "crates/mechanisms/tests/broken",
];

/// A copy of the repository's mechanism files and tables. In one of its folders, where a text under
/// test is said to stand, are all of them, so that whatever one of them names is found.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
}

impl Folder {
    /// The folder `path`, made where it is not there yet, with the files of `repository`.
    ///
    /// # Panics
    /// Where files cannot be read or written.
    pub fn new(repository: &Path, path: &Path) -> Self {
        let folder = Self {
            path: path.join(FOLDERS[3]),
        };
        for name in FOLDERS {
            let from = repository.join(name);
            let entries = from
                .read_dir()
                .unwrap_or_else(|error| panic!("{}: {error}", from.display()));
            for entry in entries {
                let file = entry.unwrap().path();
                let extension = file.extension().unwrap_or_default();
                if extension == "ron" || extension == "csv" {
                    copy(&file, &path.join(name));
                    copy(&file, &folder.path);
                }
            }
        }
        folder
    }

    /// Where a text under test is said to stand.
    pub fn text(&self) -> PathBuf {
        self.path.join("under_test.ron")
    }

    /// Where a table stands that belongs to this process alone, and its name beside the text.
    pub fn table(&self) -> (PathBuf, String) {
        let name = format!("under_test_{}.csv", std::process::id());
        (self.path.join(&name), name)
    }

    /// Text of one of the files.
    ///
    /// # Panics
    /// Where it is not there.
    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }
}

/// Copies a file into a folder, unless it is there: another process may be reading it.
fn copy(file: &Path, folder: &Path) {
    let to = folder.join(file.file_name().unwrap_or_default());
    let content = fs::read(file).unwrap();
    if fs::read(&to).is_ok_and(|there| there == content) {
        return;
    }
    fs::create_dir_all(folder).unwrap();
    fs::write(to, content).unwrap();
}

/// The repository's mechanism and batch files (`"ron"`) or its tables (`"csv"`), those that are wrong
/// too: where each stands, and its text.
///
/// # Panics
/// Where they cannot be read.
pub fn seeds(repository: &Path, extension: &str) -> Vec<(PathBuf, String)> {
    let mut seeds = Vec::new();
    for name in FOLDERS {
        for entry in repository.join(name).read_dir().unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|found| found == extension) {
                let bytes = fs::read(&path).unwrap();
                seeds.push((path, String::from_utf8_lossy(&bytes).into_owned()));
            }
        }
    }
    seeds.sort();
    seeds
}

/// Every job of a batch in a batch of its own: short texts are changed where it matters more often.
pub fn jobs_alone(batch: &str) -> Vec<String> {
    let tokens = tokens(batch);
    let Some(mut at) = tokens.iter().position(|token| *token == "jobs") else {
        return Vec::new();
    };
    let mut jobs = Vec::new();
    while let Some(job) = group(&tokens, at, "(") {
        jobs.push(format!("(jobs: [{}])", tokens[job.clone()].concat()));
        at = job.end;
    }
    jobs
}
