//! Brackets and quotes of a text that do not match.

/// The first bracket or quote that is not closed, or not by its own kind. Offsets are in bytes.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Imbalance {
    /// A text in quotes that goes on beyond its line.
    Text { start: usize },
    /// A bracket closed by one of another kind.
    Mismatch { open: usize, close: usize },
    /// A bracket that is still open at the end: the innermost one.
    Open { open: usize },
}

/// Looks for the first imbalance, passing over comments.
pub(crate) fn imbalance(text: &str) -> Option<Imbalance> {
    let bytes = text.as_bytes();
    let mut open = Vec::new();
    let mut k = 0;
    while k < bytes.len() {
        match bytes[k] {
            b'"' => match text_end(bytes, k) {
                Some(end) => k = end,
                None => return Some(Imbalance::Text { start: k }),
            },
            b'/' if bytes[k..].starts_with(b"//") => k = line_end(bytes, k),
            b'/' if bytes[k..].starts_with(b"/*") => k = comment_end(bytes, k),
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

/// The closing quote of the text that opens at `start`, if it is in the same line.
fn text_end(bytes: &[u8], start: usize) -> Option<usize> {
    let mut k = start + 1;
    loop {
        match bytes.get(k)? {
            b'"' => return Some(k),
            b'\n' => return None,
            b'\\' => k += 2,
            _ => k += 1,
        }
    }
}

fn line_end(bytes: &[u8], start: usize) -> usize {
    let length = bytes[start..].iter().position(|&b| b == b'\n');
    length.map_or(bytes.len(), |length| start + length)
}

/// The last byte of the comment, which may hold others, that opens at `start`.
fn comment_end(bytes: &[u8], start: usize) -> usize {
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
            return k - 1;
        }
    }
    bytes.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn balanced_texts_pass() {
        let texts = [
            "",
            "(a: [1], b: {\"(\": ()})",
            "( // :-)\n)",
            "(/* ] /* ( */ \" */)",
            r#"("\\", "\"(")"#,
        ];
        for text in texts {
            assert_eq!(imbalance(text), None, "{text}");
        }
    }

    #[test]
    fn the_first_imbalance_is_found() {
        assert_eq!(
            imbalance("(a, [b)"),
            Some(Imbalance::Mismatch { open: 4, close: 6 })
        );
        assert_eq!(imbalance("(a, [b]"), Some(Imbalance::Open { open: 0 }));
        assert_eq!(
            imbalance("(\"a, [b\n\")"),
            Some(Imbalance::Text { start: 1 })
        );
        assert_eq!(imbalance("(\"a\\"), Some(Imbalance::Text { start: 1 }));
    }
}
