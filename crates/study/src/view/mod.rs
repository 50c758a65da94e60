//! A mechanism as one page to look at, which opens from the disk and fetches nothing: the text, and the core
//! that answers while one drags, or else answers that were worked out beforehand.
//!
//! The page itself is `page.html`, which `just web` makes of the sources in `web`; `web/INTERFACE.md` says what
//! stands where in it.

mod recorded;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use hyperstat_mechanisms::{Files, LoadError, Registry};
use serde_json::{Value, json};

use crate::error::StudyError;
use crate::selection::Selection;
use crate::study::Study;

/// The page without a mechanism.
const PAGE: &str = include_str!("page.html");

/// The core, gzipped, as `just web` has built it.
#[cfg(feature = "live")]
const CORE: Option<&[u8]> = Some(include_bytes!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../web/dist/core.wasm.gz"
)));
#[cfg(not(feature = "live"))]
const CORE: Option<&[u8]> = None;

/// How a page is had that answers while one drags.
const NOT_LIVE: &str = "This page holds results that were worked out beforehand. For one that answers while one \
                        drags: `just web` in a clone of hyperstat, then `cargo install --locked --path crates/cli \
                        --features live`.";

/// A page to look at, in the making.
#[derive(Debug)]
pub struct View {
    title: String,
    /// Files that were read for it.
    read: Vec<PathBuf>,
    /// Their texts, by their names in the page.
    files: BTreeMap<String, String>,
    main: String,
    selection: Selection,
}

impl View {
    /// Whether pages have the core in them (feature `live`).
    pub const LIVE: bool = CORE.is_some();

    /// Of a file, at the first pose that it can take where none is chosen.
    ///
    /// # Errors
    /// As [`Study::of_first`]; a file that was read for it is no text.
    pub fn of_file(
        path: &Path,
        selection: &Selection,
        files: &dyn Files,
        registry: &Registry,
    ) -> Result<Self, StudyError> {
        let loaded = hyperstat_mechanisms::load(path, files, registry)?;
        let read = loaded.files();
        let study = Study::of_first(loaded, path, selection)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let named = |own: &Path| {
            let name = own.strip_prefix(folder).unwrap_or(own);
            name.to_string_lossy().replace('\\', "/")
        };
        let mut texts = BTreeMap::new();
        for own in &read {
            texts.insert(named(own), text(own, files)?);
        }
        Ok(Self {
            title: study.title(None),
            read,
            files: texts,
            main: named(path),
            selection: Selection {
                job: study.job().map(|(job, _)| job.into()),
                design: selection.design,
                pose: study.job().map(|(_, pose)| pose),
            },
        })
    }

    /// Of the text of a mechanism file, called by this name.
    pub fn of_text(title: impl Into<String>, name: &str, text: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            read: Vec::new(),
            files: BTreeMap::from([(name.into(), text.into())]),
            main: name.into(),
            selection: Selection::default(),
        }
    }

    /// Files that were read for it.
    pub fn read(&self) -> &[PathBuf] {
        &self.read
    }

    /// The page, one HTML document. With the core in it, it works out everything itself; without, its answers are
    /// worked out here.
    ///
    /// # Errors
    /// A text that is no mechanism.
    pub fn html(&self, registry: &Registry) -> Result<String, StudyError> {
        let core = CORE.map(|core| STANDARD.encode(core));
        let data = match core {
            Some(_) => self.data(),
            None => self.recorded(registry)?,
        };
        Ok(filled(&self.title, &data, core.as_deref()))
    }

    /// What every page holds.
    fn data(&self) -> Value {
        let Selection { job, design, pose } = &self.selection;
        let mut load = json!({ "ask": "load", "files": self.files, "main": self.main });
        let chosen = [
            ("job", job.as_ref().map(|job| json!(job))),
            ("design", design.map(|design| json!(design))),
            ("pose", pose.map(|pose| json!(pose))),
        ];
        for (name, value) in chosen {
            if let Some(value) = value {
                load[name] = value;
            }
        }
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "title": self.title,
            "load": load,
            "poses": [],
            "maps": [],
            "answers": [],
            "live": NOT_LIVE,
        })
    }
}

/// A file that was read, as text.
fn text(path: &Path, files: &dyn Files) -> Result<String, StudyError> {
    let no_text = |source| LoadError::Read {
        path: PathBuf::from(path),
        source,
    };
    let bytes = files.read(path).map_err(no_text)?;
    let text = String::from_utf8(bytes);
    let text = text.map_err(|_| no_text(std::io::ErrorKind::InvalidData.into()));
    Ok(text?)
}

/// The page with all that belongs into it.
fn filled(title: &str, data: &Value, core: Option<&str>) -> String {
    // Nothing in a text ends the element that it stands in.
    let data = data.to_string().replace('<', "\\u003c");
    let title = title.replace('&', "&amp;").replace('<', "&lt;");
    let mut page = String::with_capacity(PAGE.len() + data.len() + core.map_or(0, str::len));
    let mut rest = PAGE;
    for (mark, content) in [
        (
            "<title>hyperstat</title>",
            format!("<title>{title} – hyperstat</title>").as_str(),
        ),
        ("/*HYPERSTAT-DATA*/", &data),
        ("/*HYPERSTAT-CORE*/", core.unwrap_or_default()),
    ] {
        // In their order in the page, each once; a test holds the page to it.
        let (before, after) = rest.split_once(mark).unwrap_or((rest, ""));
        page += before;
        page += content;
        rest = after;
    }
    page + rest
}
