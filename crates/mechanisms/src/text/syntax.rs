//! Mistakes in the grammar of a file, in words for the one who wrote it.

use std::ops::Range;
use std::sync::Arc;

use ron::error::{Error, SpannedError};

use super::brackets::Imbalance;
use super::source::{Place, Source};
use crate::error::LoadError;
use crate::text::{brackets, slips};

/// What is wrong with the grammar of `source`, where ron says `error`.
///
/// ron notices a bracket or a quote that is not closed only where the text makes no more sense,
/// or at its end; the error then points at the bracket or quote itself.
pub(crate) fn error(source: &Arc<Source>, error: &SpannedError) -> LoadError {
    let noticed = source.offset(error.span.end.line, error.span.end.col);
    let place = |at: usize, width: usize| Place {
        source: Arc::clone(source),
        span: at..at + width,
    };
    match brackets::imbalance(source.text(), noticed) {
        Some(Imbalance::Text { start, hashes }) if start <= noticed => {
            return place(start, 1)
                .error("this text is not closed")
                .with_help(format!("add the missing `\"{}`", "#".repeat(hashes)));
        }
        Some(Imbalance::Comment { start }) if start <= noticed => {
            return place(start, 2)
                .error("this comment is not closed")
                .with_help("add the missing `*/`");
        }
        Some(Imbalance::Mismatch { open, close }) if close <= noticed => {
            let line = place(open, 1).location().line;
            let [open, found] = [open, close].map(|k| &source.text()[k..=k]);
            return place(close, 1)
                .error(format!(
                    "`{found}` cannot close the `{open}` of line {line}"
                ))
                .with_help("close every bracket with its own kind");
        }
        Some(Imbalance::Open { open }) if error.code == Error::Eof => {
            let bracket = &source.text()[open..=open];
            return place(open, 1)
                .error(format!("this `{bracket}` is never closed"))
                .with_help("add the missing bracket");
        }
        _ => {}
    }
    // What is right instead shows what is wrong. A `#` before the value begins an attribute of RON.
    let slip = match error.code {
        Error::ExpectedAttribute | Error::ExpectedAttributeEnd | Error::NoSuchExtension(_) => {
            source.text()[..noticed].rfind('#').map(slips::hash)
        }
        _ => slips::in_grammar(source.text(), noticed),
    };
    let slip = slip.filter(|_| source.is_shown());
    if let Some(slip) = slip {
        let Range { start, end } = slip.span;
        return place(start, end - start)
            .error(slip.message)
            .with_help(slip.help);
    }
    let next = source.text()[noticed..].chars().next();
    let (message, help) = describe(&error.code, next);
    let error = place(noticed, 0).error(message);
    match help {
        Some(help) => error.with_help(help),
        None => error,
    }
}

/// Words for ron's `code`; `next` is the character it stumbles over.
fn describe(code: &Error, next: Option<char>) -> (String, Option<&'static str>) {
    let say = |message: &str, help| (message.to_owned(), Some(help));
    match code {
        Error::Eof => say("the file holds no value", "a file holds one value in ( )"),
        Error::UnclosedBlockComment => say("a comment is not closed", "add the missing `*/`"),
        Error::ExpectedComma if next == Some(':') => say(
            "unexpected `:`",
            "fields stand in ( ) without quotes, names of a map in { } with quotes",
        ),
        Error::ExpectedComma => say(
            "expected `,` or a closing bracket before this",
            "separate fields and values by commas",
        ),
        Error::ExpectedMapColon => say(
            "expected `:` before this",
            "write `field: value` or `\"name\": value`",
        ),
        Error::TrailingCharacters => say(
            "nothing may follow the closing bracket of the file",
            "look for a bracket closed too early",
        ),
        Error::ExceededRecursionLimit => say(
            "brackets are nested too deeply",
            "no value of the format is nested more than a dozen deep",
        ),
        Error::InvalidIntegerDigit { digit, .. } => (
            format!("`{digit}` cannot stand here in a number"),
            Some("write a number such as 0.25, -3 or 2.1e11"),
        ),
        Error::UnexpectedChar(c) => (format!("unexpected `{c}`"), None),
        Error::ExpectedIdentifier | Error::SuggestRawIdentifier(_) => say(
            "expected the name of a field",
            "write `field: value`, and numbers with a decimal point",
        ),
        Error::IntegerOutOfBounds => say(
            "the number is too large",
            "write large numbers with an exponent, such as 2.1e11",
        ),
        other => (lower_first(&other.to_string()), None),
    }
}

fn lower_first(text: &str) -> String {
    let mut characters = text.chars();
    match characters.next() {
        Some(first) => first.to_lowercase().chain(characters).collect(),
        None => String::new(),
    }
}
