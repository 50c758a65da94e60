//! Expressions: texts that begin with `=` where a number may stand, such as `"= R * cos(2 * beta)"`.
//!
//! An expression is read once, into operations in the order in which they are done, each with its place
//! in the text; its value is found as often as a parameter changes. What names stand for is asked of
//! whoever has it evaluated.

mod dual;
mod evaluate;
mod functions;
mod parse;

use std::ops::Range;

pub(crate) use dual::Dual;
pub(crate) use evaluate::{Failure, Operand};
use functions::Rule;
pub(crate) use functions::{CONSTANTS, names as functions};

/// An expression as it is written, or what is wrong with how it is written.
#[derive(Debug)]
pub(crate) struct Expression(Result<Vec<Operation>, Mistake>);

/// What is wrong in an expression, and where in its text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Mistake {
    pub(crate) at: Range<usize>,
    pub(crate) message: String,
    /// What would be right.
    pub(crate) help: String,
    /// Whether it is one of the values that are there: with others the expression has one.
    pub(crate) of_values: bool,
}

/// One operation on what comes before it.
#[derive(Debug)]
struct Operation {
    /// The bytes of the text that it is about.
    at: Range<usize>,
    what: What,
}

#[derive(Debug)]
enum What {
    Number(f64),
    /// The parameter, point or constant of this name.
    Name(Box<str>),
    /// Coordinate of the point of this name.
    CoordinateOf(Box<str>, usize),
    /// Coordinate of a point.
    Coordinate(usize),
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    /// A function of so many arguments.
    Call(&'static Rule, usize),
}

impl Expression {
    /// Whether a text in quotes is one.
    pub(crate) fn begins(text: &str) -> bool {
        text.starts_with("\"=")
    }

    /// Reads a text in quotes, with them.
    pub(crate) fn read(text: &str) -> Self {
        Self(parse::read(text))
    }

    /// Names of parameters and points in it.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        let operations = self.0.iter().flatten();
        operations.filter_map(|operation| match &operation.what {
            What::Name(name) | What::CoordinateOf(name, _) => Some(&**name),
            _ => None,
        })
    }
}

/// Whether a name can stand in an expression as it is.
pub(crate) fn is_name(name: &str) -> bool {
    name.starts_with(parse::begins_name) && name.chars().all(parse::continues_name)
}
