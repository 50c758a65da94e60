//! What a terminal is shown: colours where it takes them, and nothing that would steer it.

use std::borrow::Cow;
use std::env;
use std::ffi::OsStr;
use std::io::{self, BufRead, IsTerminal, Write};

/// Whether what goes to standard error may be coloured: a terminal that takes colours, and nobody who
/// wants none (`NO_COLOR` with any text, `TERM=dumb`).
pub(crate) fn is_coloured() -> bool {
    io::stderr().is_terminal()
        && takes_colours(
            env::var_os("NO_COLOR").as_deref(),
            env::var_os("TERM").as_deref(),
        )
}

fn takes_colours(no_color: Option<&OsStr>, term: Option<&OsStr>) -> bool {
    no_color.is_none_or(OsStr::is_empty) && !is_dumb(term)
}

/// Whether the terminal cannot move its cursor: nothing that is drawn again and again is for it.
pub(crate) fn cannot_redraw() -> bool {
    is_dumb(env::var_os("TERM").as_deref())
}

fn is_dumb(term: Option<&OsStr>) -> bool {
    term.is_some_and(|term| term == "dumb")
}

/// Whether a character tells a terminal to do something else than show it: control characters but
/// line breaks and tabs, and those that turn the direction of writing.
pub(crate) fn steers(c: char) -> bool {
    let turns = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    turns || (c.is_control() && !matches!(c, '\n' | '\t'))
}

/// `text`, with every character that would steer a terminal as its number, `\u{1b}`.
pub(crate) fn plain(text: &str) -> Cow<'_, str> {
    written(text, |c| format!("\\u{{{:x}}}", u32::from(c)))
}

/// The JSON document `text`, with every character that would steer a terminal as JSON writes it by
/// its number: the same document.
pub(crate) fn plain_json(text: &str) -> Cow<'_, str> {
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

/// Says something on standard error that is neither a result nor an error.
pub(crate) fn note(text: &str) -> io::Result<()> {
    writeln!(io::stderr().lock(), "note: {}", plain(text))
}

/// Asks whoever sits at the terminal; `None` where nobody does.
pub(crate) fn ask(question: &str) -> Option<bool> {
    if !(io::stdin().is_terminal() && io::stderr().is_terminal()) {
        return None;
    }
    let mut err = io::stderr().lock();
    write!(err, "{} [y/N] ", plain(question)).ok()?;
    err.flush().ok()?;
    let mut answer = String::new();
    io::stdin().lock().read_line(&mut answer).ok()?;
    let answer = answer.trim().to_lowercase();
    Some(answer == "y" || answer == "yes")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_follow_the_environment() {
        let takes = |no_color: Option<&str>, term: Option<&str>| {
            takes_colours(no_color.map(OsStr::new), term.map(OsStr::new))
        };
        assert!(takes(None, Some("xterm-256color")));
        assert!(takes(Some(""), Some("xterm")));
        assert!(!takes(Some("1"), Some("xterm")));
        assert!(!takes(Some("0"), Some("xterm")));
        assert!(!takes(None, Some("dumb")));
        assert!(!takes(Some(""), Some("dumb")));
    }

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
