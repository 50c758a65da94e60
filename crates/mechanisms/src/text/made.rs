//! Values of a tree that are made from others: they keep the place of what they are made from.

use std::sync::Arc;

use super::source::Place;
use super::tree::{Content, Named, Node};

impl Named {
    /// An entry that stands where this one does.
    pub(crate) fn with(&self, name: &str, value: Node) -> Self {
        Self {
            name: name.into(),
            value,
            ..self.clone()
        }
    }

    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    pub(crate) fn value(&self) -> &Node {
        &self.value
    }

    /// Where the name stands.
    pub(crate) fn place(&self) -> Place {
        Place {
            source: Arc::clone(&self.source),
            span: self.at.clone(),
        }
    }
}

impl Node {
    /// The entries of a map, or the fields of a struct or of a kind; nothing of anything else.
    pub(crate) fn entries(&self) -> &[Named] {
        match &self.content {
            Content::Map(named) | Content::Fields(named) => named,
            Content::Kind(_, Some(inner)) => inner.entries(),
            _ => &[],
        }
    }

    /// The items of a list or tuple; nothing of anything else.
    pub(crate) fn items(&self) -> &[Self] {
        match &self.content {
            Content::Tuple(items) | Content::List(items) => items,
            Content::Kind(_, Some(inner)) => inner.items(),
            _ => &[],
        }
    }

    /// The text that it is, if it is one.
    pub(crate) fn as_text(&self) -> Option<&str> {
        match &self.content {
            Content::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The value of a field or an entry.
    pub(crate) fn get(&self, name: &str) -> Option<&Self> {
        let entries = self.entries().iter();
        entries
            .rev()
            .find(|own| *own.name == *name)
            .map(Named::value)
    }

    /// A text in its place.
    pub(crate) fn text_in_place(&self, text: &str) -> Self {
        self.with(Content::Text(text.into()))
    }

    /// A number in its place.
    pub(crate) fn number_in_place(&self, number: f64) -> Self {
        self.with(Content::Number(number))
    }

    /// Numbers in its place, each in that of its item where it has one.
    pub(crate) fn numbers_in_place(&self, numbers: &[f64]) -> Self {
        let items = self.items();
        let number =
            |(k, &number): (usize, &f64)| items.get(k).unwrap_or(self).number_in_place(number);
        self.with(Content::Tuple(
            numbers.iter().enumerate().map(number).collect(),
        ))
    }

    /// A list in its place.
    pub(crate) fn list_in_place(&self, items: Vec<Self>) -> Self {
        self.with(Content::List(items.into()))
    }

    /// A map in its place.
    pub(crate) fn map_in_place(&self, entries: Vec<Named>) -> Self {
        self.with(Content::Map(entries.into()))
    }

    /// Fields in its place.
    pub(crate) fn fields_in_place(&self, fields: Vec<(&str, Self)>) -> Self {
        let field = |(name, value): (&str, Self)| self.named(name, value);
        self.with(Content::Fields(fields.into_iter().map(field).collect()))
    }

    /// A field that stands nowhere.
    fn named(&self, name: &str, value: Self) -> Named {
        Named {
            name: name.into(),
            source: Arc::clone(self.source()),
            at: 0..0,
            value,
        }
    }

    /// The same with every item of a list or a tuple, or of the arguments of a kind, made anew.
    pub(crate) fn map_items(&self, item: impl FnMut(&Self) -> Self) -> Self {
        match &self.content {
            Content::Tuple(own) => self.with(Content::Tuple(own.iter().map(item).collect())),
            Content::List(own) => self.with(Content::List(own.iter().map(item).collect())),
            Content::Kind(kind, Some(inner)) => {
                let inner = Arc::new(inner.map_items(item));
                self.with(Content::Kind(kind.clone(), Some(inner)))
            }
            _ => self.clone(),
        }
    }

    /// The same with a field or an entry, of a struct, a map, or the arguments of a kind: in the place of
    /// the one of this name, else as the last one.
    pub(crate) fn with_field(&self, name: &str, value: Self) -> Self {
        let set = |named: &Arc<[Named]>, value: Self| {
            let mut named = named.to_vec();
            match named.iter_mut().find(|own| *own.name == *name) {
                Some(own) => own.value = value,
                None => named.push(self.named(name, value)),
            }
            named.into()
        };
        match &self.content {
            Content::Map(named) => self.with(Content::Map(set(named, value))),
            Content::Fields(named) => self.with(Content::Fields(set(named, value))),
            Content::Kind(kind, inner) => {
                let inner = match inner {
                    Some(inner) => inner.with_field(name, value),
                    None => self.fields_in_place(vec![(name, value)]),
                };
                self.with(Content::Kind(kind.clone(), Some(Arc::new(inner))))
            }
            // A kind without arguments is a text in JSON.
            Content::Text(_) if self.source().is_json() => {
                let quoted = self.place().span;
                let kind = quoted.start + 1..quoted.end.saturating_sub(1);
                let inner = self.fields_in_place(vec![(name, value)]);
                self.with(Content::Kind(kind, Some(Arc::new(inner))))
            }
            _ => self.clone(),
        }
    }

    /// The same without a field or an entry.
    pub(crate) fn without_field(&self, name: &str) -> Self {
        let rest = |named: &Arc<[Named]>| {
            let others = named.iter().filter(|own| *own.name != *name);
            others.cloned().collect()
        };
        match &self.content {
            Content::Map(named) => self.with(Content::Map(rest(named))),
            Content::Fields(named) => self.with(Content::Fields(rest(named))),
            _ => self.clone(),
        }
    }

    /// The kind that it names, if it is one: `Fixed` of `Fixed` and of `Fixed(…)`.
    pub(crate) fn kind(&self) -> Option<&str> {
        match &self.content {
            Content::Kind(kind, _) => self.source().text().get(kind.clone()),
            _ => None,
        }
    }
}
