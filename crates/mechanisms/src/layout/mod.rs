//! A file in the layout of this house: what it says and its comments stay, its lines become even.

mod parts;
mod print;
mod tokens;

use std::path::Path;

use crate::error::LoadError;
use crate::text::files::{Files, MemoryFiles};
use crate::text::fragment::Fragment;
use crate::text::source::Source;

/// A mechanism or batch file in even lines; `path` is what messages call it. Names, numbers and texts stay as they
/// are written, comments stay with what they are about, and at most one empty line is kept. What stands
/// on one line stays there as far as it fits; what stands in several does too. RON stays RON, JSON
/// stays JSON.
///
/// # Errors
/// The first mistake in the grammar of the file. What it says is not looked at.
pub fn format(text: &str, path: &Path) -> Result<String, LoadError> {
    let source = Source::new(path, text, &MemoryFiles::new());
    Fragment::of_file(&source)?;
    let even = laid_out(source.text(), source.is_json());
    let even = match source.text().contains("\r\n") {
        true => even.replace("\r\n", "\n").replace('\n', "\r\n"),
        false => even,
    };
    // What the printer does not know stays as it is.
    Ok(match same(source.text(), &even) {
        true => even,
        false => source.text().into(),
    })
}

/// The file in even lines; `None` where it is so already. Its line breaks stay those of Windows where they
/// are.
///
/// # Errors
/// The file cannot be read; as [`format()`].
pub fn format_file(path: &Path, files: &dyn Files) -> Result<Option<String>, LoadError> {
    let source = Source::read(path, files)?;
    let even = format(source.text(), path)?;
    Ok((even != source.text()).then_some(even))
}

/// Whether two texts have the same words and brackets in the same order, and the same comments.
fn same(one: &str, other: &str) -> bool {
    let [one, other] = [one, other].map(|text| {
        let all = tokens::tokens(text).into_iter();
        let all = all.filter(|token| token.kind != tokens::Kind::Comma);
        let (mut comments, values): (Vec<_>, Vec<_>) = all
            .map(|token| (token.is_comment(), token.text))
            .partition(|(comment, _)| *comment);
        comments.sort_unstable();
        (comments, values)
    });
    one == other
}

/// A text whose grammar is right, in even lines.
pub(crate) fn laid_out(text: &str, json: bool) -> String {
    let tokens = tokens::tokens(text);
    let file = parts::Reader::new(&tokens).group("");
    let mut printer = print::Printer {
        json,
        text: String::new(),
    };
    printer.file(&file);
    printer.text
}

#[cfg(test)]
mod tests;
