//! What is said of a piece: which rows it has, and how they came out.

use std::collections::BTreeMap;
use std::io;
use std::ops::Range;

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

use super::part::Share;
use super::shelf::{self, Shelf};
use crate::ran::Kept;
use crate::table::Reader;

/// What is said of a piece.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Manifest {
    /// Version of this form.
    pub(super) form: u32,
    /// Hash of all that was read and asked for.
    pub(super) run: String,
    /// Name of the job.
    pub(super) job: String,
    /// Its rows of the job's whole table.
    pub(super) rows: Range<usize>,
    /// Where it is one: the share that it is of.
    pub(super) share: Option<Share>,
    /// Whether it is a piece of something larger, and goes when that is complete.
    pub(super) piece: bool,
    /// How many rows came out how.
    pub(super) statuses: BTreeMap<String, usize>,
    /// The table with its rows.
    pub(super) table: Table,
    /// What else was found of them.
    pub(super) found: Kept,
}

/// A file with rows.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Table {
    /// Its name in the folder of results.
    pub(super) name: String,
    /// Its size.
    pub(super) bytes: u64,
    /// Its hash.
    pub(super) blake3: String,
}

/// A manifest as it is written, with its own hash.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Sealed<'t> {
    #[serde(borrow)]
    manifest: &'t RawValue,
    blake3: String,
}

/// Version of the form of manifests.
pub(super) const FORM: u32 = 1;

/// Folder of a job's pieces.
pub(super) fn folder(job: &str) -> String {
    format!("parts/{job}")
}

/// Name of the table and of the manifest of these rows.
pub(super) fn stem(rows: &Range<usize>) -> String {
    format!("{:012}-{:012}", rows.start, rows.end)
}

/// The rows that a name of a table, or of a manifest, is of.
pub(super) fn rows_of(name: &str) -> Option<Range<usize>> {
    let (stem, _) = name.trim_start_matches('_').split_once('.')?;
    let (start, end) = stem.split_once('-')?;
    let number = |digits: &str| {
        let digital = digits.len() >= 12 && digits.bytes().all(|b| b.is_ascii_digit());
        digits.parse().ok().filter(|_| digital)
    };
    Some(number(start)?..number(end)?)
}

impl Manifest {
    /// Its name in the folder of results.
    pub(super) fn name(&self) -> String {
        format!("{}/_{}.json", folder(&self.job), stem(&self.rows))
    }

    /// Whether its rows are the job's table itself, not one of its parts.
    pub(super) fn is_result(&self) -> bool {
        !self.table.name.starts_with("parts/")
    }

    pub(super) fn write(&self, shelf: &dyn Shelf) -> io::Result<()> {
        let manifest = serde_json::to_string(self)?;
        let hash = blake3::hash(manifest.as_bytes()).to_hex();
        let text = format!("{{\"manifest\":{manifest},\"blake3\":\"{hash}\"}}\n");
        shelf::write(shelf, &self.name(), text.as_bytes())
    }

    /// Reads one; why it is none, or not whole.
    pub(super) fn read(shelf: &dyn Shelf, name: &str) -> Result<Self, String> {
        let text = shelf::read(shelf, name).map_err(|error| error.to_string())?;
        let spoilt = || "it is not what was written".to_string();
        let sealed: Sealed<'_> = serde_json::from_slice(&text).map_err(|_| spoilt())?;
        let manifest = sealed.manifest.get();
        if blake3::hash(manifest.as_bytes()).to_hex().as_str() != sealed.blake3 {
            return Err(spoilt());
        }
        let read: Self = serde_json::from_str(manifest).map_err(|error| {
            format!("it is of another version of hyperstat, or none of its manifests: {error}")
        })?;
        match read.form == FORM && read.name() == name {
            true => Ok(read),
            false => Err(spoilt()),
        }
    }
}

impl Table {
    /// Whether the file is the one that was written; why it is not.
    pub(super) fn check(&self, shelf: &dyn Shelf) -> Result<(), String> {
        let told = |error: io::Error| match error.kind() {
            io::ErrorKind::NotFound => "it is missing".into(),
            _ => error.to_string(),
        };
        let content = shelf.open(&self.name).map_err(told)?;
        if content.length() != self.bytes {
            let (now, then) = (content.length(), self.bytes);
            return Err(format!(
                "it has {now} bytes, and had {then} when it was written"
            ));
        }
        let mut hasher = blake3::Hasher::new();
        io::copy(&mut Reader::new(content, 0), &mut hasher).map_err(told)?;
        match hasher.finalize().to_hex().as_str() == self.blake3 {
            true => Ok(()),
            false => Err("it is not what was written: bits of it have changed".into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{rows_of, stem};

    #[test]
    fn names_tell_rows() {
        let name = stem(&(5..65_536));
        assert_eq!(name, "000000000005-000000065536");
        for ending in [".csv", ".parquet"] {
            assert_eq!(rows_of(&(name.clone() + ending)), Some(5..65_536));
        }
        assert_eq!(rows_of(&format!("_{name}.json")), Some(5..65_536));
        assert_eq!(stem(&(0..1 << 45)), "000000000000-35184372088832");
        for other in ["map.csv", "0-5.csv", "000000000005-00000006553x.csv", &name] {
            assert_eq!(rows_of(other), None, "{other}");
        }
    }
}
