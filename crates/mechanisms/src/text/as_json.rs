//! A tree as JSON, on one line: the same names, in the order of the file.

use std::sync::Arc;

use super::fragment::Fragment;
use super::json;
use super::source::Source;
use super::tree::{Content, Named, Node};

impl Node {
    /// The JSON of it. Enums are as serde_json writes them.
    pub(crate) fn json(&self) -> String {
        match &self.content {
            // As it is written, where JSON can be written so.
            Content::Number(_)
                if json::number(self.text()).is_some() && json::is_value(self.text()) =>
            {
                self.text().into()
            }
            Content::Number(number) => format!("{number:?}"),
            Content::Text(text) => quoted(text),
            Content::Tuple(items) | Content::List(items) => list(items),
            Content::Map(named) | Content::Fields(named) => object(named),
            Content::Kind(kind, inner) => {
                let kind = self.source().text().get(kind.clone()).unwrap_or("");
                match (kind, inner.as_deref()) {
                    ("true" | "false", None) => kind.into(),
                    (kind, None) => quoted(kind),
                    (kind, Some(inner)) => format!("{{{}: {}}}", quoted(kind), inner.argument()),
                }
            }
            // As it is written: a text in quotes; what a made number is, has no other text.
            Content::Measured(..) if !self.text().starts_with('"') => self.text().into(),
            Content::Measured(..) | Content::Expression(_) | Content::Failed(_) => {
                match Fragment::at(&self.place()).string() {
                    Ok(text) => quoted(&text),
                    Err(_) => quoted(self.text()),
                }
            }
            Content::Other if self.source().is_json() => self.text().into(),
            Content::Other => quoted(self.text()),
        }
    }

    /// What stands in the parentheses of a kind: one value stands for itself.
    fn argument(&self) -> String {
        match &self.content {
            Content::Tuple(items) if items.len() == 1 => items[0].json(),
            _ => self.json(),
        }
    }
}

/// A text in RON as JSON, on one line; as it is where it has no value.
pub(crate) fn as_json(source: &Arc<Source>) -> String {
    match Fragment::of_file(source) {
        Ok(value) => Node::of(value).json(),
        Err(_) => source.text().into(),
    }
}

fn list(items: &[Node]) -> String {
    let items: Vec<String> = items.iter().map(Node::json).collect();
    format!("[{}]", items.join(", "))
}

fn object(named: &[Named]) -> String {
    let named = named.iter();
    let named: Vec<String> = named
        .map(|own| format!("{}: {}", quoted(&own.name), own.value.json()))
        .collect();
    format!("{{{}}}", named.join(", "))
}

/// A text in quotes.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
