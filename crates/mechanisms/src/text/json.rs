//! The text of JSON values: their parts, as pieces of the text itself, so that the place of each is
//! known.
//!
//! serde_json checks the grammar of a whole text once; after that every value is a piece of it, which
//! its `RawValue` borrows.

use std::fmt;

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;

/// Most brackets inside one another: as many as ron reads.
pub(crate) const DEEPEST: usize = 128;

/// Whether a file is JSON: a mechanism or a batch in RON never begins with a brace.
pub(crate) fn is_json(text: &str) -> bool {
    text.trim_start().starts_with('{')
}

/// Whether a text is one JSON value.
pub(crate) fn is_value(text: &str) -> bool {
    whole(text).is_ok()
}

/// The value that a text holds, without the white space around it.
pub(crate) fn whole(text: &str) -> Result<&str, serde_json::Error> {
    serde_json::from_str::<&RawValue>(text).map(RawValue::get)
}

/// Where the first bracket stands that is inside of too many others.
pub(crate) fn too_deep(text: &str) -> Option<usize> {
    let (mut depth, mut quoted, mut escaped) = (0_usize, false, false);
    for (k, byte) in text.bytes().enumerate() {
        match byte {
            _ if escaped => escaped = false,
            b'\\' if quoted => escaped = true,
            b'"' => quoted = !quoted,
            _ if quoted => {}
            b'[' | b'{' => depth += 1,
            b']' | b'}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > DEEPEST {
            return Some(k);
        }
    }
    None
}

/// A number; `None` of anything else.
pub(crate) fn number(text: &str) -> Option<f64> {
    let begins = text.starts_with(|c: char| c == '-' || c.is_ascii_digit());
    text.parse().ok().filter(|_| begins)
}

/// The items of an array; `None` of anything else.
pub(crate) fn items(text: &str) -> Option<Vec<&str>> {
    let items: Vec<&RawValue> = serde_json::from_str(text).ok()?;
    Some(items.into_iter().map(RawValue::get).collect())
}

/// Names, with their quotes, and values of an object in its order, those that are given twice too;
/// `None` of anything else.
pub(crate) fn pairs(text: &str) -> Option<Vec<(&str, &str)>> {
    let Pairs(pairs) = serde_json::from_str(text).ok()?;
    let pairs = pairs.into_iter();
    Some(pairs.map(|(key, value)| (key.get(), value.get())).collect())
}

/// What stands between the quotes of a text, as it is written; `None` of anything else.
pub(crate) fn inner(text: &str) -> Option<&str> {
    text.strip_prefix('"')?.strip_suffix('"')
}

/// Whether an object of these names is a kind with its arguments, `{"Revolute": …}`: one name with a
/// capital, as no field has.
pub(crate) fn is_kind<'n>(mut names: impl Iterator<Item = &'n str>) -> bool {
    match (names.next(), names.next()) {
        (Some(name), None) => name.starts_with(char::is_uppercase),
        _ => false,
    }
}

struct Pairs<'a>(Vec<(&'a RawValue, &'a RawValue)>);

impl<'de> Deserialize<'de> for Pairs<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Entries;
        impl<'de> Visitor<'de> for Entries {
            type Value = Pairs<'de>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_pieces_of_the_text() {
        let text = r#" { "a" : [1, {"b": "]}"}], "a": null, "\u0041": -2.5e1 } "#;
        let whole = whole(text).unwrap();
        let pairs = pairs(whole).unwrap();
        let listed = [
            ("\"a\"", "[1, {\"b\": \"]}\"}]"),
            ("\"a\"", "null"),
            ("\"\\u0041\"", "-2.5e1"),
        ];
        assert_eq!(pairs, listed);
        let within = text.as_bytes().as_ptr_range();
        for (key, value) in pairs {
            assert!(within.contains(&key.as_ptr()) && within.contains(&value.as_ptr()));
        }
        assert_eq!(items("[1, [2], {}]"), Some(vec!["1", "[2]", "{}"]));
        assert_eq!(items("{}"), None);
        assert_eq!(number("-2.5e1"), Some(-25.0));
        assert_eq!(number("null"), None);
        assert_eq!(number("1e999"), Some(f64::INFINITY));
    }

    #[test]
    fn what_begins_with_a_brace_is_json() {
        assert!(is_json("\n {\"name\": 1}"));
        assert!(!is_json("// {\n(name: 1)"));
        assert!(!is_json(""));
    }

    #[test]
    fn brackets_in_texts_are_none() {
        let deep = "[".repeat(DEEPEST);
        assert_eq!(too_deep(&deep), None);
        assert_eq!(too_deep(&format!("{deep}\"[[\\\"[\"")), None);
        assert_eq!(too_deep(&format!("{deep} [")), Some(DEEPEST + 1));
    }

    #[test]
    fn one_name_with_a_capital_is_a_kind() {
        assert!(is_kind(["Revolute"].into_iter()));
        assert!(!is_kind(["young"].into_iter()));
        assert!(!is_kind(["A", "B"].into_iter()));
        assert!(!is_kind([].into_iter()));
    }
}
