//! Reports as pages: one self-contained HTML document with drawings, tables, figures, the files that were
//! read, and the definitions of what is in it.

mod definitions;
mod job;
mod mechanism;
mod parts;

use std::path::{Path, PathBuf};

use hyperstat_mechanisms::{Files, Job};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::ask::Focus;
use crate::error::StudyError;
use crate::study::Study;
use crate::sweep::Threads;

/// A report in the making: sections are added, then it is a document. The same sections make the same
/// document, on any machine.
#[derive(Debug)]
pub struct Page {
    title: String,
    sections: Vec<(String, Markup)>,
}

impl Page {
    /// An empty report.
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            sections: Vec::new(),
        }
    }

    /// Adds a mechanism in its configuration: drawn, solved, and what is soft and why.
    ///
    /// # Errors
    /// It has no solution, or its output moves freely; it has no such case, or not the natural frequencies.
    pub fn add_study(&mut self, study: &mut Study, focus: &Focus) -> Result<(), StudyError> {
        let heading = study.title(None);
        let section = mechanism::section(study, focus)?;
        self.sections.push((heading, section));
        Ok(())
    }

    /// Adds a job of a batch, which is run: how its poses came out, the measures over them, and its figures.
    /// Its table is held in memory.
    ///
    /// # Errors
    /// The job cannot be run.
    pub fn add_job(&mut self, job: &Job, threads: &Threads) -> Result<(), StudyError> {
        let section = job::section(job, threads)?;
        self.sections.push((format!("Job {}", job.name), section));
        Ok(())
    }

    /// Adds files as they are written; one that is no text is named only.
    pub fn add_files(&mut self, paths: &[PathBuf], files: &dyn Files) {
        let texts = paths.iter().map(|path| (path, text(path, files)));
        let listed = html! {
            @for (path, text) in texts {
                h3 { (path.display()) }
                @match text {
                    Some(text) => pre { (text) },
                    None => p { "Not a text." },
                }
            }
        };
        self.sections.push(("Files".into(), listed));
    }

    /// The document.
    pub fn html(mut self) -> String {
        self.sections
            .push(("Definitions".into(), definitions::section()));
        let document = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    meta name="generator" content=(concat!("hyperstat ", env!("CARGO_PKG_VERSION")));
                    title { (self.title) }
                    style { (PreEscaped(STYLE)) }
                }
                body {
                    h1 { (self.title) }
                    p.by {
                        "Elastostatic analysis by hyperstat " (env!("CARGO_PKG_VERSION"))
                        ". SI units, global frame, where nothing else is said."
                    }
                    nav { ol {
                        @for (k, (heading, _)) in self.sections.iter().enumerate() {
                            li { a href={ "#s" (k + 1) } { (heading) } }
                        }
                    } }
                    @for (k, (heading, section)) in self.sections.iter().enumerate() {
                        section id={ "s" (k + 1) } {
                            h2 { (k + 1) ". " (heading) }
                            (section)
                        }
                    }
                }
            }
        };
        document.into_string() + "\n"
    }
}

/// The text of a file; `None` of one that is none, such as a table in binary columns.
fn text(path: &Path, files: &dyn Files) -> Option<String> {
    let bytes = files.read(path).ok()?;
    let text = String::from_utf8(bytes).ok()?;
    (!text.contains('\0')).then_some(text)
}

/// How it looks, on a screen and on paper. Nothing is fetched.
const STYLE: &str = "\
body { font: 15px/1.45 'Liberation Sans', Arimo, Arial, Helvetica, sans-serif; color: #222; max-width: 60rem;
  margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; margin-bottom: 0; } .by { color: #666; margin-top: .2rem; }
h2 { font-size: 1.3rem; border-bottom: 1px solid #ccc; margin-top: 2.5rem; } h3 { font-size: 1.05rem; }
table { border-collapse: collapse; margin: .5rem 0 1rem; font-size: .87rem; font-variant-numeric: tabular-nums; }
th, td { padding: .15rem .6rem; border-bottom: 1px solid #e4e4e4; text-align: right; white-space: nowrap; }
th { border-bottom: 1px solid #999; font-weight: 600; }
th:first-child, td:first-child, td.word, th.word { text-align: left; white-space: normal; }
div.wide { overflow-x: auto; } figure { margin: 1rem 0; } figure > svg { width: 100%; height: auto; }
figcaption { color: #555; font-size: .87rem; }
pre { background: #f6f6f6; padding: .7rem; overflow-x: auto; font-size: .8rem; white-space: pre-wrap; }
dt { font-weight: 600; margin-top: .5rem; } dd { margin-left: 1.2rem; } .warning { color: #8a3b00; }
@media print { body { max-width: none; margin: 0; font-size: 11px; } nav { display: none; }
  section { break-before: page; } section#s1 { break-before: auto; } figure, tr { break-inside: avoid; } }
";
