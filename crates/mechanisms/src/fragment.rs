//! One RON value as it stands in a file, and the ways to read it.
//!
//! A file is read value by value from the outside in. ron checks the grammar of the whole text
//! once; after that every value is a [`Fragment`], a piece of the file's own text (ron's
//! `RawValue` borrows it), so that its place is known to every error about it.

use std::fmt;
use std::sync::Arc;

use nalgebra::Vector3;
use ron::extensions::Extensions;
use ron::value::RawValue;
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};

use crate::error::LoadError;
use crate::source::{Place, Source};
use crate::syntax;

/// The text of one RON value, without the white space and comments around it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fragment<'a> {
    source: &'a Arc<Source>,
    text: &'a str,
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
        let text = raw.trim().get_ron();
        Self { source, text }
    }

    /// A part of this fragment's text.
    pub(crate) fn part(self, text: &'a str) -> Self {
        Self { text, ..self }
    }

    pub(crate) fn text(self) -> &'a str {
        self.text
    }

    pub(crate) fn source(self) -> &'a Arc<Source> {
        self.source
    }

    pub(crate) fn place(self) -> Place {
        // The text is a piece of the source's, so the distance of the two is its offset.
        let start = self.text.as_ptr() as usize;
        let start = start.saturating_sub(self.source.text().as_ptr() as usize);
        Place {
            source: Arc::clone(self.source),
            span: start..start + self.text.len(),
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
        self.error(format!("expected {expected}, found `{found}`"))
    }

    /// Any type that serde can read; `expected` says in words what it is.
    pub(crate) fn parse<T: Deserialize<'a>>(self, expected: &str) -> Result<T, LoadError> {
        options()
            .from_str(self.text)
            .map_err(|_| self.expected(expected))
    }

    /// A finite number.
    pub(crate) fn number(self) -> Result<f64, LoadError> {
        let number: f64 = self.parse("a number")?;
        if number.is_finite() {
            return Ok(number);
        }
        Err(self
            .error(format!("`{}` is not a finite number", self.text))
            .with_help("give a number such as 0.25 or 2.1e11"))
    }

    pub(crate) fn string(self) -> Result<String, LoadError> {
        self.parse("a text in quotes")
    }

    /// A tuple `(…, …)` of any length; `expected` says in words what it is.
    pub(crate) fn tuple(self, expected: &str) -> Result<Vec<Self>, LoadError> {
        let Tuple(items) = self.parse(expected)?;
        Ok(self.fragments(items))
    }

    /// A tuple of `N` values.
    pub(crate) fn array<const N: usize>(self, expected: &str) -> Result<[Self; N], LoadError> {
        let items = self.tuple(expected)?;
        items.try_into().map_err(|_| self.expected(expected))
    }

    /// A list `[…, …]`.
    pub(crate) fn list(self, expected: &str) -> Result<Vec<Self>, LoadError> {
        let items = self.parse(expected)?;
        Ok(self.fragments(items))
    }

    fn fragments(self, items: Vec<&'a RawValue>) -> Vec<Self> {
        let fragment = |raw| Self::of_raw(self.source, raw);
        items.into_iter().map(fragment).collect()
    }

    /// Three finite numbers.
    pub(crate) fn vector(self) -> Result<Vector3<f64>, LoadError> {
        let [x, y, z] = self.array("three numbers `(x, y, z)`")?;
        Ok(Vector3::new(x.number()?, y.number()?, z.number()?))
    }

    /// Three finite numbers, not all zero.
    pub(crate) fn direction(self) -> Result<Vector3<f64>, LoadError> {
        let vector = self.vector()?;
        if vector == Vector3::zeros() {
            return Err(self
                .error("a zero vector has no direction")
                .with_help("give a vector of any length but zero, such as (0.0, 0.0, 1.0)"));
        }
        Ok(vector)
    }

    /// A map `{ "name": value, … }` in the order of the file; a name given twice is an error.
    pub(crate) fn map(self) -> Result<Vec<Entry<'a>>, LoadError> {
        let Pairs(pairs) = self.parse("a map `{ \"name\": …, }`")?;
        let mut seen = std::collections::HashMap::new();
        let mut entries = Vec::with_capacity(pairs.len());
        for (key, value) in pairs {
            let key = Self::of_raw(self.source, key);
            let name = key.parse::<String>("a name in quotes")?;
            if let Some(first) = seen.insert(name.clone(), key) {
                return Err(key
                    .error(format!("the name \"{name}\" is given twice"))
                    .with_help(first_at(first)));
            }
            let value = Self::of_raw(self.source, value);
            entries.push(Entry { name, key, value });
        }
        Ok(entries)
    }

    /// The fields of a struct `(name: value, …)` in the order of the file: names and values.
    pub(crate) fn named(self, expected: &str) -> Result<Vec<(Self, Self)>, LoadError> {
        let Named(fields) = self.parse(expected)?;
        let pair = |(name, raw)| (self.part(name), Self::of_raw(self.source, raw));
        Ok(fields.into_iter().map(pair).collect())
    }

    /// A kind and its arguments: `Kind(…)` or `Kind`, whose arguments are `None`.
    pub(crate) fn variant(self, expected: &str) -> Result<(Self, Option<Self>), LoadError> {
        let wrong = |_| self.expected(expected);
        let mut deserializer = ron::Deserializer::from_str(self.text).map_err(wrong)?;
        let Identifier(kind) =
            Identifier::deserialize(&mut deserializer).map_err(|_| self.expected(expected))?;
        let rest = deserializer.remainder().trim();
        let arguments = (!rest.is_empty()).then(|| self.part(rest));
        Ok((self.part(kind), arguments))
    }
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

struct Named<'a>(Vec<(&'a str, &'a RawValue)>);

impl<'de> Deserialize<'de> for Named<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Fields;
        impl<'de> Visitor<'de> for Fields {
            type Value = Named<'de>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("named fields")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Named<'de>, A::Error> {
                let mut fields = Vec::new();
                while let Some((Identifier(name), value)) = map.next_entry()? {
                    fields.push((name, value));
                }
                Ok(Named(fields))
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
