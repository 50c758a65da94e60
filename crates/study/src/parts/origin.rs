//! All that the bytes of a run follow from: what was read and what was asked for.

use std::path::{Path, PathBuf};

use hyperstat_mechanisms::{Batch, LoadError, MemoryFiles, Registry, load_batch};
use serde::{Deserialize, Serialize};

use super::error::PartsError;
use super::reading::Reading;
use super::shelf::{self, Shelf};
use crate::sweep::Way;
use crate::table::TableFormat;

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
            hyperstat: env!("CARGO_PKG_VERSION").into(),
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
    pub(super) fn name_of(hash: &str) -> String {
        format!("parts/_run-{}.json", &hash[..hash.len().min(16)])
    }

    /// Writes it, where it is not yet.
    pub(super) fn write(&self, shelf: &dyn Shelf) -> std::io::Result<()> {
        let name = Self::name_of(&self.hash);
        if Self::read(shelf, &self.hash).is_ok() {
            return Ok(());
        }
        let text = serde_json::to_vec(&self.written).unwrap_or_default();
        shelf::write(shelf, &name, &text)
    }

    /// Reads that of a hash.
    ///
    /// # Errors
    /// There is none that is whole.
    pub fn read(shelf: &dyn Shelf, hash: &str) -> Result<Self, PartsError> {
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
