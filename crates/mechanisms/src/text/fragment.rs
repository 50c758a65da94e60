//! One RON value as it stands in a file, and the ways to read it.
//!
//! A file is read value by value from the outside in. ron checks the grammar of the whole text
//! once; after that every value is a [`Fragment`], a piece of the file's own text (ron's
//! `RawValue` borrows it), so that its place is known to every error about it.

use std::collections::HashMap;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use ron::extensions::Extensions;
use ron::value::RawValue;
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};

use super::expression::Expression;
use super::source::{Place, Source};
use super::tree::{Content, Named, Node};
use crate::error::LoadError;
use crate::text::{slips, syntax};

/// The text of one RON value, without the white space and comments around it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fragment<'a> {
    source: &'a Arc<Source>,
    pub(super) text: &'a str,
    /// The value, taken apart.
    node: Option<&'a Node>,
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

/// ron, with the extensions of the file format.
pub(crate) fn options() -> ron::Options {
    ron::Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME)
        .with_default_extension(Extensions::UNWRAP_VARIANT_NEWTYPES)
}

impl<'a> Fragment<'a> {
    /// The value that a whole file holds.
    pub(crate) fn of_file(source: &'a Arc<Source>) -> Result<Self, LoadError> {
        match options().from_str::<&RawValue>(source.text()) {
            Ok(raw) => Ok(Self::of_raw(source, raw)),
            Err(error) => Err(syntax::error(source, &error)),
        }
    }

    fn of_raw(source: &'a Arc<Source>, raw: &'a RawValue) -> Self {
        Self {
            source,
            text: text_of(raw),
            node: None,
        }
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

    /// The part of this fragment's text between these bytes of the source.
    fn between(self, span: &Range<usize>) -> Self {
        self.part(self.source.text().get(span.clone()).unwrap_or(""))
    }

    pub(super) fn content(self) -> Option<&'a Content> {
        self.node.map(|node| &node.content)
    }

    pub(crate) fn text(self) -> &'a str {
        self.text
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
        let error = self
            .error(format!("expected {expected}, found `{found}`"))
            .unreadable();
        // What is right instead shows what is wrong.
        let right = slips::in_value(self.text, expected).filter(|_| self.source.is_shown());
        match right {
            Some(help) => error.with_help(help),
            None => error,
        }
    }

    /// Any type that serde can read; `expected` says in words what it is.
    pub(crate) fn parse<T: Deserialize<'a>>(self, expected: &str) -> Result<T, LoadError> {
        options()
            .from_str(self.text)
            .map_err(|_| self.expected(expected))
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
            Some(Content::Tuple(items)) => return Ok(items.iter().map(Self::of_node).collect()),
            Some(Content::Failed(error)) => return Err(error.again()),
            Some(Content::Number(_)) if Expression::begins(self.text) => {
                let error = self.error(format!("expected {expected}, this gives one number"));
                let help = "points give three: `= midpoint(A, B)`, `= A + 0.5 * (B - A)`";
                return Err(error.unreadable().with_help(help));
            }
            _ => {}
        }
        let Tuple(items) = self.parse(expected)?;
        Ok((items.into_iter())
            .map(|raw| self.part(text_of(raw)))
            .collect())
    }

    /// A tuple of `N` values.
    pub(crate) fn array<const N: usize>(self, expected: &str) -> Result<[Self; N], LoadError> {
        let items = self.tuple(expected)?;
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
        let items: Vec<&RawValue> = self.parse(expected)?;
        Ok((items.into_iter())
            .map(|raw| self.part(text_of(raw)))
            .collect())
    }

    /// A map `{ "name": value, … }` in the order of the file; a name given twice is an error.
    pub(crate) fn map(self) -> Result<Vec<Entry<'a>>, LoadError> {
        if let Some(Content::Map(named)) = self.content() {
            let entry = |own: &'a Named| Entry {
                name: (*own.name).into(),
                key: self.between(&own.at),
                value: Self::of_node(&own.value),
            };
            return Ok(named.iter().map(entry).collect());
        }
        let Pairs(pairs) = self.parse("a map `{ \"name\": …, }`")?;
        let mut seen = HashMap::new();
        let mut entries = Vec::with_capacity(pairs.len());
        for (key, value) in pairs {
            let key = self.part(text_of(key));
            let name = key.unquoted(NAME)?;
            if let Some(first) = seen.insert(name.clone(), key) {
                return Err(key
                    .error(format!("the name \"{name}\" is given twice"))
                    .with_help(first_at(first)));
            }
            entries.push(Entry {
                name,
                key,
                value: self.part(text_of(value)),
            });
        }
        Ok(entries)
    }

    /// The fields of a struct `(name: value, …)` in the order of the file: names and values.
    pub(crate) fn named(self, expected: &str) -> Result<Vec<(Self, Self)>, LoadError> {
        if let Some(Content::Fields(named)) = self.content() {
            // A field that was put there stands nowhere.
            let name = |own: &'a Named| match own.at.is_empty() {
                true => self.part(&own.name),
                false => self.between(&own.at),
            };
            let pair = |own: &'a Named| (name(own), Self::of_node(&own.value));
            return Ok(named.iter().map(pair).collect());
        }
        self.pieces().ok_or_else(|| self.expected(expected))
    }

    /// The fields of a struct as its text has them; `None` of anything else, a tuple too.
    pub(super) fn pieces(self) -> Option<Vec<(Self, Self)>> {
        let Pieces(fields) = options().from_str(self.text).ok()?;
        let pair = |(name, raw)| (self.part(name), self.part(text_of(raw)));
        Some(fields.into_iter().map(pair).collect())
    }

    /// A kind and its arguments: `Kind(…)` or `Kind`, whose arguments are `None`.
    pub(crate) fn variant(self, expected: &str) -> Result<(Self, Option<Self>), LoadError> {
        if let Some(Content::Kind(kind, inner)) = self.content() {
            let inner = inner.as_deref().map(Self::of_node);
            return Ok((self.between(kind), inner));
        }
        let wrong = |_| self.expected(expected);
        let mut deserializer = ron::Deserializer::from_str(self.text).map_err(wrong)?;
        let Identifier(kind) =
            Identifier::deserialize(&mut deserializer).map_err(|_| self.expected(expected))?;
        let rest = deserializer.remainder().trim();
        let inner = (!rest.is_empty()).then(|| self.part(rest));
        Ok((self.part(kind), inner))
    }
}

/// What a key of a map is.
const NAME: &str = "a name in quotes";

/// The text of a value without the white space and comments around it.
fn text_of(raw: &RawValue) -> &str {
    raw.trim().get_ron()
}

/// Where something stood first that is given twice.
pub(crate) fn first_at(first: Fragment<'_>) -> String {
    let line = first.place().location().line;
    format!("it stands in line {line} already; remove one of the two")
}

struct Tuple<'a>(Vec<&'a RawValue>);

impl<'de> Deserialize<'de> for Tuple<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Items;
        impl<'de> Visitor<'de> for Items {
            type Value = Tuple<'de>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a tuple")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Tuple<'de>, A::Error> {
                let mut items = Vec::new();
                while let Some(item) = seq.next_element()? {
                    items.push(item);
                }
                Ok(Tuple(items))
            }
        }
        deserializer.deserialize_tuple(0, Items)
    }
}

struct Pairs<'a>(Vec<(&'a RawValue, &'a RawValue)>);

impl<'de> Deserialize<'de> for Pairs<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Entries;
        impl<'de> Visitor<'de> for Entries {
            type Value = Pairs<'de>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a map")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Pairs<'de>, A::Error> {
                let mut pairs = Vec::new();
                while let Some(pair) = map.next_entry()? {
                    pairs.push(pair);
                }
                Ok(Pairs(pairs))
            }
        }
        deserializer.deserialize_map(Entries)
    }
}

struct Pieces<'a>(Vec<(&'a str, &'a RawValue)>);

impl<'de> Deserialize<'de> for Pieces<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Fields;
        impl<'de> Visitor<'de> for Fields {
            type Value = Pieces<'de>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("named fields")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Pieces<'de>, A::Error> {
                let mut fields = Vec::new();
                while let Some((Identifier(name), value)) = map.next_entry()? {
                    fields.push((name, value));
                }
                Ok(Pieces(fields))
            }
        }
        deserializer.deserialize_struct("", &[], Fields)
    }
}

struct Identifier<'a>(&'a str);

impl<'de> Deserialize<'de> for Identifier<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Name;
        impl<'de> Visitor<'de> for Name {
            type Value = Identifier<'de>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an identifier")
            }
            fn visit_borrowed_str<E>(self, name: &'de str) -> Result<Identifier<'de>, E> {
                Ok(Identifier(name))
            }
        }
        deserializer.deserialize_identifier(Name)
    }
}
