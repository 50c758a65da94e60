//! Values that vary from design to design, or are put into a mechanism by a program.

use std::fmt;

use super::fragment::Fragment;
use super::tree::{Node, written};
use super::units;

/// A value in the place of another of a mechanism.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A finite number, in the unit of what it stands for.
    Number(f64),
    /// Anything else: the content of a text in quotes, or the RON as it is written, such as
    /// `Tube(outer: 0.02, inner: 0.01)`.
    Text(String),
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.into())
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl Value {
    /// The value of a tree.
    pub(crate) fn of(node: &Node) -> Self {
        let value = Fragment::of_node(node);
        match (value.number(), value.string()) {
            (Ok(number), _) => Self::Number(number),
            (_, Ok(text)) => Self::Text(text),
            _ => Self::Text(value.text().into()),
        }
    }

    /// As it is written in a file in the place of `old`: where that is a text in quotes, such as the name
    /// of a material, a text without quotes gets them; an expression and a number with a unit always do.
    pub(crate) fn written(&self, old: Option<&Node>) -> String {
        match self {
            Self::Number(number) => written(*number),
            Self::Text(text) => {
                let quoted = |text: &str| text.trim_start().starts_with('"');
                // A text of JSON may be a kind, too, in whose place another stands with its arguments.
                let kind = |old: &Node| {
                    let capital = |text: &str| text.starts_with(char::is_uppercase);
                    old.source().is_json()
                        && old.text().get(1..).is_some_and(capital)
                        && capital(text)
                        && text.ends_with(')')
                };
                let number = text.starts_with('=') || units::read(text, None).is_ok();
                let wants_quotes = |old: &Node| quoted(old.text()) && !kind(old);
                match (old.is_some_and(wants_quotes) || number) && !quoted(text) {
                    true => format!("{text:?}"),
                    false => text.clone(),
                }
            }
        }
    }
}

/// The shortest form of a number that reads back to the same double; a text as it is.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number:?}"),
            Self::Text(text) => f.write_str(text),
        }
    }
}
