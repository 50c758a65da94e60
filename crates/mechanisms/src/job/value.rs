//! Values that vary from design to design.

use std::fmt;

use crate::text::fragment::Fragment;
use crate::text::tree::Node;

/// What varies from design to design of a job.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Varied {
    /// Its path in the mechanism as it is written, such as `rod.section.diameter`.
    pub path: String,
    /// Whether all of its values are numbers.
    pub numeric: bool,
}

/// A varied value of a design.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A finite number, in the unit of what varies.
    Number(f64),
    /// Anything else: the content of a text in quotes, or the RON as it is written.
    Text(String),
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
