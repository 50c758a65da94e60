//! Reads expressions: the text becomes operations in the order in which they are done.
//!
//! Precedence, from the loosest: `+ -`, `* /`, the sign, `^`, which goes from right to left:
//! `-2^2` is −4, `2^-1` is 0.5.

use std::ops::Range;

use super::{Mistake, Operation, What, functions};
use crate::text::dimension::Dimension;
use crate::text::names;

/// Brackets, signs and powers in each other at the most.
const DEEPEST: usize = 60;

/// What begins a name.
pub(super) fn begins_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

/// What a name goes on with.
pub(super) fn continues_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Reads a text in quotes that begins with `=`.
pub(super) fn read(text: &str) -> Result<Vec<Operation>, Mistake> {
    let mut parser = Parser {
        text: &text[..text.len().saturating_sub(1)],
        at: "\"=".len(),
        depth: 0,
        operations: Vec::new(),
    };
    parser.expression(0)?;
    parser.nothing_more()?;
    Ok(parser.operations)
}

struct Parser<'t> {
    /// Up to the closing quote.
    text: &'t str,
    /// Bytes that are read.
    at: usize,
    depth: usize,
    operations: Vec<Operation>,
}

/// How tightly a sign binds: more than a product, less than a power.
const SIGN: usize = 5;

/// What an operator does, how tightly it binds to what comes before it, and to what comes after it.
fn operator(c: char) -> Option<(What, usize, usize)> {
    match c {
        '+' => Some((What::Add, 1, 2)),
        '-' | '−' => Some((What::Subtract, 1, 2)),
        '*' | '·' | '×' => Some((What::Multiply, 3, 4)),
        '/' | '÷' => Some((What::Divide, 3, 4)),
        '^' => Some((What::Power, 7, 7)),
        _ => None,
    }
}

fn mistake<T>(at: Range<usize>, message: impl Into<String>, help: &str) -> Result<T, Mistake> {
    Err(Mistake {
        of_values: false,
        at,
        message: message.into(),
        help: help.into(),
    })
}

/// What is wrong with a unit, and what would be right.
const NO_UNITS: [&str; 2] = [
    "units do not stand in expressions",
    "write the number in SI, or give it with its unit to a parameter",
];

impl Parser<'_> {
    /// An expression of operators that bind as tightly as `least`, or more so.
    fn expression(&mut self, least: usize) -> Result<(), Mistake> {
        self.depth += 1;
        if self.depth > DEEPEST {
            let help = "make parameters of its parts";
            return mistake(self.next(), "the expression is nested too deeply", help);
        }
        self.operand()?;
        while let Some((c, (what, before, after))) =
            self.peek().and_then(|c| Some((c, operator(c)?)))
        {
            if before < least {
                break;
            }
            let start = self.at;
            self.at += c.len_utf8();
            self.expression(after)?;
            let at = start..self.at;
            self.operations.push(Operation { at, what });
        }
        self.depth -= 1;
        Ok(())
    }

    fn operand(&mut self) -> Result<(), Mistake> {
        let expected = "expected a number, a name or `(` here";
        let Some(c) = self.peek() else {
            let at = self.text.len()..self.text.len() + 1;
            return mistake(at, expected, "the expression ends before it is complete");
        };
        let start = self.at;
        match c {
            '-' | '−' | '+' => {
                self.at += c.len_utf8();
                self.expression(SIGN)?;
                if c != '+' {
                    let at = start..self.at;
                    self.operations.push(Operation {
                        at,
                        what: What::Negate,
                    });
                }
            }
            '(' => {
                self.at += 1;
                self.expression(0)?;
                self.close(start)?;
                self.coordinates(start)?;
            }
            '0'..='9' | '.' => self.number()?,
            '\'' => self.quoted()?,
            c if begins_name(c) => self.name()?,
            '*' if self.text[..self.at].trim_end().ends_with('*') => {
                return mistake(self.next(), expected, "a power is written with `^`: `2^3`");
            }
            _ => {
                let help = "such as `= 2 * R`, with the names of parameters and points";
                return mistake(self.next(), expected, help);
            }
        }
        Ok(())
    }

    fn number(&mut self) -> Result<(), Mistake> {
        let start = self.at;
        self.skip(|c| c.is_ascii_digit());
        self.skip_one(|c| c == '.');
        self.skip(|c| c.is_ascii_digit());
        let mantissa = self.at;
        self.skip_one(|c| c == 'e' || c == 'E');
        if self.at > mantissa {
            self.skip_one(|c| c == '+' || c == '-');
            let digits = self.at;
            self.skip(|c| c.is_ascii_digit());
            if digits == self.at {
                self.at = mantissa;
            }
        }
        let at = start..self.at;
        let help = "write a number such as 0.25 or 2.1e11";
        match self.text[at.clone()].parse::<f64>() {
            Ok(number) if number.is_finite() => {
                let what = What::Number(number);
                self.operations.push(Operation { at, what });
                Ok(())
            }
            Ok(_) => mistake(at, "the number is too large", help),
            Err(_) => mistake(at, "this is no number", help),
        }
    }

    /// A name in single quotes, which may have any characters.
    fn quoted(&mut self) -> Result<(), Mistake> {
        let start = self.at;
        let Some(length) = self.text[start + 1..].find('\'') else {
            return mistake(
                self.next(),
                "this name is not closed",
                "add the missing `'`",
            );
        };
        self.at = start + length + 2;
        let name = &self.text[start + 1..self.at - 1];
        self.named(start, name)
    }

    fn name(&mut self) -> Result<(), Mistake> {
        let start = self.at;
        self.skip(continues_name);
        let text = self.text;
        let name = &text[start..self.at];
        if self.peek() == Some('(') {
            return self.call(start, name);
        }
        self.named(start, name)
    }

    /// What a name stands for, or a coordinate of it.
    fn named(&mut self, start: usize, name: &str) -> Result<(), Mistake> {
        let end = self.at;
        let what = match self.coordinate()? {
            Some(coordinate) => What::CoordinateOf(name.into(), coordinate),
            None => {
                self.at = end;
                What::Name(name.into())
            }
        };
        let at = start..self.at;
        self.operations.push(Operation { at, what });
        Ok(())
    }

    fn call(&mut self, start: usize, name: &str) -> Result<(), Mistake> {
        let named = start..start + name.len();
        let Some(rule) = functions::find(name) else {
            let help = match name {
                "log" => "the natural logarithm is `ln`, that to the base 10 `log10`".into(),
                _ => names::help(name, "functions", functions::names()),
            };
            return mistake(named, format!("unknown function `{name}`"), &help);
        };
        let open = self.at;
        self.at += 1;
        let mut count = 0;
        if self.peek() != Some(')') {
            self.expression(0)?;
            count += 1;
            while self.peek() == Some(',') {
                self.at += 1;
                self.expression(0)?;
                count += 1;
            }
        }
        self.close(open)?;
        if !rule.takes(count) {
            let message = format!("`{name}` takes {}, not {count} arguments", rule.arguments());
            let message = message.replace("not 1 arguments", "not 1 argument");
            return mistake(start..self.at, message, "separate arguments by commas");
        }
        let what = What::Call(rule, count);
        let at = start..self.at;
        self.operations.push(Operation { at, what });
        self.coordinates(start)
    }

    /// The bracket that closes the one at `open`.
    fn close(&mut self, open: usize) -> Result<(), Mistake> {
        match self.peek() {
            Some(')') => {
                self.at += 1;
                Ok(())
            }
            None => mistake(
                open..open + 1,
                "this `(` is never closed",
                "add the missing `)`",
            ),
            Some(c) if c.is_alphabetic() && self.is_unit() => {
                mistake(self.next(), NO_UNITS[0], NO_UNITS[1])
            }
            Some(c) => mistake(
                self.next(),
                format!("unexpected `{c}`"),
                "expected an operator such as `*`, or the closing `)`",
            ),
        }
    }

    /// A coordinate of what begins at `start`, where one is asked for.
    fn coordinates(&mut self, start: usize) -> Result<(), Mistake> {
        let end = self.at;
        match self.coordinate()? {
            Some(coordinate) => {
                let at = start..self.at;
                let what = What::Coordinate(coordinate);
                self.operations.push(Operation { at, what });
            }
            None => self.at = end,
        }
        Ok(())
    }

    /// Reads `.x`, `.y` or `.z`.
    fn coordinate(&mut self) -> Result<Option<usize>, Mistake> {
        if self.peek() != Some('.') {
            return Ok(None);
        }
        let start = self.at;
        self.at += 1;
        self.skip(continues_name);
        let place = ["x", "y", "z"]
            .iter()
            .position(|name| *name == &self.text[start + 1..self.at]);
        if place.is_none() {
            let help = "a point has `.x`, `.y` and `.z`; a name holds no `.`";
            return mistake(start..self.at, "this is no coordinate of a point", help);
        }
        Ok(place)
    }

    fn nothing_more(&mut self) -> Result<(), Mistake> {
        match self.peek() {
            None => Ok(()),
            Some(')') => mistake(self.next(), "this `)` closes nothing", "remove it"),
            Some(',') => mistake(
                self.next(),
                "unexpected `,`",
                "commas separate the arguments of a function; write numbers with a decimal point",
            ),
            Some(c) if c.is_alphabetic() && self.is_unit() => {
                mistake(self.next(), NO_UNITS[0], NO_UNITS[1])
            }
            Some(c) => mistake(
                self.next(),
                format!("unexpected `{c}`"),
                "expected an operator such as `*` before it",
            ),
        }
    }

    /// Whether the name that follows is that of a unit.
    fn is_unit(&self) -> bool {
        let rest = &self.text[self.at..];
        let end = rest.find(|c| !continues_name(c)).unwrap_or(rest.len());
        Dimension::of_unit(&rest[..end]).is_some()
    }

    /// The next character that is no blank; blanks are passed over.
    fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
        self.text[self.at..].chars().next()
    }

    /// Where the next character is.
    fn next(&self) -> Range<usize> {
        let width = self.text[self.at..]
            .chars()
            .next()
            .map_or(1, char::len_utf8);
        self.at..self.at + width
    }

    fn skip(&mut self, taken: impl Fn(char) -> bool) {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start_matches(taken).len();
    }

    fn skip_one(&mut self, taken: impl Fn(char) -> bool) {
        if let Some(c) = self.text[self.at..].chars().next().filter(|c| taken(*c)) {
            self.at += c.len_utf8();
        }
    }
}
