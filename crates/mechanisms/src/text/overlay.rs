//! What stands in for some values of a text, and what is known of the text from reading it before.
//!
//! A design of a batch is its mechanism's own text with other values at some places. It is read by
//! the same loader as any mechanism, by way of [`Fragment`]s under an [`Overlay`]: it hands out the
//! values that stand in, and saves taking the rest of the text apart again for every design.

use std::cell::RefCell;
use std::collections::HashMap;
use std::ops::Range;

use super::fragment::Fragment;

/// Values that stand in for others of one text, and a memory of that text.
#[derive(Debug)]
pub(crate) struct Overlay<'a> {
    replaced: Vec<(Range<usize>, Fragment<'a>)>,
    memory: Memory<'a>,
}

/// What was found in a text when it was read: parts, numbers and strings by place.
#[derive(Debug, Default)]
pub(crate) struct Known(HashMap<(Range<usize>, Form), Content>);

/// The ways to read a fragment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Form {
    Tuple,
    List,
    /// Names and values by turns.
    Map,
    /// Names and values by turns.
    Named,
    /// The kind and, where it has any, its arguments.
    Variant,
    Number,
    String,
}

#[derive(Debug)]
enum Content {
    Parts(Vec<Range<usize>>),
    Number(f64),
    String(String),
}

#[derive(Debug)]
enum Memory<'a> {
    Learn(&'a RefCell<Known>),
    Recall(&'a Known),
}

impl<'a> Overlay<'a> {
    /// Nothing stands in; what is read is noted in `known`.
    pub(crate) fn learning(known: &'a RefCell<Known>) -> Self {
        Self {
            replaced: Vec::new(),
            memory: Memory::Learn(known),
        }
    }

    /// Fragments that stand in for the values at these bytes of a text of which much is `known`.
    pub(crate) fn new(replaced: Vec<(Range<usize>, Fragment<'a>)>, known: &'a Known) -> Self {
        Self {
            replaced,
            memory: Memory::Recall(known),
        }
    }

    /// What stands in for a value.
    pub(crate) fn replacement(&self, value: Fragment<'a>) -> Option<Fragment<'a>> {
        if self.replaced.is_empty() {
            return None;
        }
        let span = value.span();
        let replaced = self.replaced.iter().find(|(at, _)| *at == span);
        replaced.map(|(_, instead)| *instead)
    }

    /// The known parts of a fragment.
    pub(crate) fn parts(&self, whole: Fragment<'a>, form: Form) -> Option<Vec<&'a str>> {
        match self.recall(whole, form)? {
            Content::Parts(parts) => {
                let text = whole.source().text();
                let part = |span: &Range<usize>| text.get(span.clone());
                parts.iter().map(part).collect()
            }
            _ => None,
        }
    }

    /// The known number that a fragment is.
    pub(crate) fn number(&self, fragment: Fragment<'a>) -> Option<f64> {
        match self.recall(fragment, Form::Number)? {
            Content::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// The known string that a fragment is, without its quotes.
    pub(crate) fn string(&self, fragment: Fragment<'a>) -> Option<String> {
        match self.recall(fragment, Form::String)? {
            Content::String(string) => Some(string.clone()),
            _ => None,
        }
    }

    /// Notes the parts of a fragment.
    pub(crate) fn learn_parts(&self, whole: Fragment<'a>, form: Form, parts: Vec<Range<usize>>) {
        self.learn(whole, form, || Content::Parts(parts));
    }

    /// Notes the number that a fragment is.
    pub(crate) fn learn_number(&self, fragment: Fragment<'a>, number: f64) {
        self.learn(fragment, Form::Number, || Content::Number(number));
    }

    /// Notes the string that a fragment is.
    pub(crate) fn learn_string(&self, fragment: Fragment<'a>, string: &str) {
        self.learn(fragment, Form::String, || Content::String(string.into()));
    }

    fn recall(&self, fragment: Fragment<'a>, form: Form) -> Option<&'a Content> {
        match self.memory {
            Memory::Recall(Known(known)) => known.get(&(fragment.span(), form)),
            Memory::Learn(_) => None,
        }
    }

    fn learn(&self, fragment: Fragment<'a>, form: Form, content: impl FnOnce() -> Content) {
        if let Memory::Learn(known) = self.memory {
            let key = (fragment.span(), form);
            known.borrow_mut().0.insert(key, content());
        }
    }
}
