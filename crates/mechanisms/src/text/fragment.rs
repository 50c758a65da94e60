//! One value as it stands in a file, RON or JSON, and the ways to read it.
//!
//! A file is read value by value from the outside in. ron checks the grammar of the whole text
//! once; after that every value is a [`Fragment`], a piece of the file's own text (ron's
//! `RawValue` borrows it), so that its place is known to every error about it. Of JSON serde_json does
//! the same. JSON has fewer forms: an array is a tuple and a list, an object is fields, a map, or a kind
//! with its arguments, a text is a text or a kind; each answers to whatever of these is asked for.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use serde::de::Deserialize;

use super::expression::Expression;
use super::source::{Place, Source};
use super::tree::{Content, Named, Node};
use super::{json, raw};
use crate::error::LoadError;
use crate::text::{json_syntax, slips, syntax};
use crate::words;

/// The text of one value, without the white space and comments around it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fragment<'a> {
    source: &'a Arc<Source>,
    pub(super) text: &'a str,
    /// The value, taken apart.
    node: Option<&'a Node>,
}

/// What a value that is taken apart has.
pub(super) enum Parts {
    Named(Vec<String>),
    /// So many.
    Listed(usize),
}

/// An entry `"name": value` of a map.
#[derive(Debug, Clone)]
pub(crate) struct Entry<'a> {
    /// The name without its quotes.
    pub(crate) name: String,
    /// The name as it stands in the file.
    pub(crate) key: Fragment<'a>,
    pub(crate) value: Fragment<'a>,
}

impl<'a> Entry<'a> {
    /// An entry of a tree.
    pub(crate) fn of(own: &'a Named) -> Self {
        Self {
            name: (*own.name).into(),
            key: Fragment::between(&own.source, &own.at),
            value: Fragment::of_node(&own.value),
        }
    }
}

impl<'a> Fragment<'a> {
    /// The value that a whole file holds.
    pub(crate) fn of_file(source: &'a Arc<Source>) -> Result<Self, LoadError> {
        if source.is_json() {
            let whole = json::whole(source.text());
            let text = whole.map_err(|error| json_syntax::error(source, &error))?;
            return match json_syntax::depth(source) {
                Some(error) => Err(error),
                None => Ok(Self {
                    source,
                    text,
                    node: None,
                }),
            };
        }
        let whole = raw::whole(source.text());
        let text = whole.map_err(|error| syntax::error(source, &error))?;
        Ok(Self {
            source,
            text,
            node: None,
        })
    }

    /// The value that stands at a place.
    pub(crate) fn at(place: &'a Place) -> Self {
        Self {
            source: &place.source,
            text: place.source.text().get(place.span.clone()).unwrap_or(""),
            node: None,
        }
    }

    /// The value of a tree.
    pub(crate) fn of_node(node: &'a Node) -> Self {
        Self {
            source: node.source(),
            text: node.text(),
            node: Some(node),
        }
    }

    /// A part of this fragment's text.
    pub(crate) fn part(self, text: &'a str) -> Self {
        Self {
            text,
            node: None,
            ..self
        }
    }

    /// What stands between these bytes of a source.
    fn between(source: &'a Arc<Source>, span: &Range<usize>) -> Self {
        Self {
            source,
            text: source.text().get(span.clone()).unwrap_or(""),
            node: None,
        }
    }

    pub(super) fn content(self) -> Option<&'a Content> {
        self.node.map(|node| &node.content)
    }

    pub(crate) fn text(self) -> &'a str {
        self.text
    }

    /// The text of a word, such as `Auto`: in JSON without its quotes.
    pub(crate) fn word(self) -> &'a str {
        match self.is_json() {
            true => json::inner(self.text).unwrap_or(self.text),
            false => self.text,
        }
    }

    pub(crate) fn is_json(self) -> bool {
        self.source.is_json()
    }

    /// Whether these items are what a kind of JSON has as its one argument.
    fn is_argument(self, items: &[Node]) -> bool {
        let is_whole = |only: &Node| std::ptr::eq(only.text(), self.text);
        self.is_json() && matches!(items, [only] if is_whole(only))
    }

    /// Whether it is a list, `[…]`; in JSON any array.
    pub(crate) fn is_list(self) -> bool {
        self.text.starts_with('[')
    }

    /// Whether it is a list of lists or tuples, or of what else is no tuple of numbers.
    pub(crate) fn is_list_of_tuples(self) -> bool {
        let first = |items: Vec<Self>| items.first().is_some_and(|first| first.is_list());
        self.is_list() && (!self.is_json() || self.list("").is_ok_and(first))
    }

    /// Whether it is a tuple, or fields, and no kind or word: `(…)`; in JSON any array.
    pub(crate) fn is_tuple(self) -> bool {
        self.text
            .starts_with(if self.is_json() { '[' } else { '(' })
    }

    /// Whether it is fields, or a tuple, and no kind or word: `(…)`; in JSON an object, unless it has the
    /// form of a kind.
    pub(crate) fn has_fields(self) -> bool {
        if !self.is_json() {
            return self.text.starts_with('(');
        }
        let pairs = json::pairs(self.text);
        pairs.is_some_and(|pairs| {
            !json::is_kind(pairs.iter().filter_map(|(key, _)| json::inner(key)))
        })
    }

    pub(crate) fn source(self) -> &'a Arc<Source> {
        self.source
    }

    /// The bytes of the source that it is.
    pub(crate) fn span(self) -> Range<usize> {
        // The text is a piece of the source's, so the distance of the two is its offset.
        let start = self.text.as_ptr() as usize;
        let start = start.saturating_sub(self.source.text().as_ptr() as usize);
        start..start + self.text.len()
    }

    pub(crate) fn place(self) -> Place {
        Place {
            source: Arc::clone(self.source),
            span: self.span(),
        }
    }

    pub(crate) fn error(self, message: impl Into<String>) -> LoadError {
        self.place().error(message)
    }

    /// An error for a value of another kind than `expected`.
    pub(crate) fn expected(self, expected: &str) -> LoadError {
        let line = self.text.lines().next().unwrap_or_default();
        let mut found: String = line.chars().take(40).collect();
        if found.len() < self.text.len() {
            found.push('…');
        }
        let expected = match self.is_json() {
            true => words::expected(expected),
            false => expected.into(),
        };
        let error = self
            .error(format!("expected {expected}, found `{found}`"))
            .unreadable();
        // What is right instead shows what is wrong.
        let right = match self.text {
            "null" if self.is_json() => Some(NULL.into()),
            text => slips::in_value(text, &expected, self.source.text())
                .filter(|_| self.source.is_shown()),
        };
        match right {
            Some(help) => error.with_help(help),
            None => error,
        }
    }

    /// Any type that serde can read; `expected` says in words what it is.
    pub(crate) fn parse<T: Deserialize<'a>>(self, expected: &str) -> Result<T, LoadError> {
        let read = match self.is_json() {
            true => serde_json::from_str(self.text).ok(),
            false => raw::options().from_str(self.text).ok(),
        };
        read.ok_or_else(|| self.expected(expected))
    }

    pub(crate) fn string(self) -> Result<String, LoadError> {
        self.unquoted("a text in quotes")
    }

    fn unquoted(self, expected: &str) -> Result<String, LoadError> {
        match self.content() {
            Some(Content::Text(text)) => Ok((**text).into()),
            _ => self.parse(expected),
        }
    }

    /// A tuple `(…, …)` of any length; `expected` says in words what it is.
    pub(crate) fn tuple(self, expected: &str) -> Result<Vec<Self>, LoadError> {
        match self.content() {
            Some(Content::Tuple(items)) if self.is_argument(items) => {
                return Self::of_node(&items[0]).tuple(expected);
            }
            Some(Content::Tuple(items)) => return Ok(items.iter().map(Self::of_node).collect()),
            Some(Content::Failed(error)) => return Err(error.again()),
            Some(Content::Number(_)) if Expression::begins(self.text) => {
                let error = self.error(format!("expected {expected}, this gives one number"));
                let help = "points give three: `= midpoint(A, B)`, `= A + 0.5 * (B - A)`";
                return Err(error.unreadable().with_help(help));
            }
            _ if self.is_json() => return self.list(expected),
            _ => {}
        }
        let items = raw::tuple(self.text).ok_or_else(|| self.expected(expected))?;
        Ok(items.into_iter().map(|item| self.part(item)).collect())
    }

    /// A tuple of `N` values.
    pub(crate) fn array<const N: usize>(self, expected: &str) -> Result<[Self; N], LoadError> {
        let items = match self.content() {
            // One value stands for itself in JSON.
            Some(Content::Tuple(items)) if self.is_json() && N == 1 => {
                items.iter().map(Self::of_node).collect()
            }
            _ if self.is_json() && N == 1 => vec![self],
            _ => self.tuple(expected)?,
        };
        self.no_decimal_commas(&items, N, expected)?;
        items.try_into().map_err(|_| self.expected(expected))
    }

    /// Refuses the items of this tuple where they would be so many `wanted` ones with decimal commas,
    /// and are more.
    pub(crate) fn no_decimal_commas(
        self,
        items: &[Self],
        wanted: usize,
        expected: &str,
    ) -> Result<(), LoadError> {
        // What stands in for a part of the text stands elsewhere.
        let own = |item: &Self| Arc::ptr_eq(item.source, self.source);
        if items.len() == wanted || !items.iter().all(own) {
            return Ok(());
        }
        let texts: Vec<&str> = items.iter().map(|item| item.text).collect();
        match slips::decimal_commas(&texts, wanted) {
            Some(help) => Err(self.expected(expected).with_help(help)),
            None => Ok(()),
        }
    }

    /// A list `[…, …]`.
    pub(crate) fn list(self, expected: &str) -> Result<Vec<Self>, LoadError> {
        if let Some(Content::List(items)) = self.content() {
            return Ok(items.iter().map(Self::of_node).collect());
        }
        let items = match self.is_json() {
            true => json::items(self.text),
            false => raw::items(self.text),
        };
        let items = items.ok_or_else(|| self.expected(expected))?;
        Ok(items.into_iter().map(|item| self.part(item)).collect())
    }

    /// A map `{ "name": value, … }` in the order of the file; a name given twice is an error.
    pub(crate) fn map(self) -> Result<Vec<Entry<'a>>, LoadError> {
        if let Some(Content::Map(named)) = self.content() {
            return Ok(named.iter().map(Entry::of).collect());
        }
        let expected = "a map `{ \"name\": …, }`";
        let pairs = match self.is_json() {
            true => self.object(),
            false => raw::pairs(self.text).map(|pairs| self.each(pairs)),
        };
        let pairs = pairs.ok_or_else(|| self.expected(expected))?;
        let mut seen = HashMap::new();
        let mut entries = Vec::with_capacity(pairs.len());
        for (key, value) in pairs {
            let name = key.unquoted(NAME)?;
            if let Some(first) = seen.insert(name.clone(), key) {
                return Err(key
                    .error(format!("the name \"{name}\" is given twice"))
                    .with_help(first_at(first)));
            }
            entries.push(Entry { name, key, value });
        }
        Ok(entries)
    }

    /// The fields of a struct `(name: value, …)` in the order of the file: names and values.
    pub(crate) fn named(self, expected: &str) -> Result<Vec<(Self, Self)>, LoadError> {
        if let Some(Content::Fields(named)) = self.content() {
            // A field that was put there stands nowhere.
            let name = |own: &'a Named| match own.at.is_empty() {
                true => self.part(&own.name),
                false => Self::between(&own.source, &own.at),
            };
            let pair = |own: &'a Named| (name(own), Self::of_node(&own.value));
            return Ok(named.iter().map(pair).collect());
        }
        self.pieces().ok_or_else(|| self.expected(expected))
    }

    /// The fields of a struct as its text has them; `None` of anything else, a tuple too.
    pub(super) fn pieces(self) -> Option<Vec<(Self, Self)>> {
        if self.is_json() {
            let pair = |(key, value): (Self, Self)| Some((key.unescaped()?, value));
            return self.object()?.into_iter().map(pair).collect();
        }
        Some(self.each(raw::pieces(self.text)?))
    }

    /// Names and values of its text.
    fn each(self, pairs: Vec<(&'a str, &'a str)>) -> Vec<(Self, Self)> {
        let pair = |(name, value)| (self.part(name), self.part(value));
        pairs.into_iter().map(pair).collect()
    }

    /// A kind and its arguments: `Kind(…)` or `Kind`, whose arguments are `None`.
    pub(crate) fn variant(self, expected: &str) -> Result<(Self, Option<Self>), LoadError> {
        if let Some(Content::Kind(kind, inner)) = self.content() {
            let inner = inner.as_deref().map(Self::of_node);
            return Ok((Self::between(self.source, kind), inner));
        }
        if self.is_json() {
            return self.json_variant().ok_or_else(|| self.expected(expected));
        }
        let (kind, inner) = raw::variant(self.text).ok_or_else(|| self.expected(expected))?;
        Ok((self.part(kind), inner.map(|inner| self.part(inner))))
    }

    /// The parts of a value that is taken apart, or of a kind's arguments; `None` where it has none, or
    /// is not.
    pub(super) fn parts(self) -> Option<Parts> {
        match self.content()? {
            Content::Kind(_, Some(inner)) => Self::of_node(inner).parts(),
            Content::Map(named) | Content::Fields(named) => {
                let names = named.iter().map(|own| own.name.to_string());
                Some(Parts::Named(names.collect()))
            }
            Content::Tuple(items) | Content::List(items) => Some(Parts::Listed(items.len())),
            _ => None,
        }
    }

    /// The names, with their quotes, and the values of a JSON object.
    pub(super) fn object(self) -> Option<Vec<(Self, Self)>> {
        // With its quotes.
        let key = |source: &'a Arc<Source>, at: &Range<usize>| {
            Self::between(source, &(at.start.saturating_sub(1)..at.end + 1))
        };
        match self.content() {
            Some(Content::Map(named)) => {
                let pair = |own: &'a Named| {
                    let key = Self::between(&own.source, &own.at);
                    (key, Self::of_node(&own.value))
                };
                Some(named.iter().map(pair).collect())
            }
            Some(Content::Fields(named)) => {
                let pair = |own: &'a Named| (key(&own.source, &own.at), Self::of_node(&own.value));
                Some(named.iter().map(pair).collect())
            }
            Some(Content::Kind(kind, Some(inner))) => {
                let inner = Self::of_node(inner);
                let [value] = inner.array("").unwrap_or([inner]);
                Some(vec![(key(self.source, kind), value)])
            }
            _ => Some(self.each(json::pairs(self.text)?)),
        }
    }

    /// What stands between the quotes of a JSON text.
    fn unescaped(self) -> Option<Self> {
        json::inner(self.text).map(|inner| self.part(inner))
    }

    /// A JSON text, or an object of one name, as a kind.
    fn json_variant(self) -> Option<(Self, Option<Self>)> {
        if let Some(kind) = self.unescaped() {
            return Some((kind, None));
        }
        match &self.object()?[..] {
            [(key, value)] => {
                let value = (value.text != "null").then_some(*value);
                Some((key.unescaped()?, value))
            }
            _ => None,
        }
    }
}

/// What is right in the place of `null`.
const NULL: &str = "leave the field out where there is nothing to say";

/// What a key of a map is.
const NAME: &str = "a name in quotes";

/// Where something stood first that is given twice.
pub(crate) fn first_at(first: Fragment<'_>) -> String {
    let line = first.place().location().line;
    format!("it stands in line {line} already; remove one of the two")
}
