//! What messages show of RON, in JSON.
//!
//! Messages are written for RON and show in backquotes what would be right: `Csv("file.csv")`. Of a
//! JSON file the same is shown as `{"Csv": "file.csv"}`.

use std::iter::Peekable;
use std::str::Chars;

/// What is said of names of the file, which are shown as they are.
const OF_NAMES: [&str; 2] = ["did you mean `", "the "];

/// A help in words for JSON.
pub(crate) fn help(text: &str) -> String {
    match OF_NAMES.iter().any(|start| text.starts_with(start)) {
        true => text.into(),
        false => each_snippet(text, false),
    }
}

/// What is expected, in words for JSON.
pub(crate) fn expected(text: &str) -> String {
    each_snippet(text, true).replace("in parentheses", "in braces")
}

/// Writes everything in backquotes as JSON, as far as it is understood; single words get quotes where
/// `words` says so.
fn each_snippet(text: &str, words: bool) -> String {
    let mut parts = text.split('`');
    let mut all = parts.next().unwrap_or_default().to_owned();
    while let (Some(snippet), Some(rest)) = (parts.next(), parts.next()) {
        let json = Snippet::new(snippet).whole(words);
        all += &format!("`{}`{rest}", json.as_deref().unwrap_or(snippet));
    }
    all
}

/// Where a value stands, which says what a word means.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    /// Alone: the name of a field, or a word where words are asked for.
    Alone(bool),
    /// In a tuple, where a word stands for any value.
    Tuple,
    List,
    Field,
}

/// A piece of RON that is read character by character.
struct Snippet<'a>(Peekable<Chars<'a>>);

impl<'a> Snippet<'a> {
    fn new(text: &'a str) -> Self {
        Self(text.chars().peekable())
    }

    /// All of it: a value, or fields with commas between them.
    fn whole(mut self, words: bool) -> Option<String> {
        let (items, named) = self.items(None, Place::Alone(words))?;
        match named || items.len() == 1 {
            true => Some(items.join(", ")),
            false => None,
        }
    }

    /// Items up to a closing bracket, or to the end, and whether they have names.
    fn items(&mut self, close: Option<char>, place: Place) -> Option<(Vec<String>, bool)> {
        let (mut items, mut named) = (Vec::new(), false);
        loop {
            self.blanks();
            if self.0.peek().copied() == close {
                self.0.next();
                return Some((items, named));
            }
            let first = self.value(place)?;
            self.blanks();
            if self.0.next_if_eq(&':').is_some() {
                self.blanks();
                let name = first.trim_matches('"');
                // Nothing may follow: `x:, y:`.
                let value = match self.0.peek() {
                    Some(',' | ')' | '}') | None => "…".into(),
                    _ => self.value(Place::Field)?,
                };
                items.push(format!("\"{name}\": {value}"));
                named = true;
            } else {
                items.push(first);
            }
            self.blanks();
            let comma = self.0.next_if_eq(&',').is_some();
            if !comma && self.0.peek().copied() != close {
                return None;
            }
        }
    }

    fn value(&mut self, place: Place) -> Option<String> {
        match *self.0.peek()? {
            '…' => {
                self.0.next();
                Some("…".into())
            }
            '"' => self.quoted(),
            '(' => self.brackets(')', Place::Tuple),
            '[' => self.brackets(']', Place::List),
            '{' => self.brackets('}', Place::Field),
            c if c.is_ascii_digit() || c == '-' => {
                Some(self.run(|c| c.is_ascii_alphanumeric() || "-+.".contains(c)))
            }
            c if c.is_alphabetic() || c == '_' => {
                let word = self.run(|c| c.is_alphanumeric() || c == '_');
                self.word(word, place)
            }
            _ => None,
        }
    }

    /// A word, or a kind with its arguments.
    fn word(&mut self, word: String, place: Place) -> Option<String> {
        if self.0.next_if_eq(&'(').is_none() {
            let capital = word.starts_with(char::is_uppercase);
            let as_it_is = matches!(&*word, "true" | "false");
            let quoted = match place {
                Place::Alone(words) => words && capital,
                Place::Tuple => capital,
                Place::List => true,
                Place::Field => capital,
            };
            return Some(match quoted && !as_it_is {
                true => format!("\"{word}\""),
                false => word,
            });
        }
        let (items, named) = self.items(Some(')'), Place::Tuple)?;
        let inner = match &items[..] {
            _ if named => format!("{{{}}}", items.join(", ")),
            [one] => one.clone(),
            _ => format!("[{}]", items.join(", ")),
        };
        Some(format!("{{\"{word}\": {inner}}}"))
    }

    fn brackets(&mut self, close: char, place: Place) -> Option<String> {
        self.0.next();
        let (items, named) = self.items(Some(close), place)?;
        let items = items.join(", ");
        Some(match named || close == '}' {
            true => format!("{{{items}}}"),
            false => format!("[{items}]"),
        })
    }

    fn quoted(&mut self) -> Option<String> {
        self.0.next();
        let inner = self.run(|c| c != '"');
        self.0.next_if_eq(&'"')?;
        Some(format!("\"{inner}\""))
    }

    fn blanks(&mut self) {
        while self.0.next_if(|c| c.is_whitespace()).is_some() {}
    }

    fn run(&mut self, takes: impl Fn(char) -> bool) -> String {
        let mut run = String::new();
        while let Some(c) = self.0.next_if(|&c| takes(c)) {
            run.push(c);
        }
        run
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_would_be_right_is_shown_in_json() {
        let cases = [
            ("give `Csv(\"file.csv\")`", "give `{\"Csv\": \"file.csv\"}`"),
            ("add the field `young: …`", "add the field `\"young\": …`"),
            (
                "write `kind: Revolute(…), x_axis: (…)`",
                "write `\"kind\": {\"Revolute\": …}, \"x_axis\": […]`",
            ),
            ("leave `x_axis` out", "leave `x_axis` out"),
            ("such as `poisson: 0.3`", "such as `\"poisson\": 0.3`"),
            (
                "write `on: (\"body\", \"A\", \"B\")`",
                "write `\"on\": [\"body\", \"A\", \"B\"]`",
            ),
            (
                "`[(name: \"…\", mechanism: File(\"file.ron\"))]`",
                "`[{\"name\": \"…\", \"mechanism\": {\"File\": \"file.ron\"}}]`",
            ),
            ("did you mean `A(1)`?", "did you mean `A(1)`?"),
            ("is `ground`", "is `ground`"),
            (
                "`vary: { \"path\": [value, …] }`",
                "`\"vary\": {\"path\": [\"value\", …]}`",
            ),
        ];
        for (ron, json) in cases {
            assert_eq!(help(ron), json);
        }
    }

    #[test]
    fn what_is_expected_is_shown_in_json() {
        let cases = [
            ("three numbers `(x, y, z)`", "three numbers `[x, y, z]`"),
            ("`Auto` or a factor", "`\"Auto\"` or a factor"),
            (
                "fields in parentheses, `(at: …)`",
                "fields in braces, `{\"at\": …}`",
            ),
            ("a list such as `[y]`", "a list such as `[\"y\"]`"),
            (
                "a body, `Beam(…)` or `Rigid(…)`",
                "a body, `{\"Beam\": …}` or `{\"Rigid\": …}`",
            ),
            ("a map `{ \"name\": …, }`", "a map `{\"name\": …}`"),
            (
                "a plane, such as `z(0.5)`",
                "a plane, such as `{\"z\": 0.5}`",
            ),
            (
                "`6` or `(count: 6, mass: Lumped)`",
                "`6` or `{\"count\": 6, \"mass\": \"Lumped\"}`",
            ),
            ("`true` or `false`", "`true` or `false`"),
        ];
        for (ron, json) in cases {
            assert_eq!(expected(ron), json);
        }
    }
}
