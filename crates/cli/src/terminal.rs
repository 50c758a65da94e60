//! What a terminal is shown: colours where it takes them, and nothing that would steer it.

use std::env;
use std::ffi::OsStr;
use std::io::{self, BufRead, IsTerminal, Write};

pub(crate) use hyperstat_study::plain::{plain, steers};

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
}
