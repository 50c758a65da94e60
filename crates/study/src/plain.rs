//! Texts that steer no terminal, and JSON of them.

use std::borrow::Cow;

use serde::Serialize;

/// Whether a character tells a terminal to do something else than show it: control characters but
/// line breaks and tabs, and those that turn the direction of writing.
pub fn steers(c: char) -> bool {
    let turns = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    turns || (c.is_control() && !matches!(c, '\n' | '\t'))
}

/// `text`, with every character that would steer a terminal as its number, `\u{1b}`.
pub fn plain(text: &str) -> Cow<'_, str> {
    written(text, |c| format!("\\u{{{:x}}}", u32::from(c)))
}

/// `value` as a JSON document. Numbers read back to the same double; what would steer a terminal is written by
/// its number.
///
/// # Errors
/// It has no JSON.
pub fn json(value: &impl Serialize) -> serde_json::Result<String> {
    let text = serde_json::to_string_pretty(value)?;
    Ok(plain_json(&text).into_owned() + "\n")
}

/// The JSON document `text`, with every character that would steer a terminal as JSON writes it by
/// its number: the same document.
fn plain_json(text: &str) -> Cow<'_, str> {
    written(text, |c| format!("\\u{:04x}", u32::from(c)))
}

fn written(text: &str, number: impl Fn(char) -> String) -> Cow<'_, str> {
    if !text.contains(steers) {
        return Cow::Borrowed(text);
    }
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match steers(c) {
            true => safe += &number(c),
            false => safe.push(c),
        }
    }
    Cow::Owned(safe)
}

#[cfg(test)]
mod tests {
    use super::{plain, plain_json, steers};

    #[test]
    fn nothing_steers_a_terminal() {
        assert_eq!(plain("φ: 1\tm\n"), "φ: 1\tm\n");
        assert_eq!(plain("a\u{1b}[2Jb\r\u{7}"), "a\\u{1b}[2Jb\\u{d}\\u{7}");
        assert_eq!(plain("\u{9b}31m\u{202e}"), "\\u{9b}31m\\u{202e}");
        let name = "a\u{7f}\u{9b}31m\u{2066}";
        let json = serde_json::to_string(name).unwrap();
        let shown = plain_json(&json);
        assert!(!shown.contains(steers));
        assert_eq!(serde_json::from_str::<String>(&shown).unwrap(), name);
    }
}
