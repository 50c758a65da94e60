//! All that the bytes of a run follow from: what was read and what was asked for.

use std::path::{Path, PathBuf};

use hyperstat_mechanisms::{Batch, LoadError, MemoryFiles, Registry, load_batch};
use serde::{Deserialize, Serialize};

use super::error::PartsError;
use super::reading::Reading;
use super::shelf::{self, Shelf};
use crate::sweep::Way;
use crate::table::TableFormat;

/// The version of hyperstat, of a build from a clone with the state of its sources.
const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), env!("HYPERSTAT_STATE"));

/// What names of files begin and end with, around some digits of the hash.
const BEGIN: &str = "_run-";
const END: &str = ".json";
const DIGITS: usize = 16;

/// What is asked for and changes what is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Options {
    /// Tables in Apache Parquet; else in CSV.
    pub parquet: bool,
    /// Measures over the rows.
    pub summary: bool,
    /// Figures as PDF, too.
    pub pdf: bool,
    /// Every pose by itself.
    pub one_by_one: bool,
}

impl Options {
    /// The way that poses go.
    pub fn way(&self) -> Way {
        match self.one_by_one {
            true => Way::OneByOne,
            false => Way::Lanes,
        }
    }

    /// The form of the tables.
    pub fn format(&self) -> TableFormat {
        match self.parquet {
            #[cfg(feature = "parquet")]
            true => TableFormat::Parquet,
            _ => TableFormat::Csv,
        }
    }
}

/// All that was read and asked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Origin {
    written: Written,
    hash: String,
}

#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    /// Version of hyperstat.
    hyperstat: String,
    options: Options,
    /// Name of the batch file.
    batch: String,
    /// It and the files that it names, by their names from its folder.
    files: Vec<File>,
}

#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: String,
    content: Text,
}

#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
enum Text {
    Text(String),
    Bytes(Vec<u8>),
}

impl Origin {
    /// Of a batch that was read through `reading`. What its designs read is read now.
    pub fn new(path: &Path, batch: &Batch, reading: &Reading, options: Options) -> Self {
        for job in &batch.jobs {
            // Another text may name another file.
            if job.varied().iter().any(|varied| !varied.numeric) {
                (0..job.designs()).for_each(|design| drop(job.design(design)));
            }
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        let name = |path: &Path| {
            let own = path.strip_prefix(folder).unwrap_or(path);
            own.to_string_lossy().replace('\\', "/")
        };
        let files = reading.all().into_iter().map(|(path, content)| File {
            name: name(&path),
            content: match str::from_utf8(&content) {
                Ok(text) => Text::Text(text.into()),
                Err(_) => Text::Bytes(content.to_vec()),
            },
        });
        Self::of(Written {
            hyperstat: VERSION.into(),
            options,
            batch: name(path),
            files: files.collect(),
        })
    }

    fn of(written: Written) -> Self {
        // What is made of texts and numbers always has a JSON.
        let text = serde_json::to_vec(&written).unwrap_or_default();
        let hash = blake3::hash(&text).to_hex().to_string();
        Self { written, hash }
    }

    /// 64 digits, of which others with any other content have others.
    pub fn hash(&self) -> &str {
        &self.hash
    }

    /// What was asked for.
    pub fn options(&self) -> Options {
        self.written.options
    }

    /// Name of its file.
    pub(super) fn name(&self) -> String {
        Self::name_of(&self.hash)
    }

    /// Name of the file of that of a hash.
    pub(super) fn name_of(hash: &str) -> String {
        format!("parts/{BEGIN}{}{END}", &hash[..hash.len().min(DIGITS)])
    }

    /// Whether the run of this hash was begun in a folder of results, and no other.
    pub(super) fn is_alone(shelf: &dyn Shelf, hash: &str) -> Result<bool, PartsError> {
        let own = Self::name_of(hash);
        let names = shelf.names("parts").map_err(PartsError::read("parts"))?;
        let origins: Vec<_> = names.iter().filter(|name| Self::is_name(name)).collect();
        Ok(!origins.is_empty() && origins.iter().all(|name| own.ends_with(&***name)))
    }

    /// Whether a name in the folder of parts is of such a file, and not of a job.
    pub(super) fn is_name(name: &str) -> bool {
        let digits = name
            .strip_prefix(BEGIN)
            .and_then(|name| name.strip_suffix(END));
        digits.is_some_and(|own| {
            own.len() == DIGITS && own.bytes().all(|b| matches!(b, b'0'..=b'9' | b'a'..=b'f'))
        })
    }

    /// Writes it, where it is not yet.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(&self, shelf: &dyn Shelf) -> std::io::Result<()> {
        if Self::known(shelf, &self.hash).is_ok() {
            return Ok(());
        }
        let text = serde_json::to_vec(&self.written).unwrap_or_default();
        shelf::write(shelf, &self.name(), &text)
    }

    /// Reads that of a hash, to go on with its run.
    ///
    /// # Errors
    /// There is none that is whole, or it is of another version of hyperstat.
    pub fn read(shelf: &dyn Shelf, hash: &str) -> Result<Self, PartsError> {
        let read = Self::known(shelf, hash)?;
        match read.written.hyperstat == VERSION {
            true => Ok(read),
            false => Err(PartsError::Version {
                then: read.written.hyperstat,
                now: VERSION,
            }),
        }
    }

    /// Reads that of a hash, of whatever version.
    pub(super) fn known(shelf: &dyn Shelf, hash: &str) -> Result<Self, PartsError> {
        let name = Self::name_of(hash);
        let lost = |why: String| PartsError::NoOrigin {
            name: name.clone(),
            why,
        };
        let text = shelf::read(shelf, &name).map_err(|error| lost(error.to_string()))?;
        let written = serde_json::from_slice(&text).map_err(|error| lost(error.to_string()))?;
        let read = Self::of(written);
        match read.hash == hash {
            true => Ok(read),
            false => Err(lost("it is not what was written".into())),
        }
    }

    /// The batch, from the texts that were read.
    ///
    /// # Errors
    /// As of a batch file.
    pub fn batch(&self, registry: &Registry) -> Result<Batch, LoadError> {
        let files = self.written.files.iter().map(|file| {
            let content = match &file.content {
                Text::Text(text) => text.clone().into_bytes(),
                Text::Bytes(bytes) => bytes.clone(),
            };
            (PathBuf::from(&file.name), content)
        });
        let files: MemoryFiles = files.collect();
        load_batch(Path::new(&self.written.batch), &files, registry)
    }

    /// What differs in another one, in words.
    pub(super) fn difference(&self, other: &Self) -> String {
        let (own, other) = (&self.written, &other.written);
        let mut told = Vec::new();
        if own.hyperstat != other.hyperstat {
            told.push(format!("it is of hyperstat {}", other.hyperstat));
        }
        let options = |of: &Options| {
            [
                ("--format parquet", of.parquet),
                ("--summary", of.summary),
                ("--pdf", of.pdf),
                ("--one-by-one", of.one_by_one),
            ]
        };
        for ((name, own), (_, other)) in options(&own.options)
            .into_iter()
            .zip(options(&other.options))
        {
            match (own, other) {
                (true, false) => told.push(format!("it was without `{name}`")),
                (false, true) => told.push(format!("it was with `{name}`")),
                _ => {}
            }
        }
        for file in &own.files {
            match other.files.iter().find(|known| known.name == file.name) {
                None => told.push(format!("it did not read {}", file.name)),
                Some(known) if known.content != file.content => {
                    told.push(format!("{} was another then", file.name));
                }
                Some(_) => {}
            }
        }
        for file in &other.files {
            if !own.files.iter().any(|known| known.name == file.name) {
                told.push(format!("it read {}", file.name));
            }
        }
        told.join(", ")
    }
}
