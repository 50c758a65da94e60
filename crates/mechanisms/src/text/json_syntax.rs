//! Mistakes in the grammar of a JSON file, in words for the one who wrote it.

use std::sync::Arc;

use super::brackets::{self, Imbalance};
use super::json;
use super::source::{Place, Source};
use crate::error::LoadError;

/// What is said of notation that is RON's.
const RON: &str = "write the file as RON, which begins with `(`";

/// What is wrong with the grammar of `source`, where serde_json says `error`.
pub(crate) fn error(source: &Arc<Source>, error: &serde_json::Error) -> LoadError {
    let text = source.text();
    let noticed = offset(text, error.line(), error.column());
    let place = |at: usize, width: usize| Place {
        source: Arc::clone(source),
        span: at..at + width,
    };
    let said = error.to_string();
    if error.is_eof() {
        return match brackets::imbalance(text, usize::MAX) {
            Some(Imbalance::Text { start, .. }) => place(start, 1)
                .error("this text is not closed")
                .with_help("add the missing `\"`"),
            Some(Imbalance::Open { open }) => place(open, 1)
                .error(format!("this `{}` is never closed", &text[open..=open]))
                .with_help("add the missing bracket"),
            _ => place(text.len(), 0)
                .error("the file ends too early")
                .with_help("look for what is missing at its end"),
        };
    }
    if let Some(Imbalance::Mismatch { open, close }) = brackets::imbalance(text, usize::MAX)
        && close == noticed
        && text[open..].starts_with(['[', '{'])
    {
        let line = place(open, 1).location().line;
        let [open, found] = [open, close].map(|k| &text[k..=k]);
        return place(close, 1)
            .error(format!(
                "`{found}` cannot close the `{open}` of line {line}"
            ))
            .with_help("close every bracket with its own kind");
    }
    let next = text[noticed..].chars().next();
    let trailing = text[..noticed].trim_end().ends_with(',');
    if trailing && matches!(next, Some(']' | '}')) {
        return place(noticed, 1)
            .error("no comma may stand before a closing bracket")
            .with_help("JSON has no trailing commas: remove it");
    }
    let word: String = text[noticed..]
        .chars()
        .take_while(|c| c.is_alphanumeric() || *c == '_')
        .collect();
    let (message, help) = describe(&said, next, &word);
    let width = word.len().max(next.map_or(0, char::len_utf8));
    place(noticed, width).error(message).with_help(help)
}

/// The error of brackets that are nested too deeply, if they are.
pub(crate) fn depth(source: &Arc<Source>) -> Option<LoadError> {
    let at = json::too_deep(source.text())?;
    let place = Place {
        source: Arc::clone(source),
        span: at..at + 1,
    };
    let error = place.error("brackets are nested too deeply");
    Some(error.with_help("no value of the format is nested more than a dozen deep"))
}

/// Byte offset of a line, from 1, and a column in bytes, from 1; 0 is the end of the line before.
fn offset(text: &str, line: usize, column: usize) -> usize {
    let mut start = 0;
    for _ in 1..line {
        start += text[start..].find('\n').map_or(0, |k| k + 1);
    }
    let offset = (start + column).saturating_sub(1).min(text.len());
    (0..=offset)
        .rev()
        .find(|&k| text.is_char_boundary(k))
        .unwrap_or(0)
}

/// Words for what serde_json says at the character `next`, with which `word` may begin.
fn describe(said: &str, next: Option<char>, word: &str) -> (String, String) {
    let say = |message: &str, help: &str| (message.to_owned(), help.to_owned());
    match next {
        Some('/' | '#') => return say("JSON has no comments", &format!("remove it, or {RON}")),
        Some('\'') => return say("unexpected `'`", "texts stand in double quotes"),
        Some('(' | ')') => {
            let found = next.unwrap_or_default();
            return (
                format!("unexpected `{found}`"),
                format!("vectors stand in `[ ]`, fields in `{{ }}`; or {RON}"),
            );
        }
        _ => {}
    }
    if said.starts_with("trailing characters") {
        return say(
            "nothing may follow the closing bracket of the file",
            "look for a bracket closed too early",
        );
    }
    if said.starts_with("key must be a string") {
        return match word {
            "" => say("expected a name in quotes", "write `\"name\": …`"),
            word => (
                format!("expected a name in quotes, found `{word}`"),
                format!("write `\"{word}\"`, or {RON}"),
            ),
        };
    }
    if said.starts_with("expected `:`") {
        return say("expected `:` before this", "write `\"name\": value`");
    }
    if said.starts_with("expected `,`") {
        return say(
            "expected `,` or a closing bracket before this",
            "separate fields and values by commas",
        );
    }
    if said.starts_with("control character") {
        return say(
            "a text does not go on in the next line, and holds no tabs",
            "write `\\n` and `\\t`, or close the text",
        );
    }
    if said.contains("escape") {
        return say(
            "a `\\` begins an escape, and this is none",
            "write `\\\\` for a backslash",
        );
    }
    let number = "write a number such as 0.25, -3 or 2.1e11";
    match word {
        "True" | "False" => (
            format!("unexpected `{word}`"),
            format!("write {}", word.to_lowercase()),
        ),
        "NaN" | "Infinity" | "inf" | "nan" => {
            (format!("`{word}` is not a finite number"), number.into())
        }
        _ if said.starts_with("invalid number") || matches!(next, Some('.' | '+')) => {
            say("this cannot stand here in a number", number)
        }
        "" => (
            match next {
                Some(next) => format!("expected a value, found `{next}`"),
                None => "expected a value".into(),
            },
            "give a number, a text in quotes, `[ ]` or `{ }`".into(),
        ),
        word => (
            format!("unexpected `{word}`"),
            format!("texts and words stand in quotes: write \"{word}\""),
        ),
    }
}
