//! Texts changed by bytes and by tokens.

use std::collections::BTreeSet;
use std::ops::Range;

use super::random::Random;

/// Longer texts are cut.
const LONGEST: usize = 16_000;

/// Names and pieces that mean something in the files, or nearly; libFuzzer reads it too.
const DICTIONARY: &str = include_str!("dictionary.txt");

/// Numbers that are seldom meant.
const NUMBERS: [&str; 24] = [
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "3",
    "6",
    "7",
    "0.5",
    "1e-320",
    "-1e-320",
    "1e-300",
    "1e-150",
    "1e-9",
    "1e9",
    "1e50",
    "1e150",
    "1e300",
    "-1e300",
    "1.7976931348623157e308",
    "1e999",
    "NaN",
    "inf",
    "18446744073709551616",
];

/// Changes texts, with pieces of other texts.
#[derive(Debug)]
pub struct Mutator {
    seeds: Vec<String>,
    /// All tokens of the seeds and the dictionary, each once, by class.
    pool: [Vec<String>; 4],
}

/// What a token is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Class {
    Word,
    Number,
    Text,
    Other,
}

impl Mutator {
    /// Of these texts to begin with.
    pub fn new(seeds: Vec<String>) -> Self {
        let words = DICTIONARY.lines().filter_map(|line| {
            let word = line.strip_prefix('"')?.strip_suffix('"')?;
            Some(word.replace("\\\"", "\"").replace("\\\\", "\\"))
        });
        let of_seeds = seeds.iter().flat_map(|seed| tokens(seed));
        let all: BTreeSet<_> = of_seeds.map(String::from).chain(words).collect();
        let mut pool: [Vec<String>; 4] = Default::default();
        for token in all {
            if !token.trim().is_empty() && token.len() < 100 {
                pool[class(&token) as usize].push(token);
            }
        }
        pool[Class::Number as usize].extend(NUMBERS.map(String::from));
        Self { seeds, pool }
    }

    /// Number of texts to begin with.
    pub fn seeds(&self) -> usize {
        self.seeds.len()
    }

    /// One of the texts, changed.
    pub fn text(&self, random: &mut Random) -> String {
        let seed = random.of(&self.seeds).map_or("", String::as_str);
        self.changed(seed, random)
    }

    /// Takes a text for one to begin with, in place of any other where there are `most`.
    pub fn learn(&mut self, text: String, most: usize, random: &mut Random) {
        if self.seeds.len() < most {
            self.seeds.push(text);
        } else {
            let place = random.below(self.seeds.len());
            self.seeds[place] = text;
        }
    }

    /// A text changed in one or several places.
    pub fn changed(&self, text: &str, random: &mut Random) -> String {
        let mut text = text.to_owned();
        loop {
            text = match random.below(16) {
                0 => by_bytes(&text, random),
                _ => self.by_tokens(&text, random),
            };
            if text.len() > LONGEST {
                let cut = (0..=LONGEST).rev().find(|&at| text.is_char_boundary(at));
                text.truncate(cut.unwrap_or(0));
            }
            if random.below(2) == 0 {
                return text;
            }
        }
    }

    /// One change of a text by whole tokens.
    fn by_tokens(&self, text: &str, random: &mut Random) -> String {
        let mut now = tokens(text);
        let at = random.below(now.len());
        let few = at..(at + 1 + random.below(6)).min(now.len());
        match random.below(13) {
            // Most are small: the more often is the text still taken.
            0..=2 => {
                let places: Vec<_> = (0..now.len())
                    .filter(|&k| class(now[k]) == Class::Number)
                    .collect();
                if let Some(&place) = random.of(&places) {
                    let new = match random.below(3) {
                        0 => random.of(&NUMBERS).copied(),
                        _ => self.like(Class::Number, random),
                    };
                    now[place] = new.unwrap_or("0");
                }
            }
            3 | 4 => {
                let places: Vec<_> = (0..now.len())
                    .filter(|&k| class(now[k]) != Class::Other)
                    .collect();
                if let Some(&place) = random.of(&places) {
                    now[place] = self.like(class(now[place]), random).unwrap_or("x");
                }
            }
            5 => drop(now.drain(few)),
            6 => insert(&mut now, at, &tokens(text)[few]),
            7 => {
                let other = random.below(now.len());
                if at < now.len() {
                    now.swap(at, other);
                }
            }
            8 => {
                let kinds = [Class::Word, Class::Number, Class::Text, Class::Other];
                let kind = kinds[random.below(kinds.len())];
                now.splice(at..at, self.like(kind, random));
            }
            9 => {
                if let Some(entry) = any_group(&now, at) {
                    now.drain(entry);
                }
            }
            10 => {
                if let Some(entry) = any_group(&now, at) {
                    let mut twice = vec![","];
                    twice.extend(&tokens(text)[entry.clone()]);
                    insert(&mut now, entry.end, &twice);
                }
            }
            11 => {
                let other = tokens(random.of(&self.seeds).map_or("", String::as_str));
                let there = any_group(&other, random.below(other.len()));
                if let (Some(here), Some(there)) = (any_group(&now, at), there) {
                    now.splice(here, other[there].iter().copied());
                }
            }
            _ => {
                let other = tokens(random.of(&self.seeds).map_or("", String::as_str));
                now.truncate(at);
                now.extend(&other[random.below(other.len())..]);
            }
        }
        now.concat()
    }

    /// A token of a class.
    fn like(&self, class: Class, random: &mut Random) -> Option<&str> {
        random.of(&self.pool[class as usize]).map(String::as_str)
    }
}

fn insert<'t>(tokens: &mut Vec<&'t str>, at: usize, new: &[&'t str]) {
    tokens.splice(at..at, new.iter().copied());
}

/// One change of a text by bytes; what is no UTF-8 then becomes replacement characters.
fn by_bytes(text: &str, random: &mut Random) -> String {
    let mut bytes = text.as_bytes().to_vec();
    let at = random.below(bytes.len());
    let any = random.number().to_le_bytes()[0];
    match random.below(5) {
        0 => bytes.insert(at, any),
        1 if !bytes.is_empty() => bytes[at] ^= 1 << random.below(8),
        2 if !bytes.is_empty() => bytes[at] = any,
        3 => drop(bytes.drain(at..(at + random.below(40)).min(text.len()))),
        _ => bytes.truncate(at),
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

fn class(token: &str) -> Class {
    let mut characters = token.chars();
    match characters.next() {
        Some('"') => Class::Text,
        Some('+' | '-' | '.') if token.len() > 1 => Class::Number,
        Some(c) if c.is_ascii_digit() => Class::Number,
        Some(c) if c.is_alphabetic() || c == '_' => Class::Word,
        _ => Class::Other,
    }
}

/// Words, numbers, texts in quotes, runs of blanks, and single other characters; together they are
/// the text.
pub(super) fn tokens(text: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let while_ = |part: fn(char) -> bool| rest.find(|c| !part(c)).unwrap_or(rest.len());
        let signed = |sign: char| {
            let after = rest[sign.len_utf8()..].chars().next();
            after.is_some_and(|c| c.is_ascii_digit() || c == '.')
        };
        let length = match first {
            '"' => rest[1..].find('"').map_or(rest.len(), |end| end + 2),
            c if c.is_alphabetic() || c == '_' => while_(|c| c.is_alphanumeric() || c == '_'),
            c if c.is_ascii_digit() || ("+-.".contains(c) && signed(c)) => number_length(rest),
            c if c.is_whitespace() => while_(char::is_whitespace),
            c => c.len_utf8(),
        };
        let (token, after) = rest.split_at(length);
        tokens.push(token);
        rest = after;
    }
    tokens
}

/// Length of the number that a text begins with.
fn number_length(text: &str) -> usize {
    let mut before = ' ';
    let end = text.char_indices().find(|&(at, c)| {
        let exponent = at > 0 && matches!(before, 'e' | 'E');
        let part = c.is_ascii_digit()
            || c == '.'
            || (matches!(c, 'e' | 'E') && at > 0)
            || ("+-".contains(c) && (at == 0 || exponent));
        before = c;
        !part
    });
    end.map_or(text.len(), |(at, _)| at).max(1)
}

/// The first group in brackets at or after a place, with the brackets.
fn any_group(tokens: &[&str], from: usize) -> Option<Range<usize>> {
    let opening = tokens
        .get(from..)?
        .iter()
        .find(|t| ["(", "[", "{"].contains(*t))?;
    group(tokens, from, opening)
}

/// The first group that `opening` begins at or after a place, with its brackets.
pub(super) fn group(tokens: &[&str], from: usize, opening: &str) -> Option<Range<usize>> {
    let first = from + tokens.get(from..)?.iter().position(|t| *t == opening)?;
    let mut depth = 0_usize;
    for (at, token) in tokens.iter().enumerate().skip(first) {
        match *token {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 {
            return Some(first..at + 1);
        }
    }
    None
}
