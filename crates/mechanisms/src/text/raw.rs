//! The text of RON values: their parts, as pieces of the text itself, so that the place of each is
//! known.

use std::fmt;

use ron::error::SpannedError;
use ron::extensions::Extensions;
use ron::value::RawValue;
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};

/// ron, with the extensions of the file format.
pub(crate) fn options() -> ron::Options {
    ron::Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME)
        .with_default_extension(Extensions::UNWRAP_VARIANT_NEWTYPES)
}

/// The value that a text holds, without the white space and comments around it.
pub(crate) fn whole(text: &str) -> Result<&str, SpannedError> {
    options().from_str::<&RawValue>(text).map(text_of)
}

/// The items of a tuple `(…, …)` of any length; `None` of anything else.
pub(crate) fn tuple(text: &str) -> Option<Vec<&str>> {
    let Tuple(items) = options().from_str(text).ok()?;
    Some(items.into_iter().map(text_of).collect())
}

/// The items of a list `[…, …]`; `None` of anything else.
pub(crate) fn items(text: &str) -> Option<Vec<&str>> {
    let items: Vec<&RawValue> = options().from_str(text).ok()?;
    Some(items.into_iter().map(text_of).collect())
}

/// Names, with their quotes, and values of a map, those that are given twice too; `None` of anything
/// else.
pub(crate) fn pairs(text: &str) -> Option<Vec<(&str, &str)>> {
    let Pairs(pairs) = options().from_str(text).ok()?;
    let pair = |(key, value)| (text_of(key), text_of(value));
    Some(pairs.into_iter().map(pair).collect())
}

/// Names and values of fields `(name: value, …)`; `None` of anything else, a tuple too.
pub(crate) fn pieces(text: &str) -> Option<Vec<(&str, &str)>> {
    let Pieces(fields) = options().from_str(text).ok()?;
    let pair = |(name, value)| (name, text_of(value));
    Some(fields.into_iter().map(pair).collect())
}

/// A kind and its arguments with their parentheses, if it has some; `None` of anything else.
pub(crate) fn variant(text: &str) -> Option<(&str, Option<&str>)> {
    let mut deserializer = ron::Deserializer::from_str(text).ok()?;
    let Identifier(kind) = Identifier::deserialize(&mut deserializer).ok()?;
    let rest = deserializer.remainder().trim();
    Some((kind, (!rest.is_empty()).then_some(rest)))
}

/// The text of a value without the white space and comments around it.
fn text_of(raw: &RawValue) -> &str {
    raw.trim().get_ron()
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
