//! The words, brackets and comments of a file whose grammar is right, RON or JSON.

use crate::text::brackets::{character_end, comment_end, line_end, raw_hashes, text_end};

/// A piece of the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Open,
    Close,
    Comma,
    Colon,
    /// A number, a text with its quotes, a word.
    Atom,
    /// A comment up to the end of its line.
    Line,
    /// A comment that ends by itself, or an attribute of RON.
    Block,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Token<'a> {
    pub(super) kind: Kind,
    pub(super) text: &'a str,
    /// Line breaks between it and what stands before it.
    pub(super) breaks: usize,
}

impl Token<'_> {
    pub(super) fn is_comment(&self) -> bool {
        matches!(self.kind, Kind::Line | Kind::Block)
    }
}

/// All tokens of a text.
pub(super) fn tokens(text: &str) -> Vec<Token<'_>> {
    let bytes = text.as_bytes();
    let mut tokens = Vec::new();
    let (mut k, mut breaks) = (0, 0);
    while let Some(next) = text[k..].chars().next() {
        if next.is_whitespace() {
            breaks += usize::from(next == '\n');
            k += next.len_utf8();
            continue;
        }
        let (kind, end) = match next {
            '(' | '[' | '{' => (Kind::Open, k + 1),
            ')' | ']' | '}' => (Kind::Close, k + 1),
            ',' => (Kind::Comma, k + 1),
            ':' => (Kind::Colon, k + 1),
            '/' if bytes[k..].starts_with(b"//") => (Kind::Line, line_end(bytes, k)),
            '/' => (
                Kind::Block,
                comment_end(bytes, k).map_or(bytes.len(), |end| end + 1),
            ),
            '#' => (Kind::Block, attribute_end(text, k)),
            _ => (Kind::Atom, atom_end(text, k)),
        };
        let piece = match kind {
            Kind::Line => text[k..end].trim_end(),
            _ => &text[k..end],
        };
        tokens.push(Token {
            kind,
            text: piece,
            breaks,
        });
        (k, breaks) = (end, 0);
    }
    tokens
}

/// Where `#![enable(…)]` ends.
fn attribute_end(text: &str, start: usize) -> usize {
    text[start..]
        .find(']')
        .map_or(text.len(), |k| start + k + 1)
}

/// Where the number, the text or the word ends that begins at `start`.
fn atom_end(text: &str, start: usize) -> usize {
    let bytes = text.as_bytes();
    let mut k = start;
    while let Some(next) = text[k..].chars().next() {
        match next {
            '"' => {
                let end = text_end(bytes, k, raw_hashes(bytes, k));
                return end.map_or(text.len(), |end| end + 1);
            }
            '\'' => k = character_end(bytes, k) + 1,
            '/' if k > start => return k,
            c if c.is_whitespace() || "()[]{},:".contains(c) => return k,
            c => k += c.len_utf8(),
        }
    }
    k
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_lost() {
        let text = "#![enable(x)]\n(a: -1.5e3, // one, (two)\n\n b: r#\"x\"y\"#,/* ( */ \"å\\\"\": '(', K (1))";
        let found: Vec<(Kind, &str, usize)> = (tokens(text).iter())
            .map(|token| (token.kind, token.text, token.breaks))
            .collect();
        let expected = [
            (Kind::Block, "#![enable(x)]", 0),
            (Kind::Open, "(", 1),
            (Kind::Atom, "a", 0),
            (Kind::Colon, ":", 0),
            (Kind::Atom, "-1.5e3", 0),
            (Kind::Comma, ",", 0),
            (Kind::Line, "// one, (two)", 0),
            (Kind::Atom, "b", 2),
            (Kind::Colon, ":", 0),
            (Kind::Atom, "r#\"x\"y\"#", 0),
            (Kind::Comma, ",", 0),
            (Kind::Block, "/* ( */", 0),
            (Kind::Atom, "\"å\\\"\"", 0),
            (Kind::Colon, ":", 0),
            (Kind::Atom, "'('", 0),
            (Kind::Comma, ",", 0),
            (Kind::Atom, "K", 0),
            (Kind::Open, "(", 0),
            (Kind::Atom, "1", 0),
            (Kind::Close, ")", 0),
            (Kind::Close, ")", 0),
        ];
        assert_eq!(found, expected);
    }
}
