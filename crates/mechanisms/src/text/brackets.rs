//! Brackets and quotes of a text that do not match.

/// What is not closed, or not by its own kind. Offsets are in bytes.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Imbalance {
    /// A text in quotes that is not closed, or only by the opening quote of a later one; `hashes`
    /// stand around its quotes (`r#"…"#`).
    Text { start: usize, hashes: usize },
    /// A comment that is not closed.
    Comment { start: usize },
    /// A bracket closed by one of another kind.
    Mismatch { open: usize, close: usize },
    /// A bracket that is still open at the end: the innermost one.
    Open { open: usize },
}

/// Looks for the first imbalance in a text whose grammar is noticed to be wrong at `noticed`.
///
/// A text may go on over several lines. One that does and has something glued to its end that
/// cannot stand there was closed by the opening quote of another text.
pub(crate) fn imbalance(text: &str, noticed: usize) -> Option<Imbalance> {
    let bytes = text.as_bytes();
    let mut open = Vec::new();
    let mut k = 0;
    while k < bytes.len() {
        match bytes[k] {
            b'"' => {
                let start = k;
                let raw = raw_hashes(bytes, start);
                let hashes = raw.unwrap_or(0);
                let Some(end) = text_end(bytes, start, raw) else {
                    return Some(Imbalance::Text { start, hashes });
                };
                let lines = bytes[start..end].contains(&b'\n');
                let glued = noticed == end + 1 && !bytes.get(noticed)?.is_ascii_whitespace();
                if raw.is_none() && lines && glued {
                    return Some(Imbalance::Text { start, hashes });
                }
                k = end;
            }
            b'\'' => k = character_end(bytes, k),
            b'/' if bytes[k..].starts_with(b"//") => k = line_end(bytes, k),
            b'/' if bytes[k..].starts_with(b"/*") => match comment_end(bytes, k) {
                Some(end) => k = end,
                None => return Some(Imbalance::Comment { start: k }),
            },
            b'(' | b'[' | b'{' => open.push(k),
            b')' | b']' | b'}' => {
                let start = open.pop()?;
                if !matches!(
                    (bytes[start], bytes[k]),
                    (b'(', b')') | (b'[', b']') | (b'{', b'}')
                ) {
                    return Some(Imbalance::Mismatch {
                        open: start,
                        close: k,
                    });
                }
            }
            _ => {}
        }
        k += 1;
    }
    open.pop().map(|open| Imbalance::Open { open })
}

/// Number of `#` before the quote at `start` where it opens a raw text, `r"…"` or `r#"…"#`.
pub(crate) fn raw_hashes(bytes: &[u8], start: usize) -> Option<usize> {
    let before = &bytes[..start];
    let hashes = before.iter().rev().take_while(|&&b| b == b'#').count();
    let before = before[..start - hashes].strip_suffix(b"r")?;
    let before = before.strip_suffix(b"b").unwrap_or(before);
    let in_a_word = before.last().is_some_and(|b| b.is_ascii_alphanumeric());
    (!in_a_word).then_some(hashes)
}

/// The last byte of the text that opens at `start`, if it is closed; `raw` is the number of
/// hashes of a raw one.
pub(crate) fn text_end(bytes: &[u8], start: usize, raw: Option<usize>) -> Option<usize> {
    let mut k = start + 1;
    loop {
        match (*bytes.get(k)?, raw) {
            (b'"', None) => return Some(k),
            (b'"', Some(hashes)) => {
                let closing = bytes.get(k + 1..=k + hashes)?;
                if closing.iter().all(|&b| b == b'#') {
                    return Some(k + hashes);
                }
                k += 1;
            }
            (b'\\', None) => k += 2,
            _ => k += 1,
        }
    }
}

/// The last byte of the character `'…'` that opens at `start`; `start` where none does.
pub(crate) fn character_end(bytes: &[u8], start: usize) -> usize {
    /// Bytes of `'\u{10ffff}'` between its quotes.
    const LONGEST: usize = 10;
    let from = match bytes.get(start + 1) {
        Some(b'\\') => start + 3,
        _ => start + 2,
    };
    let quote = (from..=start + 1 + LONGEST).find(|&k| bytes.get(k) == Some(&b'\''));
    quote.unwrap_or(start)
}

pub(crate) fn line_end(bytes: &[u8], start: usize) -> usize {
    let length = bytes[start..].iter().position(|&b| b == b'\n');
    length.map_or(bytes.len(), |length| start + length)
}

/// The last byte of the comment, which may hold others, that opens at `start`, if it is closed.
pub(crate) fn comment_end(bytes: &[u8], start: usize) -> Option<usize> {
    let (mut depth, mut k) = (0, start);
    while k + 1 < bytes.len() {
        match &bytes[k..k + 2] {
            b"/*" => depth += 1,
            b"*/" => depth -= 1,
            _ => {
                k += 1;
                continue;
            }
        }
        k += 2;
        if depth == 0 {
            return Some(k - 1);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An offset at which nothing is noticed.
    const NOWHERE: usize = usize::MAX;

    #[test]
    fn balanced_texts_pass() {
        let texts = [
            "",
            "(a: [1], b: {\"(\": ()})",
            "( // :-)\n)",
            "(/* ] /* ( */ \" */)",
            r#"("\\", "\"(")"#,
            r##"(r#"a "( b"#, br"\", r"]", b"[")"##,
            "(\"two\nlines (\")",
            r"('(', '\'', '\u{28}', '[')",
        ];
        for text in texts {
            assert_eq!(imbalance(text, NOWHERE), None, "{text}");
        }
    }

    #[test]
    fn the_first_imbalance_is_found() {
        let text = |start, hashes| Imbalance::Text { start, hashes };
        let cases = [
            ("(a, [b)", Imbalance::Mismatch { open: 4, close: 6 }),
            ("(a, [b]", Imbalance::Open { open: 0 }),
            ("(\"a, [b\n)", text(1, 0)),
            ("(\"a\\", text(1, 0)),
            ("(r#\"a\")", text(3, 1)),
            (
                r##"(r#"""#, [)"##,
                Imbalance::Mismatch { open: 9, close: 10 },
            ),
            ("(a /* b /* c */)", Imbalance::Comment { start: 3 }),
        ];
        for (broken, found) in cases {
            assert_eq!(imbalance(broken, NOWHERE), Some(found), "{broken}");
        }
    }

    #[test]
    fn a_text_closed_by_the_quote_of_the_next_one_is_not_closed() {
        let text = "(\"a, \n\"b\")";
        let noticed = text.find('b').unwrap();
        let found = Imbalance::Text {
            start: 1,
            hashes: 0,
        };
        assert_eq!(imbalance(text, noticed), Some(found));
        // Only a comma is missing here.
        let text = "(\"a\nb\"\nc)";
        let noticed = text.find('c').unwrap();
        assert_eq!(imbalance(text, noticed), None);
    }
}
