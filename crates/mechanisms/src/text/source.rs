//! The text of a file, and places in it.

use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use crate::error::{LoadError, Location};
use crate::text::files::{self, Files, MemoryFiles};
use crate::text::json;

/// A text file: its name in messages and its text.
#[derive(Debug)]
pub(crate) struct Source {
    path: PathBuf,
    text: String,
    /// Whether its last line feed is not the file's.
    added: bool,
    /// Whether it is JSON; else it is RON.
    json: bool,
    /// Where the whole text is asked for, if it stands in no file as it is.
    origin: Option<Place>,
    /// Name of the argument that it is, if a program hands it in.
    argument: Option<String>,
    family: Arc<Family>,
    /// Whether messages may show its text: not that of a file from elsewhere, named by another,
    /// before it is known to be of the kind that it was taken for.
    shown: AtomicBool,
}

/// What the file that was asked for and the files that it names have in common.
#[derive(Debug)]
struct Family {
    /// Where files are read from.
    files: Box<dyn Files>,
    /// Folder of the file that was asked for; `None` where it is in none.
    folder: Option<PathBuf>,
    /// All files that were read.
    read: Mutex<BTreeSet<PathBuf>>,
}

impl Family {
    /// Of a file that is asked for.
    fn of(path: &Path, files: &dyn Files) -> Arc<Self> {
        Arc::new(Self {
            files: files.clone_box(),
            folder: folder(path, files),
            read: Mutex::default(),
        })
    }

    /// Whether a file lies in the folder, or in one below it.
    fn holds(&self, path: &Path) -> bool {
        let place = self.files.resolve(path).ok();
        let of_both = place.as_ref().zip(self.folder.as_ref());
        of_both.is_some_and(|(place, folder)| place.starts_with(folder))
    }
}

/// A text whose lines end with line feeds, the last one too if it holds a comment, since ron reads none that
/// does not end; and whether that one was added.
fn whole_lines(text: &str) -> (String, bool) {
    let mut text = match text.contains('\n') {
        true => text.to_owned(),
        false => text.replace('\r', "\n"),
    };
    let added =
        !text.ends_with('\n') && text.lines().last().is_some_and(|last| last.contains("//"));
    if added {
        text.push('\n');
    }
    (text, added)
}

/// The folder that a file is in, without links.
fn folder(path: &Path, files: &dyn Files) -> Option<PathBuf> {
    let parent = path.parent()?;
    let here = parent.as_os_str().is_empty();
    let parent = if here { Path::new(".") } else { parent };
    files.resolve(parent).ok()
}

impl Source {
    /// `text`, which messages call `path`; a byte order mark is dropped, and carriage returns that
    /// alone end lines are read as line feeds. Files that it names are read from `files`.
    pub(crate) fn new(path: &Path, text: &str, files: &dyn Files) -> Arc<Self> {
        Self::of(path, text, Family::of(path, files), true)
    }

    fn of(path: &Path, text: &str, family: Arc<Family>, shown: bool) -> Arc<Self> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let (text, added) = whole_lines(text);
        Arc::new(Self {
            path: path.into(),
            json: json::is_json(&text),
            text,
            added,
            origin: None,
            argument: None,
            family,
            shown: AtomicBool::new(shown),
        })
    }

    /// A value that is asked for at `origin` without standing there, such as one of a range:
    /// messages about it point there.
    pub(crate) fn made(text: String, origin: Place) -> Arc<Self> {
        Arc::new(Self {
            path: origin.source.path.clone(),
            text,
            added: false,
            json: false,
            family: Arc::clone(&origin.source.family),
            shown: AtomicBool::new(true),
            argument: None,
            origin: Some(origin),
        })
    }

    /// What a program hands in under this name, as it would stand in a file: in that of `near`, whose
    /// files it may name, or in none. Near a JSON file it is JSON where it can be, else RON.
    pub(crate) fn argument(name: &str, text: String, near: Option<&Arc<Self>>) -> Arc<Self> {
        let json = near.is_some_and(|near| near.json) && json::is_value(&text);
        Self::handed_in(name, text, json, near)
    }

    /// The same in JSON, near whatever file.
    pub(crate) fn json_argument(name: &str, text: String, near: Option<&Arc<Self>>) -> Arc<Self> {
        Self::handed_in(name, text, true, near)
    }

    fn handed_in(name: &str, text: String, json: bool, near: Option<&Arc<Self>>) -> Arc<Self> {
        Arc::new(Self {
            path: near.map_or_else(PathBuf::new, |near| near.path.clone()),
            json,
            text,
            added: false,
            origin: None,
            argument: Some(name.into()),
            family: match near {
                Some(near) => Arc::clone(&near.family),
                None => Family::of(Path::new(""), &MemoryFiles::new()),
            },
            shown: AtomicBool::new(true),
        })
    }

    /// Reads a file that is asked for.
    pub(crate) fn read(path: &Path, files: &dyn Files) -> Result<Arc<Self>, LoadError> {
        let family = Family::of(path, files);
        let ending = path.extension().and_then(|ending| ending.to_str());
        if ending.is_some_and(|ending| ["csv", "parquet"].contains(&ending)) {
            let bytes = files::read_from(files, path);
            bytes.map_err(|source| LoadError::Read {
                path: path.into(),
                source,
            })?;
            let place = Place {
                source: Self::of(path, "", family, false),
                span: 0..0,
            };
            return Err(place
                .error("this is a table, where a mechanism or batch file is wanted")
                .with_help("`plot` draws tables, `compare` compares two of them"));
        }
        Self::read_into(path, family, true)
    }

    /// Reads a file that this one names. Messages show its text where it lies in the folder of the
    /// file that was asked for, else from [`Source::understood`] on.
    pub(crate) fn read_named(&self, path: &Path) -> Result<Arc<Self>, LoadError> {
        Self::read_into(path, Arc::clone(&self.family), self.family.holds(path))
    }

    fn read_into(path: &Path, family: Arc<Family>, shown: bool) -> Result<Arc<Self>, LoadError> {
        let read = files::read_from(family.files.as_ref(), path);
        let bytes = read.map_err(|source| LoadError::Read {
            path: path.into(),
            source,
        })?;
        let mut read = family.read.lock().unwrap_or_else(PoisonError::into_inner);
        read.insert(path.into());
        drop(read);
        match String::from_utf8(bytes) {
            Ok(text) => Ok(Self::of(path, &text, family, shown)),
            Err(error) => {
                let valid = error.utf8_error().valid_up_to();
                let text = String::from_utf8_lossy(error.as_bytes());
                let place = Place {
                    source: Self::of(path, &text, family, shown),
                    span: valid..valid,
                };
                Err(place
                    .error("the file is not UTF-8 text")
                    .with_help("save it with the encoding UTF-8"))
            }
        }
    }

    /// Notes that the file is of the kind that it was taken for: from now on messages show its text.
    pub(crate) fn understood(&self) {
        self.shown.store(true, Ordering::Relaxed);
    }

    /// Whether messages may show its text.
    pub(crate) fn is_shown(&self) -> bool {
        self.shown.load(Ordering::Relaxed)
    }

    /// All files that were read: the one that was asked for and those that it led to, so far.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        let read = self.family.read.lock();
        let read = read.unwrap_or_else(PoisonError::into_inner);
        read.iter().cloned().collect()
    }

    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// The text as the file has it.
    pub(crate) fn written(&self) -> &str {
        &self.text[..self.text.len() - usize::from(self.added)]
    }

    /// Whether it is JSON; else it is RON.
    pub(crate) fn is_json(&self) -> bool {
        self.json
    }

    /// `path` as seen from the folder of this file.
    pub(crate) fn relative(&self, path: &str) -> PathBuf {
        match self.path.parent() {
            Some(folder) => folder.join(path),
            None => path.into(),
        }
    }

    fn locate(&self, span: &Range<usize>) -> Location {
        let last = self.text.len() - usize::from(self.added);
        let start = boundary(&self.text, span.start.min(last));
        let (before, rest) = self.text.split_at(start);
        let line_start = before.rfind('\n').map_or(0, |k| k + 1);
        let line_end = rest.find('\n').map_or(self.text.len(), |k| start + k);
        let end = boundary(&self.text, span.end.min(line_end));
        let whole = self.argument.is_some() && (span.is_empty() || *span == (0..self.text.len()));
        let (line, column) = match whole {
            true => (0, 0),
            false => (
                1 + before.matches('\n').count(),
                1 + self.text[line_start..start].chars().count(),
            ),
        };
        Location {
            path: self.argument.as_ref().map_or(self.path.clone(), Into::into),
            line,
            column,
            width: self.text[start..end.max(start)]
                .trim_end()
                .chars()
                .count()
                .max(1),
            text: match self.is_shown() {
                true => self.text[line_start..line_end]
                    .trim_end_matches('\r')
                    .into(),
                false => String::new(),
            },
        }
    }

    /// Byte offset of a line and a column in characters, both from 1.
    pub(crate) fn offset(&self, line: usize, column: usize) -> usize {
        let mut start = 0;
        for _ in 1..line {
            start += self.text[start..].find('\n').map_or(0, |k| k + 1);
        }
        let mut characters = self.text[start..].char_indices();
        characters
            .nth(column.saturating_sub(1))
            .map_or(self.text.len(), |(k, _)| start + k)
    }
}

/// The last character boundary of `text` at or before `offset`.
fn boundary(text: &str, offset: usize) -> usize {
    let offset = offset.min(text.len());
    (0..=offset)
        .rev()
        .find(|&k| text.is_char_boundary(k))
        .unwrap_or(0)
}

/// A range of bytes of a source, kept for messages that come after reading.
#[derive(Debug, Clone)]
pub(crate) struct Place {
    pub(crate) source: Arc<Source>,
    pub(crate) span: Range<usize>,
}

impl Place {
    /// A whole source.
    pub(crate) fn whole(source: &Arc<Source>) -> Self {
        Self {
            source: Arc::clone(source),
            span: 0..source.text().len(),
        }
    }

    pub(crate) fn location(&self) -> Location {
        match &self.source.origin {
            Some(origin) => origin.location(),
            None => self.source.locate(&self.span),
        }
    }

    pub(crate) fn error(&self, message: impl Into<String>) -> LoadError {
        LoadError::At {
            location: Box::new(self.location()),
            message: match self.source.is_shown() {
                true => message.into(),
                false => NOT_SHOWN.into(),
            },
            help: None,
            unreadable: false,
            json: self.source.is_json(),
        }
    }
}

/// What is said of a file from elsewhere that is not what it was taken for.
const NOT_SHOWN: &str = "this is not understood; the text is not shown, for the file lies outside \
                         the folder of the file that was given";

#[cfg(test)]
mod tests {
    use super::*;

    fn locate(text: &str, span: Range<usize>) -> (usize, usize, usize, String) {
        let source = Source::new(Path::new("f.ron"), text, &MemoryFiles::new());
        let place = Place { source, span };
        let at = place.location();
        (at.line, at.column, at.width, at.text)
    }

    #[test]
    fn columns_and_widths_count_characters() {
        let text = "å: 1,\r\nβγ: 22,\n";
        let start = text.find("22").unwrap();
        assert_eq!(locate(text, start..start + 2), (2, 5, 2, "βγ: 22,".into()));
        assert_eq!(locate(text, 0..2), (1, 1, 1, "å: 1,".into()));
        assert_eq!(locate(text, start..text.len()), (2, 5, 3, "βγ: 22,".into()));
    }

    #[test]
    fn ends_and_odd_offsets_are_places_too() {
        assert_eq!(locate("", 0..0), (1, 1, 1, String::new()));
        assert_eq!(locate("a\n", 2..2), (2, 1, 1, String::new()));
        assert_eq!(locate("åb", 1..9).1, 1);
    }

    #[test]
    fn offset_is_the_inverse_of_location() {
        let source = Source::new(Path::new("f.ron"), "ab\nåcd\n\nx", &MemoryFiles::new());
        for (k, _) in source.text().char_indices() {
            let at = source.locate(&(k..k));
            assert_eq!(source.offset(at.line, at.column), k);
        }
        assert_eq!(source.offset(99, 99), source.text().len());
    }
}
